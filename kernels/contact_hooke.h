/* `law: hooke`, the linear spring-dashpot of Cundall & Strack (1979) as Pournin et al. (2005, eqs. 2-7) use
 * it: f_n = k_n xi + c_n dxi/dt, k_t and c_t alike.
 * OZ_SMOOTH (`damping: smooth`): the dashpot is scaled by w xi / sqrt((w xi)^2 + (dxi/dt)^2), w^2 = k_n/m:
 * nothing at first touch, where a constant dashpot makes the force jump, all of it at the deepest point. The
 * force stays homogeneous of degree one in (xi, dxi/dt), so restitution and duration do not depend on speed;
 * host/model/contact.h solves both for k_n and c_n.
 * OZ_AT_CONTACT (`restitution_at: contact`): the oscillator's mass is the one that the contact feels, m_c
 * = lightness^2 m, and c_n is scaled by sqrt(m_c/m), so that its damping ratio and with it the restitution
 * stay what was asked; k_n is kept. */
#pragma once

#include "kernels/contact.h"

OZ_INLINE OzResponse oz_contact_hooke(OzContact c, OZ_LAW law)
{
    OzResponse out;
    out.spring = c.mass * law.stiffness * c.overlap;
    out.dashpot = c.mass * law.damping * c.rate;
    if (OZ_AT_CONTACT) {
        out.dashpot *= c.lightness;
    }
    if (OZ_SMOOTH) {
        real felt = OZ_AT_CONTACT ? c.rate * c.lightness : c.rate;
        real swing2 = law.stiffness * c.overlap * c.overlap;
        real size2 = oz_larger(swing2 + felt * felt, REAL(OZ_TINY * OZ_TINY));
        out.dashpot *= sqrt(swing2 / size2);
    }
    out.energy = REAL(0.5) * out.spring * c.overlap;
    out.tangential_stiffness = c.mass * law.tangential_stiffness;
    out.tangential_damping = c.mass * law.tangential_damping;
    return out;
}
