/* What the values of a wall's motion must be together, in both models. */
#pragma once

#include "scene/scene_types.h"
#include "scene/tree.h"

/* Adds a fault where a motion says too little, or turns a wall that does not stay as it is then.
 * index: of the wall. */
void oz_check_motion_wall(const OzWall *wall, int index, OzNode *root, OzFaults *faults);
