/* What each feature of an6 costs. */
#pragma once

#include "bench/bench_bed.h"

#include <stdio.h>

/* Times (of a CPU: by processor time) an6 as it is and with one feature changed, in turns on one
 * thread (or on --threads), from the same settled and shaken bed; prints microseconds a step and
 * the difference (medians over the turns) and writes folder/features.csv. A changed feature changes
 * the motion too, so pairs per grain are told. */
OzStatus oz_bench_features_print(const OzBenchBed *bed, const OzOptions *options,
                                 const char *folder, FILE *text);
