/* `law: hertz` as Poeschel & Buchholtz (1995, eqs. 10, 11, 13) use it: f_n = Y xi^(3/2) + m* gamma_n dxi/dt
 * and, after Haff & Werner (1986), the tangential force m* gamma_t v_t without memory, limited by Coulomb
 * friction. Constants: stiffness Y, N/m^(3/2); damping gamma_n and tangential_damping gamma_t, 1/s; friction. */
#pragma once

#include "kernels/contact.h"

OZ_INLINE OzResponse oz_contact_hertz(OzContact c, OZ_LAW law)
{
    OzResponse out;
    real overlap = oz_larger(c.overlap, REAL(0.0));
    out.spring = law.stiffness * overlap * sqrt(overlap);
    out.dashpot = c.mass * law.damping * c.rate;
    out.energy = REAL(0.4) * out.spring * overlap;
    out.tangential_stiffness = REAL(0.0);
    out.tangential_damping = c.mass * law.tangential_damping;
    return out;
}
