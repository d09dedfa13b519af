/* Snapshots of a simulation of trigrains. */
#ifndef OZ_COMPUTE_PIECE_CAPTURE_H
#define OZ_COMPUTE_PIECE_CAPTURE_H

#include "compute/piece_sim.h"
#include "observe/snapshot.h"

/* The state of a member now, into a snapshot made for its scene and grains. contacts: the sums over
 * contacts and beams and, with the ledger on, the energies too (dearer: the host looks for all
 * contacts). They are left out when the run was stopped by a guard. */
OzStatus oz_piece_capture_snapshot(OzPieceSim *sim, int member, OzSnapshot *snapshot,
                                   bool contacts);

#endif
