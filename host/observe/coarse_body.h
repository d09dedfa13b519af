/* A spherocylinder's volume as points in it, for fields of volume fraction. The integral over the
 * body of what is smooth over a length is the sum over the points, weighted. */
#pragma once

#include "base/status.h"

#include <stdint.h>

typedef struct OzCoarsePoint {
    double at[3]; /* m, from the centre           */
    double share; /* of the body's volume, sum 1 */
} OzCoarsePoint;

/* Zeroed is empty. Frees with free(points.of). */
typedef struct OzCoarsePoints {
    OzCoarsePoint *of;
    int64_t count, capacity;
} OzCoarsePoints;

/* Points of a body of this diameter and shaft (m) along a unit axis, for a function that is smooth
 * over `width` (m): slices across the axis, rings in them. What a cell gets of a sphere is right to
 * 3 % of the largest such share, and to 1 % at a width of half a diameter or more. */
OzStatus oz_coarse_body_fill(OzCoarsePoints *points, double diameter, double length,
                             const double axis[3], double width);
