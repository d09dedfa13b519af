/* Settling: judging members by their energy. It knows nothing of what they are made of. */
#include "sim/relax.h"

#include "base/log.h"

#include <math.h>
#include <string.h>

bool oz_relax_is_same(const OzSettle *a, const OzSettle *b)
{
    return a->present == b->present && a->drag == b->drag && a->threshold == b->threshold &&
           a->rest_time == b->rest_time && a->time_max == b->time_max;
}

static double gravity_of(const OzScene *scene)
{
    const double *g = scene->gravity;
    return sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
}

/* A member's kinetic energy over N m g d of its grains. */
static OzStatus energy_ratio(const OzRelax *rest, int member, double *ratio)
{
    OzStatus status = OZ_OK;
    OzSnapshot now = {0};
    const OzScene *scene = rest->batch->members[member].scene;
    const OzGrains *grains = rest->batch->members[member].grains;
    double energy = 0, scale = 0, gravity = gravity_of(scene);
    OZ_TRY(oz_snapshot_create(&now, scene, grains));
    OZ_TRY(rest->take_energy(rest->sim, member, &now, &energy));
    for (int64_t i = 0; i < grains->count; i++) {
        scale += grains->mass[i] * gravity * grains->diameter[i];
    }
    *ratio = scale > 0 ? energy / scale : 0;
done:
    oz_snapshot_free(&now);
    return status;
}

/* Grains start at rest: their energy says nothing before they have had time to fall. This is ten
 * times what a free fall takes to the threshold's speed, as a step. */
static int64_t first_judgement(const OzScene *scene, const OzGrains *grains)
{
    double gravity = gravity_of(scene), fall = 2 * scene->settle.threshold * grains->diameter[0];
    double time = gravity > 0 ? sqrt(fall / gravity) : 0;
    return (int64_t)ceil(10 * time / scene->step);
}

/* Lets members that have come to rest wait for the others, so that what a member does depends on
 * itself alone; *worst receives the largest energy ratio of those that go on, *going how many there
 * are. */
static OzStatus judge(const OzRelax *rest, double *worst, int *going)
{
    OzBatch *batch = rest->batch;
    *worst = 0;
    *going = 0;
    for (int m = 0; m < batch->member_count; m++) {
        const OzMember *member = &batch->members[m];
        double ratio = 0;
        if (!oz_batch_goes_on(batch, m)) {
            continue;
        }
        OZ_PASS(energy_ratio(rest, m, &ratio));
        bool old_enough = batch->step >= first_judgement(member->scene, member->grains);
        batch->waits[m] = old_enough && ratio < member->scene->settle.threshold;
        *worst = ratio > *worst ? ratio : *worst;
        *going += !batch->waits[m];
    }
    return OZ_OK;
}

/* Of a member, the first step that is shown at `from` or later; its steps are its own, so that what
 * is shown of it does not depend on companions. */
static int64_t shown_step(const OzRelax *rest, int member, int64_t from)
{
    double every = rest->show_interval / rest->batch->clock[member].dt;
    double k = fmax(0, floor((double)from / every) - 1);
    while (llround(k * every) < from) {
        k++;
    }
    return llround(k * every);
}

/* Shows the members that are at a step to be shown. */
static OzStatus show(const OzRelax *rest, void *context)
{
    const OzBatch *batch = rest->batch;
    for (int m = 0; rest->show && m < batch->member_count; m++) {
        int64_t own = batch->reached[m];
        if (oz_batch_goes_on(batch, m) && shown_step(rest, m, own) == own) {
            OZ_PASS(rest->show(context, m));
        }
    }
    return OZ_OK;
}

/* The step at which a member is to be shown next, at most last. */
static int64_t next_shown(const OzRelax *rest, int64_t last)
{
    const OzBatch *batch = rest->batch;
    for (int m = 0; rest->show && m < batch->member_count; m++) {
        int64_t own = batch->reached[m];
        int64_t left = oz_batch_goes_on(batch, m) ? shown_step(rest, m, own + 1) - own : INT64_MAX;
        last = left < last - batch->step ? batch->step + left : last;
    }
    return last;
}

static OzStatus advance(const OzRelax *rest, int64_t step, void *context)
{
    while (rest->batch->step < step) {
        int64_t next = next_shown(rest, step);
        while (rest->batch->step < next) {
            OZ_PASS(rest->launch(rest->sim, next));
        }
        OZ_PASS(show(rest, context));
    }
    return OZ_OK;
}

static int count_going(const OzBatch *batch)
{
    int going = 0;
    for (int m = 0; m < batch->member_count; m++) {
        going += oz_batch_goes_on(batch, m);
    }
    return going;
}

/* Advances to the end of the part in hand, or with judging until every member waits. The energy is
 * looked at after fixed numbers of steps, not of launches, whose length depends on the machine: the
 * same bits on any. */
static OzStatus run_part(const OzRelax *rest, bool judging, OzSettleWatch watch, void *context)
{
    const OzBatch *batch = rest->batch;
    const OzScene *scene = batch->members[0].scene;
    double worst = 0;
    int going = count_going(batch);
    int64_t last = batch->settling_last;
    while (batch->step < last && going > 0) {
        int64_t next = batch->step + rest->judge_steps;
        OZ_PASS(advance(rest, next < last ? next : last, context));
        if (judging) {
            OZ_PASS(judge(rest, &worst, &going));
        }
        if (watch) {
            OZ_PASS(watch(context, oz_batch_time(batch, 0, batch->step), worst));
        }
    }
    if (judging && going > 0 && scene->settle.threshold > 0) {
        oz_log_line("settling: kinetic energy still %.3g N m g d after %.3g s (threshold %.3g)",
                    worst, scene->settle.time_max, scene->settle.threshold);
    }
    return OZ_OK;
}

static void begin_part(OzBatch *batch, OzSettling part, double time)
{
    batch->settling = part;
    batch->settling_last = batch->step + (int64_t)ceil(time / batch->clock[0].dt - 1e-9);
}

static OzStatus damp(const OzRelax *rest, OzSettleWatch watch, void *context)
{
    OzBatch *batch = rest->batch;
    const OzSettle *settle = &batch->members[0].scene->settle;
    OZ_PASS(rest->set_drag(rest->sim, settle->drag));
    OZ_PASS(run_part(rest, true, watch, context));
    OZ_PASS(rest->set_drag(rest->sim, 0));
    memset(batch->waits, 0, (size_t)batch->member_count * sizeof *batch->waits);
    begin_part(batch, OZ_SETTLING_RESTS, settle->rest_time);
    return OZ_OK;
}

OzStatus oz_relax_run(const OzRelax *rest, double *seconds, OzSettleWatch watch, void *context)
{
    OzBatch *batch = rest->batch;
    const OzScene *scene = batch->members[0].scene;
    *seconds = 0;
    if (batch->settling == OZ_SETTLING_AHEAD) {
        bool any = scene->settle.present && !rest->is_empty;
        batch->walls_still = any;
        begin_part(batch, any ? OZ_SETTLING_DAMPS : OZ_SETTLING_OVER, scene->settle.time_max);
        OZ_PASS(any ? show(rest, context) : OZ_OK);
    }
    if (batch->settling == OZ_SETTLING_OVER) {
        return OZ_OK;
    }
    if (batch->settling == OZ_SETTLING_DAMPS) {
        OZ_PASS(damp(rest, watch, context));
    }
    OZ_PASS(run_part(rest, false, watch, context));
    *seconds = oz_batch_time(batch, 0, batch->step);
    oz_batch_start_clock(batch);
    batch->settling = OZ_SETTLING_OVER;
    return rest->start_ledger(rest->sim);
}
