/* What acts on a simulation from outside: forces and torques on grains, speeds of walls. Scenes
 * whose `is_pushed` is set have room for the former; all else pays nothing. */
#pragma once

#include "sim/sim.h"

/* Refuses scenes whose model has no place for forces from outside. */
OzStatus oz_push_check(const OzScene *scene);

/* Between launches, of a scene that is pushed: force (N) and torque (N m) on every grain, 3 numbers
 * each in the frame of the scene, hold until they are set again. They are part of the state. */
OzStatus oz_push_grains(OzSim *sim, int member, const double *force, const double *torque);

/* Between launches: a wall with a motion goes on from where it is at this speed (m/s) along its
 * direction, whatever its motion was, until it is told again. Part of the state. */
void oz_push_wall(OzSim *sim, int member, int wall, double speed);
