/* Materials, who names them, and pairs of them. */
#pragma once

#include "scene/scene_types.h"
#include "scene/tree.h"

/* Finds what populations, walls and pairs name, gives grains their material's density, and fills in
 * what all contacts come to (scene/mixing.h). Adds a fault for each name that is not there. */
void oz_check_materials_resolve(OzScene *scene, OzNode *root, OzFaults *faults);
