/* What a guard of trigrains' kernels found, in words. */
#ifndef OZ_COMPUTE_PIECE_GUARD_H
#define OZ_COMPUTE_PIECE_GUARD_H

#include "compute/piece_arrays.h"
#include "observe/snapshot.h"

#include <stdbool.h>

/* Fails with OZ_ERR_BLOWUP, naming grain, step, time, reasons, and what would help. now: the state
 * after that step. */
OzStatus oz_piece_guard_fail(const OzPieceControl *control, const OzSnapshot *now, bool settling);

#endif
