/* Outer lists made by the host, for `broadphase: sort_axis`: the kernel stops when it needs one,
 * the host makes it and the kernel goes on. */
#pragma once

#include "sim/sim.h"

/* Makes the outer list of every member that waits for one: the same pairs in the same order as the
 * device would list them. Tangential springs are kept, and a list that is too small grows. Fails
 * with OZ_ERR_DEVICE in a simulation whose kernels make the lists themselves. */
OzStatus oz_host_lists_make(OzSim *sim);
