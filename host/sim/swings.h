/* Rods' walls that change their place when they turn (scene/wall_swing.h), at a time. */
#pragma once

#include "scene/scene.h"
#include "sim/physics.h"

#include "kernels/wall_drive.h"

/* Turns the kernel walls of a physics to where they are at a time, s; at_rest: as built. */
void oz_swings_set(OzPhysics *physics, const OzScene *scene, double time, bool at_rest);

/* Adds to how kernel wall w moves what its point does by turning. */
void oz_swings_drive(OzWallDrive *drive, const OzPhysics *physics, const OzScene *scene, int w,
                     double time, bool at_rest);

/* How the wall of kernel wall w moves at a time, s. */
OzWallDrive oz_swings_drive_at(const OzPhysics *physics, const OzScene *scene, int w, double time);

/* OZ_SWING words (kernels/layout.h) of kernel wall w, a side of wall order[w], at a time in a
 * device's units; at_rest: as built. */
void oz_swings_words(double words[OZ_SWING], const OzScene *scene, const int *order, int w,
                     double time, bool at_rest, const OzUnits *units);
