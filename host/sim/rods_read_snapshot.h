/* What a snapshot knows of rods. */
#pragma once

#include "sim/model.h"

/* For the model's row (sim/model.h). What tangential springs hold when the ledger starts was
 * not given to them since; a simulation that starts without settling starts with none. */
OzStatus oz_rods_read_snapshot_state(OzSim *sim, int member, OzSnapshot *snapshot);
OzStatus oz_rods_read_snapshot_contacts(OzSim *sim, int member, OzSnapshot *snapshot);
double oz_rods_read_snapshot_energy(const OzSnapshot *now);
OzStatus oz_rods_read_snapshot_start_ledger(OzSim *sim, int member);
