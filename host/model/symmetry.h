/* Whether a polygon's triangles are as symmetric as its outline. */
#pragma once

#include "model/triangle_set.h"

#include <stdbool.h>

/* Of a triangle set whose vertices are the outline's corners, in order: whether every rotation and
 * reflection that maps the outline onto itself, to a thousandth of its size, maps triangles onto
 * triangles. True of outlines that have none. A square cut along one diagonal is not: dropped flat,
 * it is softer on one side and begins to turn. */
bool oz_symmetry_is_kept(const OzTriangleSet *triangle_set);
