/* What a snapshot knows of trigrains. */
#pragma once

#include "sim/model.h"

/* For the model's row (sim/model.h). The host looks for all contacts. Elements move against each
 * other: the energy is theirs, not the grains'. */
OzStatus oz_element_read_snapshot_state(OzSim *sim, int member, OzSnapshot *snapshot);
OzStatus oz_element_read_snapshot_contacts(OzSim *sim, int member, OzSnapshot *snapshot);
double oz_element_read_snapshot_energy(const OzSnapshot *now);
