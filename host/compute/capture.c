/* Snapshots from device arrays. */
#include "compute/capture.h"

#include "compute/pack.h"
#include "compute/sim_private.h"

OzStatus oz_capture_snapshot(OzSim *sim, int member, OzSnapshot *snapshot, bool contacts)
{
    OzStatus status = OZ_OK;
    snapshot->step = sim->step;
    snapshot->time = (double)sim->step * sim->members[member].scene->step;
    snapshot->has_contacts = false;
    snapshot->has_ledger = false;
    oz_snapshot_move_walls(snapshot);
    OZ_TRY(oz_pack_state(&sim->arrays, member, &sim->parameters[member], snapshot));
    (void)contacts;
done:
    return status;
}
