/* final.csv: one row per grain by id, with enough digits to restore every value. Its columns and
 * its reader are in model/bed.h. */
#ifndef OZ_OBSERVE_FINAL_H
#define OZ_OBSERVE_FINAL_H

#include "observe/snapshot.h"

/* Writes under a temporary name beside path and renames. Fails with OZ_ERR_FILE, leaving what stood
 * under path. */
OzStatus oz_final_write(const OzSnapshot *snapshot, const char *path);

#endif
