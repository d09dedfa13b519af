/* Grains as contacts see them, and the contact of two at given points of their shafts. Switches:
 * OZ_EQUAL 1: all grains are alike; OZ_SURFACES 1: each force acts on its own grain's surface
 * (Pournin et al. 2005; breaks angular momentum), 0: both in the middle of the overlap;
 * OZ_AT_CONTACT: whether a contact's lightness is needed; OZ_FINE: overlaps as fine.h has them. */
#pragma once

#include "kernels/closest.h"
#include "kernels/contact_law.h"
#include "kernels/space.h"
#if OZ_FINE
#include "kernels/fine.h"
#endif

typedef struct OzGrain {
    OzFixedPosition position;
    OzVec3 half_shaft;    /* m                                                       */
    OzVec3 velocity;      /* m/s                                                     */
    OzVec3 rate;          /* rad/s, world frame                                      */
    real radius, mass;    /* m, kg                                                   */
    real inverse_inertia; /* 1/(kg m^2), across the shaft; with OZ_AT_CONTACT only    */
#if OZ_FINE
    OzFineGrain fine;
#endif
} OzGrain;

/* Velocity of the material point at arm. */
OZ_INLINE OzVec3 oz_grain_velocity_at(OzGrain grain, OzVec3 arm)
{
    return oz_add(grain.velocity, oz_cross(grain.rate, arm));
}

/* The rotation's part in how easily a grain gives way to a push along the normal, 1/kg: to be added
 * to its inverse mass. from_centre: the point of the shaft that is pushed, from the grain's centre.
 * The surface point lies farther along the normal, which changes no torque, so the grain turns
 * about an axis across its shaft. */
OZ_INLINE real oz_grain_inverse_mass_turn(OzGrain grain, OzVec3 from_centre, OzVec3 normal)
{
    OzVec3 turning = oz_cross(from_centre, normal);
    return grain.inverse_inertia * oz_dot(turning, turning);
}

/* The contact of a and b at points of their shafts; apart = x_a - x_b. Arms reach from each centre
 * to where the forces act. *crossed: the shafts meet there, no normal exists and z is taken. */
OZ_INLINE OzContact oz_grain_contact(OzGrain a, OzGrain b, OzVec3 apart, OzClosest at,
                                     OzVec3 *arm_a, OzVec3 *arm_b, mask *crossed)
{
    OzContact contact;
    OzVec3 from_a = oz_scale(a.half_shaft, at.s), from_b = oz_scale(b.half_shaft, at.t);
    OzVec3 gap = oz_minus(from_b, oz_add(apart, from_a)); /* y2 - y1 */
    real gap2 = oz_dot(gap, gap);
    *crossed = gap2 <= OZ_TINY * OZ_TINY;
    real inverse = oz_inverse_root(oz_larger(gap2, REAL(OZ_TINY * OZ_TINY)));
    OzVec3 up = oz_vec3(REAL(0.0), REAL(0.0), REAL(1.0));
    contact.normal = oz_choose(*crossed, up, oz_scale(gap, inverse));
#if OZ_FINE
    contact.overlap = oz_fine_pair(a.fine, b.fine, at.s, at.t) * (a.radius / a.fine.radius);
#else
    contact.overlap = a.radius + b.radius - gap2 * inverse;
#endif
    contact.touching = contact.overlap > REAL(0.0);
    real inside = OZ_SURFACES ? REAL(0.0) : REAL(0.5) * contact.overlap;
    *arm_a = oz_along(from_a, a.radius - inside, contact.normal);
    *arm_b = oz_along(from_b, inside - b.radius, contact.normal);
    contact.velocity = oz_minus(oz_grain_velocity_at(b, *arm_b), oz_grain_velocity_at(a, *arm_a));
    contact.rate = -oz_dot(contact.velocity, contact.normal);
    contact.mass = OZ_EQUAL ? REAL(0.5) * a.mass : a.mass * b.mass / (a.mass + b.mass);
    contact.radius =
        a.radius * b.radius / (a.radius + b.radius); /* left out where no law reads it */
    contact.share = REAL(1.0);
    if (OZ_ROLLING) {
        real a2 = a.mass * a.radius * a.radius, b2 = b.mass * b.radius * b.radius;
        contact.turning = oz_minus(b.rate, a.rate);
        contact.inertia = a2 * b2 / (a2 + b2);
    }
    contact.lightness = REAL(1.0);
    if (OZ_AT_CONTACT) {
        real inverse_mass_turn = oz_grain_inverse_mass_turn(a, from_a, contact.normal) +
                                 oz_grain_inverse_mass_turn(b, from_b, contact.normal);
        contact.lightness = REAL(1.0) / sqrt(REAL(1.0) + contact.mass * inverse_mass_turn);
    }
    return contact;
}
