/* The law of the scene, Coulomb friction, and both put together: from a contact to what it does.
 * Switches (constant on a device): OZ_LAW_ID (the law's row in laws.h), OZ_ATTRACTION_CLAMP (f_n >= 0),
 * OZ_FRICTION, OZ_HISTORY (a tangential spring exists), OZ_SLIP_SCALE (P: the force alone is limited and the
 * spring grows on; otherwise the spring is cut back to what the sliding contact carries). */
#ifndef OZ_KERNELS_CONTACT_LAW_H
#define OZ_KERNELS_CONTACT_LAW_H

#include "kernels/contact_hertz.h"
#include "kernels/contact_hertz_mindlin.h"
#include "kernels/contact_hooke.h"
#include "kernels/laws.h"

OZ_INLINE OzResponse oz_contact_response(OzContact c, OzLawConstants law)
{
    OzResponse response = {REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0)};
#define OZ_CONTACT_LAW_ROW(NAME, name, choice, linear, stiffness, damping)                         \
    if (OZ_LAW_ID == OZ_LAW_##NAME) {                                                              \
        response = oz_contact_##name(c, law);                                                      \
    }
    OZ_LAWS(OZ_CONTACT_LAW_ROW)
#undef OZ_CONTACT_LAW_ROW
    if (OZ_ATTRACTION_CLAMP) {
        response.dashpot = oz_larger(response.dashpot, -response.spring);
    }
    return response;
}

/* Cuts the tangential force to the Coulomb limit and the spring to what the sliding contact carries.
 * *dashpot is none then: what sliding takes is friction's, or the ledger would count a dashpot that the
 * limit never let act, and friction as negative. */
OZ_INLINE OzVec3 oz_contact_limit(OzVec3 tangential, real limit, OzVec3 *dashpot, real stiffness,
                                  OzVec3 *stretch)
{
    real size2 = oz_dot(tangential, tangential);
    mask slips = size2 > limit * limit;
    real cut = slips ? limit * oz_inverse_root(oz_larger(size2, REAL(OZ_TINY * OZ_TINY))) : REAL(1.0);
    tangential = oz_scale(tangential, cut);
    if (OZ_HISTORY & !OZ_SLIP_SCALE) {
        /* a contact without a spring, in a scene where others have one, carries nothing */
        real compliance = stiffness > REAL(0.0) ? oz_inverse(stiffness) : REAL(0.0);
        OzVec3 carried = oz_scale(oz_minus(tangential, *dashpot), compliance);
        *stretch = oz_choose(slips, carried, *stretch);
    }
    *dashpot = oz_choose(slips, oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0)), *dashpot);
    return tangential;
}

/* The tangential force, N on b, limited by friction times |normal_force|; *dashpot receives its dashpot's
 * part. *history is the tangential spring as stored between steps, zero before first touch; it is replaced.
 * The share of the step by which it is advanced before the force (the rest after it) is the integrator's:
 * 0 explicit, 1/2 second order, 1 symplectic. */
OZ_INLINE OzVec3 oz_contact_friction(OzContact c, OzResponse response, real normal_force, scalar friction,
                                     OzVec3 *history, scalar dt, scalar share, OzVec3 *dashpot)
{
    OzVec3 tangential = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0)), stretch = tangential;
    *dashpot = tangential;
    if (OZ_FRICTION) {
        /* d(xi_t)/dt, against the relative velocity (P eq. 6) */
        OzVec3 sliding = oz_scale(oz_along(c.velocity, c.rate, c.normal), REAL(-1.0));
        *dashpot = oz_scale(sliding, response.tangential_damping);
        tangential = *dashpot;
        if (OZ_HISTORY) {
            OzVec3 turned = oz_contact_turn(*history, c.normal);
            stretch = oz_along(turned, REAL(share * dt), sliding);
            tangential = oz_along(tangential, response.tangential_stiffness, stretch);
        }
        tangential = oz_contact_limit(tangential, friction * oz_magnitude(normal_force), dashpot,
                                      response.tangential_stiffness, &stretch);
        if (OZ_HISTORY) {
            OzVec3 next = oz_along(stretch, REAL((1 - share) * dt), sliding);
            *history = oz_where(c.touching, next);
        }
    }
    return tangential;
}

OZ_INLINE OzContactForce oz_contact_force(OzContact c, OzLawConstants law, OzVec3 *history, scalar dt,
                                          scalar share)
{
    OzContactForce out;
    OzVec3 dashpot;
    OzResponse response = oz_contact_response(c, law);
    real normal_force = response.spring + response.dashpot;
    OzVec3 tangential = oz_contact_friction(c, response, normal_force, law.friction, history, dt, share,
                                            &dashpot);
    out.force = oz_where(c.touching, oz_along(tangential, normal_force, c.normal));
    out.spring = oz_where(c.touching, oz_minus(tangential, dashpot));
    out.dashpot = oz_where(c.touching, oz_along(dashpot, response.dashpot, c.normal));
    out.energy = c.touching ? response.energy : REAL(0.0);
    out.tangential_stiffness = response.tangential_stiffness;
    return out;
}

#endif
