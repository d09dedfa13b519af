/* A tree into a scene, by the list of keys. */
#ifndef OZ_SCENE_READ_H
#define OZ_SCENE_READ_H

#include "scene/scene.h"
#include "scene/tree.h"

/* Puts every default and then every written value into a zeroed scene. Adds faults for unknown,
 * contradicting and wrong values, which keep their defaults, and, when the tree is whole, for
 * missing ones. */
OzStatus oz_read_scene(OzScene *scene, const OzNode *root, bool whole, OzFaults *faults);

#endif
