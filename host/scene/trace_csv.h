/* The numbers of two columns of a CSV: time and what was measured. */
#pragma once

#include "scene/faults.h"

#include <stdint.h>

/* Owned: frees with oz_trace_csv_free; zeroed is fine. */
typedef struct OzTraceCsv {
    int64_t count;
    double *time, *value;
} OzTraceCsv;

/* Reads the column called time, or else the first one, and the one of that name (NULL: the only
 * other one). Times increase. What is wrong becomes one fault at its line, and the numbers are left
 * empty. Fails with OZ_ERR_MEMORY alone. */
OzStatus oz_trace_csv_read(OzTraceCsv *csv, const char *path, const char *column, OzFaults *faults);
void oz_trace_csv_free(OzTraceCsv *csv);
