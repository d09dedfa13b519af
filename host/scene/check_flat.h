/* What the values of a trigrains scene must be together: shapes, walls and their motion. */
#pragma once

#include "scene/scene_types.h"
#include "scene/tree.h"

/* Adds a fault for each thing that cannot be, and gives every wall the scene's contact values.
 * Values that were refused before are skipped. */
void oz_check_flat_scene(OzScene *scene, OzNode *root, OzFaults *faults);
