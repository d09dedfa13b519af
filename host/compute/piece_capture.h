/* What a snapshot knows of trigrains. */
#ifndef OZ_COMPUTE_PIECE_CAPTURE_H
#define OZ_COMPUTE_PIECE_CAPTURE_H

#include "compute/model.h"

/* For the model's row (compute/model.h). The host looks for all contacts. Pieces move against each
 * other: the energy is theirs, not the grains'. When the ledger starts nothing moves fast enough
 * for the power to matter that its rate starts from. */
OzStatus oz_piece_capture_state(OzSim *sim, int member, OzSnapshot *snapshot);
OzStatus oz_piece_capture_contacts(OzSim *sim, int member, OzSnapshot *snapshot);
double oz_piece_capture_energy(const OzSnapshot *now);
OzStatus oz_piece_capture_start_ledger(OzSim *sim);

#endif
