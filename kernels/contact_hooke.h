/* The linear spring-dashpot contact of Cundall & Strack (1979) as Pournin et al. (2005, eqs. 2-7) use it:
 * f_n = k_n xi + c_n dxi/dt, f_t = k_t xi_t + c_t dxi_t/dt, limited by Coulomb friction.
 * Switches (each 0 or 1, constant on a device): OZ_FRICTION, OZ_HISTORY (a tangential spring exists),
 * OZ_SLIP_SCALE (P: the force alone is limited and the spring grows on; otherwise the spring is cut back
 * to what the sliding contact carries), OZ_ATTRACTION_CLAMP (f_n >= 0). */
#ifndef OZ_KERNELS_CONTACT_HOOKE_H
#define OZ_KERNELS_CONTACT_HOOKE_H

#include "kernels/contact.h"

/* Cuts the tangential force to the Coulomb limit and the spring to what the sliding contact carries.
 * *dashpot is none then: what sliding takes is friction's, or the ledger would count a dashpot that the
 * limit never let act, and friction as negative. */
OZ_INLINE OzVec3 oz_contact_hooke_limit(OzVec3 tangential, real limit, OzVec3 *dashpot, real stiffness,
                                        OzVec3 *stretch)
{
    real size2 = oz_dot(tangential, tangential);
    mask slips = size2 > limit * limit;
    real cut = slips ? limit / sqrt(oz_larger(size2, REAL(OZ_TINY * OZ_TINY))) : REAL(1.0);
    tangential = oz_scale(tangential, cut);
    if (OZ_HISTORY & !OZ_SLIP_SCALE) {
        /* a contact without a spring, in a scene where others have one, carries nothing */
        real compliance = stiffness > REAL(0.0) ? REAL(1.0) / stiffness : REAL(0.0);
        OzVec3 carried = oz_scale(oz_minus(tangential, *dashpot), compliance);
        *stretch = oz_choose(slips, carried, *stretch);
    }
    *dashpot = oz_choose(slips, oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0)), *dashpot);
    return tangential;
}

/* *history is the tangential spring as stored between steps, zero before first touch; it is replaced. The
 * share of the step by which it is advanced before the force (the rest after it) is the integrator's:
 * 0 explicit, 1/2 second order, 1 symplectic. */
OZ_INLINE OzContactForce oz_contact_hooke(OzContact c, OzLawConstants law, OzVec3 *history, scalar dt,
                                          scalar share)
{
    OzContactForce out;
    OzVec3 none = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0));
    real rate = -oz_dot(c.velocity, c.normal); /* d(overlap)/dt */
    real spring = c.mass * law.stiffness * c.overlap;
    out.dashpot = c.mass * law.damping * rate;
    if (OZ_ATTRACTION_CLAMP) {
        out.dashpot = oz_larger(out.dashpot, -spring);
    }
    real normal_force = spring + out.dashpot;
    OzVec3 tangential = none;
    out.dashpot_tangential = none;
    out.stretch = none;
    out.stretched = none;
    if (OZ_FRICTION) {
        /* d(xi_t)/dt, against the relative velocity (P eq. 6) */
        OzVec3 sliding = oz_scale(oz_along(c.velocity, rate, c.normal), REAL(-1.0));
        real stiffness = c.mass * law.tangential_stiffness;
        out.dashpot_tangential = oz_scale(sliding, c.mass * law.tangential_damping);
        tangential = out.dashpot_tangential;
        if (OZ_HISTORY) {
            OzVec3 turned = oz_contact_turn(*history, c.normal);
            out.stretched = oz_along(turned, REAL(share * dt), sliding);
            tangential = oz_along(tangential, stiffness, out.stretched);
        }
        out.stretch = out.stretched;
        tangential = oz_contact_hooke_limit(tangential, law.friction * oz_magnitude(normal_force),
                                            &out.dashpot_tangential, stiffness, &out.stretch);
        if (OZ_HISTORY) {
            OzVec3 next = oz_along(out.stretch, REAL((1 - share) * dt), sliding);
            *history = oz_where(c.touching, next);
        }
    }
    out.force = oz_where(c.touching, oz_along(tangential, normal_force, c.normal));
    return out;
}

#endif
