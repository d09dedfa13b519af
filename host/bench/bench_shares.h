/* Where the time of one scene goes: parts of a step, and what looks at it. */
#pragma once

#include "bench/bench_bed.h"

#include <stdio.h>

/* Prints the shares of a bed on one thread (or on --threads), after it has settled, if its scene
 * says so, and run for `warm` s, and writes folder/NAME.csv; a short movie for the sake of drawing
 * and encoding goes to folder/NAME/.
 * Parts of a step run in one kernel, so each is repeated by itself on the bed standing still, at
 * several moments of a tap, and their sum is held against a whole step; samples, rows, drawing and
 * encoding are timed on the host at the rates of the scene. */
OzStatus oz_bench_shares_print(const OzBenchBed *bed, double warm, const OzOptions *options,
                               const char *folder, const char *name, FILE *text);
