/* Settling trigrains. */
#include "compute/piece_settle.h"

#include "base/log.h"
#include "compute/piece_capture.h"
#include "compute/piece_pack.h"
#include "compute/piece_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Steps between looks at the energy: often enough to stop in time, rarely enough to cost nothing. A
 * fixed number of steps, not of launches, whose length depends on the machine: the same bits on
 * any. */
enum { JUDGE_STEPS = 512 };

static double gravity_of(const OzScene *scene)
{
    return hypot(scene->gravity[0], scene->gravity[1]);
}

/* Kinetic energy of all pieces over N m g d of the member's grains. */
static OzStatus energy_ratio(OzPieceSim *sim, int member, double *ratio)
{
    OzStatus status = OZ_OK;
    OzSnapshot now = {0};
    const OzGrains *grains = sim->crew.members[member].grains;
    const OzPieces *pieces = grains->pieces;
    double energy = 0, scale = 0, gravity = gravity_of(sim->crew.members[member].scene);
    OZ_TRY(oz_snapshot_create(&now, sim->crew.members[member].scene, grains));
    OZ_TRY(oz_piece_capture_snapshot(sim, member, &now, false));
    for (int64_t i = 0; i < pieces->free_count; i++) {
        const double *v = &now.piece_velocity[2 * i], w = now.piece_spin[i];
        energy +=
            0.5 * (pieces->mass[i] * (v[0] * v[0] + v[1] * v[1]) + pieces->inertia[i] * w * w);
    }
    for (int64_t i = 0; i < grains->count; i++) {
        scale += grains->mass[i] * gravity * grains->diameter[i];
    }
    *ratio = scale > 0 ? energy / scale : 0;
done:
    oz_snapshot_free(&now);
    return status;
}

static OzStatus set_drag(OzPieceSim *sim, double drag)
{
    for (int m = 0; m < sim->crew.member_count; m++) {
        sim->parameters[m].drag = drag;
    }
    return oz_piece_sim_write_parameters(sim);
}

/* Grains start at rest: their energy says nothing before they have had time to fall. This is ten
 * times what a free fall takes to the threshold's speed, as a step. */
static int64_t first_judgement(const OzScene *scene, const OzGrains *grains)
{
    double gravity = gravity_of(scene), fall = 2 * scene->settle.threshold * grains->diameter[0];
    double time = gravity > 0 ? sqrt(fall / gravity) : 0;
    return (int64_t)ceil(10 * time / scene->step);
}

/* Lets members that have come to rest wait for the others; *worst receives the largest energy ratio
 * of those that go on, *going how many there are. */
static OzStatus judge(OzPieceSim *sim, double *worst, int *going)
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

static OzStatus advance(OzPieceSim *sim, int64_t step)
{
    OzStatus status = OZ_OK;
    while (status == OZ_OK && sim->crew.step < step) {
        status = oz_piece_sim_launch(sim, step);
    }
    return status;
}

/* Advances by so many steps, or with judging until every member waits. */
static OzStatus run_for(OzPieceSim *sim, int64_t steps, bool judging, OzSettleWatch watch,
                        void *context)
{
    OzStatus status = OZ_OK;
    const OzScene *scene = sim->crew.members[0].scene;
    double worst = 0;
    int going = sim->crew.member_count;
    int64_t last = sim->crew.step + steps;
    while (sim->crew.step < last && going > 0) {
        int64_t next = sim->crew.step + JUDGE_STEPS;
        OZ_TRY(advance(sim, next < last ? next : last));
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

/* Time 0: no steps made, nothing added up, walls free to move. Nothing moves fast enough for its
 * power to matter. */
static OzStatus start_clock(OzPieceSim *sim)
{
    OzStatus status = OZ_OK;
    static const OzPieceLedger none;
    for (int m = 0; m < sim->crew.member_count; m++) {
        OZ_TRY(oz_piece_pack_ledger(&sim->arrays, m, &none));
        sim->control[m].refreshes = sim->control[m].rebuilds = 0;
        sim->crew.reached[m] = 0;
    }
    sim->crew.step = 0;
    sim->crew.walls_still = false;
    sim->crew.counts = (OzSimCounts){0};
done:
    return status;
}

static int64_t steps_of(const OzScene *scene, double time)
{
    return (int64_t)ceil(time / scene->step - 1e-9);
}

OzStatus oz_piece_settle_run(OzPieceSim *sim, double *seconds, OzSettleWatch watch, void *context)
{
    OzStatus status = OZ_OK;
    const OzScene *scene = sim->crew.members[0].scene;
    *seconds = 0;
    if (!scene->settle.present || sim->arrays.sizes.free_slots == 0) {
        return OZ_OK;
    }
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
