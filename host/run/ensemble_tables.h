/* The tables of an ensemble: members.csv with one row a member, ensemble.csv with mean, spread and
 * 95 % interval of every column of series.csv over the members of each combination of the sweep; of
 * a drum swept over its speed also inclination_fit.csv (observe/inclination_fit.h). */
#pragma once

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct OzEnsemble OzEnsemble;

/* What members.csv says of a member. */
typedef struct OzEnsembleRow {
    const char *name; /* its folder below the ensemble's        */
    uint64_t seed;
    const char *value;  /* of the swept keys, with commas between; NULL without a sweep */
    const char *status; /* "done", "stopped", ...                 */
    bool has_series;    /* it was opened in this run              */
    const char *place;  /* where its folder is instead; NULL: below the ensemble's */
} OzEnsembleRow;

/* key is the swept one or NULL; of several keys, with commas between, each has a column. Both are
 * borrowed. */
OzStatus oz_ensemble_tables_create(OzEnsemble **ensemble, const char *folder, const char *key);

/* Adds a member, whose series.csv (if there is one) is whole. Members of one combination
 * come one after another. */
OzStatus oz_ensemble_tables_add(OzEnsemble *ensemble, const OzEnsembleRow *row);

/* Puts members.csv and ensemble.csv in place, says and writes the fit, and frees; NULL is fine. */
OzStatus oz_ensemble_tables_finish(OzEnsemble *ensemble);
