/* Pairs of shafts to find the closest points of: random ones and every degenerate case, for tests
 * on the host and on a device. Lengths are of order one. */
#ifndef OZ_TESTS_SHAFTS_H
#define OZ_TESTS_SHAFTS_H

#include "base/random.h"
#include "brute.h"

enum { SHAFT_PAIRS = 20000 };

static inline void make_random(OzCapsule pair[2], OzRandom *random)
{
    for (int i = 0; i < 2; i++) {
        double direction[3], half_length = oz_random_uniform(random, 0, 2);
        oz_random_direction(random, direction);
        for (int c = 0; c < 3; c++) {
            pair[i].centre[c] = oz_random_uniform(random, -2, 2);
            pair[i].half_shaft[c] = half_length * direction[c];
        }
    }
}

/* Shaft 1 becomes `factor` times shaft 0, turned a little: nearly parallel for small angles. */
static inline void align(OzCapsule pair[2], double factor, double angle)
{
    const double *a = pair[0].half_shaft, *across = pair[1].half_shaft;
    double a2 = 0, b2 = 0, both = 0, side[3];
    for (int c = 0; c < 3; c++) {
        a2 += a[c] * a[c];
        both += a[c] * across[c];
    }
    for (int c = 0; c < 3; c++) {
        side[c] = across[c] - both / a2 * a[c];
        b2 += side[c] * side[c];
    }
    for (int c = 0; c < 3; c++) {
        pair[1].half_shaft[c] = factor * (cos(angle) * a[c] + sin(angle) * sqrt(a2 / b2) * side[c]);
    }
}

/* Shaft 1's centre is moved to `along` half-shafts of 0 from its middle and `aside` half-shafts of
 * 1 before its own: collinear shafts, or shafts that meet. */
static inline void join(OzCapsule pair[2], double along, double aside)
{
    for (int c = 0; c < 3; c++) {
        pair[1].centre[c] =
            pair[0].centre[c] + along * pair[0].half_shaft[c] - aside * pair[1].half_shaft[c];
    }
}

/* Pair k: random shafts for even k, for odd k each degenerate case in turn. */
static inline void make_pair(OzCapsule pair[2], int k)
{
    OzRandom random = oz_random_stream(7, (uint64_t)k);
    double angle = pow(10, -1 - (k / 16) % 12); /* 1e-1 ... 1e-12 */
    double factor = oz_random_uniform(&random, 0.2, 2), along = oz_random_uniform(&random, -3, 3);
    double aside = oz_random_uniform(&random, -3, 3);
    make_random(pair, &random);
    switch (k % 16) {
    case 1: /* a sphere and a shaft */
        memset(pair[0].half_shaft, 0, sizeof pair[0].half_shaft);
        break;
    case 3: /* a shaft and a sphere */
        memset(pair[1].half_shaft, 0, sizeof pair[1].half_shaft);
        break;
    case 5: /* two spheres */
        memset(pair[0].half_shaft, 0, sizeof pair[0].half_shaft);
        memset(pair[1].half_shaft, 0, sizeof pair[1].half_shaft);
        break;
    case 7: /* nearly parallel or anti-parallel */
        align(pair, k % 32 < 16 ? factor : -factor, angle);
        break;
    case 9: /* parallel or anti-parallel, exactly in the numbers: powers of two */
        align(pair, k % 32 < 16 ? 0.5 : -2, 0);
        break;
    case 11: /* collinear, overlapping or end to end */
        align(pair, k % 32 < 16 ? 0.5 : -2, 0);
        join(pair, along, 0);
        break;
    case 13: /* on one plane, crossing or not */
        join(pair, along, aside);
        break;
    case 15: /* crossing at a small angle */
        align(pair, factor, angle);
        join(pair, along / 4, aside / 4);
        break;
    default:
        break;
    }
}

/* Distance of the points at s and t. */
static inline double distance_between(const OzCapsule pair[2], double s, double t)
{
    double distance2 = 0;
    for (int c = 0; c < 3; c++) {
        double apart = pair[0].centre[c] - pair[1].centre[c];
        distance2 += pow(apart + s * pair[0].half_shaft[c] - t * pair[1].half_shaft[c], 2);
    }
    return sqrt(distance2);
}

/* How much too far the chosen points may be. Distances are stationary in s and t, or s or t is at
 * an end, so that their errors enter squared, or along shafts that are apart by a small angle times
 * them: what is left is rounding. Shafts within `parallel` (the sine, as the code under test has
 * it) are taken as parallel: that moves a point of a shaft (up to 4 long on either side) by the
 * angle, on both. */
static inline double allowed_excess(const OzCapsule pair[2], double rounding, double parallel)
{
    const double *a = pair[0].half_shaft, *b = pair[1].half_shaft;
    double a2 = 0, b2 = 0, across2 = 0;
    for (int c = 0; c < 3; c++) {
        int d = (c + 1) % 3;
        a2 += a[c] * a[c];
        b2 += b[c] * b[c];
        across2 += pow(a[c] * b[d] - a[d] * b[c], 2);
    }
    bool counts = across2 > 0 && across2 < 1.5 * parallel * parallel * a2 * b2;
    return rounding + (counts ? 8 * parallel : 0);
}

#endif
