/* What follows from a trigrains scene, for `orzo check`. */
#pragma once

#include "model/grains.h"

#include <stdio.h>

/* Prints grains, elements and beams with their extremes, how walls move (a drum's Froude number),
 * and the step against the largest stable one with what sets it. Fails with OZ_ERR_MEMORY. */
OzStatus oz_inspect_elements_print(FILE *file, const OzScene *scene, const OzGrains *grains);

/* A line that warns of beams or contacts too soft for the hits to be expected, where they are. */
OzStatus oz_inspect_elements_warn(FILE *file, const OzScene *scene, const OzGrains *grains);
