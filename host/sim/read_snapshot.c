/* Snapshots from device arrays. */
#include "sim/read_snapshot.h"

#include "sim/sim_private.h"

OzStatus oz_read_snapshot_snapshot(OzSim *sim, int member, OzSnapshot *snapshot, bool contacts)
{
    snapshot->step = sim->batch.reached[member];
    snapshot->time = oz_batch_time(&sim->batch, member, snapshot->step);
    snapshot->deep_count = sim->batch.deep_count[member];
    snapshot->has_contacts = false;
    snapshot->contacts.count = 0;
    snapshot->has_ledger = false;
    oz_snapshot_move_walls(snapshot);
    OZ_PASS(sim->model->unpack(sim, member, snapshot));
    if (contacts) {
        OZ_PASS(sim->model->contacts(sim, member, snapshot));
    }
    return OZ_OK;
}
