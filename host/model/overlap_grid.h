/* Spherocylinders lying in space, and the question whether one more would touch any of them. Works
 * for any mixture of sizes and aspects without comparing all with all. */
#pragma once

#include "base/status.h"
#include "scene/scene_types.h"

#include <stdbool.h>
#include <stdint.h>

/* All points within radius of the shaft from centre - half_shaft to centre + half_shaft, m. */
typedef struct OzCapsule {
    double centre[3], half_shaft[3], radius;
} OzCapsule;

/* One stretch of a member's shaft in one cell; cells that share a head are chained by next. */
typedef struct OzOverlapGridEntry {
    uint64_t hash;
    int64_t member, next;
} OzOverlapGridEntry;

/* A zeroed overlap grid is empty and may be used at once, after its boundary has been set.
 * Diameters up to 8e6 m. */
typedef struct OzOverlapGrid {
    OzCapsule *members;
    int64_t count, capacity;
    OzOverlapGridEntry *entries;
    int64_t entry_count, entry_capacity;
    int64_t *heads; /* head_count (0 or a power of two) first entries, -1: none */
    int64_t head_count;
    uint64_t levels; /* bit l: some member has a diameter of size class l */
    const OzBoundary
        *boundary;    /* borrowed: of a periodic one all images count; NULL: space is open */
    double reach_max; /* m, of a member from its centre                        */
} OzOverlapGrid;

void oz_overlap_grid_free(OzOverlapGrid *overlap_grid);

/* Adds a member, whether it touches others or not. Fails with OZ_ERR_MEMORY. */
OzStatus oz_overlap_grid_add(OzOverlapGrid *overlap_grid, const OzCapsule *capsule);

/* True when capsule overlaps a member. */
bool oz_overlap_grid_touches(const OzOverlapGrid *overlap_grid, const OzCapsule *capsule);

/* The least distance between two shafts, m; 0 when they intersect. */
double oz_overlap_grid_distance(const OzCapsule *a, const OzCapsule *b);
