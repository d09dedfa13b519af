/* The reference's servo walls. */
#pragma once

#include "sim/reference_private.h"

/* Before the forces of a step: moves pistons whose integrator does so, and puts all where forces
 * see them. */
void oz_reference_servo_before(OzReference *reference, double dt);

/* After them, what grains push them with: moves them, and notes their work. */
void oz_reference_servo_after(OzReference *reference, double dt);

/* Whether a kernel wall is one, and then its speed as it is now. */
bool oz_reference_servo_speed(const OzReference *reference, int wall, double *speed);

/* Writes where they stand into a snapshot. */
void oz_reference_servo_write(const OzReference *reference, OzSnapshot *snapshot);
