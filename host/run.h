/* The straight line of one run: scene in; movie, pictures and numbers out. */
#ifndef OZ_RUN_H
#define OZ_RUN_H

#include "base/status.h"
#include "cli.h"

/* Runs the scene of options->paths[0] into its folder. On failure or interruption the outputs so far are
 * whole and the movie is playable. */
OzStatus oz_run_scene(const OzOptions *options);

#endif
