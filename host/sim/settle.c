/* What settling asks of a simulation. */
#include "sim/settle.h"

#include "sim/read_snapshot.h"
#include "sim/sim_private.h"

#include <math.h>

static OzStatus launch(void *of, int64_t step)
{
    return oz_sim_launch(of, step);
}

static OzStatus set_drag(void *of, double drag)
{
    OzSim *sim = of;
    for (int m = 0; m < sim->batch.member_count; m++) {
        oz_sim_parameters(sim, m)->drag = drag;
    }
    return oz_sim_write_parameters(sim);
}

static OzStatus take_energy(void *of, int member, OzSnapshot *now, double *energy)
{
    OzSim *sim = of;
    OzStatus status = oz_read_snapshot_snapshot(sim, member, now, false);
    *energy = status == OZ_OK ? sim->model->energy(now) : 0;
    return status;
}

static OzStatus start_ledger(void *of)
{
    OzSim *sim = of;
    for (int m = 0; m < sim->batch.member_count; m++) {
        oz_sim_control(sim, m)->refreshes = oz_sim_control(sim, m)->rebuilds = 0;
    }
    return oz_read_snapshot_start_ledger(sim);
}

OzStatus oz_settle_show(OzSim *sim, double *seconds, OzSettleWatch watch, void *context,
                        OzSettleShow show, double interval)
{
    const OzRelax rest = {.sim = sim,
                          .batch = &sim->batch,
                          .is_empty = sim->is_empty,
                          .judge_steps = sim->model->judge_steps,
                          .launch = launch,
                          .set_drag = set_drag,
                          .take_energy = take_energy,
                          .start_ledger = start_ledger,
                          .show = interval > 0 && isfinite(interval) ? show : NULL,
                          .show_interval = interval};
    return oz_relax_run(&rest, seconds, watch, context);
}

OzStatus oz_settle_run(OzSim *sim, double *seconds, OzSettleWatch watch, void *context)
{
    return oz_settle_show(sim, seconds, watch, context, NULL, 0);
}

bool oz_settle_is_over(const OzSim *sim)
{
    return sim->batch.settling == OZ_SETTLING_OVER;
}
