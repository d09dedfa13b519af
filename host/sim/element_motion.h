/* Walls of trigrains from launch to launch. */
#pragma once

#include "sim/model.h"

/* For the model's row (sim/model.h): how many of these steps can be made before a wall of the
 * member comes or goes; bodies of walls that are there and walls' motion for a launch. */
int64_t oz_element_motion_steps_alike(const OzSim *sim, int member, int64_t steps);
OzStatus oz_element_motion_prepare(OzSim *sim, int member, int steps);

/* The motion of every wall of a member at each step of the launch, and at its end. */
OzStatus oz_element_motion_write_motion(OzSim *sim, int member, int steps);
