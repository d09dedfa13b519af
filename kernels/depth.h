/* How deep a contact of rods is, against what a run may go on with. The unit is the smaller radius,
 * at a wall half of the radius: two shafts of a kind meet at 2, and so do a shaft and a wall, which
 * is as a mirror. Every comparison fails where a number is none. */
#ifndef OZ_KERNELS_DEPTH_H
#define OZ_KERNELS_DEPTH_H

#include "kernels/real.h"

/* Whether an overlap (m) is beyond so many units (m each). */
OZ_INLINE mask oz_depth_beyond(real overlap, real unit, scalar most)
{
    return !(overlap <= REAL(most) * unit);
}

/* Whether the shafts, reach (m) apart at first touch, are at each other or will be a step later: a
 * contact that goes through has its normal turned round and then pulls the two on. rate: m/s, of
 * the overlap. */
OZ_INLINE mask oz_depth_meets(real overlap, real rate, real reach, scalar dt)
{
    return !(overlap + oz_larger(rate, REAL(0.0)) * REAL(dt) < reach);
}

#endif
