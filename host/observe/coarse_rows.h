/* fields.csv: a row for every cell of every moment asked for, x fastest, then y, then z, with the
 * middle of the cell (m) and the columns of observe/coarse_columns.h; an empty cell of the table
 * means: not defined here. fields_mean.csv: a row for every cell, of the mean over moments: what is
 * added up (observe/coarse_sums.h) is averaged, so that velocity is mean momentum over mean
 * density, and kinetic stress and temperature are of velocities about that one. */
#pragma once

#include "base/state.h"
#include "observe/coarse_columns.h"

typedef struct OzCoarseRows OzCoarseRows;

/* Opens path and writes the header. Fails with OZ_ERR_FILE, naming path. */
OzStatus oz_coarse_rows_create(OzCoarseRows **rows, const char *path, const OzScene *scene);

/* The same for rows that are there already: as oz_series_go_on. */
OzStatus oz_coarse_rows_go_on(OzCoarseRows **rows, const char *path, const OzScene *scene);

/* Saves or loads (base/state.h) how far the file counts, where cells lie and the mean so far. */
OzStatus oz_coarse_rows_state(OzCoarseRows *rows, OzStateVisit *visit);

/* All cells of a snapshot with its contacts; then flushes. The first one says where cells lie. */
OzStatus oz_coarse_rows_write(OzCoarseRows *rows, const OzSnapshot *snapshot);

/* Whether moments have been taken into the mean. */
bool oz_coarse_rows_has_mean(const OzCoarseRows *rows);

/* Writes fields_mean.csv. */
OzStatus oz_coarse_rows_write_mean(const OzCoarseRows *rows, const char *path);

/* The moment that was written last, or the mean: sums (OZ_COARSE_COUNT a cell) to be taken times
 * *factor, borrowed until the next write. */
const double *oz_coarse_rows_last(const OzCoarseRows *rows, bool mean, double *factor);

/* Where cells lie; NULL before the first write. */
const OzCoarseGrid *oz_coarse_rows_grid(const OzCoarseRows *rows);

/* Closes; NULL is fine. */
OzStatus oz_coarse_rows_free(OzCoarseRows *rows);
