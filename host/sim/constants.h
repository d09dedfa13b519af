/* Scene and grains as the numbers that kernels and the host reference share: the parameter struct,
 * in double. Compiles the physics headers for the host. */
#pragma once

#define OZ_HOST
#include "kernels/layout.h"
#include "sim/switches.h"

/* Fills parameters for a scene. length_unit is chosen for single precision (1 in double): as fine
 * as the extent of the scene allows. Walls are put in kernel order, kind by kind; wall_order[k]
 * receives the scene index of kernel wall k. Fails with OZ_ERR_INPUT when the scene is too wide for
 * single precision. */
OzStatus oz_constants_fill(OzParameters *parameters, int wall_order[OZ_WALLS_MAX],
                           const OzScene *scene, const OzGrains *grains);

/* What the kernels have of contact values, in SI. */
OzLawConstants oz_constants_law(const OzScene *scene, const OzContactValues *values);

/* The same for a scene that takes over from one whose parameters these are: units and length_unit
 * stay, as the device's arrays are in them. Fails also where walls now lie too far away for them.
 */
OzStatus oz_constants_refill(OzParameters *parameters, int wall_order[OZ_WALLS_MAX],
                             const OzScene *scene, const OzGrains *grains,
                             const OzParameters *running);
