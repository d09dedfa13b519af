/* Walls as signed distances. A wall touches the cap at an end of a shaft (Pournin et al. 2005, sec. 3.2):
 * two contacts for a rod lying flat, one for a sphere. */
#ifndef OZ_KERNELS_WALLS_H
#define OZ_KERNELS_WALLS_H

#include "kernels/vec3.h"

/* Where a cap's centre stands against a wall. */
typedef struct OzWallDistance {
    OzVec3 normal; /* unit vector into the free side        */
    real distance; /* m, of the cap's centre from the wall  */
#if OZ_FINE
    real overlap; /* m, of the cap and the wall */
#endif
} OzWallDistance;

/* from_point: cap centre minus a point of the plane, the plane's motion included. */
OZ_INLINE OzWallDistance oz_walls_plane(OzVec3 from_point, scalar nx, scalar ny, scalar nz)
{
    OzWallDistance wall;
    wall.normal = oz_vec3(REAL(nx), REAL(ny), REAL(nz));
    wall.distance = oz_dot(from_point, wall.normal);
    return wall;
}

/* Inside of an upright cylinder about the z axis; from_axis: cap centre, its z not used. On the axis
 * itself any direction serves: nothing is in reach there. */
OZ_INLINE OzWallDistance oz_walls_cylinder(OzVec3 from_axis, scalar radius)
{
    OzWallDistance wall;
    real r2 = from_axis.x * from_axis.x + from_axis.y * from_axis.y;
    real inverse = oz_inverse_root(oz_larger(r2, REAL(OZ_TINY)));
    wall.normal = oz_vec3(-from_axis.x * inverse, -from_axis.y * inverse, REAL(0.0));
    wall.distance = REAL(radius) - r2 * inverse;
    return wall;
}

#endif
