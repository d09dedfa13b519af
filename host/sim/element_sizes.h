/* How a scene of trigrains is laid out on a device: slots, regions, list capacities, cells, skins;
 * and the parameters that its kernels read. */
#pragma once

#include "sim/element_fields.h"

/* For the model's row (sim/model.h), of OzElementSizes, OzElementParameters and OzElementSwitches.
 * Constants of a scene, in double, and its lists' skins and cells; fails with OZ_ERR_INPUT when
 * there are more walls than the kernels hold. */
OzStatus oz_element_sizes_parameters(void *parameters, const OzScene *scene, const OzGrains *grains,
                                     const void *running);

/* Sizes that a member of this kind needs. */
OzStatus oz_element_sizes_choose(void *sizes, void *parameters, const OzScene *scene,
                                 const OzGrains *grains, const void *switches);

/* Makes sizes large enough for another member too. */
void oz_element_sizes_join(void *sizes, const void *another);
