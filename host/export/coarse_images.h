/* Coarse-grained fields for ParaView: fields/fields_NNNNN.vti of every moment, cells of equal size
 * with the columns of observe/coarse_columns.h as single precision; fields.pvd, which names them
 * with their times; and fields_mean.vti, all in a folder of the run's. */
#pragma once

#include "base/state.h"
#include "observe/coarse_rows.h"

typedef struct OzCoarseImages OzCoarseImages;

/* folder: the run's, open (base/folder.h). */
OzStatus oz_coarse_images_create(OzCoarseImages **images, const char *folder);

/* Saves or loads (base/state.h) which moments there are. */
OzStatus oz_coarse_images_state(OzCoarseImages *images, OzStateVisit *visit);

/* The moment that rows have written last, at `time` (s). Fails with OZ_ERR_FILE. */
OzStatus oz_coarse_images_add(OzCoarseImages *images, const OzCoarseRows *rows, double time);

/* The mean, at the end of the run. */
OzStatus oz_coarse_images_add_mean(OzCoarseImages *images, const OzCoarseRows *rows, double time);

/* Closes; NULL is fine. */
OzStatus oz_coarse_images_free(OzCoarseImages *images);
