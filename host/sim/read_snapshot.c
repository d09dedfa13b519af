/* Snapshots from device arrays. */
#include "sim/read_snapshot.h"

#include "base/memory.h"
#include "sim/sim_private.h"
#include "sim/units.h"

#include <stdlib.h>

OzStatus oz_read_snapshot_snapshot(OzSim *sim, int member, OzSnapshot *snapshot, bool contacts)
{
    snapshot->step = sim->batch.reached[member];
    snapshot->time = oz_batch_time(&sim->batch, member, snapshot->step);
    snapshot->settling = sim->batch.walls_still;
    snapshot->deep_count = sim->batch.deep_count[member];
    snapshot->has_contacts = false;
    snapshot->contacts.count = 0;
    snapshot->has_ledger = snapshot->has_wall_impulse = false;
    oz_snapshot_move_walls(snapshot);
    OZ_PASS(sim->model->unpack(sim, member, snapshot));
    if (contacts) {
        OZ_PASS(sim->model->contacts(sim, member, snapshot));
    }
    return OZ_OK;
}

OzStatus oz_read_snapshot_sums(const OzSim *sim, int member, int field, int row, double *sum)
{
    OzStatus status = OZ_OK;
    size_t count = oz_arrays_bytes(&sim->arrays, field) / sizeof(double);
    double *words = NULL;
    OZ_TRY(oz_arrays_download(&sim->arrays, field, member, &words));
    for (size_t k = 0; k < count; k++) {
        sum[k % (size_t)row] += words[k];
    }
done:
    free(words);
    return status;
}

OzStatus oz_read_snapshot_ledger(const OzSim *sim, int member, double *sum)
{
    const OzModel *model = sim->model;
    double unit = oz_units_energy(&oz_sim_parameters(sim, member)->units);
    OZ_PASS(oz_read_snapshot_sums(sim, member, model->ledger_field, model->ledger_words, sum));
    for (int k = 0; k < model->ledger_words; k++) {
        sum[k] *= unit;
    }
    return OZ_OK;
}

OzStatus oz_read_snapshot_start_ledger(OzSim *sim)
{
    OzStatus status = OZ_OK;
    const OzModel *model = sim->model;
    size_t bytes = oz_arrays_bytes(&sim->arrays, model->ledger_field);
    void *zero = NULL;
    OZ_TRY(oz_memory_new(&zero, bytes, 1, "ledger"));
    for (int m = 0; m < sim->batch.member_count; m++) {
        OZ_TRY(oz_arrays_write(&sim->arrays, model->ledger_field, m, zero, bytes));
        if (model->start_ledger) {
            OZ_TRY(model->start_ledger(sim, m));
        }
    }
done:
    free(zero);
    return status;
}
