/* Snapshots of a simulation. */
#ifndef OZ_COMPUTE_CAPTURE_H
#define OZ_COMPUTE_CAPTURE_H

#include "compute/sim.h"
#include "observe/snapshot.h"

/* The state of a member now, into a snapshot made for its scene and grains. contacts: the sums over
 * contacts and, with the ledger on, the energies too (dearer: lists and springs are downloaded, or
 * the host looks for all contacts). They are left out when the run was stopped by a guard. */
OzStatus oz_capture_snapshot(OzSim *sim, int member, OzSnapshot *snapshot, bool contacts);

#endif
