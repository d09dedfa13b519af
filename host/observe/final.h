/* final.csv: one row per grain by id, with enough digits to restore every value. Its columns and
 * its reader are in model/restart_csv.h; trigrains have columns of their own, OZ_FINAL_FLAT_HEADER.
 */
#pragma once

#include "model/snapshot.h"

/* SI; angle is how far the grain has turned since the start (rad, not wrapped), elements how many
 * it is made of, area m^2, mass kg a metre deep. */
#define OZ_FINAL_FLAT_HEADER "id,x,y,angle,vx,vy,spin,pieces,area,mass"

/* Reserves room on the disk for the final.csv of these grains, under the temporary name of
 * oz_final_write, so that the last state can be written when the disk has become full. Fails with
 * OZ_ERR_FILE where there is no room now; on a file system that reserves nothing it only makes the
 * file. */
OzStatus oz_final_reserve(const OzGrains *grains, const char *path);

/* Removes what was reserved for a path that will not be written; nothing there is fine. */
void oz_final_give_up(const char *path);

/* Writes under a temporary name beside path and renames. Fails with OZ_ERR_FILE, leaving what stood
 * under path, and with OZ_ERR_BLOWUP where a grain's state is no number. */
OzStatus oz_final_write(const OzSnapshot *snapshot, const char *path);
