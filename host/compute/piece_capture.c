/* Snapshots from device arrays: free pieces are downloaded, those of walls follow from the time. */
#include "compute/piece_capture.h"

#include "base/memory.h"
#include "compute/piece_forces.h"
#include "compute/piece_pack.h"
#include "compute/piece_private.h"
#include "compute/units.h"
#include "model/wall_motion.h"

#include <stdlib.h>

static OzStatus read_ledger(OzPieceSim *sim, int member, OzPieceLedger *ledger)
{
    OzStatus status = OZ_OK;
    double *words = NULL, sum[OZ_PIECE_LEDGER_WORDS] = {0};
    size_t count = (size_t)sim->arrays.sizes.regions * OZ_PIECE_LEDGER_WORDS;
    OZ_TRY(OZ_NEW(&words, count));
    OZ_TRY(oz_piece_arrays_read(&sim->arrays, OZ_PIECE_FIELD_ledger, member, words,
                                count * sizeof *words));
    for (size_t k = 0; k < count; k++) {
        sum[k % OZ_PIECE_LEDGER_WORDS] +=
            words[k] * oz_units_energy(&sim->parameters[member].units);
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

OzStatus oz_piece_capture_snapshot(OzPieceSim *sim, int member, OzSnapshot *snapshot, bool contacts)
{
    OzStatus status = OZ_OK;
    const OzScene *scene = sim->crew.members[member].scene;
    snapshot->step = sim->crew.reached[member];
    snapshot->time = (double)snapshot->step * scene->step;
    snapshot->deep_count = sim->crew.deep_count[member];
    snapshot->has_contacts = false;
    snapshot->has_ledger = false;
    oz_snapshot_move_walls(snapshot);
    OZ_TRY(oz_piece_pack_state(&sim->arrays, member, &sim->parameters[member], snapshot));
    oz_wall_motion_place(snapshot->grains->pieces, scene, snapshot->time, sim->crew.walls_still,
                         snapshot->piece_position, snapshot->piece_angle, snapshot->piece_velocity,
                         snapshot->piece_spin);
    oz_snapshot_join_pieces(snapshot);
    if (contacts && !sim->crew.stopped[member]) {
        OZ_TRY(oz_piece_forces_sums(snapshot));
    }
    if (contacts && !sim->crew.stopped[member] && sim->arrays.switches.ledger) {
        OZ_TRY(read_ledger(sim, member, &snapshot->piece_ledger));
        snapshot->has_ledger = true;
    }
done:
    return status;
}
