/* A straight line turned about an axis, from `radius` at its point to extent[0] so far along as
 * extent[1]: a disc, an open cone or an open cylinder. A thin sheet, both sides of which are free.
 */
#ifndef OZ_KERNELS_WALL_BAND_H
#define OZ_KERNELS_WALL_BAND_H

#include "kernels/wall_shape.h"

/* from: cap centre minus the wall's point, the wall's motion included. The nearest point lies in
 * the half-plane of the axis and the cap's centre. On the axis itself any such half-plane serves.
 */
OZ_INLINE OzWallDistance oz_wall_band(OzVec3 from, OzWallShape wall)
{
    OzVec3 axis = oz_vec3(REAL(wall.normal[0]), REAL(wall.normal[1]), REAL(wall.normal[2]));
    OzVec3 any = oz_vec3(REAL(wall.across[0]), REAL(wall.across[1]), REAL(wall.across[2]));
    real along = oz_dot(from, axis), wider = REAL(wall.extent[0] - wall.radius),
         length = REAL(wall.extent[1]);
    OzVec3 out = oz_along(from, -along, axis);
    real out2 = oz_dot(out, out),
         inverse = oz_inverse_root(oz_larger(out2, REAL(OZ_TINY * OZ_TINY)));
    OzVec3 outwards = oz_choose(out2 > REAL(OZ_TINY * OZ_TINY), oz_scale(out, inverse), any);
    real far = out2 * inverse, beyond = far - REAL(wall.radius);
    real share = (beyond * wider + along * length) / (wider * wider + length * length);
    share = oz_larger(REAL(0.0), oz_smaller(REAL(1.0), share));
    OzVec3 away = oz_scale(outwards, beyond - share * wider);
    return oz_wall_shape_sheet(oz_along(away, along - share * length, axis));
}

#endif
