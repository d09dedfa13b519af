/* The straight line of a run: scene in; movie, pictures and numbers out. */
#pragma once

#include "base/status.h"
#include "cli.h"

/* Runs the scene of options->paths[0] into its folder. With --seeds or a sweep every member has a
 * folder below it, and members.csv and ensemble.csv say what came out; one that fails is named, and
 * the others go on. On failure or interruption the outputs so far are whole and movies are
 * playable. */
OzStatus oz_run_scene(const OzOptions *options);

/* Goes on with the run in the folder options->paths[0] from its last states, to its end or to
 * --until, or to a later end (--set time.taps, time.duration): rows and frames are the same to the
 * byte as without the stop. Members of an ensemble that had not begun are run too. Fails as
 * oz_run_scene does, and with OZ_ERR_INPUT when there is no state of this run, device and scene. */
OzStatus oz_run_resume(const OzOptions *options);
