/* One launch of a simulation's kernels. */
#pragma once

#include "sim/sim_private.h"

/* Makes up to so many steps (0 makes what lists there are to make), fewer when what a launch is
 * given of walls ends on the way; *made receives how many. Fails with OZ_ERR_BLOWUP when guards
 * have stopped all members. */
OzStatus oz_launch_steps(OzSim *sim, int64_t steps, int *made);

/* Makes what kernels of sim->program do the steps: sim->advance, or sim->large. */
OzStatus oz_launch_open(OzSim *sim);

/* Puts contacts' memory where it outlives the lists, which are then made anew; control words are as
 * the device has them before and after. */
OzStatus oz_launch_save_springs(OzSim *sim);

/* A kernel over all members, one work-group each (over all regions of a large scene), and waits;
 * last is its one argument of its own, unless negative. */
OzStatus oz_launch_enqueue(OzSim *sim, cl_kernel kernel, int last);

/* Control words of all members to the device. */
OzStatus oz_launch_write_control(OzSim *sim);
