/* `law: hertz-mindlin`: elastic spheres of effective modulus E* and radius R* (a rod's cap and mantle count
 * as spheres of its radius; walls as flat). Normal: Hertz's K xi^(3/2), K = 4/3 E* sqrt(R*), with the dashpot
 * alpha sqrt(m* K) xi^(1/4) dxi/dt of Tsuji, Tanaka & Ishida (1992), whose alpha gives the restitution asked
 * at every speed (Antypov & Elliott 2011). Tangential: Mindlin's stiffness 8 G* sqrt(R* xi) on the spring
 * carried along; its dashpot is a share of the normal one. The spring is kept as a length, so a contact that
 * is loaded while stretched gains what it loses unloaded the same way.
 * Constants: stiffness 4/3 E*, Pa; damping alpha, 1; tangential_stiffness 8 G*, Pa; tangential_damping: c_t
 * over the normal dashpot's constant, 1; friction. */
#pragma once

#include "kernels/contact.h"

OZ_INLINE OzResponse oz_contact_hertz_mindlin(OzContact c, OZ_LAW law)
{
    OzResponse out;
    real overlap = oz_larger(c.overlap, REAL(0.0));
    real half_width = sqrt(c.radius * overlap); /* m, of the touching disc */
    real stiffness = law.stiffness * half_width; /* N/m: force over overlap  */
    real damping = law.damping * sqrt(c.mass * stiffness);
    if (OZ_AT_CONTACT) {
        damping *= c.lightness;
    }
    out.spring = stiffness * overlap;
    out.dashpot = damping * c.rate;
    out.energy = REAL(0.4) * out.spring * overlap;
    out.tangential_stiffness = law.tangential_stiffness * half_width;
    out.tangential_damping = law.tangential_damping * damping;
    return out;
}
