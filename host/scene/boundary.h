/* What is at the ends of space. */
#pragma once

#include "scene/scene_types.h"
#include "scene/tree.h"

/* m after which space repeats itself along an axis, 0 to 2; 0: it does not. The cell is centred on
 * the origin. */
double oz_boundary_period(const OzBoundary *boundary, int axis);

/* Of a cell, that a grain may be as long as: two such grains meet at one of their images alone. */
#define OZ_BOUNDARY_LONGEST 0.49

/* Brings a place to within half a cell of the origin. */
void oz_boundary_wrap(const OzBoundary *boundary, double place[3]);

/* What a boundary must be beside grains and walls: adds a fault where a cell has no size or is too
 * small for a grain, and where a wall is not the same in every cell. */
void oz_boundary_check(const OzScene *scene, OzNode *root, OzFaults *faults);
