/* What a guard of trigrains' kernels found, in words. */
#ifndef OZ_COMPUTE_PIECE_GUARD_H
#define OZ_COMPUTE_PIECE_GUARD_H

#include "compute/piece_arrays.h"
#include "compute/sim.h"

/* Fails with OZ_ERR_BLOWUP, naming grain, step, time and reasons. step is the last one made. */
OzStatus oz_piece_guard_fail(const OzPieceControl *control, const OzMember *member, int64_t step,
                             bool settling);

#endif
