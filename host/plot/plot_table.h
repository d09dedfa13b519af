/* A table of a run, series.csv or ensemble.csv, as far as plots need to know it. */
#pragma once

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct OzPlotTable {
    char *text;      /* owned: the file, cut into cells  */
    char **names;    /* owned: of columns, in text       */
    bool *has_value; /* owned: any row has a number      */
    int column_count;
    int64_t row_count;
    char **first; /* owned: each different text of the first column, in order, in text */
    int first_count;
} OzPlotTable;

/* Reads a file of rows of cells with commas between, the first row names. The caller frees. Fails
 * with OZ_ERR_FILE, and with OZ_ERR_INPUT for a file without columns. */
OzStatus oz_plot_table_read(OzPlotTable *table, const char *path);

/* The column's number, -1: there is none. */
int oz_plot_table_find(const OzPlotTable *table, const char *name);

void oz_plot_table_free(OzPlotTable *table);
