/* What the parts of a step cost, each timed by itself on a simulation that stands still. For `orzo
 * bench`. */
#pragma once

#include "sim/sim.h"

/* Seconds (of a CPU: processor time) of doing each once for all grains; NAN: not measured. */
typedef struct OzStageTiming {
    double pairs;   /* forces between grains                                             */
    double grains;  /* gather, integration, record, guards; walls left out               */
    double walls;   /* what that takes longer with the walls                             */
    double refresh; /* the inner list anew                                               */
    double rebuild; /* what that takes longer with the outer list anew, and a re-sort     */
} OzStageTiming;

/* Repeats each part many times at the state as it is, with a step of no length. Afterwards every
 * array of the device holds the same bits as before, and the simulation can go on. One member only.
 */
OzStatus oz_stage_timing_measure(OzStageTiming *phases, OzSim *sim, const char *source_dir);
