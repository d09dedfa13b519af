/* How a scene is laid out on a device: blocks, regions, list capacities, cells, skins. */
#pragma once

#include "sim/constants.h"

/* For the model's row (sim/model.h), of OzSizes, OzParameters and OzSwitches: the sizes that a
 * scene needs, and the list parameters (skins, cells); members have the same number of grains, and
 * the last one's grid serves all. */
void oz_sizes_choose(void *sizes, void *parameters, const OzScene *scene, const OzGrains *grains,
                     const void *switches);
void oz_sizes_join(void *sizes, const void *other);
