/* `orzo gather`: the tables of an ensemble whose parts ran apart (`orzo run --part`). */
#pragma once

#include "cli.h"

/* members.csv and ensemble.csv of all parts together, as one run would have written them, into -o
 * or the one folder that holds the parts. Parts are folders with a members.csv. */
OzStatus oz_gather_run(const OzOptions *options);
