/* Rods' walls as their distances read them: the one place where a scene's keys become a shape. Says
 * OZ_HOST for whoever includes it. */
#pragma once

#define OZ_HOST

#include "kernels/wall_shape.h"
#include "scene/scene.h"

/* The wall at rest, in m. Walls of trigrains have none: all is zero but the kind. */
OzWallShape oz_wall_shape_of(const OzWall *wall);

/* Distance of a point from the wall, m, > 0 on the free side; offset: m, by which the wall has
 * moved up. normal, unless NULL, receives the unit vector into the free side. */
double oz_wall_shape_distance(const OzWall *wall, double offset, const double point[3],
                              double normal[3]);
