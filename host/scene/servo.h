/* Servo walls are numbered in the order of a scene's walls. */
#pragma once

#include "scene/scene_types.h"

/* Servo walls before this wall: its number among them, if it is one; how many there are, of the wall
 * after the last. */
int oz_servo_number(const OzScene *scene, int wall);
