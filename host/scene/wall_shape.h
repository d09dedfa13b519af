/* Rods' walls as their distances read them: the one place where a scene's keys become a shape. Says
 * OZ_HOST for whoever includes it. */
#pragma once

#define OZ_HOST

#include "kernels/wall_shape.h"
#include "scene/scene_types.h"

enum { OZ_WALL_SIDES_MAX = 6 };

/* The wall at rest, in m, as the sides it is made of: most walls are their only side, a box has
 * six. Returns how many. Walls of trigrains have none. */
int oz_wall_shape_sides(const OzWall *wall, OzWallShape sides[OZ_WALL_SIDES_MAX]);

/* Whether a shaft may touch a side between its ends. */
bool oz_wall_shape_is_edged(const OzWallShape *side);

/* Whether a wall is made of thin sheets with edges, or of triangles. */
bool oz_wall_shape_is_sheet(const OzWall *wall);

/* The unit vector along a cylinder's or a cone's axis. */
void oz_wall_shape_axis(const OzWall *wall, double axis[3]);

/* Two unit vectors across a third. */
void oz_wall_shape_across(const double normal[3], double u[3], double v[3]);

/* Whether it is a cylinder about the z axis: that kernels know for itself, that pictures look into
 * and in which density is defined. */
bool oz_wall_shape_is_upright(const OzWall *wall);

/* Notes at a scene's walls whether it has rods. */
void oz_wall_shape_meet(OzScene *scene);

/* Distance of a point from the wall's nearest side, m, > 0 on the free side; offset: m, by which
 * the wall has moved along its direction. normal, unless NULL, receives the unit vector into the
 * free side. */
double oz_wall_shape_distance(const OzWall *wall, double offset, const double point[3],
                              double normal[3]);

/* The same of one side that has moved by shift, m. */
double oz_wall_shape_side_distance(const OzWallShape *side, const double shift[3],
                                   const double point[3], double normal[3]);

/* How far a wall has moved, m, that has done so by offset along its motion's direction, or
 * a servo along its normal. */
void oz_wall_shape_shift(const OzWall *wall, double offset, double shift[3]);
