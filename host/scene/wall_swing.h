/* How rods' walls stand that change their place when they turn: meshes and rectangles, about
 * motion.axis through motion.point, and discs that are told one of these. All others keep their
 * shape, and stay as they were built. */
#pragma once

#include "scene/wall_shape.h"

#include "kernels/wall_swing.h"

/* Whether the wall turns so, or has. */
bool oz_wall_swing_has(const OzWall *wall);

/* How it stands when it has turned by an angle, rad, and goes on at a rate, rad/s; offsets are left
 * out. */
OzWallSwing oz_wall_swing_at(const OzWall *wall, double angle, double rate);

/* The wall turned by an angle: its point, and a rectangle's directions. Triangles stay where they
 * were built. Borrows all that the wall holds. */
OzWall oz_wall_swing_turned(const OzWall *wall, double angle);

/* The farthest that a place on it is from the axis, m; 0 of walls that keep their shape. */
double oz_wall_swing_reach(const OzWall *wall);
