/* THE list of observables: the columns of series.csv, `orzo keys --columns` and the README's table
 * are this list. A new observable is one function and one row. */
#pragma once

#include "observe/flow.h"
#include "observe/measure.h"

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

OzTapSample oz_observables_sample(OzMeasure *measure, const OzSnapshot *snapshot);

/* Everything that a value of one row may depend on. */
typedef struct OzObservation {
    OzMeasure *measure;
    const OzSnapshot *snapshot;
    const OzFlow *flow; /* of flat grains, the snapshot seen */
    int index;          /* of the column asked for, and of its repetition */
    OzContactSums contacts;
    double (*wall_force)[3]; /* N, of all grains on each wall of the scene; NULL: nobody asked */
    OzLayer layers[OZ_MEASURE_LAYERS];
    bool has_mean[OZ_TAP_MEANS];
    double mean[OZ_TAP_MEANS]; /* tap means, by the series                  */
    bool has_start;            /* energy_start is that of an earlier row    */
    double energy_start;       /* J, oz_observables_energy of the first row */
} OzObservation;

/* How often a column stands in a row, and what must be asked for: once; once with observe.ledger;
 * for each layer, "<i>" in its name being 1 to 4; with observe.walls for each wall, "<i>" being its
 * number from 0, and of each for every axis of the model, "<x>". */
typedef enum OzColumnNeed {
    OZ_COLUMN_ALWAYS,
    OZ_COLUMN_LEDGER,
    OZ_COLUMN_LAYERS,
    OZ_COLUMN_WALLS
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

/* The rows in the order of series.csv, ending with a NULL name. */
const OzColumn *oz_observables_list(void);

/* How many cells of a row are the column's: 0 in scenes that have not got it. */
int oz_observables_cells(const OzColumn *column, const OzScene *scene);

/* How many they are in a scene that has got it, alike in all else. */
int oz_observables_width(const OzColumn *column, const OzScene *scene);

/* The name of one of them, counted from 0. */
void oz_observables_name(const OzColumn *column, const OzScene *scene, int cell,
                         char name[OZ_COLUMN_NAME]);

/* Kinetic + rotational + potential + stored + dissipated (friction too) - work of the walls, J:
 * constant but for the error of integration. */
double oz_observables_energy(const OzSnapshot *snapshot);

/* What of it is dissipated, friction too, J; 0 without a ledger. */
double oz_observables_lost(const OzSnapshot *snapshot);
