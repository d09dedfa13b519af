/* Letting grains come to rest before time 0. */
#ifndef OZ_COMPUTE_SETTLE_H
#define OZ_COMPUTE_SETTLE_H

#include "compute/sim.h"

#include <stdbool.h>

/* Told between launches how far settling has come; says whether to go on. */
typedef bool (*OzSettleWatch)(void *context, double time, double energy_ratio);

/* Lets the grains come to rest as scene.settle says: walls still, with drag until a member's kinetic energy is below
 * threshold x N m g d (it then waits for the others) or time_max is reached (logged), then rest_time without drag.
 * The step count is 0 again afterwards. Does nothing without scene.settle. *seconds receives the simulated time of
 * the member that took longest. Fails with OZ_ERR_INTERRUPTED when watch (may be NULL) says no. */
OzStatus oz_settle_run(OzSim *sim, double *seconds, OzSettleWatch watch, void *context);

#endif
