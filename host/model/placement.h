/* What grains of all models have alike at the start: their numbers and random streams, places as
 * told, and random ones that are tried one after another until they touch nothing. */
#pragma once

#include "base/random.h"
#include "base/stage.h"
#include "model/grains.h"
#include "model/overlap_grid.h"

/* A grain waiting for its place. */
typedef struct OzWaiting {
    double extent; /* m: those of a larger one are placed first */
    int64_t id;
} OzWaiting;

/* Zeroed is valid. */
typedef struct OzPlacement {
    const OzScene *scene;
    OzGrains *grains;
    int64_t *first; /* id of each population's first grain; the grains' number at the end */
    OzWaiting *waiting;
    int64_t waiting_count;
    OzOverlapGrid overlap_grid;
    int64_t raise_count; /* of the region, by a tenth each time */
    OzStage *stage;      /* borrowed */
} OzPlacement;

/* Finds the populations' ids, of those from files by their beds (one for each population; NULL:
 * none is), and makes the grains and room for all to wait. Frees what it made with
 * oz_placement_free, also on failure. Fails with OZ_ERR_INPUT where they are too many. */
OzStatus oz_placement_create(OzPlacement *placement, const OzGrains *beds);
void oz_placement_free(OzPlacement *placement); /* not the grains */

/* A grain's own random numbers, whatever else the scene holds. */
OzRandom oz_placement_stream(const OzPlacement *placement, int64_t i);

/* Position (in the lattice) and velocity along so many axes as its population tells. */
void oz_placement_put(const OzPlacement *placement, int64_t i, int axes);

/* What a model does for its random grains. own: as given to oz_placement_fill. */
typedef struct OzPlacementWay {
    OzCapsule (*capsule)(const void *own, int64_t i); /* what a told grain takes up            */
    void (*begin)(void *own); /* makes the region; the waiting ones are in order               */
    OzStatus (*place)(void *own, int64_t i, int64_t placed); /* one grain, after so many       */
    const char *grown; /* "large": how many times so the region is when it was raised          */
} OzPlacementWay;

/* Places all that wait, the largest first: they need the most room, and small ones still fit
 * between them. A line in the log when the region had to grow. */
OzStatus oz_placement_fill(OzPlacement *placement, const OzPlacementWay *way, void *own);

/* OZ_ERR_INPUT: the region is full. */
OzStatus oz_placement_refuse(const OzPlacement *placement, int64_t i, int64_t placed);
