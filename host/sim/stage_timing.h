/* What the parts of a step cost, each timed by itself on a simulation that stands still. For `orzo
 * bench`. */
#pragma once

#include "sim/model.h"

/* Processor time of a CPU, which other programs disturb less; wall-clock time of another device, s.
 */
double oz_stage_timing_clock(const OzDevice *device);

/* Seconds of doing each of the model's stages once for all bodies of the first member, by that
 * clock. Afterwards every array of the device holds the same bits as before, and the simulation can
 * go on. */
OzStatus oz_stage_timing_measure(double seconds[OZ_TIMED_MOST], OzSim *sim, const char *source_dir);
