/* Distances between shafts found by searching, for tests: independent of the code under test. */
#ifndef OZ_TESTS_BRUTE_H
#define OZ_TESTS_BRUTE_H

#include "model/overlap_grid.h"

#include <math.h>

/* Distance of the point at s (-1 to 1) on shaft a from shaft b. */
static inline double distance_at(const OzCapsule *a, const OzCapsule *b, double s)
{
    double w[3], along = 0, length2 = 0, distance2 = 0;
    for (int k = 0; k < 3; k++) {
        w[k] = a->centre[k] + s * a->half_shaft[k] - b->centre[k];
        along += w[k] * b->half_shaft[k];
        length2 += b->half_shaft[k] * b->half_shaft[k];
    }
    double t = length2 > 0 ? fmax(-1, fmin(1, along / length2)) : 0;
    for (int k = 0; k < 3; k++) {
        distance2 += pow(w[k] - t * b->half_shaft[k], 2);
    }
    return sqrt(distance2);
}

/* The distance is convex in s: a search by thirds, independent of the code under test. */
static inline double brute_distance(const OzCapsule *a, const OzCapsule *b)
{
    double low = -1, high = 1;
    for (int i = 0; i < 100; i++) {
        double third = (high - low) / 3;
        if (distance_at(a, b, low + third) < distance_at(a, b, high - third)) {
            high -= third;
        } else {
            low += third;
        }
    }
    return distance_at(a, b, 0.5 * (low + high));
}

#endif
