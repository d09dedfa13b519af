/* THE list of what is exported of a grain; every format walks it. */
#pragma once

#include "model/snapshot.h"

enum { OZ_GRAIN_COLUMN_WIDTH = 4 }; /* numbers of the widest column */

typedef struct OzGrainColumn {
    const char *name, *unit;
    int width;
    const char *parts[OZ_GRAIN_COLUMN_WIDTH]; /* a name for each number, in tables */
    bool is_whole;                            /* whole numbers                     */
    bool is_lasting;                          /* the same in every frame           */
    unsigned models;                          /* bit i: of the model i             */
    void (*fill)(const OzSnapshot *snapshot, int64_t grain, double *values);
} OzGrainColumn;

/* The rows, ending with one whose name is NULL. */
const OzGrainColumn *oz_grain_columns_all(void);

/* Whether the snapshot's grains have it. */
bool oz_grain_columns_serves(const OzGrainColumn *column, const OzSnapshot *snapshot);
