/* The `sweep` group of a scene: keys and the values that each takes, whose combinations are members
 * of an ensemble. */
#pragma once

#include "scene/scene_types.h"
#include "scene/tree.h"

enum {
    OZ_SWEEP_KEYS_MAX = 16,
    OZ_SWEEP_COMBINATIONS_MAX = 100000, /* each has a folder of its own */
    OZ_SWEEP_VALUE_MAX = 100            /* letters: a value is part of a folder's name */
};

/* Takes the group's entries into sweep: keys with lists, and `zip`. Adds faults for a key that does
 * not exist, for values that are no numbers or words, and for those of a key that are not different
 * (of a zip: for lists of different lengths); whether a key may have a value shows when a member is
 * loaded. */
OzStatus oz_sweep_read(OzSweep *sweep, const OzNode *node, int model, OzFaults *faults);

/* The value of key k in combination i. */
const char *oz_sweep_value(const OzSweep *sweep, int64_t i, int k);

/* {key: [value, ...], ...}, as read. */
void oz_sweep_write(const OzSweep *sweep, FILE *file);

/* A copy that shares no memory; to be freed after a failure too. */
OzStatus oz_sweep_copy(OzSweep *copy, const OzSweep *sweep);

/* Frees what sweep owns and zeroes it. */
void oz_sweep_free(OzSweep *sweep);
