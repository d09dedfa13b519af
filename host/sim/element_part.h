/* A grain that has come apart: who is of which piece, and the contacts that begin in the middle. */
#pragma once

#include "sim/element_forces.h"

/* Elements before and after a break. */
typedef struct OzElementParting {
    const int *body_before;  /* free_count                                            */
    const int *edges_before; /* count: bits of outer edges; NULL where contacts have no potential */
    const OzElements *after; /* of the pieces                                         */
} OzElementParting;

/* In this state, the least depths (kernels/beam_strength.h) of contacts that begin between elements
 * of one grain which were of one body before and are not after; and what is lost by new outer
 * edges, from which depths are now: added to the first broken beam. */
OzStatus oz_element_part_contacts(OzWear *wear, const OzScene *scene, const OzElementState *state,
                                  const OzElementParting *parting);

/* After an evaluation in which beams broke: forces are from now on between what is left of these
 * grains, in this state. */
OzStatus oz_element_part_grains(OzElementForces *forces, const OzGrains *grains,
                                const OzElementState *state);
