/* Trigrains' part of a snapshot: free pieces are downloaded, those of walls follow from the time.
 */
#include "compute/piece_capture.h"

#include "base/memory.h"
#include "compute/piece_forces.h"
#include "compute/piece_pack.h"
#include "compute/piece_private.h"
#include "compute/units.h"
#include "model/wall_motion.h"

#include <stdlib.h>

static OzStatus read_ledger(OzSim *sim, int member, OzPieceLedger *ledger)
{
    OzStatus status = OZ_OK;
    double *words = NULL, sum[OZ_PIECE_LEDGER_WORDS] = {0};
    size_t count = (size_t)oz_piece_sizes(sim)->regions * OZ_PIECE_LEDGER_WORDS;
    OZ_TRY(OZ_NEW(&words, count));
    OZ_TRY(
        oz_arrays_read(&sim->arrays, OZ_PIECE_FIELD_ledger, member, words, count * sizeof *words));
    for (size_t k = 0; k < count; k++) {
        sum[k % OZ_PIECE_LEDGER_WORDS] +=
            words[k] * oz_units_energy(&oz_piece_parameters(sim, member)->units);
    }
    *ledger = (OzPieceLedger){.beam_axial = sum[OZ_PL_BEAM_AXIAL],
                              .beam_bending = sum[OZ_PL_BEAM_BENDING],
                              .disc_damping = sum[OZ_PL_DISC_DAMPING],
                              .disc_friction = sum[OZ_PL_DISC_FRICTION],
                              .work_walls = sum[OZ_PL_WORK_WALLS]};
done:
    free(words);
    return status;
}

OzStatus oz_piece_capture_state(OzSim *sim, int member, OzSnapshot *snapshot)
{
    OzStatus status = OZ_OK;
    const OzScene *scene = sim->crew.members[member].scene;
    OZ_TRY(oz_piece_pack_state(&sim->arrays, member, oz_piece_parameters(sim, member), snapshot));
    oz_wall_motion_place(snapshot->grains->pieces, scene, snapshot->time, sim->crew.walls_still,
                         snapshot->piece_position, snapshot->piece_angle, snapshot->piece_velocity,
                         snapshot->piece_spin);
    oz_snapshot_join_pieces(snapshot);
done:
    return status;
}

OzStatus oz_piece_capture_contacts(OzSim *sim, int member, OzSnapshot *snapshot)
{
    OzStatus status = OZ_OK;
    if (sim->crew.stopped[member]) {
        return OZ_OK;
    }
    OZ_TRY(oz_piece_forces_sums(snapshot));
    if (oz_piece_switches(sim)->ledger) {
        OZ_TRY(read_ledger(sim, member, &snapshot->piece_ledger));
        snapshot->has_ledger = true;
    }
done:
    return status;
}

double oz_piece_capture_energy(const OzSnapshot *now)
{
    const OzPieces *pieces = now->grains->pieces;
    double energy = 0;
    for (int64_t i = 0; i < pieces->free_count; i++) {
        const double *v = &now->piece_velocity[2 * i], w = now->piece_spin[i];
        energy +=
            0.5 * (pieces->mass[i] * (v[0] * v[0] + v[1] * v[1]) + pieces->inertia[i] * w * w);
    }
    return energy;
}

OzStatus oz_piece_capture_start_ledger(OzSim *sim)
{
    OzStatus status = OZ_OK;
    static const OzPieceLedger none;
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(oz_piece_pack_ledger(&sim->arrays, m, &oz_piece_parameters(sim, m)->units, &none));
    }
done:
    return status;
}
