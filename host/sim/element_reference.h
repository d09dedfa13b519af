/* The reference of trigrains: a scene of elements stepped on the host in double, by the same
 * physics headers as the kernels, with every integrator there is: gear4 (started with correct
 * derivatives), velocity-verlet (velocities predicted for damping; beams in substeps), rk4. For
 * tests and for errors against a known answer; one thread, no settling: step 0 is the grains' state
 * as given. */
#pragma once

#include "model/snapshot.h"

typedef struct OzElementReference OzElementReference;

/* scene and grains (with elements) are borrowed and must outlive the reference. The caller frees
 * it. On failure *reference is NULL. */
OzStatus oz_element_reference_create(OzElementReference **reference, const OzScene *scene,
                                     const OzGrains *grains);

/* Advances to the given step, counted from the start; nothing happens when it is there already.
 * Fails with OZ_ERR_BLOWUP on any fault of sim/element_forces.h, naming grains, step and time;
 * the state is then that of the failing step. */
OzStatus oz_element_reference_advance(OzElementReference *reference, int64_t step);

/* Fills a snapshot made for the same scene and grains: elements, grains, walls, contacts, and the
 * ledger when the scene asks for it. */
OzStatus oz_element_reference_snapshot(const OzElementReference *reference, OzSnapshot *snapshot);

/* NULL is fine. */
void oz_element_reference_free(OzElementReference *reference);

/* The second, third and fourth time derivatives of every free element's x, y and angle (each array
 * 3 x free_count: x y angle of element 0, ...) in a snapshot's state, for gear4's start: central
 * differences of fourth order over two scene steps of rk4 either way. */
OzStatus oz_element_reference_start_derivatives(const OzSnapshot *snapshot, bool at_rest,
                                                double *second, double *third, double *fourth);
