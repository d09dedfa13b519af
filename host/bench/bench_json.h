/* A benchmark as bench.json, and two of them side by side. */
#pragma once

#include "bench/bench_row.h"

#include <stdio.h>

/* What is kept of a benchmark. Zeroed is valid. */
typedef struct OzBenchRecord {
    char *device, *version; /* owned */
    OzBenchRow *rows;       /* owned */
    int row_count;
    double start_cold, start_warm; /* s, to the first step: kernels built, and read from the
                                    * driver's cache; NAN: not measured */
} OzBenchRecord;

/* Leaves it as bench.json in a folder of the benchmark's: {"version": text, "device": text,
 * "start_cold_s": s, "start_warm_s": s, "rows": [{"bed": text, "grains": N, ...}, ...]}, a row's
 * names those of bench.csv, null for what was not measured. Prints rows of equal bed, grains,
 * scenes, bits and threads in `before` (empty: none) beside them: wall and processor time of a step
 * before, now, and their ratio. */
OzStatus oz_bench_json_leave(const OzBenchRecord *record, const OzBenchRecord *before,
                             const char *folder, FILE *text);

/* Reads one. The caller frees it, after a failure too. Fails with OZ_ERR_FILE, and with
 * OZ_ERR_INPUT for what is no bench.json, naming the line. */
OzStatus oz_bench_json_read(OzBenchRecord *record, const char *path);

void oz_bench_json_free(OzBenchRecord *record);
