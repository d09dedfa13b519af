/* The floor and the cross-section of what a bed lies in, which heights and densities are measured
 * from. */
#pragma once

#include "scene/scene_types.h"

/* The wall whose bottom is the floor, or -1: the first level plane, else the first box or closed
 * upright cylinder, else the first level disc or rectangle. None that tilts, comes or goes. */
int oz_basin_floor(const OzScene *scene);

/* The floor's height at rest, in m. */
double oz_basin_bottom(const OzWall *floor);

/* The cross-section in m2 of the first upright cylinder, else of the first box that does not tilt,
 * else of a cell that is periodic in x and y; 0 without any. */
double oz_basin_area(const OzScene *scene);
