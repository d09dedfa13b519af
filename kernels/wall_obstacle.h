/* The outside of a cylinder about an axis, or of a sphere where normal is zero, among rods: a shaft
 * touches it between its ends, too, at one point (wall_shaft.h). */
#ifndef OZ_KERNELS_WALL_OBSTACLE_H
#define OZ_KERNELS_WALL_OBSTACLE_H

#include "kernels/wall_tube.h"

/* from: cap centre minus a point of the axis, or the sphere's centre; the wall's motion included.
 */
OZ_INLINE OzWallDistance oz_wall_obstacle(OzVec3 from, OzWallShape wall)
{
    return oz_wall_tube(from, wall);
}

/* As oz_wall_middle: nearest to the axis or the centre, where the overlap is largest. */
OZ_INLINE real oz_wall_obstacle_middle(OzVec3 from, OzVec3 half_shaft, OzWallShape wall)
{
    OzVec3 axis = oz_vec3(REAL(wall.normal[0]), REAL(wall.normal[1]), REAL(wall.normal[2]));
    real rise = oz_dot(half_shaft, axis);
    real across = oz_dot(from, half_shaft) - oz_dot(from, axis) * rise;
    real across2 = oz_dot(half_shaft, half_shaft) - rise * rise;
    return -across / oz_larger(across2, REAL(OZ_TINY * OZ_TINY));
}

/* As oz_wall_flush: it is round towards grains everywhere. */
OZ_INLINE real oz_wall_obstacle_flush(OzVec3 from, OzWallShape wall)
{
    (void)from;
    (void)wall;
    return REAL(0.0);
}

#endif
