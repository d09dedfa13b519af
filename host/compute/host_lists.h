/* Outer lists made by the host, for `broadphase: sort_axis`: the kernel stops when it needs one, the
 * host makes it and the kernel goes on. */
#ifndef OZ_COMPUTE_HOST_LISTS_H
#define OZ_COMPUTE_HOST_LISTS_H

#include "compute/sim.h"

/* Makes the lists of every member that waits for one: the same pairs in the same order as the
 * device would list them, springs kept. Lists grow when they must. Fails with OZ_ERR_DEVICE when
 * the kernels make lists themselves: nothing to wait for. */
OzStatus oz_host_lists_make(OzSim *sim);

#endif
