/* How long the first step is waited for. */
#pragma once

#include "bench/bench_row.h"

#include <stdio.h>

/* Prints and returns s from opening the device to the end of the first launch of the bed: with
 * kernels built, and read from the driver's cache. PoCL keeps them in an empty folder of the
 * measurement's own meanwhile; another driver's cache stays what it is, and the first figure is
 * then of that. */
OzStatus oz_bench_start_print(double *cold, double *warm, OzBenchBed *bed, const OzOptions *options,
                              FILE *text);
