/* Whether grains start soundly: overlaps with each other and with walls, grains that no wall will
 * catch. Springs that start compressed throw grains apart at speeds that nobody asked for. */
#pragma once

#include "model/grains.h"

/* Overlaps up to this share of the smaller radius are rounding's. */
#define OZ_START_ROUNDING 1e-3
/* Beyond this share a scene is refused. */
#define OZ_START_MOST 0.5
/* Grains beyond this number are not looked at: it would take longer than a second. */
#define OZ_START_COUNT_MOST 200000

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

/* Looks at the start of a scene. Two kinds of overlap are not counted: those of rounding, and those
 * whose force a contact of a bed at rest may bear (oz_start_load). An overlap is refused when its
 * share is above OZ_START_MOST. Grains that were all read from a file go on as they were: of their
 * overlaps those alone are refused that guards.overlap.stop would stop. Grains placed at random
 * have no overlaps, so a scene of these alone is not looked at. */
OzStatus oz_start_look(OzStart *start, const OzScene *scene, const OzGrains *grains);

/* Fails with OZ_ERR_INPUT where no run should begin, naming pair, depth and stored energy, unless
 * forced; a warning in the log for other overlaps, and for grains that nothing will catch. */
OzStatus oz_start_judge(const OzScene *scene, const OzGrains *grains, bool force);

/* What a contact of a bed at rest may bear, N: three times the weight of a column of the heaviest
 * grain as high as the bed. */
double oz_start_load(const OzScene *scene, const OzGrains *grains);

/* Counts an overlap that is not left alone. It is refused where its share is above most, or, with
 * refuse, whatever its share. */
void oz_start_add(OzStart *start, const OzStartOverlap *overlap, double most, bool refuse);
