/* Energies of rods and spheres, J. */
#pragma once

#include "model/snapshot.h"

double oz_rod_energy_translational(const OzSnapshot *snapshot);
double oz_rod_energy_rotational(const OzSnapshot *snapshot);
double oz_rod_energy_potential(const OzSnapshot *snapshot); /* in gravity, from the origin */
