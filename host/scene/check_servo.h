/* What a wall that holds a pressure must be together with others. */
#pragma once

#include "scene/scene_types.h"
#include "scene/tree.h"

/* Adds a fault for each servo that cannot be. */
void oz_check_servo_scene(const OzScene *scene, OzNode *root, OzFaults *faults);
