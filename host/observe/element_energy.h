/* Energies of flat grains, summed over their elements, J a metre deep. */
#pragma once

#include "model/snapshot.h"

double oz_element_energy_translational(const OzSnapshot *snapshot);
double oz_element_energy_rotational(const OzSnapshot *snapshot);
double oz_element_energy_potential(const OzSnapshot *snapshot); /* in gravity, from the origin */

/* Stored in overlaps and beams; known with contacts. */
double oz_element_energy_stored(const OzSnapshot *snapshot);

/* Dissipated since time 0 by every mechanism; known with the ledger. */
double oz_element_energy_lost(const OzSnapshot *snapshot);
