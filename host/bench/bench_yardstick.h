/* The scalar yardstick (tests/yardstick.c): another program that steps the same bed on one core. */
#pragma once

#include "bench/bench_row.h"

#include <stdio.h>

/* Runs the yardstick several times on the bed, written to folder; the row is the middle one. The
 * program is options->yardstick, or `yardstick` beside orzo or in tests/ below it. *found is false
 * without one. */
OzStatus oz_bench_yardstick_measure(OzBenchRow *row, bool *found, const OzBenchBed *bed,
                                    const OzOptions *options, const char *folder);

/* How many times as fast each scene of as many grains is, by the wall's and by the processor's
 * clock. */
void oz_bench_yardstick_compare(const OzBenchRow *yardstick, const OzBenchRow *rows, int count,
                                FILE *file);
