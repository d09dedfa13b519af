/* The physics headers compiled for the host: real is double, and the switches that are constants on
 * a device are those of sim/host_switches.h. For .c files alone. */
#pragma once

#include "scene/mixing.h"
#include "sim/host_switches.h"
#include "sim/host_touch.h"
#include "sim/physics.h"

#define OZ_ROUND            oz_host_switches_now.rods.round
#define OZ_EQUAL            oz_host_switches_now.rods.equal
#define OZ_FRICTION         oz_host_switches_now.rods.friction
#define OZ_HISTORY          oz_host_switches_now.rods.history
#define OZ_ADHESION         oz_host_switches_now.rods.adhesion
#define OZ_ROLLING          oz_host_switches_now.rods.rolling
#define OZ_ROLLING_SPRING   oz_host_switches_now.rods.rolling_spring
#define OZ_SLIP_SCALE       oz_host_switches_now.rods.slip_scale
#define OZ_ATTRACTION_CLAMP oz_host_switches_now.rods.attraction_clamp
#define OZ_SURFACES         oz_host_switches_now.rods.surfaces
#define OZ_GYROSCOPIC       oz_host_switches_now.rods.gyroscopic
#define OZ_LAW_ID           oz_host_switches_now.rods.law
#define OZ_LINE             oz_host_switches_now.rods.line
#define OZ_SMOOTH           oz_host_switches_now.rods.smooth
#define OZ_AT_CONTACT       oz_host_switches_now.rods.at_contact
#define OZ_GATED            oz_host_switches_now.rods.gated
#define OZ_PERIODIC         oz_host_switches_now.rods.periodic
#define OZ_SHEAR            oz_host_switches_now.rods.shear
#define OZ_WALL_EDGED       oz_host_switches_now.rods.edged
#define OZ_MESHES           oz_host_switches_now.rods.meshes
#define OZ_WALL_KINDS       0x3fffffff /* the host knows them all */
#define OZ_WALL_KINDS_MORE  0x3fffffff
#define OZ_INTEGRATOR_ID    oz_host_switches_now.rods.integrator
#define OZ_MOVES_BEFORE     oz_host_switches_now.rods.moves_before

#include "kernels/drag.h"
#include "kernels/integrate.h"
#include "kernels/rods.h"
#include "kernels/shear.h"
#include "kernels/wall_drive.h"
#include "kernels/wall_joint.h"

OZ_INLINE OzVec3 oz_dialect_load3(const double *from)
{
    return oz_vec3(from[0], from[1], from[2]);
}

OZ_INLINE void oz_dialect_store3(double *to, OzVec3 v)
{
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}

/* Which material of grains a grain is of. */
OZ_INLINE int oz_dialect_kind(const OzPhysics *physics, int64_t grain)
{
    return oz_mixing_kind(physics->scene, physics->grains->population[grain]);
}

/* The constants of two grains, and of a grain at kernel wall w: as kernels/material.h. */
OZ_INLINE OzLawConstants oz_dialect_pair_law(const OzPhysics *physics, int64_t a, int64_t b)
{
    int kinds = physics->switches.materials;
    return kinds > 1
               ? physics
                     ->law_table[oz_dialect_kind(physics, a) * kinds + oz_dialect_kind(physics, b)]
               : physics->parameters.law;
}

OZ_INLINE OzLawConstants oz_dialect_wall_law(const OzPhysics *physics, int w, int64_t grain)
{
    int kinds = physics->switches.materials;
    return kinds > 1 ? physics->law_table[(kinds + w) * kinds + oz_dialect_kind(physics, grain)]
                     : physics->parameters.wall[w].law;
}

OZ_INLINE OzSpace oz_dialect_space(const OzPhysics *physics)
{
    const OzParameters *p = &physics->parameters;
    OzSpace space = {.unit = 1}; /* of a sheared cell, without tilt */
    for (int k = 0; k < 3; k++) {
        space.period[k] = p->period[k];
        space.period_rest[k] = p->period_rest[k];
        space.inverse_period[k] = p->inverse_period[k];
    }
    return space;
}

/* The same of a sheared cell, for places of a lattice with this tilt. */
OZ_INLINE OzSpace oz_dialect_sheared(const OzPhysics *physics, double tilt, double rate)
{
    OzSpace space = oz_dialect_space(physics);
    space.tilt = tilt;
    space.rate = rate;
    return space;
}

/* How the wall of kernel wall w moves; offset and speed along its direction, rate about its axis;
 * what its point does by turning (sim/swings.h) is left open. */
OZ_INLINE OzWallDrive oz_dialect_drive(const OzPhysics *physics, int w, double offset, double speed,
                                       double rate)
{
    const OzWallParameters *wall = &physics->parameters.wall[w];
    return (OzWallDrive){.direction = oz_dialect_load3(wall->direction),
                         .axis = oz_dialect_load3(wall->axis),
                         .offset = offset,
                         .speed = speed,
                         .rate = rate};
}

/* A place on a grain, `end` from its centre, seen from the point of kernel wall w where that is
 * now. */
OZ_INLINE OzVec3 oz_dialect_from(const OzPhysics *physics, int w, OzFixedPosition place, OzVec3 end,
                                 OzWallDrive drive)
{
    OzVec3 point = oz_dialect_load3(physics->parameters.wall[w].shape.point);
    OzVec3 at = oz_vec3(place.x + end.x, place.y + end.y, place.z + end.z);
    at = oz_minus(at, oz_along(point, drive.offset, drive.direction));
    return oz_minus(at, drive.away);
}

/* Where one end of a grain (end: from its centre) stands against kernel wall w. */
OZ_INLINE OzWallDistance oz_dialect_wall(const OzPhysics *physics, int w, OzFixedPosition place,
                                         OzVec3 end, OzWallDrive drive)
{
    return oz_wall_distance(oz_dialect_from(physics, w, place, end, drive),
                            physics->parameters.wall[w].shape);
}

/* The velocity of kernel wall w where it touches a grain, arm from the grain's centre. */
OZ_INLINE OzVec3 oz_dialect_wall_velocity(const OzPhysics *physics, int w, OzFixedPosition place,
                                          OzVec3 arm, OzWallDrive drive)
{
    return oz_wall_drive_velocity(drive, oz_dialect_from(physics, w, place, arm, drive));
}

/* The kernel wall that an end touches in the place of wall w where both join (wall_joint.h); -1:
 * none. drives: of every wall. */
OZ_INLINE int oz_dialect_hider(const OzPhysics *physics, int w, int end_index, OzGrain grain,
                               const OzWallDrive *drives)
{
    OzVec3 end = oz_scale(grain.half_shaft, end_index ? -1 : 1);
    OzWallDistance own = oz_dialect_wall(physics, w, grain.position, end, drives[w]);
    int first = physics->wall_count - physics->edged;
    for (int other = first; w >= first && other < physics->wall_count; other++) {
        OzVec3 from = oz_dialect_from(physics, other, grain.position, end, drives[other]);
        OzWallShape shape = physics->parameters.wall[other].shape;
        if (other != w && oz_wall_joint_hides(from, shape, oz_wall_distance(from, shape), other < w,
                                              own, grain.radius)) {
            return other;
        }
    }
    return -1;
}

/* Whether a shaft may touch kernel wall w between its ends: as the kernels' sieve. */
OZ_INLINE bool oz_dialect_is_across(const OzPhysics *physics, int w, OzGrain grain,
                                    OzWallDrive drive)
{
    OzWallShape shape = physics->parameters.wall[w].shape;
    OzVec3 from = oz_dialect_from(physics, w, grain.position, oz_vec3(0, 0, 0), drive);
    double half = sqrt(oz_dot(grain.half_shaft, grain.half_shaft));
    return half > 0 && oz_wall_distance(from, shape).distance < grain.radius + half &&
           !(oz_wall_flush(oz_add(from, grain.half_shaft), shape) *
                 oz_wall_flush(oz_minus(from, grain.half_shaft), shape) >
             0);
}

/* The points of a shaft at kernel wall w; those that another wall bears, which comes first, are
 * none. */
OZ_INLINE void oz_dialect_points(const OzPhysics *physics, int w, OzGrain grain,
                                 const OzWallDrive *drives, OzWallPoint points[OZ_WALL_SHAFT_PARTS])
{
    const OzWallParameters *walls = physics->parameters.wall;
    OzVec3 none = oz_vec3(0, 0, 0);
    if (!oz_dialect_is_across(physics, w, grain, drives[w])) {
        for (int part = 0; part < OZ_WALL_SHAFT_PARTS; part++) {
            OzWallDistance at = oz_dialect_wall(physics, w, grain.position, none, drives[w]);
            points[part] = (OzWallPoint){.wall = at, .overlap = -grain.radius};
        }
        return;
    }
    OzWallRod rod = {oz_dialect_from(physics, w, grain.position, none, drives[w]), grain.half_shaft,
                     grain.radius, -grain.radius, -grain.radius};
    int first = physics->wall_count - physics->edged;
    for (int other = first; other < physics->wall_count; other++) {
        OzVec3 tail = oz_scale(grain.half_shaft, -1);
        OzWallDistance ahead =
            oz_dialect_wall(physics, other, grain.position, grain.half_shaft, drives[other]);
        OzWallDistance behind =
            oz_dialect_wall(physics, other, grain.position, tail, drives[other]);
        rod.tip = fmax(rod.tip, grain.radius - ahead.distance);
        rod.tail = fmax(rod.tail, grain.radius - behind.distance);
    }
    oz_wall_shaft_points(rod, walls[w].shape, points);
    for (int part = 0; part < OZ_WALL_SHAFT_PARTS; part++) {
        OzVec3 place = oz_scale(grain.half_shaft, points[part].at);
        for (int other = first; other < w; other++) {
            OzVec3 from = oz_dialect_from(physics, other, grain.position, place, drives[other]);
            if (oz_wall_shaft_hides(from, walls[other].shape, points[part], grain.radius)) {
                points[part].overlap = -grain.radius;
            }
        }
    }
    oz_wall_shaft_push(rod, points);
}

/* The overlap that an end at a wall with edges is relieved of by the shaft's points. */
OZ_INLINE double oz_dialect_relief(const OzPhysics *physics, int w, int part, OzGrain grain,
                                   const OzWallDrive *drives)
{
    int first = physics->wall_count - physics->edged;
    double relief = 0;
    for (int other = first; w >= first && other < physics->wall_count; other++) {
        OzWallPoint points[OZ_WALL_SHAFT_PARTS];
        oz_dialect_points(physics, other, grain, drives, points);
        for (int k = 0; k < OZ_WALL_SHAFT_PARTS; k++) {
            double end = part == OZ_WALL_TIP ? 1 : -1;
            relief += points[k].push * oz_wall_shaft_reach(points[k].at, end);
        }
    }
    return relief;
}

/* Where an end or a point of a shaft stands against kernel wall w; the wall's velocity is left
 * open. */
OZ_INLINE OzWallEnd oz_dialect_end(const OzPhysics *physics, int w, int part, OzGrain grain,
                                   const OzWallDrive *drives)
{
    OzWallEnd at = {.share = 1};
    double left;
    if (part >= OZ_WALL_AHEAD) {
        OzWallPoint points[OZ_WALL_SHAFT_PARTS];
        oz_dialect_points(physics, w, grain, drives, points);
        OzWallPoint point = points[part - OZ_WALL_AHEAD];
        at.end = oz_scale(grain.half_shaft, point.at);
        at.wall = point.wall;
        at.present = true;
        left = point.push;
    } else {
        at.end = oz_scale(grain.half_shaft, part == OZ_WALL_TIP ? 1 : -1);
        at.wall = oz_dialect_wall(physics, w, grain.position, at.end, drives[w]);
        /* a sphere touches once, not with two coincident ends */
        left = grain.radius - at.wall.distance;
        at.present = (part == OZ_WALL_TIP || oz_dot(at.end, at.end) > 0) &&
                     (left <= 0 || oz_dialect_hider(physics, w, part, grain, drives) < 0);
        if (left > 0 && !physics->switches.round) {
            left -= oz_dialect_relief(physics, w, part, grain, drives);
        }
    }
    if (w >= physics->wall_count - physics->edged) {
        at.present &= left > 0;
        at.share = at.present ? left / (grain.radius - at.wall.distance) : 1;
    }
    return at;
}

/* What may touch, one of physics->touches: an end or a point of a shaft at kernel wall *wall;
 * OZ_WALL_PARTS and on: a slot of a mesh. */
OZ_INLINE int oz_dialect_part(const OzPhysics *physics, int index, int *wall)
{
    OzWallNumbers numbers = {physics->ends, physics->wall_count, physics->meshes, physics->edged};
    *wall = oz_wall_shaft_wall(index, numbers);
    return oz_wall_shaft_part(index, numbers);
}

/* Where a grain stands against a mesh in one of its slots. */
OZ_INLINE OzWallEnd oz_dialect_mesh_end(const OzHostTouch *touch, OzGrain grain)
{
    OzWallDistance far = {oz_vec3(0, 0, 1), OZ_WALL_FAR};
    OzWallEnd at = {.wall = far, .share = 1, .present = touch->present};
    if (touch->present) {
        at.end = oz_scale(grain.half_shaft, touch->place);
        at.wall = (OzWallDistance){oz_dialect_load3(touch->normal), touch->distance};
        at.share = touch->push / (grain.radius - touch->distance);
    }
    return at;
}

/* That of grain number i which stands so against kernel wall w, but for the wall's velocity;
 * drives: of every wall; memory as for oz_rods_wall. */
OZ_INLINE OzWallForce oz_dialect_touch_end(const OzPhysics *physics, int w, OzWallEnd at, int64_t i,
                                           OzGrain grain, const OzWallDrive *drives, double dt,
                                           OzMemory *memory)
{
    at.wall_velocity = oz_dialect_wall_velocity(
        physics, w, grain.position, oz_rods_wall_arm(grain, at.end, at.wall), drives[w]);
    at.wall_turning = oz_scale(drives[w].axis, drives[w].rate);
    return oz_rods_wall(grain, at, oz_dialect_wall_law(physics, w, i), memory, dt, physics->share);
}

/* The same of an end or a point of a shaft, no slot. */
OZ_INLINE OzWallForce oz_dialect_touch_wall(const OzPhysics *physics, int index, int64_t i,
                                            OzGrain grain, const OzWallDrive *drives, double dt,
                                            OzMemory *memory)
{
    int w, part = oz_dialect_part(physics, index, &w);
    OzWallEnd at = oz_dialect_end(physics, w, part, grain, drives);
    return oz_dialect_touch_end(physics, w, at, i, grain, drives, dt, memory);
}
