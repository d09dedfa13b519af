/* Cosine and sine of any angle on lanes: devices' own are taken lane by lane on some drivers, and need not give one
 * lane what they give eight. The angle is brought into an eighth of a turn, where power series end soon. */
#ifndef OZ_KERNELS_TURN_H
#define OZ_KERNELS_TURN_H

#include "kernels/vec2.h"

/* Sine of -pi/4..pi/4: its series up to the term below a double's last bit there. */
OZ_INLINE real oz_turn_sine(real x)
{
    real s = x * x;
    real sum = REAL(-1.0 / 1307674368000.0) + s * REAL(1.0 / 355687428096000.0);
    sum = REAL(1.0 / 6227020800.0) + s * sum;
    sum = REAL(-1.0 / 39916800.0) + s * sum;
    sum = REAL(1.0 / 362880.0) + s * sum;
    sum = REAL(-1.0 / 5040.0) + s * sum;
    sum = REAL(1.0 / 120.0) + s * sum;
    sum = REAL(-1.0 / 6.0) + s * sum;
    return x + x * (s * sum);
}

OZ_INLINE real oz_turn_cosine(real x)
{
    real s = x * x;
    real sum = REAL(1.0 / 20922789888000.0);
    sum = REAL(-1.0 / 87178291200.0) + s * sum;
    sum = REAL(1.0 / 479001600.0) + s * sum;
    sum = REAL(-1.0 / 3628800.0) + s * sum;
    sum = REAL(1.0 / 40320.0) + s * sum;
    sum = REAL(-1.0 / 720.0) + s * sum;
    sum = REAL(1.0 / 24.0) + s * sum;
    return REAL(1.0) + s * (REAL(-0.5) + s * sum);
}

/* (cosine, sine). Quarter turns are taken off with pi/2 in two parts, the first of so few digits that whole
 * numbers of it up to 2^20 are exact in double. */
OZ_INLINE OzVec2 oz_turn_of(real angle)
{
    real quarters = rint(angle * REAL(0.63661977236758134308));
    real x = (angle - quarters * REAL(1.5707963267341256)) -
             quarters * REAL(6.077100506506192e-11);
    real part = quarters - REAL(4.0) * floor(quarters * REAL(0.25)); /* 0..3 */
    real c = oz_turn_cosine(x), s = oz_turn_sine(x);
    mask odd = (part == REAL(1.0)) | (part == REAL(3.0));
    real first = odd ? s : c, second = odd ? c : s;
    first = ((part == REAL(1.0)) | (part == REAL(2.0))) ? -first : first;
    second = part >= REAL(2.0) ? -second : second;
    return oz_vec2(first, second);
}

#endif
