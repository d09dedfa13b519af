/* Where a step of a trigrains scene spends its time: the rows of Table 1 of Poeschel and Buchholtz
 * (1995). */
#pragma once

#include "bench/bench_bed.h"

/* Takes the scene apart after it has settled and run for a while, in a process of its own, and
 * prints the table; `folder`/elements_NAME.csv receives the same. */
OzStatus oz_bench_elements_print(const OzBenchBed *bed, const OzOptions *options,
                                 const char *folder, FILE *text);
