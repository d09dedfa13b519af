/* The units in which kernels count: a length, a time and a mass of the scene's own, so that physics
 * and guards are the same from a nanometre to a kilometre though single precision ends at 1e-38.
 * Powers of two: nothing is rounded, and the host goes on in SI units. */
#pragma once

#define OZ_HOST
#include "kernels/element_layout.h"
#include "kernels/layout.h"
#include "model/grains.h"

/* Near the smallest diameter of rods or the smallest reach of elements; the time of a contact of 32
 * steps; and the mean of the lightest and the heaviest mass (geometric: their squares are then as
 * far from either end of a float). */
OzUnits oz_units_choose(const OzGrains *grains, double step);

/* The SI value of one unit of a device: m/s; rad/s, or kg m^2/s where the spin is an angular
 * momentum; N; kg m^2; J. */
double oz_units_speed(const OzUnits *units);
double oz_units_spin(const OzUnits *units, bool is_momentum);
double oz_units_force(const OzUnits *units);
double oz_units_inertia(const OzUnits *units);
double oz_units_energy(const OzUnits *units);

/* Makes a law's constants, of this row in the list, such as kernels count them. */
void oz_units_law(OzLawConstants *law, const OzUnits *units, int id);

/* The parameters of a scene with the given law (its row in the list), in SI, as kernels count them.
 */
OzParameters oz_units_parameters(const OzParameters *si, int law);

/* The same of trigrains. */
OzElementParameters oz_units_elements(const OzElementParameters *si);
