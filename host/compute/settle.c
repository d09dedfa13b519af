/* Settling. */
#include "compute/settle.h"

#include "base/log.h"
#include "base/memory.h"
#include "compute/capture.h"
#include "compute/sim_private.h"

#include <stdlib.h>
#include <string.h>

enum {
    JUDGE_STEPS = 128
}; /* between looks at the energy: often enough to stop in time, rarely enough to cost
    * nothing */

/* Kinetic energy, translational and rotational, over N m g d of the member's grains. */
static OzStatus energy_ratio(OzSim *sim, int member, double *ratio)
{
    OzStatus status = OZ_OK;
    OzSnapshot now = {0};
    const OzGrains *grains = sim->crew.members[member].grains;
    const double *g = sim->crew.members[member].scene->gravity;
    double energy = 0, scale = 0, gravity = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    OZ_TRY(oz_snapshot_create(&now, sim->crew.members[member].scene, grains));
    OZ_TRY(oz_capture_snapshot(sim, member, &now, false));
    for (int64_t i = 0; i < grains->count; i++) {
        const double *v = &now.velocity[3 * i], *w = &now.spin[3 * i], *u = &now.axis[3 * i];
        double along = w[0] * u[0] + w[1] * u[1] + w[2] * u[2];
        double spin2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
        energy += 0.5 * grains->mass[i] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        energy += 0.5 * grains->inertia[i] * (spin2 - along * along);
        energy += 0.5 * grains->inertia_axis[i] * along * along;
        scale += grains->mass[i] * gravity * grains->diameter[i];
    }
    *ratio = scale > 0 ? energy / scale : 0;
done:
    oz_snapshot_free(&now);
    return status;
}

static OzStatus set_drag(OzSim *sim, double drag)
{
    for (int m = 0; m < sim->crew.member_count; m++) {
        sim->parameters[m].drag = drag;
    }
    return oz_sim_write_parameters(sim);
}

/* Grains start at rest: their energy says nothing before they have had time to fall. This is ten
 * times what a free fall takes to the threshold's speed, as a step. */
static int64_t first_judgement(const OzScene *scene, const OzGrains *grains)
{
    const double *g = scene->gravity;
    double gravity = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    double time =
        gravity > 0 ? sqrt(2 * scene->settle.threshold * grains->diameter[0] / gravity) : 0;
    return (int64_t)ceil(10 * time / scene->step);
}

/* Lets members that have come to rest wait for the others, so that what a member does depends on
 * itself alone; *worst receives the largest energy ratio of those that go on, *going how many there
 * are. */
static OzStatus judge(OzSim *sim, double *worst, int *going)
{
    OzStatus status = OZ_OK;
    *worst = 0;
    *going = 0;
    for (int m = 0; m < sim->crew.member_count; m++) {
        const OzMember *member = &sim->crew.members[m];
        double ratio = 0;
        if (sim->crew.waits[m] || sim->crew.stopped[m]) {
            continue;
        }
        OZ_TRY(energy_ratio(sim, m, &ratio));
        bool old_enough = sim->crew.step >= first_judgement(member->scene, member->grains);
        sim->crew.waits[m] = old_enough && ratio < member->scene->settle.threshold;
        *worst = ratio > *worst ? ratio : *worst;
        *going += !sim->crew.waits[m];
    }
done:
    return status;
}

static int64_t steps_of(const OzScene *scene, double time)
{
    return (int64_t)ceil(time / scene->step - 1e-9);
}

/* Advances by so many steps, or with judging until every member waits. The energy is looked at
 * after fixed numbers of steps, not of launches, whose length depends on the machine: the same bits
 * on any. */
static OzStatus run_for(OzSim *sim, int64_t steps, bool judging, OzSettleWatch watch, void *context)
{
    OzStatus status = OZ_OK;
    const OzScene *scene = sim->crew.members[0].scene;
    double worst = 0;
    int going = sim->crew.member_count;
    int64_t last = sim->crew.step + steps;
    while (sim->crew.step < last && going > 0) {
        int64_t next = sim->crew.step + JUDGE_STEPS;
        OZ_TRY(oz_sim_advance(sim, next < last ? next : last));
        if (judging) {
            OZ_TRY(judge(sim, &worst, &going));
        }
        if (watch && !watch(context, (double)sim->crew.step * scene->step, worst)) {
            status = oz_status_fail(OZ_ERR_INTERRUPTED, "interrupted while settling");
            goto done;
        }
    }
    if (judging && going > 0 && scene->settle.threshold > 0) {
        oz_log_line("settling: kinetic energy still %.3g N m g d after %.3g s (threshold %.3g)",
                    worst, scene->settle.time_max, scene->settle.threshold);
    }
done:
    return status;
}

/* Nothing added up yet; what springs hold was not given to them since time 0. */
static OzStatus start_ledger(OzSim *sim)
{
    OzStatus status = OZ_OK;
    size_t bytes = oz_arrays_bytes(OZ_FIELD_ledger, &sim->arrays.switches, &sim->arrays.sizes);
    void *zero = NULL;
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

/* Time 0: no steps made, nothing added up. */
static OzStatus start_clock(OzSim *sim)
{
    sim->crew.step = 0;
    memset(sim->crew.reached, 0, (size_t)sim->crew.member_count * sizeof *sim->crew.reached);
    sim->crew.walls_still = false;
    sim->crew.counts = (OzSimCounts){0};
    for (int m = 0; m < sim->crew.member_count; m++) {
        sim->control[m].refreshes = 0;
        sim->control[m].rebuilds = 0;
    }
    return start_ledger(sim);
}

OzStatus oz_settle_run(OzSim *sim, double *seconds, OzSettleWatch watch, void *context)
{
    OzStatus status = OZ_OK;
    const OzScene *scene = sim->crew.members[0].scene;
    *seconds = 0;
    if (!scene->settle.present || sim->arrays.sizes.count == 0) {
        return OZ_OK;
    }
    sim->crew.walls_still = true;
    OZ_TRY(set_drag(sim, scene->settle.drag));
    OZ_TRY(run_for(sim, steps_of(scene, scene->settle.time_max), true, watch, context));
    OZ_TRY(set_drag(sim, 0));
    memset(sim->crew.waits, 0, (size_t)sim->crew.member_count * sizeof *sim->crew.waits);
    OZ_TRY(run_for(sim, steps_of(scene, scene->settle.rest_time), false, watch, context));
    *seconds = (double)sim->crew.step * scene->step;
    OZ_TRY(start_clock(sim));
done:
    return status;
}
