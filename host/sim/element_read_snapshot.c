/* Trigrains' part of a snapshot: free elements are downloaded, those of walls follow from the time.
 */
#include "sim/element_read_snapshot.h"

#include "base/memory.h"
#include "model/wall_motion.h"
#include "sim/element_forces.h"
#include "sim/element_pack.h"
#include "sim/element_private.h"
#include "sim/units.h"

#include <stdlib.h>

static OzStatus read_ledger(OzSim *sim, int member, OzElementLedger *ledger)
{
    OzStatus status = OZ_OK;
    double *words = NULL, sum[OZ_ELEMENT_LEDGER_WORDS] = {0};
    size_t count = (size_t)oz_element_sizes(sim)->regions * OZ_ELEMENT_LEDGER_WORDS;
    OZ_TRY(OZ_NEW(&words, count));
    OZ_TRY(oz_arrays_read(&sim->arrays, OZ_ELEMENT_FIELD_ledger, member, words,
                          count * sizeof *words));
    for (size_t k = 0; k < count; k++) {
        sum[k % OZ_ELEMENT_LEDGER_WORDS] +=
            words[k] * oz_units_energy(&oz_element_parameters(sim, member)->units);
    }
    *ledger = (OzElementLedger){.beam_axial = sum[OZ_PL_BEAM_AXIAL],
                                .beam_bending = sum[OZ_PL_BEAM_BENDING],
                                .disc_damping = sum[OZ_PL_DISC_DAMPING],
                                .disc_friction = sum[OZ_PL_DISC_FRICTION],
                                .work_walls = sum[OZ_PL_WORK_WALLS]};
done:
    free(words);
    return status;
}

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
        OZ_PASS(read_ledger(sim, member, &snapshot->element_ledger));
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

OzStatus oz_element_read_snapshot_start_ledger(OzSim *sim)
{
    static const OzElementLedger none;
    for (int m = 0; m < sim->batch.member_count; m++) {
        OZ_PASS(
            oz_element_pack_ledger(&sim->arrays, m, &oz_element_parameters(sim, m)->units, &none));
    }
    return OZ_OK;
}
