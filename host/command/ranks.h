/* `orzo run`, alone or as one of the processes that mpirun or srun has started. */
#pragma once

#include "cli.h"

/* Runs the scene (run/run.h). One of several processes takes its part of --seeds, as --part K/M
 * does, with as many threads as it may use processors; --part goes before. The last to end makes
 * the tables of all parts. Fails as a run and gather do; with OZ_ERR_INPUT without --seeds, since
 * one scene is not cut up over processes. */
OzStatus oz_ranks_run(const OzOptions *options);
