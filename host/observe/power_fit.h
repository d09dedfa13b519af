/* A constant and a power: y = constant + factor x^exponent, all three free, by least squares. */
#pragma once

#include <stdbool.h>

/* Where the exponent is looked for: below, x^exponent is hardly told from a logarithm; above, the
 * greatest x alone is fitted. */
#define OZ_POWER_FIT_LOW  0.1
#define OZ_POWER_FIT_HIGH 8.0

enum { OZ_POWER_FIT_POINTS = 4 }; /* at least so many, of different x */

typedef struct OzPowerFit {
    double constant, factor, exponent;
    double exponent_low, exponent_high; /* 95 %: see below                                       */
    double residual;                    /* root mean square of the points' distances             */
    bool open;                          /* an end of the 95 % is an end of the search: the points
                                           do not say the exponent                               */
} OzPowerFit;

/* Fits count points, x >= 0. The 95 % of the exponent are where the sum of squares stays below its
 * least times 1 + t^2 / (count - 3), Student's t for count - 3 degrees of freedom (exact for a
 * model linear in it and equal normal errors). False with fewer than OZ_POWER_FIT_POINTS different
 * x. */
bool oz_power_fit_find(OzPowerFit *fit, const double *x, const double *y, int count);
