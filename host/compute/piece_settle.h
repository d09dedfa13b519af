/* Letting trigrains come to rest before time 0. */
#ifndef OZ_COMPUTE_PIECE_SETTLE_H
#define OZ_COMPUTE_PIECE_SETTLE_H

#include "compute/piece_sim.h"

/* As oz_settle_run: walls at rest and all there, with drag until a member's kinetic energy is below
 * threshold x N m g d or time_max is reached, then rest_time without drag. The step count is 0
 * again afterwards. */
OzStatus oz_piece_settle_run(OzPieceSim *sim, double *seconds, OzSettleWatch watch, void *context);

#endif
