/* Moving trigrains apart: the part of sim/part.h that knows triangles. */
#pragma once

#include "model/grains.h"

/* One sweep. *deepest becomes the depth of the deepest overlap found, over the smaller radius,
 * where that is more than it was. An overlap for which contacts have no law (one grain inside
 * another) counts as INFINITY; its two grains are moved apart along the line between their centres.
 */
OzStatus oz_part_elements_sweep(OzGrains *grains, const OzScene *scene, double *deepest);
