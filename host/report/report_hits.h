/* `orzo report --hits`: how often two grains hit each other, and how they spin afterwards, for
 * every value of a scene's sweep; stepped by the reference. */
#pragma once

#include "cli.h"

/* Prints a row for every value of the sweep and each seed of options->paths[0], and between which
 * values the number of hits changes, counted from options->share (0: OZ_HITS_SHARE) of the impulse
 * and from 3, 5 and 10 % of it; leaves folder/hits.csv and, with gnuplot, folder/hits.png. Fails with
 * OZ_ERR_INPUT unless there are two grains of trigrains that move relative to each other, no walls
 * and no settling. */
OzStatus oz_report_hits_run(const OzOptions *options, const char *folder);
