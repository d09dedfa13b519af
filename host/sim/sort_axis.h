/* Pairs of grains near each other by a sort along one axis (Pournin et al. 2005, sec. 3): on the
 * host, for `broadphase: sort_axis` and for the reference simulation. */
#pragma once

#include "model/grains.h"
#include "scene/scene_types.h"

/* Ids. a is the grain of larger reach (half-length + radius), or the lower id where reaches are
 * equal. */
typedef struct OzPair {
    int a, b;
} OzPair;

/* Zeroed is empty. Owns pair. */
typedef struct OzPairs {
    OzPair *pair;
    int64_t count, capacity;
} OzPairs;

/* Replaces the list by every pair whose surfaces are less than skin (m) apart, sorted by a, then b.
 * position and axis are 3 x count (axis unit vectors); sizes are the grains'. Of a periodic
 * boundary all images count. The list's memory is
 * used again; the caller frees it with oz_sort_axis_free. */
OzStatus oz_sort_axis_pairs(OzPairs *list, const OzGrains *grains, const double *position,
                            const double *axis, double skin, const OzBoundary *boundary);

void oz_sort_axis_free(OzPairs *list);
