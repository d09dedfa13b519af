/* The rods model: contacts between two spherocylinders, and between a spherocylinder's end and a
 * wall (Pournin et al. 2005, sec. 3). Switches: OZ_ROUND 1: all grains are spheres; OZ_LINE 1:
 * nearly parallel shafts touch as contact_line.h says, 0: at their closest points; those of
 * grain.h. */
#pragma once

#include "kernels/contact_line.h"
#include "kernels/depth.h"
#include "kernels/wall_shaft.h"

/* Whether touches share a response, at walls with edges or meshes. */
#define OZ_WALL_SHARES (OZ_WALL_EDGED > 0 || OZ_MESHES > 0)

/* What a pair of grains does to both. */
typedef struct OzPairForce {
    OzVec3 force;              /* N, on b; -force on a            */
    OzVec3 torque_a, torque_b; /* N m, about each one's centre    */
    real depth, closing;       /* m, m/s: overlap at the closest points, < 0 apart, and its rate */
    mask crossed;              /* the shafts meet: no normal exists, z was taken */
    OzContact contact;         /* for the ledger                  */
    OzContactForce parts;
    OzVec3 arm_a, arm_b; /* m, from each centre to where the force acts */
    OzVec3 couple,
        turning; /* with OZ_LINE, for the ledger: N m on b, of dashpots that act elsewhere than
                    at arm_b (exact with forces in the middle); rad/s, of b relative to a */
} OzPairForce;

/* The closest points of two grains' shafts; apart = x_a - x_b. */
OZ_INLINE OzClosest oz_rods_closest(OzVec3 apart, OzVec3 half_shaft_a, OzVec3 half_shaft_b)
{
    return OZ_ROUND ? oz_closest_spheres() : oz_closest(apart, half_shaft_a, half_shaft_b);
}

#if OZ_SPACE_TILTS
/* The velocity of b as a sees it, of those about a sheared cell's flow (shear.h). */
OZ_INLINE OzVec3 oz_rods_beside(OzVec3 velocity, OzVec3 apart, OzSpace space)
{
    velocity.x -= space.rate * apart.y;
    return velocity;
}
#endif

/* Replaces the contact at the closest points by the mean of the pair's points, and adds what they
 * do. */
OZ_INLINE void oz_rods_line(OzPairForce *pair, OzGrain a, OzGrain b, OzVec3 apart, OZ_LAW law,
                            OzMemory *memory, scalar dt, scalar share)
{
    OzContact *c = &pair->contact;
    OzLine sum = oz_line_sum(a, b, apart, law, *c, pair->arm_a, pair->arm_b);
    OzResponse response = {
        sum.push, REAL(0.0), sum.energy, sum.tangential_stiffness, sum.tangential_damping,
        REAL(0.0)};
    c->touching = sum.overlap > REAL(0.0);
    real inverse = REAL(1.0) / (c->touching ? sum.overlap : REAL(1.0));
    real length = sqrt(oz_dot(sum.normal, sum.normal));
    mask aimed = length > REAL(0.0); /* not so where normals cancel: crossed shafts */
    real inverse_length = REAL(1.0) / (aimed ? length : REAL(1.0));
    c->normal = oz_choose(aimed, oz_scale(sum.normal, inverse_length), c->normal);
    c->overlap = c->touching ? sum.overlap : oz_smaller(c->overlap, REAL(0.0));
    pair->arm_a = oz_choose(c->touching, oz_scale(sum.arm_a, inverse), pair->arm_a);
    pair->arm_b = oz_choose(c->touching, oz_scale(sum.arm_b, inverse), pair->arm_b);
    c->velocity =
        oz_minus(oz_grain_velocity_at(b, pair->arm_b), oz_grain_velocity_at(a, pair->arm_a));
    c->rate = -oz_dot(c->velocity, c->normal);
    OzFriction f = oz_contact_friction(*c, response, sum.push, law.friction, memory, dt, share);
    OzVec3 tangential = oz_where(c->touching, f.force), dashpot = oz_where(c->touching, f.dashpot);
    pair->parts.force = oz_add(sum.force, tangential);
    pair->parts.press = sum.push;
    pair->parts.spring = oz_minus(tangential, dashpot);
    pair->parts.dashpot = oz_add(sum.dashpot, dashpot);
    pair->parts.slips = f.slips;
    pair->parts.energy = sum.energy;
    pair->parts.tangential_stiffness = sum.tangential_stiffness;
    pair->parts.couple =
        oz_contact_rolling(*c, law, sum.push, sum.spring / oz_contact_depth(*c), memory, dt, share);
    pair->torque_a = oz_add(sum.torque_a, oz_cross(tangential, pair->arm_a));
    pair->torque_b = oz_add(sum.torque_b, oz_cross(pair->arm_b, tangential));
    OzVec3 couple_a = oz_minus(sum.dashpot_a, oz_cross(sum.dashpot, pair->arm_a));
    OzVec3 couple_b = oz_minus(sum.dashpot_b, oz_cross(pair->arm_b, sum.dashpot));
    pair->couple = oz_scale(oz_minus(couple_b, couple_a), REAL(0.5));
    pair->turning = oz_minus(b.rate, a.rate);
}

/* What a and b do to each other, whose closest points are at `at`; their places are not looked at.
 */
OZ_INLINE OzPairForce oz_rods_touch(OzGrain a, OzGrain b, OzVec3 apart, OzClosest at, OZ_LAW law,
                                    OzMemory *memory, scalar dt, scalar share)
{
    OzPairForce pair;
    pair.contact = oz_grain_contact(a, b, apart, at, &pair.arm_a, &pair.arm_b, &pair.crossed);
    pair.crossed = pair.crossed & pair.contact.touching;
    pair.depth = pair.contact.overlap;
    pair.closing = pair.contact.rate;
    if (OZ_LINE) {
        oz_rods_line(&pair, a, b, apart, law, memory, dt, share);
    } else {
        pair.couple = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0));
        pair.parts = oz_contact_force(pair.contact, law, memory, dt, share);
        pair.torque_a = oz_cross(pair.parts.force, pair.arm_a);
        pair.torque_b = oz_cross(pair.arm_b, pair.parts.force);
    }
    if (OZ_ROLLING) {
        OzVec3 couple = oz_add(pair.parts.couple.spring, pair.parts.couple.dashpot);
        pair.torque_a = oz_minus(pair.torque_a, couple);
        pair.torque_b = oz_add(pair.torque_b, couple);
    }
    pair.force = pair.parts.force;
    return pair;
}

OZ_INLINE OzPairForce oz_rods_pair(OzGrain a, OzGrain b, OzSpace space, OZ_LAW law,
                                   OzMemory *memory, scalar dt, scalar share)
{
    OzVec3 apart = oz_space_minus(a.position, b.position, space);
    OzClosest at = oz_rods_closest(apart, a.half_shaft, b.half_shaft);
#if OZ_SPACE_TILTS
    if (OZ_SHEAR) {
        b.velocity = oz_rods_beside(b.velocity, apart, space);
    }
#endif
    return oz_rods_touch(a, b, apart, at, law, memory, dt, share);
}

/* Where an end touches a wall, from the grain's centre. */
OZ_INLINE OzVec3 oz_rods_wall_arm(OzGrain grain, OzVec3 end, OzWallDistance wall)
{
#if OZ_FINE
    real overlap = wall.overlap;
#else
    real overlap = grain.radius - wall.distance;
#endif
    real inside = OZ_SURFACES ? REAL(0.0) : REAL(0.5) * overlap;
    return oz_along(end, inside - grain.radius, wall.normal);
}

/* One end of a grain before a wall, or a point of its shaft. */
typedef struct OzWallEnd {
    OzVec3 end;           /* m, the cap's centre from the grain's: a half-shaft, or minus it */
    real share;           /* of the overlap that counts here (wall_shaft.h); with OZ_WALL_SHARES */
    OzWallDistance wall;  /* where the cap's centre stands                                   */
    OzVec3 wall_velocity; /* m/s, the wall's own                                             */
    OzVec3 wall_turning;  /* rad/s, the wall's own; with OZ_ROLLING only                     */
    mask present;         /* else it does not touch                                          */
} OzWallEnd;

/* What a wall does to that end. */
typedef struct OzWallForce {
    OzContact contact; /* the wall is a */
    OzContactForce parts;
    OzVec3 arm; /* m, from the grain's centre to where the force acts */
} OzWallForce;

/* Its couple on the grain, and the torque of all of it about the grain's centre, N m. */
OZ_INLINE OzVec3 oz_rods_wall_couple(OzWallForce wall)
{
    return oz_add(wall.parts.couple.spring, wall.parts.couple.dashpot);
}

OZ_INLINE OzVec3 oz_rods_wall_torque(OzWallForce wall)
{
    OzVec3 torque = oz_cross(wall.arm, wall.parts.force);
    return OZ_ROLLING ? oz_add(torque, oz_rods_wall_couple(wall)) : torque;
}

OZ_INLINE OzWallForce oz_rods_wall(OzGrain grain, OzWallEnd at, OZ_LAW law, OzMemory *memory,
                                   scalar dt, scalar share)
{
    OzWallForce force;
    OzContact *contact = &force.contact;
    OzWallDistance wall = at.wall;
    contact->normal = wall.normal;
#if OZ_FINE
    contact->overlap = wall.overlap;
#else
    contact->overlap = grain.radius - wall.distance;
#endif
    contact->touching = (contact->overlap > REAL(0.0)) & at.present;
    force.arm = oz_rods_wall_arm(grain, at.end, wall);
    contact->velocity = oz_minus(oz_grain_velocity_at(grain, force.arm), at.wall_velocity);
    contact->rate = -oz_dot(contact->velocity, contact->normal);
    if (OZ_WALL_SHARES) {
        contact->overlap *= at.share;
        contact->rate *= at.share;
    }
    contact->share = at.share;
    contact->mass = grain.mass;
    contact->radius = grain.radius;
    if (OZ_ROLLING) {
        contact->turning = oz_minus(grain.rate, at.wall_turning);
        contact->inertia = grain.mass * grain.radius * grain.radius;
    }
    contact->lightness = REAL(1.0);
    if (OZ_AT_CONTACT) {
        real inverse_mass_turn = oz_grain_inverse_mass_turn(grain, at.end, wall.normal);
        contact->lightness = REAL(1.0) / sqrt(REAL(1.0) + contact->mass * inverse_mass_turn);
    }
    force.parts = oz_contact_force(*contact, law, memory, dt, share);
    if (OZ_WALL_SHARES) {
        force.parts.energy /= at.share; /* a.K.a / 2 is a.e / 2 */
    }
    return force;
}
