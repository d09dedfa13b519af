/* How deep a contact of rods is, against what a run may go on with. The unit is the smaller radius
 * of two grains, at a wall half of the grain's radius. So the depth at which the shafts of two equal
 * grains meet is 2, and so is that at which a shaft lies in a wall, which acts like the grain's mirror
 * image. With NaN every comparison is false. */
#pragma once

#include "kernels/real.h"

/* Whether an overlap (m) is beyond so many units (m each). */
OZ_INLINE mask oz_depth_beyond(real overlap, real unit, scalar most)
{
    return !(overlap <= REAL(most) * unit);
}

/* Whether the shafts, reach (m) apart at first touch, meet now or will have met a step later, at the
 * overlap's present rate (m/s). Once they have passed each other the normal points the other way, and
 * the contact would push the grains on through each other. */
OZ_INLINE mask oz_depth_meets(real overlap, real rate, real reach, scalar dt)
{
    return !(overlap + oz_larger(rate, REAL(0.0)) * REAL(dt) < reach);
}
