/* A solid cylinder of `radius` about an axis, from its point to extent[1] along it, with both ends:
 * grains are outside. */
#ifndef OZ_KERNELS_WALL_SOLID_H
#define OZ_KERNELS_WALL_SOLID_H

#include "kernels/wall_band.h"

/* A cap's centre within: away from the nearest of side and ends. */
OZ_INLINE OzWallDistance oz_wall_solid_within(OzWallBandPlace at)
{
    OzWallDistance found;
    real to_end = oz_smaller(at.along, at.length - at.along);
    OzVec3 end = oz_scale(at.axis, at.along < at.length - at.along ? REAL(-1.0) : REAL(1.0));
    mask at_side = -at.beyond < to_end;
    found.normal = oz_choose(at_side, at.outwards, end);
    found.distance = at_side ? at.beyond : -to_end;
    return found;
}

/* from: cap centre minus the wall's point, the wall's motion included. */
OZ_INLINE OzWallDistance oz_wall_solid(OzVec3 from, OzWallShape wall)
{
    OzWallBandPlace at = oz_wall_band_place(from, wall);
    real past = at.along - oz_larger(REAL(0.0), oz_smaller(at.length, at.along));
    real beyond = oz_larger(at.beyond, REAL(0.0));
    OzWallDistance out =
        oz_wall_shape_sheet(oz_along(oz_scale(at.axis, past), beyond, at.outwards));
    OzWallDistance in = oz_wall_solid_within(at);
    mask within = (past == REAL(0.0)) & (beyond == REAL(0.0));
    out.normal = oz_choose(within, in.normal, out.normal);
    out.distance = within ? in.distance : out.distance;
    return out;
}

/* As oz_wall_middle. */
OZ_INLINE real oz_wall_solid_middle(OzVec3 from, OzVec3 half_shaft, OzWallShape wall)
{
    return oz_wall_band_middle(from, half_shaft, wall);
}

/* As oz_wall_flush: its sign is the end's that the cap is over. */
OZ_INLINE real oz_wall_solid_flush(OzVec3 from, OzWallShape wall)
{
    OzWallBandPlace at = oz_wall_band_place(from, wall);
    real past = at.along - oz_larger(REAL(0.0), oz_smaller(at.length, at.along));
    return at.beyond < REAL(0.0) ? past : REAL(0.0);
}

#endif
