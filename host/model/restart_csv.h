/* A bed from a file: final.csv of an earlier run, one row per grain by id, with enough digits to
 * restore every value. The columns are spelled here once, for its writer too. */
#pragma once

#include "model/grains.h"

#define OZ_RESTART_CSV_HEADER "id,x,y,z,qw,qx,qy,qz,ux,uy,uz,vx,vy,vz,wx,wy,wz,diameter,length,mass"

/* Where each value stands in a row; everything is SI and in the world frame. */
enum {
    OZ_BED_ID = 0,
    OZ_BED_POSITION = 1,
    OZ_BED_QUATERNION = 4,
    OZ_BED_AXIS = 8, /* follows from the quaternion: for people, checked when read */
    OZ_BED_VELOCITY = 11,
    OZ_BED_SPIN = 14,
    OZ_BED_DIAMETER = 17,
    OZ_BED_LENGTH = 18, /* the shaft */
    OZ_BED_MASS = 19,
    OZ_BED_COLUMNS = 20
};

/* Reads a bed into grains (the caller frees with oz_grains_free): geometry, mass, the inertia of
 * that mass, and the state as written, bit for bit; population 0. Rows and columns may come in any
 * order; a byte-order mark, quotes and spaces about cells are passed over; ids must be 0 to count -
 * 1, each once, and there is at least one. Fails with OZ_ERR_INPUT as `file:line: what is wrong;
 * what was expected`, with OZ_ERR_FILE when the file cannot be read; grains is then zeroed. */
OzStatus oz_restart_csv_read(OzGrains *grains, const char *path);
