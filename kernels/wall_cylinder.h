/* The inside of an upright cylinder of `radius` about the z axis. */
#pragma once

#include "kernels/wall_shape.h"

/* from: cap centre minus a point of the axis. On the axis itself any direction serves: nothing is in reach there. */
OZ_INLINE OzWallDistance oz_wall_cylinder(OzVec3 from, OzWallShape wall)
{
    OzWallDistance at;
    real r2 = from.x * from.x + from.y * from.y;
    real inverse = oz_inverse_root(oz_larger(r2, REAL(OZ_TINY)));
    at.normal = oz_vec3(-from.x * inverse, -from.y * inverse, REAL(0.0));
    at.distance = REAL(wall.radius) - r2 * inverse;
    return at;
}

#if OZ_FINE
/* Overlap of an end, seen from the axis, and the cylinder that it is in, as oz_wall_plane_fine. */
OZ_INLINE real oz_wall_cylinder_fine(OzFineVec3 end, OzWallShape wall, OzFine rise, real radius, scalar counts)
{
    OzFine sum = {REAL(0.0), REAL(0.0)};
    (void)rise;
    real room = REAL(wall.radius * counts) - radius; /* how far it may be from the axis */
    sum = oz_fine_add_square(sum, end.x);
    sum = oz_fine_add_square(sum, end.y);
    return -oz_fine_nearer(sum, room);
}
#endif
