/* The stress of a periodic cell: what grains carry, and what contacts do. */
#pragma once

#include "observe/column.h"

/* xx, yy, zz, xy, xz, yz. */
enum { OZ_STRESS_PARTS = 6 };

/* The volume of a cell that is periodic in x, y and z, m^3; 0 of any other. */
double oz_stress_volume(const OzBoundary *boundary);

/* Pa, positive where it presses, of a snapshot with contacts of such a cell: (sum of m c c + sum of
 * f l) / volume, c velocities about the flow, l from the centre of a contact's first grain to that
 * of its second, which feels f (Christoffersen, Mehrabadi & Nemat-Nasser 1981). The first letter is
 * the force's direction, the second that of the plane's normal. */
double oz_stress_part(const OzSnapshot *snapshot, int part);

/* Columns: the part of the column's index, without contacts none; and the cell's strain. */
bool oz_stress_value(const OzObservation *o, double *value);
bool oz_stress_strain(const OzObservation *o, double *value);
