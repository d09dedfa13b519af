/* Trigrains' part of a snapshot: free elements are downloaded, those of walls follow from the time.
 */
#include "sim/element_read_snapshot.h"

#include "model/wall_motion.h"
#include "sim/element_forces.h"
#include "sim/element_pack.h"
#include "sim/element_private.h"
#include "sim/read_snapshot.h"

OzStatus oz_element_read_snapshot_state(OzSim *sim, int member, OzSnapshot *snapshot)
{
    const OzScene *scene = sim->batch.members[member].scene;
    OZ_PASS(
        oz_element_pack_state(&sim->arrays, member, oz_element_parameters(sim, member), snapshot));
    oz_wall_motion_place(snapshot->grains->elements, scene, snapshot->time, sim->batch.walls_still,
                         snapshot->element_position, snapshot->element_angle,
                         snapshot->element_velocity, snapshot->element_angular_velocity);
    oz_snapshot_join_elements(snapshot);
    return OZ_OK;
}

OzStatus oz_element_read_snapshot_contacts(OzSim *sim, int member, OzSnapshot *snapshot)
{
    if (sim->batch.stopped[member]) {
        return OZ_OK;
    }
    OZ_PASS(oz_element_forces_contacts(snapshot));
    if (oz_element_switches(sim)->ledger) {
        double sum[OZ_ELEMENT_LEDGER_WORDS] = {0};
        OZ_PASS(oz_read_snapshot_ledger(sim, member, sum));
#define TAKE(NAME, entry, column, meaning) snapshot->element_ledger.entry = sum[OZ_PL_##NAME];
        OZ_ELEMENT_LEDGER_LOSSES(TAKE)
        OZ_LEDGER_WORK(TAKE)
#undef TAKE
        snapshot->has_ledger = true;
    }
    return OZ_OK;
}

double oz_element_read_snapshot_energy(const OzSnapshot *now)
{
    const OzElements *elements = now->grains->elements;
    double energy = 0;
    for (int64_t i = 0; i < elements->free_count; i++) {
        const double *v = &now->element_velocity[2 * i], w = now->element_angular_velocity[i];
        energy +=
            0.5 * (elements->mass[i] * (v[0] * v[0] + v[1] * v[1]) + elements->inertia[i] * w * w);
    }
    return energy;
}
