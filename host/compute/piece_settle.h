/* Letting trigrains come to rest before time 0. */
#ifndef OZ_COMPUTE_PIECE_SETTLE_H
#define OZ_COMPUTE_PIECE_SETTLE_H

#include "compute/piece_sim.h"
#include "compute/rest.h"

/* As oz_rest_run; walls that will go later are all there meanwhile. */
OzStatus oz_piece_settle_run(OzPieceSim *sim, double *seconds, OzSettleWatch watch, void *context);

#endif
