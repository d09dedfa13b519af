/* final.csv: one row per grain by id, with enough digits to restore every value. */
#ifndef OZ_OBSERVE_FINAL_H
#define OZ_OBSERVE_FINAL_H

#include "observe/snapshot.h"

/* Writes under a temporary name and renames. */
OzStatus oz_final_write(const OzSnapshot *snapshot, const char *path);

/* Reads a final.csv into grains (the caller frees): geometry, mass, inertia for the written mass,
 * state; population 0. Fails with OZ_ERR_INPUT, naming file and line. */
OzStatus oz_final_read(OzGrains *grains, const char *path);

#endif
