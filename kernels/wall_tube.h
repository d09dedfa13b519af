/* A cylinder of `radius` about an axis of any direction. */
#ifndef OZ_KERNELS_WALL_TUBE_H
#define OZ_KERNELS_WALL_TUBE_H

#include "kernels/wall_shape.h"

/* from: cap centre minus a point of the axis, the wall's motion included. On the axis itself any direction serves:
 * nothing is in reach there. */
OZ_INLINE OzWallDistance oz_wall_tube(OzVec3 from, OzWallShape wall)
{
    OzWallDistance at;
    OzVec3 axis = oz_vec3(REAL(wall.normal[0]), REAL(wall.normal[1]), REAL(wall.normal[2]));
    OzVec3 across = oz_along(from, -oz_dot(from, axis), axis);
    real r2 = oz_dot(across, across), side = REAL(wall.side);
    real inverse = oz_inverse_root(oz_larger(r2, REAL(OZ_TINY)));
    at.normal = oz_scale(across, -side * inverse);
    at.distance = side * (REAL(wall.radius) - r2 * inverse);
    return at;
}

#endif
