/* Overlaps at the start, counted alike whatever the model (sim/start.h says which). */
#pragma once

#include "model/grains.h"

/* An overlap; the deepest of several. */
typedef struct OzStartOverlap {
    int64_t a;
    int64_t b;     /* the other grain, -1: a wall                                              */
    int wall;      /* of the scene                                                             */
    double depth;  /* m                                                                        */
    double share;  /* over the smaller radius (trigrains: of the circle of the grain's area)   */
    double energy; /* J, stored in the two's contacts                                          */
    bool behind;   /* rods: a centre is behind the wall; trigrains: more than half a triangle is
                      inside another, where contacts have no law                               */
} OzStartOverlap;

typedef struct OzStart {
    int64_t count;   /* overlaps beyond what is left alone                                      */
    int64_t refused; /* those among them with which no run should begin                         */
    double energy;   /* J, of all contacts                                                      */
    OzStartOverlap worst; /* the deepest; of those refused, if any                             */
    int64_t
        outside; /* trigrains: grains that no container holds and no wall is below, gravity on */
    int64_t outside_first; /* the first of them                                                */
} OzStart;

/* Overlaps up to this share of the smaller radius are rounding's. */
#define OZ_START_ROUNDING 1e-3
/* Beyond this share a scene is refused. */
#define OZ_START_MOST 0.5

/* What a contact of a bed at rest may bear, N: three times the weight of a column of the heaviest
 * grain as high as the bed. */
double oz_start_overlap_load(const OzScene *scene, const OzGrains *grains);

/* Counts an overlap that is not left alone. It is refused where its share is above most, or, with
 * refuse, whatever its share. */
void oz_start_overlap_add(OzStart *start, const OzStartOverlap *overlap, double most, bool refuse);
