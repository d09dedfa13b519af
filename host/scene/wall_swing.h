/* How rods' walls stand that change their place when they turn: meshes, rectangles and boxes, about
 * motion.axis through motion.point, and discs and planes that are told one of these. All others
 * keep their shape, and stay as they were built. */
#pragma once

#include "scene/wall_shape.h"

#include "kernels/wall_swing.h"

/* Whether the wall turns so, or has. */
bool oz_wall_swing_has(const OzWall *wall);

/* Whether it is a plane whose normal turns. */
bool oz_wall_swing_tilts(const OzWall *wall);

/* How it stands when it has turned by an angle, rad, and goes on at a rate, rad/s; offsets are left
 * out. */
OzWallSwing oz_wall_swing_at(const OzWall *wall, double angle, double rate);

/* The same of a side of it, whose point as built is given. */
OzWallSwing oz_wall_swing_side(const OzWall *wall, const double point[3], double angle,
                               double rate);

/* The wall turned by an angle: its point, and a rectangle's directions. Triangles and a box's sides
 * stay as they were built. Borrows all that the wall holds. */
OzWall oz_wall_swing_turned(const OzWall *wall, double angle);

/* The farthest that a place on it is from the axis, m; 0 of walls that keep their shape, and of
 * planes, which have no end. */
double oz_wall_swing_reach(const OzWall *wall);
