/* Snapshots of a simulation. */
#ifndef OZ_COMPUTE_CAPTURE_H
#define OZ_COMPUTE_CAPTURE_H

#include "compute/sim.h"
#include "observe/snapshot.h"

/* The state of a member now, into a snapshot made for its scene and grains. contacts: the contact
 * sums and, with the ledger on, the energies too (dearer: pair lists and springs are downloaded).
 * They are left out when the run was stopped by a guard. */
OzStatus oz_capture_snapshot(OzSim *sim, int member, OzSnapshot *snapshot, bool contacts);

/* Takes the energy that tangential springs hold now as what they held at time 0. A simulation that
 * starts without settling starts with none. */
OzStatus oz_capture_start(OzSim *sim);

#endif
