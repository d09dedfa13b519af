/* series.csv: one row per interval from THE list of observables. */
#pragma once

#include "base/state.h"
#include "observe/observables.h"

typedef struct OzSeries OzSeries;

/* THE list of columns (name, unit, meaning), ending with a NULL name: for `orzo keys --columns` and
 * the README. */
const OzColumn *oz_series_columns(void);

/* Opens path and writes the header row; columns that the scene cannot have (ledger off, another
 * model) are absent. path NULL: there is no file, and oz_series_row is what is left of a row. scene
 * and grains are borrowed. Fails with OZ_ERR_FILE, naming path. */
OzStatus oz_series_create(OzSeries **series, const char *path, const OzScene *scene,
                          const OzGrains *grains);

/* The same for rows that are there already: they are left alone until oz_series_state loads how
 * many of their bytes count, cuts off the others and lets rows follow. */
OzStatus oz_series_go_on(OzSeries **series, const char *path, const OzScene *scene,
                         const OzGrains *grains);

/* Saves or loads (base/state.h) all that later rows depend on. */
OzStatus oz_series_state(OzSeries *series, OzStateVisit *visit);

/* Takes one sample for the tap means (positions, axes and wall offsets of the snapshot are read;
 * called samples_per_tap times a period, or once, at the phase of observe.at). Cheap: no contacts
 * needed. The means run over the last two periods, over what there is before that, and are empty
 * before the first sample. */
void oz_series_sample(OzSeries *series, const OzSnapshot *snapshot);

/* The scene has changed. Columns that it has got are added to the file, empty in the rows so far;
 * those that it has lost are empty from now on. Rows at another interval begin an even series of a
 * drum anew, and energy_residual counts from the first row with another ledger. Fails with
 * OZ_ERR_FILE or OZ_ERR_MEMORY. */
OzStatus oz_series_take(OzSeries *series);

/* Writes one row and flushes. Needs contacts and, with the ledger on, the ledger: their cells are
 * empty otherwise. energy_residual counts from the first row written. */
OzStatus oz_series_write(OzSeries *series, const OzSnapshot *snapshot);

/* The cells of the last row (NAN: empty; none written yet: 0), owned by the series, and their count;
 * and a cell's name in the header. */
int oz_series_row(const OzSeries *series, const double **cells);
void oz_series_name(const OzSeries *series, int cell, char name[OZ_COLUMN_NAME]);

/* Whether there is a drum's inclination to write a spectrum of. */
bool oz_series_has_spectrum(const OzSeries *series);

/* After the last row: writes what a drum's inclination is made of (oz_flow_write_spectrum); without
 * a drum it writes no file. */
OzStatus oz_series_write_spectrum(const OzSeries *series, const char *path);

/* Closes; NULL is fine. */
OzStatus oz_series_free(OzSeries *series);
