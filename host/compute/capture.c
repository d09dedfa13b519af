/* Snapshots from device arrays. */
#include "compute/capture.h"

#include "compute/sim_private.h"

OzStatus oz_capture_snapshot(OzSim *sim, int member, OzSnapshot *snapshot, bool contacts)
{
    OzStatus status = OZ_OK;
    snapshot->step = sim->crew.reached[member];
    snapshot->time = oz_crew_time(&sim->crew, member, snapshot->step);
    snapshot->deep_count = sim->crew.deep_count[member];
    snapshot->has_contacts = false;
    snapshot->has_ledger = false;
    oz_snapshot_move_walls(snapshot);
    OZ_TRY(sim->model->unpack(sim, member, snapshot));
    if (contacts) {
        OZ_TRY(sim->model->contacts(sim, member, snapshot));
    }
done:
    return status;
}
