/* The rods model: contacts between two spherocylinders, and between a spherocylinder's end and a wall
 * (Pournin et al. 2005, sec. 3). Switches: OZ_ROUND 1: all grains are spheres; OZ_SURFACES 1: each force
 * acts on its own grain's surface (the paper; breaks angular momentum), 0: both in the middle of the
 * overlap. */
#ifndef OZ_KERNELS_RODS_H
#define OZ_KERNELS_RODS_H

#include "kernels/closest.h"
#include "kernels/contact_hooke.h"
#include "kernels/walls.h"

/* A grain as contacts see it. */
typedef struct OzGrain {
    OzPlace place;
    OzVec3 half_shaft; /* m                 */
    OzVec3 velocity;   /* m/s               */
    OzVec3 rate;       /* rad/s, world frame */
    real radius, mass; /* m, kg             */
} OzGrain;

/* What a pair of grains does to both. */
typedef struct OzPairForce {
    OzVec3 force;              /* N, on b; -force on a            */
    OzVec3 torque_a, torque_b; /* N m, about each one's centre    */
    real overlap;              /* m, 0 when not touching          */
    mask deep;                 /* overlap beyond the smaller radius */
    mask crossed;              /* the shafts meet: no normal exists, z was taken */
    OzContact contact;         /* for the ledger                  */
    OzContactForce parts;
    OzVec3 arm_a, arm_b;       /* m, from each centre to where the force acts */
} OzPairForce;

/* Velocity of the material point at arm. */
OZ_INLINE OzVec3 oz_rods_velocity_at(OzGrain grain, OzVec3 arm)
{
    return oz_add(grain.velocity, oz_cross(grain.rate, arm));
}

/* The contact of a and b; arms are filled in with the points where the forces act. */
OZ_INLINE OzContact oz_rods_contact(OzGrain a, OzGrain b, scalar length_unit, OzVec3 *arm_a,
                                    OzVec3 *arm_b, mask *crossed)
{
    OzContact contact;
    OzVec3 apart = oz_place_minus(a.place, b.place, length_unit);
    OzClosest at = OZ_ROUND ? oz_closest_spheres() : oz_closest(apart, a.half_shaft, b.half_shaft);
    OzVec3 from_a = oz_scale(a.half_shaft, at.s), from_b = oz_scale(b.half_shaft, at.t);
    OzVec3 gap = oz_minus(from_b, oz_add(apart, from_a)); /* y2 - y1 */
    real gap2 = oz_dot(gap, gap);
    *crossed = gap2 <= OZ_TINY * OZ_TINY;
    real inverse = REAL(1.0) / sqrt(oz_larger(gap2, REAL(OZ_TINY * OZ_TINY)));
    OzVec3 up = oz_vec3(REAL(0.0), REAL(0.0), REAL(1.0));
    contact.normal = oz_choose(*crossed, up, oz_scale(gap, inverse));
    contact.overlap = a.radius + b.radius - gap2 * inverse;
    contact.touching = contact.overlap > REAL(0.0);
    real inside = OZ_SURFACES ? REAL(0.0) : REAL(0.5) * contact.overlap;
    *arm_a = oz_along(from_a, a.radius - inside, contact.normal);
    *arm_b = oz_along(from_b, inside - b.radius, contact.normal);
    contact.velocity = oz_minus(oz_rods_velocity_at(b, *arm_b), oz_rods_velocity_at(a, *arm_a));
    contact.mass = OZ_EQUAL ? REAL(0.5) * a.mass : a.mass * b.mass / (a.mass + b.mass);
    return contact;
}

OZ_INLINE OzPairForce oz_rods_pair(OzGrain a, OzGrain b, scalar length_unit, OzLawConstants law,
                                   OzVec3 *history, scalar dt, scalar share)
{
    OzPairForce pair;
    pair.contact = oz_rods_contact(a, b, length_unit, &pair.arm_a, &pair.arm_b, &pair.crossed);
    pair.parts = oz_contact_hooke(pair.contact, law, history, dt, share);
    pair.force = pair.parts.force;
    pair.torque_a = oz_cross(pair.force, pair.arm_a);
    pair.torque_b = oz_cross(pair.arm_b, pair.force);
    pair.overlap = pair.contact.touching ? pair.contact.overlap : REAL(0.0);
    pair.deep = pair.overlap > oz_smaller(a.radius, b.radius);
    pair.crossed = pair.crossed & pair.contact.touching;
    return pair;
}

/* One end of a grain at a wall: end is the cap's centre from the grain's centre (a half-shaft, or minus
 * it), wall where that centre stands, wall_velocity the wall's own. */
OZ_INLINE OzContactForce oz_rods_wall(OzGrain grain, OzVec3 end, OzWallDistance wall,
                                      OzVec3 wall_velocity, mask present, OzLawConstants law,
                                      OzVec3 *history, scalar dt, scalar share, OzContact *contact,
                                      OzVec3 *arm)
{
    contact->normal = wall.normal;
    contact->overlap = grain.radius - wall.distance;
    contact->touching = (contact->overlap > REAL(0.0)) & present;
    real inside = OZ_SURFACES ? REAL(0.0) : REAL(0.5) * contact->overlap;
    *arm = oz_along(end, inside - grain.radius, wall.normal);
    contact->velocity = oz_minus(oz_rods_velocity_at(grain, *arm), wall_velocity);
    contact->mass = grain.mass;
    return oz_contact_hooke(*contact, law, history, dt, share);
}

#endif
