/* One launch of a simulation's kernels. */
#pragma once

#include "sim/sim_private.h"

/* Makes up to so many steps (0 makes what lists there are to make), fewer when what a launch is
 * given of walls ends on the way; *made receives how many. Fails with OZ_ERR_BLOWUP when guards
 * have stopped all members. */
OzStatus oz_launch_steps(OzSim *sim, int64_t steps, int *made);

/* A kernel over all members, one work-group each, and waits; last is its one argument of its own,
 * unless negative. */
OzStatus oz_launch_enqueue(OzSim *sim, cl_kernel kernel, int last);

/* Control words of all members to the device, and back. */
OzStatus oz_launch_write_control(OzSim *sim);
OzStatus oz_launch_read_control(OzSim *sim);
