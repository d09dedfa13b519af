/* Letting grains come to rest before time 0. */
#ifndef OZ_COMPUTE_SETTLE_H
#define OZ_COMPUTE_SETTLE_H

#include "compute/sim.h"

#include <stdbool.h>

/* Told between launches how far settling has come; says whether to go on. */
typedef bool (*OzSettleWatch)(void *context, double time, double energy_ratio);

/* Lets the grains come to rest as scene.settle says: walls still, with drag until the kinetic energy of every
 * member is below threshold x N m g d or time_max is reached (logged), then rest_time without drag. The step
 * count is 0 again afterwards. Does nothing without scene.settle. *seconds receives the simulated time. Fails
 * with OZ_ERR_INTERRUPTED when watch (may be NULL) says no. */
OzStatus oz_settle_run(OzSim *sim, double *seconds, OzSettleWatch watch, void *context);

#endif
