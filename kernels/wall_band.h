/* A straight line turned about an axis, from `radius` at its point to extent[0] so far along as
 * extent[1]: a disc, an open cone or an open cylinder. A thin sheet, both sides of which are free.
 */
#ifndef OZ_KERNELS_WALL_BAND_H
#define OZ_KERNELS_WALL_BAND_H

#include "kernels/wall_shape.h"

/* How far the middle of a band is looked for along its axis: a shaft across the mouth of a long
 * tube touches both sides of its rim, and is split between them, not towards the middle of the
 * tube; one that is parallel to the axis has no other middle than that. A hundredth: directions
 * count as across down to a tenth of a radian. */
#define OZ_WALL_BAND_ALONG 0.01

/* A cap's centre in the half-plane of the axis in which it lies; on the axis itself any serves. */
typedef struct OzWallBandPlace {
    OzVec3 axis, outwards; /* unit vectors                                              */
    real along, beyond;    /* m: along the axis, and from the radius at the wall's point */
    real wider, length;    /* m: the band's own line                                    */
    real share;            /* of that line at the nearest point of its endless extension */
} OzWallBandPlace;

OZ_INLINE OzWallBandPlace oz_wall_band_place(OzVec3 from, OzWallShape wall)
{
    OzWallBandPlace at;
    OzVec3 any = oz_vec3(REAL(wall.across[0]), REAL(wall.across[1]), REAL(wall.across[2]));
    at.axis = oz_vec3(REAL(wall.normal[0]), REAL(wall.normal[1]), REAL(wall.normal[2]));
    at.along = oz_dot(from, at.axis);
    at.wider = REAL(wall.extent[0] - wall.radius);
    at.length = REAL(wall.extent[1]);
    OzVec3 out = oz_along(from, -at.along, at.axis);
    real out2 = oz_dot(out, out);
    real inverse = oz_inverse_root(oz_larger(out2, REAL(OZ_TINY * OZ_TINY)));
    at.outwards = oz_choose(out2 > REAL(OZ_TINY * OZ_TINY), oz_scale(out, inverse), any);
    at.beyond = out2 * inverse - REAL(wall.radius);
    at.share = (at.beyond * at.wider + at.along * at.length) /
               (at.wider * at.wider + at.length * at.length);
    return at;
}

/* from: cap centre minus the wall's point, the wall's motion included. */
OZ_INLINE OzWallDistance oz_wall_band(OzVec3 from, OzWallShape wall)
{
    OzWallBandPlace at = oz_wall_band_place(from, wall);
    real share = oz_larger(REAL(0.0), oz_smaller(REAL(1.0), at.share));
    OzVec3 away = oz_scale(at.outwards, at.beyond - share * at.wider);
    return oz_wall_shape_sheet(oz_along(away, at.along - share * at.length, at.axis));
}

/* As oz_wall_middle: nearest to the axis, and a little to the band's middle along it. */
OZ_INLINE real oz_wall_band_middle(OzVec3 from, OzVec3 half_shaft, OzWallShape wall)
{
    OzVec3 axis = oz_vec3(REAL(wall.normal[0]), REAL(wall.normal[1]), REAL(wall.normal[2]));
    real place = oz_dot(from, axis), rise = oz_dot(half_shaft, axis);
    real off = place - REAL(0.5 * wall.extent[1]), little = REAL(OZ_WALL_BAND_ALONG);
    real across = oz_dot(from, half_shaft) - place * rise;
    real across2 = oz_dot(half_shaft, half_shaft) - rise * rise;
    return -(across + little * off * rise) /
           oz_larger(across2 + little * rise * rise, REAL(OZ_TINY * OZ_TINY));
}

/* As oz_wall_flush: at a tube or a cone not outside, where the wall is round towards the grain. */
OZ_INLINE real oz_wall_band_flush(OzVec3 from, OzWallShape wall)
{
    OzWallBandPlace at = oz_wall_band_place(from, wall);
    real side = at.along * at.wider - at.beyond * at.length;
    side = wall.extent[1] > 0 ? oz_larger(side, REAL(0.0)) : side;
    mask within = (at.share > REAL(0.0)) & (at.share < REAL(1.0));
    return within ? side : REAL(0.0);
}

#endif
