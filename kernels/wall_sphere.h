/* A sphere of `radius` about the wall's point. */
#ifndef OZ_KERNELS_WALL_SPHERE_H
#define OZ_KERNELS_WALL_SPHERE_H

#include "kernels/wall_shape.h"

/* from: cap centre minus the sphere's, the wall's motion included. At the centre any direction serves. */
OZ_INLINE OzWallDistance oz_wall_sphere(OzVec3 from, OzWallShape wall)
{
    OzWallDistance at;
    real r2 = oz_dot(from, from), side = REAL(wall.side);
    real inverse = oz_inverse_root(oz_larger(r2, REAL(OZ_TINY)));
    at.normal = oz_scale(from, -side * inverse);
    at.distance = side * (REAL(wall.radius) - r2 * inverse);
    return at;
}

#endif
