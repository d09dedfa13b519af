/* A tree into a scene, by the list of keys. */
#pragma once

#include "scene/scene_types.h"
#include "scene/tree.h"

/* Puts every default and then every written value into a zeroed scene. Takes out of the tree what
 * is left out by `false` (oz_layers_drop). Adds faults for unknown, contradicting and wrong values,
 * which keep their defaults, and for missing ones; where the model is not known, and other keys
 * cannot be judged without it, for that alone. */
OzStatus oz_read_scene(OzScene *scene, OzNode *root, OzFaults *faults);
