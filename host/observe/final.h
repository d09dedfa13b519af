/* final.csv: one row per grain by id, with enough digits to restore every value. Its columns and
 * its reader are in model/bed.h; trigrains have columns of their own, OZ_FINAL_FLAT_HEADER. */
#ifndef OZ_OBSERVE_FINAL_H
#define OZ_OBSERVE_FINAL_H

#include "observe/snapshot.h"

/* SI; angle is how far the grain has turned since the start (rad, not wrapped), pieces how many it
 * is made of, area m^2, mass kg a metre deep. */
#define OZ_FINAL_FLAT_HEADER "id,x,y,angle,vx,vy,spin,pieces,area,mass"

/* Writes under a temporary name beside path and renames. Fails with OZ_ERR_FILE, leaving what stood
 * under path. */
OzStatus oz_final_write(const OzSnapshot *snapshot, const char *path);

#endif
