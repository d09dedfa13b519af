/* series.csv: one row per interval from THE list of observables. */
#ifndef OZ_OBSERVE_SERIES_H
#define OZ_OBSERVE_SERIES_H

#include "observe/snapshot.h"

typedef struct OzSeries OzSeries;

/* One row of the list of columns, for `orzo keys --columns` and README. */
typedef struct OzColumn {
    const char *name, *unit, *meaning;
} OzColumn;

/* The columns, ending with a NULL name. */
const OzColumn *oz_series_columns(void);

/* Opens path and writes the header row; columns that the scene cannot have (ledger off) are absent. */
OzStatus oz_series_create(OzSeries **series, const char *path, const OzScene *scene,
                          const OzGrains *grains);

/* Takes one sample for the tap means (positions, axes and wall offsets of the snapshot are read; called
 * samples_per_tap times a period). Cheap: no contacts needed. */
void oz_series_sample(OzSeries *series, const OzSnapshot *snapshot);

/* Writes one row and flushes. Needs contacts and, with the ledger on, the ledger. */
OzStatus oz_series_write(OzSeries *series, const OzSnapshot *snapshot);

/* Closes; NULL is fine. */
OzStatus oz_series_free(OzSeries *series);

#endif
