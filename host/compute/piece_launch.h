/* One launch of trigrains' kernels. */
#ifndef OZ_COMPUTE_PIECE_LAUNCH_H
#define OZ_COMPUTE_PIECE_LAUNCH_H

#include "compute/piece_sim.h"

/* Makes up to so many steps: fewer when a wall comes or goes on the way, or when the launch's
 * motion of walls ends; *made receives how many. Fails with OZ_ERR_BLOWUP when no member is left.
 */
OzStatus oz_piece_launch_steps(OzPieceSim *sim, int64_t steps, int *made);

/* Makes the records of pieces and walls anew, after an upload. */
OzStatus oz_piece_launch_begin(OzPieceSim *sim);

#endif
