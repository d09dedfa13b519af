/* A grain that has come apart: who is of which piece, and the contacts that begin in the middle. */
#pragma once

#include "sim/element_forces.h"

/* The bodies of free elements before and after a break. */
typedef struct OzElementParting {
    const int *before, *after;
} OzElementParting;

/* The least depths of contacts (kernels/beam_strength.h) that begin between elements of one grain
 * which were of one body before and are not after; position (2 x) and angle are theirs now. */
void oz_element_part_contacts(OzWear *wear, const OzScene *scene, const OzElements *elements,
                              const double *position, const double *angle,
                              OzElementParting parting);

/* After an evaluation in which beams broke: forces are from now on between what is left of these
 * grains, in this state. */
OzStatus oz_element_part_grains(OzElementForces *forces, const OzGrains *grains,
                                const OzElementState *state);
