/* What follows from a scene's values, and whether they agree with one another. */
#pragma once

#include "scene/scene_types.h"
#include "scene/tree.h"

/* The most that a scene may ask for, each stated in its message. */
#define OZ_CHECK_GRAINS_MAX 20000000 /* about 1.5 kB each on host and device: 30 GB */
#define OZ_CHECK_STEPS_MAX  1e13     /* step times step count stays exact in double              */
#define OZ_CHECK_ROWS_MAX   1e8      /* of series.csv, about 300 bytes each: 30 GB               */
#define OZ_CHECK_FRAMES_MAX 1e7      /* of the movie                                             */

/* Fills in what is derived (unit vectors, period, taps in seconds, amplitudes) and adds faults for
 * what cannot be together. Values that were refused before are skipped. */
OzStatus oz_check_scene(OzScene *scene, OzNode *root, OzFaults *faults);
