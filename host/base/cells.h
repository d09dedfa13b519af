/* A table (series.csv, ensemble.csv, members.csv) cut into cells, all of it in memory. */
#pragma once

#include "base/status.h"

#include <stdint.h>

/* Zeroed is empty. */
typedef struct OzCells {
    char *text;   /* owned: the file, cut into cells           */
    char **cells; /* owned: in text, row by row, the names first */
    int column_count;
    int64_t row_count; /* without the names */
} OzCells;

/* Reads a file of lines of cells with commas between, the first line names; a short line's missing
 * cells are empty. The caller frees. Fails with OZ_ERR_FILE, and with OZ_ERR_INPUT without names.
 */
OzStatus oz_cells_read(OzCells *table, const char *path);
void oz_cells_free(OzCells *table);

/* The column's number, -1: there is none. */
int oz_cells_find(const OzCells *table, const char *name);

/* A cell's text, of row -1 the column's name; its number, NAN where it holds none. */
const char *oz_cells_text(const OzCells *table, int64_t row, int column);
double oz_cells_number(const OzCells *table, int64_t row, int column);
