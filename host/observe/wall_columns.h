/* Columns of walls: what grains push them with, and of servo walls, which are numbered in the order
 * of the scene's walls, what they do. */
#pragma once

#include "observe/column.h"

/* The axes that a column of walls has a cell for. */
const char *oz_wall_columns_axes(OzColumnNeed need, const OzScene *scene);

/* The scene's wall that a servo is. */
int oz_wall_columns_servo(const OzScene *scene, int servo);

/* J, kinetic energy of all pistons. */
double oz_wall_columns_kinetic(const OzSnapshot *snapshot);

/* Values of rows; the observation's index is the cell: of a servo its number. */
bool oz_wall_columns_force(const OzObservation *observation, double *value);
bool oz_wall_columns_torque(const OzObservation *observation, double *value);
bool oz_wall_columns_place(const OzObservation *observation, double *value);
bool oz_wall_columns_velocity(const OzObservation *observation, double *value);
bool oz_wall_columns_servo_force(const OzObservation *observation, double *value);
bool oz_wall_columns_pressure(const OzObservation *observation, double *value);
