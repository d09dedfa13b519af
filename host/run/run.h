/* The straight line of a run: scene in; movie, pictures and numbers out. */
#pragma once

#include "base/status.h"
#include "cli.h"

/* Runs the scene of options->paths[0] into its folder. With --seeds or a sweep every member has a
 * folder below it, and members.csv and ensemble.csv say what came out; one that fails is named, and
 * the others go on. On failure or interruption the outputs so far are whole and movies are
 * playable. */
OzStatus oz_run_scene(const OzOptions *options);
