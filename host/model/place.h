/* The start: grains from a scene's populations. */
#ifndef OZ_MODEL_PLACE_H
#define OZ_MODEL_PLACE_H

#include "model/grains.h"

/* Fills grains (the caller frees with oz_grains_free) with every population in scene order; the same
 * scene and seed give the same grains on any machine. `random` grains are placed without overlap
 * among themselves, other grains placed before and all walls, in a column above the floor of the
 * container whose volume makes the fraction `fill`; without a cylinder the box of the planes around
 * it, or a cube about the origin, serves. Fails with OZ_ERR_INPUT, naming the population's line,
 * when they cannot be fitted in, and when a file population cannot be read. */
OzStatus oz_place_grains(OzGrains *grains, const OzScene *scene);

#endif
