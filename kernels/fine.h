/* Overlaps with as many digits at a light contact as at a heavy one (switch OZ_FINE, single
 * precision). A place is an integer with a carried remainder, and so is a turn. The overlap is the
 * small difference of large numbers: in plain floats all of it below one unit of a place would be
 * lost. Here differences of places are taken in integers, remainders are counted in, and the
 * rounding of sums and products is carried along as a second number (Dekker 1971; Knuth's sum of
 * two). All lengths are in units of a place. */
#pragma once

#include "kernels/space.h"

/* A sum, and what its digits could not hold. */
typedef struct OzFine {
    real high, low;
} OzFine;

OZ_INLINE OzFine oz_fine_add(OzFine sum, real x)
{
#pragma OPENCL FP_CONTRACT OFF
    real whole = sum.high + x, part = whole - sum.high;
    OzFine next = {whole, sum.low + ((sum.high - (whole - part)) + (x - part))};
    return next;
}

OZ_INLINE OzFine oz_fine_add_product(OzFine sum, real a, real b)
{
#pragma OPENCL FP_CONTRACT OFF
    real product = a * b;
    OzFine next = oz_fine_add(sum, product);
    next.low += fma(a, b, -product);
    return next;
}

/* The same sum, with as much of it as goes in its first number. */
OZ_INLINE OzFine oz_fine_tidy(OzFine sum)
{
#pragma OPENCL FP_CONTRACT OFF
    real whole = sum.high + sum.low;
    OzFine next = {whole, sum.low - (whole - sum.high)};
    return next;
}

/* Adds factor (x.high + x.low). */
OZ_INLINE OzFine oz_fine_add_share(OzFine sum, real factor, OzFine x)
{
    OzFine next = oz_fine_add_product(sum, factor, x.high);
    next.low += factor * x.low;
    return next;
}

/* Adds the product of two. */
OZ_INLINE OzFine oz_fine_add_both(OzFine sum, OzFine a, OzFine b)
{
    OzFine next = oz_fine_add_share(sum, a.high, b);
    next.low += a.low * b.high;
    return next;
}

OZ_INLINE OzFine oz_fine_minus(OzFine a)
{
    OzFine minus = {-a.high, -a.low};
    return minus;
}

typedef struct OzFineVec3 {
    OzFine x, y, z;
} OzFineVec3;

/* A grain's place and shaft. */
typedef struct OzFineGrain {
    OzSpace space;
    OzFixedPosition position;
    OzVec3 rest; /* of the place                                  */
    real radius;
    real half_shaft; /* 0 among spheres, whose axis is not looked at  */
    OzFineVec3 axis; /* unit vector                                   */
} OzFineGrain;

/* The axis of a turn with its remainder: body z turned into the world, over the turn's length
 * squared, which a float keeps to its own digits only. */
OZ_INLINE OzFineVec3 oz_fine_axis(OzQuaternion turn, OzQuaternion rest)
{
    OzFine x = {turn.x, rest.x}, y = {turn.y, rest.y}, z = {turn.z, rest.z}, w = {turn.w, rest.w};
    OzFine none = {REAL(0.0), REAL(0.0)}, longer = {REAL(-1.0), REAL(0.0)};
    OzFine bodies = oz_fine_add_both(oz_fine_add_both(none, w, w), z, z);
    OzFine across = oz_fine_add_both(oz_fine_add_both(none, x, x), y, y);
    longer = oz_fine_add(oz_fine_add(longer, bodies.high), across.high);
    real excess = longer.high + (longer.low + (bodies.low + across.low));
    OzFineVec3 axis;
    axis.x = oz_fine_add_both(oz_fine_add_both(none, x, z), w, y);
    axis.y = oz_fine_add_both(oz_fine_add_both(none, y, z), oz_fine_minus(w), x);
    axis.x.high *= REAL(2.0);
    axis.x.low *= REAL(2.0);
    axis.y.high *= REAL(2.0);
    axis.y.low *= REAL(2.0);
    axis.z = oz_fine_add(bodies, -across.high);
    axis.z.low -= across.low;
    axis.x.low -= excess * axis.x.high;
    axis.y.low -= excess * axis.y.high;
    axis.z.low -= excess * axis.z.high;
    return axis;
}

/* The difference of two coordinates, and that of their remainders. */
OZ_INLINE OzFine oz_fine_apart(fixed_position count, real rest)
{
    OzFine apart;
    apart.high = oz_fixed_position_to_real(count);
    apart.low = oz_fixed_position_to_real(count - oz_fixed_position_from_real(apart.high)) + rest;
    return apart;
}

/* Adds the square. */
OZ_INLINE OzFine oz_fine_add_square(OzFine sum, OzFine x)
{
    OzFine tidy = oz_fine_tidy(x);
    OzFine next = oz_fine_add_product(sum, tidy.high, tidy.high);
    next.low += tidy.low * (REAL(2.0) * tidy.high + tidy.low);
    return next;
}

/* By how much a point is nearer to the origin than `reach`: the difference of squares over the sum.
 * `square` is its distance squared. */
OZ_INLINE real oz_fine_nearer(OzFine square, real reach)
{
    real distance = sqrt(oz_larger(square.high, REAL(0.0)));
    OzFine excess = oz_fine_add_product(square, -reach, reach);
    return -(excess.high + excess.low) / (distance + reach);
}

/* Overlap of two grains at points of their shafts, given in half-shafts: s of a, t of b. That these
 * are floats does not matter: between closest points the distance does not change when one slides.
 */
OZ_INLINE real oz_fine_pair(OzFineGrain a, OzFineGrain b, real s, real t)
{
    OzFine sum = {REAL(0.0), REAL(0.0)};
#if OZ_SPACE_TILTS
    fixed_position across = oz_space_nearest(a.position.y - b.position.y, a.space, 1);
    OzFine x = oz_fine_apart(oz_space_nearest_tilted(a.position.x - b.position.x, across, a.space),
                             a.rest.x - b.rest.x);
#else
    OzFine x = oz_fine_apart(oz_space_nearest(a.position.x - b.position.x, a.space, 0),
                             a.rest.x - b.rest.x);
#endif
    OzFine y = oz_fine_apart(oz_space_nearest(a.position.y - b.position.y, a.space, 1),
                             a.rest.y - b.rest.y);
    OzFine z = oz_fine_apart(oz_space_nearest(a.position.z - b.position.z, a.space, 2),
                             a.rest.z - b.rest.z);
#if OZ_SPACE_TILTS
    x = oz_fine_add_product(x, REAL(a.space.tilt), y.high);
    x.low += a.space.tilt * y.low + a.space.tilt_rest * y.high;
#endif
    if (!OZ_ROUND) {
        real along_a = s * a.half_shaft, along_b = -t * b.half_shaft;
        x = oz_fine_add_share(oz_fine_add_share(x, along_a, a.axis.x), along_b, b.axis.x);
        y = oz_fine_add_share(oz_fine_add_share(y, along_a, a.axis.y), along_b, b.axis.y);
        z = oz_fine_add_share(oz_fine_add_share(z, along_a, a.axis.z), along_b, b.axis.z);
    }
    sum = oz_fine_add_square(sum, x);
    sum = oz_fine_add_square(sum, y);
    sum = oz_fine_add_square(sum, z);
    return oz_fine_nearer(sum, a.radius + b.radius);
}

/* Where an end of a grain is (sign: of the half-shaft that leads to it), seen from a point. */
OZ_INLINE OzFineVec3 oz_fine_end(OzFineGrain grain, real sign, OzFixedPosition from)
{
    OzFineVec3 end;
    end.x = oz_fine_apart(grain.position.x - from.x, grain.rest.x);
    end.y = oz_fine_apart(grain.position.y - from.y, grain.rest.y);
    end.z = oz_fine_apart(grain.position.z - from.z, grain.rest.z);
    if (!OZ_ROUND) {
        end.x = oz_fine_add_share(end.x, sign * grain.half_shaft, grain.axis.x);
        end.y = oz_fine_add_share(end.y, sign * grain.half_shaft, grain.axis.y);
        end.z = oz_fine_add_share(end.z, sign * grain.half_shaft, grain.axis.z);
    }
    return end;
}
