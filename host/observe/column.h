/* A column of series.csv: a row of THE list of observables (observe/observables.h), and all that
 * its value may depend on. */
#pragma once

#include "observe/bed_order.h"
#include "observe/flow.h"
#include "observe/measure.h"
#include "observe/wall_push.h"

/* What tap means are made of, in the order of OzObservation.mean. */
typedef enum OzTapMean {
    OZ_TAP_DENSITY,
    OZ_TAP_DENSITY_ALL,
    OZ_TAP_DENSITY_COM,
    OZ_TAP_DENSITY_SLAB,
    OZ_TAP_ANGLE,
    OZ_TAP_MEANS
} OzTapMean;

/* One sample of each. */
typedef struct OzTapSample {
    bool present[OZ_TAP_MEANS]; /* false where the scene or the bed has no such value */
    double value[OZ_TAP_MEANS];
} OzTapSample;

/* Everything that a value of one row may depend on. */
typedef struct OzObservation {
    OzMeasure *measure;
    const OzSnapshot *snapshot;
    const OzFlow *flow; /* of flat grains, the snapshot seen */
    int index;          /* of the column asked for, and of its repetition */
    OzContactSums contacts;
    const OzWallPush *push;  /* forces on walls; none where nobody asked     */
    const OzBedOrder *order; /* of rods, this state's; with observe.order alone */
    OzLayer layers[OZ_MEASURE_LAYERS];
    bool has_mean[OZ_TAP_MEANS];
    double mean[OZ_TAP_MEANS]; /* tap means, by the series                  */
    bool has_start;            /* energy_start is that of an earlier row    */
    double energy_start;       /* J, oz_observables_energy of the first row */
} OzObservation;

/* How often a column stands in a row, and what must be asked for: once; once with observe.ledger,
 * or with observe.order, or with phases, or in a cell periodic in x, y and z, or in a sheared one,
 * or with beams.strength, or with that and the ledger, or with beams.yield and the ledger; for each
 * layer, "<i>" in its name being 1 to 4; for each servo wall, "<i>" being the wall's number from 0;
 * with observe.walls for each wall, "<i>" being its number from 0, and of each for every axis of
 * the model, "<x>". */
typedef enum OzColumnNeed {
    OZ_COLUMN_ALWAYS,
    OZ_COLUMN_LEDGER,
    OZ_COLUMN_ORDER,
    OZ_COLUMN_PHASES,
    OZ_COLUMN_CELL,
    OZ_COLUMN_SHEAR,
    OZ_COLUMN_STRENGTH,
    OZ_COLUMN_STRENGTH_LEDGER,
    OZ_COLUMN_YIELD_LEDGER,
    OZ_COLUMN_LAYERS,
    OZ_COLUMN_SERVOS,
    OZ_COLUMN_WALLS,
    OZ_COLUMN_WALL_TURNS
} OzColumnNeed;

enum { OZ_COLUMN_NAME = 64 };

/* The models that have a column: bits. */
enum {
    OZ_COLUMN_RODS = 1 << OZ_MODEL_RODS,
    OZ_COLUMN_TRIGRAINS = 1 << OZ_MODEL_TRIGRAINS,
    OZ_COLUMN_ALL = OZ_COLUMN_RODS | OZ_COLUMN_TRIGRAINS
};

/* One observable. value gives true and *value, or false for an empty cell. */
typedef struct OzColumn {
    const char *name, *unit, *meaning;
    int models;
    OzColumnNeed need;
    bool whole; /* printed as a whole number */
    bool (*value)(const OzObservation *observation, double *value);
    int index; /* tells apart the rows that share a function; of a repeated one the first index */
} OzColumn;
