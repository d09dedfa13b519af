/* contacts.csv: a row for every contact of every moment asked for, by a, then b; b is -1 - i at
 * wall i of the scene. Positions in m, forces in N: fn along the normal, which points from a to b,
 * pushing apart when positive, and ft across it, both on b. overlap in m, of triangles in m^2;
 * slips is 1 where the tangential force is all that friction lets it be. Trigrains have several
 * rows for two grains that touch with several triangles, and no z. */
#pragma once

#include "base/state.h"
#include "model/snapshot.h"

#include <stdio.h>

#define OZ_CONTACT_ROWS_HEADER "step,time,a,b,x,y,z,nx,ny,nz,overlap,fn,ftx,fty,ftz,slips"

typedef struct OzContactRows OzContactRows;

/* Opens path and writes the header. Fails with OZ_ERR_FILE, naming path. */
OzStatus oz_contact_rows_create(OzContactRows **rows, const char *path);

/* The same for rows that are there already: as oz_series_go_on. */
OzStatus oz_contact_rows_go_on(OzContactRows **rows, const char *path);

/* Saves or loads (base/state.h) how far the file counts. */
OzStatus oz_contact_rows_state(OzContactRows *rows, OzStateVisit *visit);

/* All contacts of a snapshot, nothing of one without; then flushes. */
OzStatus oz_contact_rows_write(OzContactRows *rows, const OzSnapshot *snapshot);

/* The rows alone, into any file. */
void oz_contact_rows_print(FILE *file, const OzSnapshot *snapshot);

/* Closes; NULL is fine. */
OzStatus oz_contact_rows_free(OzContactRows *rows);
