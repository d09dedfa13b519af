/* The physics headers compiled for the host: real is double, and the switches that are constants on
 * a device are those of sim/host_switches.h. For .c files alone. */
#pragma once

#include "sim/host_switches.h"
#include "sim/physics.h"

#define OZ_ROUND            oz_host_switches_now.rods.round
#define OZ_EQUAL            oz_host_switches_now.rods.equal
#define OZ_FRICTION         oz_host_switches_now.rods.friction
#define OZ_HISTORY          oz_host_switches_now.rods.history
#define OZ_SLIP_SCALE       oz_host_switches_now.rods.slip_scale
#define OZ_ATTRACTION_CLAMP oz_host_switches_now.rods.attraction_clamp
#define OZ_SURFACES         oz_host_switches_now.rods.surfaces
#define OZ_GYROSCOPIC       oz_host_switches_now.rods.gyroscopic
#define OZ_LAW_ID           oz_host_switches_now.rods.law
#define OZ_LINE             oz_host_switches_now.rods.line
#define OZ_SMOOTH           oz_host_switches_now.rods.smooth
#define OZ_AT_CONTACT       oz_host_switches_now.rods.at_contact
#define OZ_WALL_KINDS       0x3fffffff /* the host knows them all */
#define OZ_WALL_KINDS_MORE  0x3fffffff
#define OZ_INTEGRATOR_ID    oz_host_switches_now.rods.integrator
#define OZ_MOVES_BEFORE     oz_host_switches_now.rods.moves_before

#include "kernels/integrate.h"
#include "kernels/rods.h"
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

/* How the wall of kernel wall w moves; offset and speed along its direction, rate about its axis.
 */
OZ_INLINE OzWallDrive oz_dialect_drive(const OzPhysics *physics, int w, double offset, double speed,
                                       double rate)
{
    const OzWallParameters *wall = &physics->parameters.wall[w];
    return (OzWallDrive){oz_dialect_load3(wall->direction), oz_dialect_load3(wall->axis), offset,
                         speed, rate};
}

/* A place on a grain, `end` from its centre, seen from the point of kernel wall w where that is
 * now. */
OZ_INLINE OzVec3 oz_dialect_from(const OzPhysics *physics, int w, OzFixedPosition place, OzVec3 end,
                                 OzWallDrive drive)
{
    OzVec3 point = oz_dialect_load3(physics->parameters.wall[w].shape.point);
    OzVec3 at = oz_vec3(place.x + end.x, place.y + end.y, place.z + end.z);
    return oz_minus(at, oz_along(point, drive.offset, drive.direction));
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

/* One end of a grain at kernel wall w; drives: of every wall; history as for oz_rods_wall. */
OZ_INLINE OzWallForce oz_dialect_touch_wall(const OzPhysics *physics, int w, int end_index,
                                            OzGrain grain, const OzWallDrive *drives, double dt,
                                            OzVec3 *history)
{
    OzVec3 end = oz_scale(grain.half_shaft, end_index ? -1 : 1);
    OzWallDrive drive = drives[w];
    OzWallEnd at = {.end = end, .wall = oz_dialect_wall(physics, w, grain.position, end, drive)};
    at.wall_velocity = oz_dialect_wall_velocity(physics, w, grain.position,
                                                oz_rods_wall_arm(grain, end, at.wall), drive);
    /* a sphere touches once, not with two coincident ends */
    at.present = (end_index == 0 || oz_dot(end, end) > 0) &&
                 oz_dialect_hider(physics, w, end_index, grain, drives) < 0;
    return oz_rods_wall(grain, at, physics->parameters.wall[w].law, history, dt, physics->share);
}
