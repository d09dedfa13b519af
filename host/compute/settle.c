/* Settling rods. */
#include "compute/settle.h"

#include "base/memory.h"
#include "compute/capture.h"
#include "compute/sim_private.h"

#include <stdlib.h>

enum { JUDGE_STEPS = 128 };

static OzStatus launch(void *of, int64_t step)
{
    return oz_sim_launch(of, step);
}

static OzStatus set_drag(void *of, double drag)
{
    OzSim *sim = of;
    for (int m = 0; m < sim->crew.member_count; m++) {
        sim->parameters[m].drag = drag;
    }
    return oz_sim_write_parameters(sim);
}

static OzStatus take_energy(void *of, int member, OzSnapshot *now, double *energy)
{
    OzStatus status = OZ_OK;
    const OzGrains *grains = now->grains;
    OZ_TRY(oz_capture_snapshot(of, member, now, false));
    *energy = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        const double *v = &now->velocity[3 * i], *w = &now->spin[3 * i], *u = &now->axis[3 * i];
        double along = w[0] * u[0] + w[1] * u[1] + w[2] * u[2];
        double spin2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
        *energy += 0.5 * grains->mass[i] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        *energy += 0.5 * grains->inertia[i] * (spin2 - along * along);
        *energy += 0.5 * grains->inertia_axis[i] * along * along;
    }
done:
    return status;
}

/* What springs hold was not given to them since time 0. */
static OzStatus start_ledger(void *of)
{
    OzStatus status = OZ_OK;
    OzSim *sim = of;
    size_t bytes = oz_arrays_bytes(OZ_FIELD_ledger, &sim->arrays.switches, &sim->arrays.sizes);
    void *zero = NULL;
    for (int m = 0; m < sim->crew.member_count; m++) {
        sim->control[m].refreshes = sim->control[m].rebuilds = 0;
    }
    if (bytes == 0) {
        return OZ_OK;
    }
    OZ_TRY(oz_memory_new(&zero, bytes, 1, "ledger"));
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(oz_arrays_write(&sim->arrays, OZ_FIELD_ledger, m, zero, bytes));
    }
    OZ_TRY(oz_capture_start(sim));
done:
    free(zero);
    return status;
}

OzStatus oz_settle_run(OzSim *sim, double *seconds, OzSettleWatch watch, void *context)
{
    const OzRest rest = {.sim = sim,
                         .crew = &sim->crew,
                         .is_empty = sim->arrays.sizes.count == 0,
                         .judge_steps = JUDGE_STEPS,
                         .launch = launch,
                         .set_drag = set_drag,
                         .take_energy = take_energy,
                         .start_ledger = start_ledger};
    return oz_rest_run(&rest, seconds, watch, context);
}
