/* What differs between a scene that runs and one that shall take over, key by key. */
#pragma once

#include "scene/scene_types.h"
#include "scene/tree.h"

/* A key whose value differs; owned texts, as YAML. */
typedef struct OzChange {
    char *path; /* "walls.0.motion.amplitude"                */
    char *old;  /* "2e-3"; empty: it was not written, and would not be */
    char *now;
} OzChange;

/* Zeroed is none. */
typedef struct OzChanges {
    OzChange *rows;
    int count;
} OzChanges;

/* Every key that would be written otherwise, in the order of the list of keys. Lists of unequal
 * length differ as a whole, of which old and now are the lengths. A key that takes its value from
 * another one in both scenes is left out. */
OzStatus oz_changes_find(OzChanges *changes, const OzScene *running, const OzScene *next);
void oz_changes_free(OzChanges *changes);

/* Adds a fault for each difference that cannot be while a scene runs, and for each key that the
 * running scene sweeps, at its place in the tree of next: key, running value, reason. */
OzStatus oz_changes_refuse(const OzScene *running, const OzScene *next, OzNode *root,
                           OzFaults *faults);

/* Each change as a setting for oz_scene_change; the caller frees every text and the array. */
OzStatus oz_changes_settings(char ***settings, const OzChanges *changes);
