/* The reference of trigrains: a scene of pieces stepped on the host in double, by the same physics
 * headers as the kernels, with every integrator there is: gear4 (started with correct derivatives),
 * velocity-verlet (velocities predicted for damping; beams in substeps), rk4. For tests and for
 * errors against a known answer; one thread, no settling: step 0 is the grains' state as given. */
#ifndef OZ_COMPUTE_PIECE_REFERENCE_H
#define OZ_COMPUTE_PIECE_REFERENCE_H

#include "observe/snapshot.h"

typedef struct OzPieceReference OzPieceReference;

/* scene and grains (with pieces) are borrowed and must outlive the reference. The caller frees it.
 * On failure *reference is NULL. */
OzStatus oz_piece_reference_create(OzPieceReference **reference, const OzScene *scene,
                                   const OzGrains *grains);

/* Advances to the given step, counted from the start; nothing happens when it is there already.
 * Fails with OZ_ERR_BLOWUP on any fault of compute/piece_forces.h, naming grains, step and time;
 * the state is then that of the failing step. */
OzStatus oz_piece_reference_advance(OzPieceReference *reference, int64_t step);

/* Fills a snapshot made for the same scene and grains: pieces, grains, walls, sums, and the ledger
 * when the scene asks for it. */
OzStatus oz_piece_reference_snapshot(const OzPieceReference *reference, OzSnapshot *snapshot);

/* NULL is fine. */
void oz_piece_reference_free(OzPieceReference *reference);

/* The second, third and fourth time derivatives of every free piece's x, y and angle (each array
 * 3 x free_count: x y angle of piece 0, ...) in a snapshot's state, for gear4's start: central
 * differences of fourth order over two scene steps of rk4 either way. */
OzStatus oz_piece_reference_start_derivatives(const OzSnapshot *snapshot, bool at_rest,
                                              double *second, double *third, double *fourth);

#endif
