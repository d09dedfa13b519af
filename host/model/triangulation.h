/* A simple polygon cut into triangles whose corners are its own. */
#pragma once

#include "model/triangle_set.h"

/* Cuts the polygon of corner_count corners (x y in order, either way round) into corner_count - 2
 * triangles with as large a least angle as its own corners allow (Delaunay); the triangle set is
 * joined. Fails with OZ_ERR_INPUT, the text beginning with where ("scene.yaml:7"), when corners are
 * fewer than 3 or more than OZ_CORNERS_MAX, two coincide, one lies on the line of its neighbours,
 * or edges meet. */
OzStatus oz_triangulation_make(OzTriangleSet *triangle_set, const double *corners, int corner_count,
                               const char *where);
