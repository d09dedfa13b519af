/* Snapshots of a simulation. */
#pragma once

#include "model/snapshot.h"
#include "sim/sim.h"

/* The state of a member now, into a snapshot made for its scene and grains. contacts: its
 * contacts, beams' sums and, where they are kept, energies and walls' impulses too (dearer: lists and springs are
 * downloaded, or the host looks for all contacts). They are left out when the run was stopped by a
 * guard. */
OzStatus oz_read_snapshot_snapshot(OzSim *sim, int member, OzSnapshot *snapshot, bool contacts);

/* Each word, as the device counts it, over all rows of a member's stretch of a field of doubles;
 * sum has as many zeros as a row has words. */
OzStatus oz_read_snapshot_sums(const OzSim *sim, int member, int field, int row, double *sum);

/* J, added up since the ledger started: each word over all rows of a member's ledger; sum has as
 * many zeros as the model's rows have words. */
OzStatus oz_read_snapshot_ledger(const OzSim *sim, int member, double *sum);

/* Empties all members' ledgers. When they start nothing moves fast enough for a power to matter
 * that its rate starts from. */
OzStatus oz_read_snapshot_start_ledger(OzSim *sim);
