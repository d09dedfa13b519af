/* `orzo bench`: how fast this machine runs beds of rods, and how far that is from what it could do.
 */
#pragma once

#include "cli.h"

/* Times an6 (or the scenes given) and a ladder of beds of the same height, on one and on all
 * threads, in float and double; prints a table and leaves DIR/bench.csv and DIR/bench.png, and what
 * a step of an6 and its pictures take, by parts and by sizes. A row
 * that memory or time does not allow is left out with a line that says so. */
OzStatus oz_bench_run(const OzOptions *options);
