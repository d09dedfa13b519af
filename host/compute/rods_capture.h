/* What a snapshot knows of rods. */
#ifndef OZ_COMPUTE_RODS_CAPTURE_H
#define OZ_COMPUTE_RODS_CAPTURE_H

#include "compute/model.h"

/* For the model's row (compute/model.h). What tangential springs hold when the ledger starts was
 * not given to them since; a simulation that starts without settling starts with none. */
OzStatus oz_rods_capture_state(OzSim *sim, int member, OzSnapshot *snapshot);
OzStatus oz_rods_capture_contacts(OzSim *sim, int member, OzSnapshot *snapshot);
double oz_rods_capture_energy(const OzSnapshot *now);
OzStatus oz_rods_capture_start_ledger(OzSim *sim);

#endif
