/* A table of a run, series.csv or ensemble.csv, as far as plots need to know it. */
#pragma once

#include "base/cells.h"

#include <stdbool.h>

typedef struct OzPlotTable {
    OzCells cells;
    bool *has_value;    /* owned: any row of the column has a number    */
    double *low, *high; /* owned: the least and the greatest of them    */
    const char **first; /* owned: each different text of the first column, in order, in cells */
    int first_count;
} OzPlotTable;

/* Reads the file as oz_cells_read does. The caller frees, also on failure. */
OzStatus oz_plot_table_read(OzPlotTable *table, const char *path);

void oz_plot_table_free(OzPlotTable *table);
