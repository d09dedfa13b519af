/* The file names of a run's single pictures. */
#pragma once

#include "scene/scene.h"

#include <stddef.h>

/* Decimals that tell the scene's snapshots apart: 3 of taps, 6 of seconds, or more where two would
 * have one name. Times that fall into one step are one picture and need not differ. */
int oz_picture_name_decimals(const OzScene *scene);

/* tap_00300.png of a whole tap, tap_00300.500.png of others, time_1.250000.png without a moving
 * wall: the tap or time that was asked for where the picture's own is within half a step of one. */
void oz_picture_name_make(const OzScene *scene, double time, int decimals, char *name, size_t size);
