/* One launch of a simulation's kernels. */
#ifndef OZ_COMPUTE_LAUNCH_H
#define OZ_COMPUTE_LAUNCH_H

#include "compute/sim.h"

/* Makes exactly so many steps (at most sizes.motion_steps; 0 makes the lists), no first force
 * evaluation. Lists hold afterwards but for members that a guard stopped. Fails with OZ_ERR_BLOWUP
 * when none is left. */
OzStatus oz_launch_steps(OzSim *sim, int steps);

/* Writes offset and velocity of every wall of a member for so many steps (at most
 * sizes.motion_steps) from the present one on, and for their end; all the present one's while the
 * step has no length. A launch does so by itself. */
OzStatus oz_launch_move_walls(OzSim *sim, int member, int steps);

#endif
