/* Cosine and sine of any angle, and the angle between two directions, on lanes: devices' own are taken lane by lane on
 * some drivers, and need not give one lane what they give eight. Polynomials are summed by halves, which leaves a
 * processor more to do at a time than Horner's one after the other. */
#pragma once

#include "kernels/vec2.h"

/* Added and taken off again, this leaves whole numbers: no digits for less are left beside it. */
#if defined(OZ_HOST) || defined(OZ_DOUBLE)
#define OZ_TURN_WHOLE 6755399441055744.0
#else
#define OZ_TURN_WHOLE 12582912.0
#endif

/* The nearest whole number of a moderate one. */
OZ_INLINE real oz_turn_round(real x)
{
    return (x + REAL(OZ_TURN_WHOLE)) - REAL(OZ_TURN_WHOLE);
}

/* a + b x + x^2 (c + d x) */
OZ_INLINE real oz_turn_cubic(real x, real square, scalar a, scalar b, scalar c, scalar d)
{
    return (REAL(a) + x * REAL(b)) + square * (REAL(c) + x * REAL(d));
}

/* Sine and cosine of -pi/4..pi/4: their series up to the term below a double's last bit there. */
OZ_INLINE real oz_turn_sine(real x)
{
    real s = x * x, s2 = s * s;
    real low = oz_turn_cubic(s, s2, -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362880.0);
    real high = oz_turn_cubic(s, s2, -1.0 / 39916800.0, 1.0 / 6227020800.0,
                              -1.0 / 1307674368000.0, 1.0 / 355687428096000.0);
    return x + (x * s) * (low + (s2 * s2) * high);
}

OZ_INLINE real oz_turn_cosine(real x)
{
    real s = x * x, s2 = s * s;
    real low = oz_turn_cubic(s, s2, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40320.0, -1.0 / 3628800.0);
    real high = REAL(1.0 / 479001600.0) + s * REAL(-1.0 / 87178291200.0) +
                s2 * REAL(1.0 / 20922789888000.0);
    return REAL(1.0) + (s * REAL(-0.5) + s2 * (low + (s2 * s2) * high));
}

/* (cosine, sine). Quarter turns are taken off with pi/2 in two parts, the first of so few digits that whole
 * numbers of it up to 2^20 are exact in double. */
OZ_INLINE OzVec2 oz_turn_of(real angle)
{
    real quarters = oz_turn_round(angle * REAL(0.63661977236758134308));
    real x = (angle - quarters * REAL(1.5707963267341256)) - quarters * REAL(6.077100506506192e-11);
    real part = quarters - REAL(4.0) * oz_turn_round(quarters * REAL(0.25)); /* -2..2 */
    real c = oz_turn_cosine(x), s = oz_turn_sine(x);
    mask back = oz_magnitude(part) == REAL(2.0), left = part == REAL(1.0), right = part == REAL(-1.0);
    real first = (left | right) ? s : c, second = (left | right) ? c : s;
    return oz_vec2((left | back) ? -first : first, (right | back) ? -second : second);
}

/* Beyond this angle, twice the arc tangent of 0.6, oz_turn_between gives it and no more, rad. */
#define OZ_TURN_MOST 1.0808390005411683

/* The arc tangent of -0.6..0.6, by the polynomial through Chebyshev's points of 0..0.6^2 that is off by 3e-18. */
OZ_INLINE real oz_turn_arc(real s)
{
    real z = s * s, z2 = z * z, z4 = z2 * z2;
    real a = oz_turn_cubic(z, z2, -0.3333333333333316, 0.1999999999996373, -0.14285714282724926, 0.11111110981659093);
    real b = oz_turn_cubic(z, z2, -0.0909090570198637, 0.07692249512732006, -0.06665977586984781, 0.05876537802373187);
    real c = oz_turn_cubic(z, z2, -0.052274965347070414, 0.04601327865006977, -0.03815292395350499, 0.02701834918527347);
    real d = REAL(-0.013821591361196449) + z * REAL(0.003650661723404572);
    return s + (s * z) * ((a + z4 * b) + (z4 * z4) * (c + z4 * d));
}

/* The angle from the direction `from` (a unit vector) counter-clockwise to `to`, whose length is given: exact to a
 * double's digits between -OZ_TURN_MOST and OZ_TURN_MOST, and these beyond. tan(angle / 2) = sin / (1 + cos). */
OZ_INLINE real oz_turn_between(OzVec2 from, OzVec2 to, real length)
{
    real up = oz_cross2(from, to), along = oz_dot2(from, to);
    real s = up / (length + oz_larger(along, REAL(0.0)));
    s = oz_larger(REAL(-0.6), oz_smaller(REAL(0.6), s));
    s = along > REAL(0.0) ? s : (up > REAL(0.0) ? REAL(0.6) : REAL(-0.6));
    return REAL(2.0) * oz_turn_arc(s);
}
