/* The sides of rods' walls: a wall to the kernels is one side of a wall of the scene. */
#pragma once

#include "scene/wall_shape.h" /* says OZ_HOST */

#include "kernels/layout.h"

typedef struct OzWallSide {
    int wall; /* of the scene */
    OzWallShape shape;
} OzWallSide;

/* In the kernels' order: by kind, then as in the scene. Returns how many there are, of which the
 * first OZ_WALLS_MAX are written. */
int oz_sides_list(OzWallSide sides[OZ_WALLS_MAX], const OzScene *scene);

/* Refuses a scene of more than OZ_WALLS_MAX with OZ_ERR_INPUT. */
OzStatus oz_sides_check(const OzScene *scene);
