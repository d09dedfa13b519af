/* How a scene is laid out on a device: blocks, regions, list capacities, cells, skins. */
#ifndef OZ_COMPUTE_SIZES_H
#define OZ_COMPUTE_SIZES_H

#include "compute/constants.h"

/* Fills sizes for members scenes like this one side by side, and the list parameters (skins, cells) of
 * parameters. */
void oz_sizes_choose(OzSizes *sizes, OzParameters *parameters, const OzScene *scene,
                     const OzGrains *grains, const OzSwitches *switches, int members);

/* Enlarges the capacities that control asks for, with room to spare. */
void oz_sizes_grow(OzSizes *sizes, const OzControl *control, const OzSwitches *switches);

#endif
