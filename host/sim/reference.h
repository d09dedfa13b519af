/* The reference: the same scene stepped on the host in double precision, by the same physics
 * headers in the same order as the kernels (each grain sums the pairs in which it is the second by
 * the other's id, then its own, then planes, then cylinders). For tests and for errors against a
 * known answer; one thread, no settling: step 0 is the grains' state as given. */
#pragma once

#include "model/snapshot.h"

typedef struct OzReference OzReference;

/* scene and grains are borrowed and must outlive the reference. The caller frees it. On failure
 * *reference is NULL. */
OzStatus oz_reference_create(OzReference **reference, const OzScene *scene, const OzGrains *grains);

/* Advances to the given step, counted from the start; nothing happens when it is there already.
 * Fails with OZ_ERR_BLOWUP, naming grain, step and time, when a grain became NaN or too fast for
 * the step, when an overlap is deeper than the smaller radius, and when a grain is through a wall;
 * the state is then that of the failing step. */
OzStatus oz_reference_advance(OzReference *reference, int64_t step);

/* Fills a snapshot made for the same scene and grains: state, walls, contacts, and the ledger when
 * the scene asks for it. */
OzStatus oz_reference_snapshot(const OzReference *reference, OzSnapshot *snapshot);

/* NULL is fine. */
void oz_reference_free(OzReference *reference);
