/* Rods' walls that come and go (walls[].from, until), as a step's forces are told of them. Where a
 * wall that is gone would stand, nothing touches it: kernels/wall.h. */
#pragma once

#include "scene/scene.h"
#include "sim/physics.h"

#include <stdbool.h>

/* Whether the wall comes or goes at all. */
bool oz_gates_has(const OzWall *wall);

/* OZ_GATE_ bits (kernels/layout.h) of a wall at a step; times: s, of the step before, of this one
 * and of the next. */
int oz_gates_bits(const OzWall *wall, const double times[3], bool at_rest);

/* Takes away, or puts back, the sides of the kernel walls of a physics that are gone at a time. */
void oz_gates_set(OzPhysics *physics, const OzScene *scene, double time, bool at_rest);
