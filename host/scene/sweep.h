/* The `sweep` group of a scene: one key and the values it takes in turn, each a member of an
 * ensemble. */
#ifndef OZ_SCENE_SWEEP_H
#define OZ_SCENE_SWEEP_H

#include "scene/scene.h"
#include "scene/tree.h"

/* Takes the group's one entry into sweep. Adds faults for more than one key, one that does not
 * exist, and values that are no different numbers or words; whether the key may have them shows
 * when a member is loaded. */
OzStatus oz_sweep_read(OzSweep *sweep, const OzNode *node, int model, OzFaults *faults);

/* {key: [value, ...]}, as read. */
void oz_sweep_write(const OzSweep *sweep, FILE *file);

/* Frees what sweep owns and zeroes it. */
void oz_sweep_free(OzSweep *sweep);

#endif
