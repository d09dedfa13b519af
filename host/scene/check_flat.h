/* What the values of a trigrains scene must be together: shapes, walls and their motion. */
#ifndef OZ_SCENE_CHECK_FLAT_H
#define OZ_SCENE_CHECK_FLAT_H

#include "scene/scene.h"
#include "scene/tree.h"

/* Adds a fault for each thing that cannot be, and gives every wall the scene's contact values.
 * Values that were refused before are skipped. */
void oz_check_flat_scene(OzScene *scene, OzNode *root, OzFaults *faults);

#endif
