/* A plane: `normal` into the free side. */
#pragma once

#include "kernels/wall_shape.h"

/* from: cap centre minus the wall's point, the wall's motion included. */
OZ_INLINE OzWallDistance oz_wall_plane(OzVec3 from, OzWallShape wall)
{
    OzWallDistance at;
    at.normal = oz_vec3(REAL(wall.normal[0]), REAL(wall.normal[1]), REAL(wall.normal[2]));
    at.distance = oz_dot(from, at.normal);
    return at;
}

#if OZ_FINE
/* Overlap of an end and a plane, in a place's units (counts of them in a metre). end: seen from the wall's point at
 * rest. rise: how far the wall has moved along z. */
OZ_INLINE real oz_wall_plane_fine(OzFineVec3 end, OzWallShape wall, OzFine rise, real radius, scalar counts)
{
    OzFine sum = {REAL(0.0), REAL(0.0)};
    (void)counts;
    sum = oz_fine_add_share(sum, REAL(wall.normal[0]), end.x);
    sum = oz_fine_add_share(sum, REAL(wall.normal[1]), end.y);
    sum = oz_fine_add_share(sum, REAL(wall.normal[2]), end.z);
    sum = oz_fine_add_share(sum, -REAL(wall.normal[2]), rise);
    sum = oz_fine_add(sum, -radius);
    return -(sum.high + sum.low);
}
#endif
