/* What the values of a wall's motion must be together, in both models. */
#pragma once

#include "scene/scene_types.h"
#include "scene/tree.h"

/* Of a shaken wall: either of amplitude A and acceleration ratio from the other, A (2 pi f)^2 =
 * ratio gravity (m/s^2), and how the shaking starts. */
void oz_check_motion_derive(OzMotion *motion, double gravity, int index, OzNode *root,
                            OzFaults *faults);

/* Adds a fault where a motion says too little, or turns a wall that does not stay as it is then.
 * index: of the wall. */
void oz_check_motion_wall(const OzWall *wall, int index, OzNode *root, OzFaults *faults);
