/* Settling trigrains. */
#include "compute/piece_settle.h"

#include "compute/piece_capture.h"
#include "compute/piece_pack.h"
#include "compute/piece_private.h"

enum { JUDGE_STEPS = 512 };

static OzStatus launch(void *of, int64_t step)
{
    return oz_piece_sim_launch(of, step);
}

static OzStatus set_drag(void *of, double drag)
{
    OzPieceSim *sim = of;
    for (int m = 0; m < sim->crew.member_count; m++) {
        sim->parameters[m].drag = drag;
    }
    return oz_piece_sim_write_parameters(sim);
}

/* Pieces move against each other: their energies, not the grains'. */
static OzStatus take_energy(void *of, int member, OzSnapshot *now, double *energy)
{
    OzStatus status = OZ_OK;
    const OzPieces *pieces = now->grains->pieces;
    OZ_TRY(oz_piece_capture_snapshot(of, member, now, false));
    *energy = 0;
    for (int64_t i = 0; i < pieces->free_count; i++) {
        const double *v = &now->piece_velocity[2 * i], w = now->piece_spin[i];
        *energy +=
            0.5 * (pieces->mass[i] * (v[0] * v[0] + v[1] * v[1]) + pieces->inertia[i] * w * w);
    }
done:
    return status;
}

/* Nothing moves fast enough for the power to matter that the ledger's rate starts from. */
static OzStatus start_ledger(void *of)
{
    OzStatus status = OZ_OK;
    OzPieceSim *sim = of;
    static const OzPieceLedger none;
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(oz_piece_pack_ledger(&sim->arrays, m, &sim->parameters[m].units, &none));
        sim->control[m].refreshes = sim->control[m].rebuilds = 0;
    }
done:
    return status;
}

OzStatus oz_piece_settle_run(OzPieceSim *sim, double *seconds, OzSettleWatch watch, void *context)
{
    const OzRest rest = {.sim = sim,
                         .crew = &sim->crew,
                         .is_empty = sim->arrays.sizes.free_slots == 0,
                         .judge_steps = JUDGE_STEPS,
                         .launch = launch,
                         .set_drag = set_drag,
                         .take_energy = take_energy,
                         .start_ledger = start_ledger};
    return oz_rest_run(&rest, seconds, watch, context);
}
