/* How many pictures a second are drawn of a bed, by size and view. */
#pragma once

#include "bench/bench_bed.h"

#include <stdio.h>

/* Prints processor time and pictures a second of one core for each size and view, of the bed as it
 * is, and writes folder/NAME.csv. Encoding is no part of it: it is a row of the shares. A machine
 * that cannot draw says so and has no such table. */
OzStatus oz_bench_pictures_print(const OzBenchBed *bed, const OzOptions *options,
                                 const char *folder, const char *name, FILE *text);
