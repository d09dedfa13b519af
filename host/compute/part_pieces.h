/* Moving trigrains apart: the part of compute/part.h that knows triangles. */
#ifndef OZ_COMPUTE_PART_PIECES_H
#define OZ_COMPUTE_PART_PIECES_H

#include "model/grains.h"

/* One sweep; *deepest is raised to the deepest overlap found, over the smaller radius, INFINITY
 * where contacts have no law: grains of which one is inside another are moved from each other's
 * centres.
 */
OzStatus oz_part_pieces_sweep(OzGrains *grains, const OzScene *scene, double *deepest);

#endif
