/* What the values of a rods scene must be together: grains and the room between walls. */
#pragma once

#include "scene/scene_types.h"
#include "scene/tree.h"

/* Adds a fault for each thing that cannot be. Values that were refused before are skipped. */
void oz_check_solid_scene(const OzScene *scene, OzNode *root, OzFaults *faults);
