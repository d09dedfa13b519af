/* Rows of numbers to plot, of which a long run keeps every 2nd, 4th, ... one. No lock of its own.
 */
#pragma once

#include "base/status.h"

#include <stdint.h>
#include <stdio.h>

/* Zeroed is empty and takes no rows. */
typedef struct OzPageRows {
    char **names;
    int column_count;
    double *values;             /* kept x column_count                 */
    int64_t count, kept, every; /* given; kept: each `every`th of them */
} OzPageRows;

/* The columns, whose names are copied. Rows that are there keep the cells of columns that go on;
 * others are empty. On failure it is to be freed all the same. */
OzStatus oz_page_rows_open(OzPageRows *rows, const char *const *names, int count);
void oz_page_rows_free(OzPageRows *rows);

/* NAN: an empty cell. */
void oz_page_rows_add(OzPageRows *rows, const double *values);

/* JSON: all names; and, of the columns that a list "a,b" names, {"columns": [...], "rows": [...]}.
 */
void oz_page_rows_print_names(const OzPageRows *rows, FILE *file);
void oz_page_rows_print(const OzPageRows *rows, const char *list, FILE *file);
