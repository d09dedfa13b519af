/* Keeping count of members. It knows nothing of what they are made of. */
#include "sim/batch.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A launch is kept below this so that Ctrl-C and watchdogs are served, s. */
static const double launch_seconds = 0.04;

enum { FIRST_LAUNCH = 16 };

static void begin_clocks(OzBatch *batch)
{
    for (int m = 0; m < batch->member_count; m++) {
        batch->clock[m] = oz_step_clock_begin(batch->members[m].scene->step);
    }
}

OzStatus oz_batch_create(OzBatch *batch, const OzMember *members, int member_count)
{
    *batch = (OzBatch){.member_count = member_count, .launch_steps = FIRST_LAUNCH};
    OZ_PASS(OZ_NEW(&batch->members, member_count));
    OZ_PASS(OZ_NEW(&batch->reached, member_count));
    OZ_PASS(OZ_NEW(&batch->clock, member_count));
    OZ_PASS(OZ_NEW(&batch->waits, member_count));
    OZ_PASS(OZ_NEW(&batch->stopped, member_count));
    OZ_PASS(OZ_NEW(&batch->deep_count, member_count));
    OZ_PASS(OZ_NEW(&batch->deep_told, member_count));
    OZ_PASS(OZ_NEW(&batch->scenes, member_count));
    for (int m = 0; m < member_count; m++) {
        OZ_PASS(oz_scene_copy(&batch->scenes[m], members[m].scene));
        batch->members[m] = (OzMember){&batch->scenes[m], members[m].grains};
    }
    begin_clocks(batch);
    return OZ_OK;
}

OzStatus oz_batch_take_scene(OzBatch *batch, int member, const OzScene *scene)
{
    OzScene copy;
    OZ_PASS(oz_scene_copy(&copy, scene));
    oz_scene_free(&batch->scenes[member]);
    batch->scenes[member] = copy;
    oz_step_clock_change(&batch->clock[member], batch->step, scene->step);
    return OZ_OK;
}

void oz_batch_free(OzBatch *batch)
{
    for (int m = 0; batch->stopped && m < batch->member_count; m++) {
        free(batch->stopped[m]);
    }
    for (int m = 0; batch->scenes && m < batch->member_count; m++) {
        oz_scene_free(&batch->scenes[m]);
    }
    free(batch->scenes);
    free(batch->members);
    free(batch->reached);
    free(batch->clock);
    free(batch->waits);
    free(batch->stopped);
    free(batch->deep_count);
    free(batch->deep_told);
    *batch = (OzBatch){0};
}

bool oz_batch_goes_on(const OzBatch *batch, int member)
{
    return !batch->waits[member] && !batch->stopped[member];
}

static bool all_stopped(const OzBatch *batch)
{
    for (int m = 0; m < batch->member_count; m++) {
        if (!batch->stopped[m]) {
            return false;
        }
    }
    return true;
}

OzStatus oz_batch_check(const OzBatch *batch)
{
    if (all_stopped(batch)) {
        return oz_status_fail(OZ_ERR_BLOWUP, "%s", batch->stopped[batch->member_count - 1]);
    }
    return OZ_OK;
}

void oz_batch_skip(OzBatch *batch, int64_t step)
{
    batch->step = step > batch->step ? step : batch->step;
    for (int m = 0; m < batch->member_count; m++) {
        batch->reached[m] = batch->step;
    }
}

int oz_batch_launch_steps(const OzBatch *batch, int64_t step)
{
    int64_t left = step - batch->step;
    return left < batch->launch_steps ? (int)left : batch->launch_steps;
}

void oz_batch_note_launch(OzBatch *batch, int made, double seconds, int most_steps)
{
    double wanted = launch_seconds / (seconds / fmax(made, 1));
    double most = fmin(4.0 * batch->launch_steps, most_steps);
    if (made == batch->launch_steps || wanted < batch->launch_steps) {
        batch->launch_steps = (int)fmax(1, fmin(wanted, most));
    }
}

void oz_batch_count(OzBatch *batch, int member, int own, int *most)
{
    batch->reached[member] += own;
    *most = own > *most ? own : *most;
}

OzStatus oz_batch_stop(OzBatch *batch, int member)
{
    return oz_memory_text(&batch->stopped[member], oz_status_text());
}

OzStatus oz_batch_end_launch(OzBatch *batch, int steps, int most)
{
    int made = all_stopped(batch) ? most : steps;
    batch->step += made;
    batch->counts.steps += made;
    return oz_batch_check(batch);
}

double oz_batch_time(const OzBatch *batch, int member, int64_t step)
{
    return oz_step_clock_time(&batch->clock[member], step);
}

void oz_batch_start_clock(OzBatch *batch)
{
    batch->step = 0;
    begin_clocks(batch);
    memset(batch->reached, 0, (size_t)batch->member_count * sizeof *batch->reached);
    memset(batch->deep_count, 0, (size_t)batch->member_count * sizeof *batch->deep_count);
    memset(batch->deep_told, 0, (size_t)batch->member_count * sizeof *batch->deep_told);
    batch->walls_still = false;
    batch->counts = (OzSimCounts){0};
}

static OzStatus member_state(OzBatch *batch, int m, OzStateVisit *visit)
{
    oz_state_enter_one(visit, "member", m);
    OZ_PASS(oz_state_int64(visit, "reached", "step", &batch->reached[m]));
    OZ_PASS(oz_step_clock_state(&batch->clock[m], visit, "clock"));
    OZ_PASS(oz_state_bool(visit, "waits", &batch->waits[m]));
    OZ_PASS(oz_state_text(visit, "stopped", &batch->stopped[m]));
    OZ_PASS(oz_state_int64(visit, "deep_count", "none", &batch->deep_count[m]));
    OZ_PASS(oz_state_bool(visit, "deep_told", &batch->deep_told[m]));
    oz_state_leave(visit);
    return OZ_OK;
}

OzStatus oz_batch_state(OzBatch *batch, OzStateVisit *visit)
{
    int64_t settling = batch->settling;
    OZ_PASS(oz_state_enter(visit, "batch", 1));
    OZ_PASS(oz_state_int64(visit, "step", "step", &batch->step));
    OZ_PASS(oz_state_bool(visit, "walls_still", &batch->walls_still));
    OZ_PASS(oz_state_index(visit, "settling", &settling, OZ_SETTLING_AHEAD, OZ_SETTLING_OVER));
    OZ_PASS(oz_state_int64(visit, "settling_last", "step", &batch->settling_last));
    for (int m = 0; m < batch->member_count; m++) {
        OZ_PASS(member_state(batch, m, visit));
    }
    oz_state_leave(visit);
    batch->settling = (OzSettling)settling;
    return OZ_OK;
}
