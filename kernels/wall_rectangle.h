/* A rectangle about its point: a thin sheet, both sides of which are free. */
#ifndef OZ_KERNELS_WALL_RECTANGLE_H
#define OZ_KERNELS_WALL_RECTANGLE_H

#include "kernels/wall_shape.h"

/* What of x lies beyond -most and most. */
OZ_INLINE real oz_wall_rectangle_beyond(real x, real most)
{
    return x - oz_larger(-most, oz_smaller(most, x));
}

/* from: cap centre minus the rectangle's middle, the wall's motion included. */
OZ_INLINE OzWallDistance oz_wall_rectangle(OzVec3 from, OzWallShape wall)
{
    OzVec3 normal = oz_vec3(REAL(wall.normal[0]), REAL(wall.normal[1]), REAL(wall.normal[2]));
    OzVec3 first = oz_vec3(REAL(wall.across[0]), REAL(wall.across[1]), REAL(wall.across[2]));
    OzVec3 second = oz_cross(normal, first);
    real beyond_first = oz_wall_rectangle_beyond(oz_dot(from, first), REAL(wall.extent[0]));
    real beyond_second = oz_wall_rectangle_beyond(oz_dot(from, second), REAL(wall.extent[1]));
    OzVec3 away = oz_scale(normal, oz_dot(from, normal));
    away = oz_along(away, beyond_first, first);
    return oz_wall_shape_sheet(oz_along(away, beyond_second, second));
}

/* As oz_wall_middle: nearest to the rectangle's own. */
OZ_INLINE real oz_wall_rectangle_middle(OzVec3 from, OzVec3 half_shaft, OzWallShape wall)
{
    (void)wall;
    return -oz_dot(from, half_shaft) /
           oz_larger(oz_dot(half_shaft, half_shaft), REAL(OZ_TINY * OZ_TINY));
}

/* As oz_wall_flush; its sign is the side's. */
OZ_INLINE real oz_wall_rectangle_flush(OzVec3 from, OzWallShape wall)
{
    OzVec3 normal = oz_vec3(REAL(wall.normal[0]), REAL(wall.normal[1]), REAL(wall.normal[2]));
    OzVec3 first = oz_vec3(REAL(wall.across[0]), REAL(wall.across[1]), REAL(wall.across[2]));
    real one = oz_dot(from, first), other = oz_dot(from, oz_cross(normal, first));
    mask within =
        (oz_magnitude(one) < REAL(wall.extent[0])) & (oz_magnitude(other) < REAL(wall.extent[1]));
    return within ? oz_dot(from, normal) : REAL(0.0);
}

#endif
