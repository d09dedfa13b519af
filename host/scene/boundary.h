/* What is at the ends of space. */
#pragma once

#include "scene/scene_types.h"
#include "scene/tree.h"

/* m after which space repeats itself along an axis, 0 to 2; 0: it does not. The cell is centred on
 * the origin. */
double oz_boundary_period(const OzBoundary *boundary, int axis);

/* Of a cell, that a grain may be as long as: two such grains meet at one of their images alone. */
#define OZ_BOUNDARY_LONGEST 0.49

/* By how much a cell is sheared at a time, s. While grains settle it stands as at time 0. */
double oz_boundary_strain(const OzBoundary *boundary, double time, bool settling);

/* How far its lattice tilts at that strain: as much less as leaves at most half of its length over
 * its width; and how many times that is. 0 of a cell that is not sheared. */
double oz_boundary_tilt(const OzBoundary *boundary, double strain);
double oz_boundary_turns(const OzBoundary *boundary, double strain);

/* The cell at a time: with its strain and tilt there. */
OzBoundary oz_boundary_at(const OzBoundary *boundary, double time, bool settling);

/* Lets the shear of `next`, as loaded, go on from that of a running one at a time. */
void oz_boundary_take_over(OzBoundary *next, const OzBoundary *running, double time);

/* Of a sheared cell, the strain of a step at which a pair that touches has still many steps. */
#define OZ_BOUNDARY_STEP_MOST 0.01

/* Refuses a scene that would leave a running one's sheared cell as if it stood upright. */
OzStatus oz_boundary_check_next(const OzScene *running, const OzScene *next);

/* Brings a place to within half a cell of the origin, in the lattice of its tilt. */
void oz_boundary_wrap(const OzBoundary *boundary, double place[3]);

/* What a boundary must be beside grains and walls: adds a fault where a cell has no size or is too
 * small for a grain, and where a wall is not the same in every cell. */
void oz_boundary_check(const OzScene *scene, OzNode *root, OzFaults *faults);
