/* Trees put over one another: a scene over the one that it extends, settings over both. Of two keys
 * that say the same (time.duration and time.taps) the upper layer's replaces the lower one's. A
 * part that a scene can do without is left out where an upper layer says `false`. */
#pragma once

#include "scene/tree.h"

/* Moves what upper does not say from lower into upper: maps key by key, all else as a whole. Both
 * are maps; the caller still frees lower. */
OzStatus oz_layers_merge(OzNode *upper, OzNode *lower);

/* Puts value (owned from now on, also on failure) at a dotted path such as
 * `walls.0.motion.amplitude`, making missing groups. Adds a fault when there is no such place. */
OzStatus oz_layers_set(OzNode *root, const char *path, OzNode *value, OzFaults *faults);

/* Takes out of the finished tree what is `false` and may be missing: sections, keys without a
 * default, groups of those, and items of lists of groups. What has a default or is required stays,
 * to be refused as a wrong value. */
void oz_layers_drop(OzNode *root, int model);
