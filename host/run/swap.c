/* Carrying out a change: phases of walls, the simulation, outputs, the schedule; and what is said
 * and noted of it. */
#include "run/swap.h"

#include "base/clock.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/thread.h"
#include "model/motion.h"
#include "run/reload.h"
#include "run/replay.h"
#include "run/watch.h"
#include "scene/changes.h"
#include "sim/take_over.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A simulation that is being built. */
struct OzSwap {
    pthread_t thread;
    atomic_bool done;
    OzWorker *worker;
    OzDevice *device;
    OzSim *sim;
    OzScene *next;          /* the worker's members', of the request      */
    const OzScene **scenes; /* pointers to them                          */
    double started, seconds;
    OzStatus status;
    char text[2048];
};

static void free_device(OzDevice *device)
{
    if (device) {
        oz_device_close(device);
        free(device);
    }
}

static void free_swap(OzSwap *swap)
{
    if (swap) {
        oz_sim_free(swap->sim);
        free_device(swap->device);
        free(swap->scenes);
        free(swap);
    }
}

static OzStatus point(const OzScene ***scenes, OzScene *next, int64_t count)
{
    OZ_PASS(OZ_NEW((OzScene ***)scenes, count));
    for (int64_t m = 0; m < count; m++) {
        (*scenes)[m] = &next[m];
    }
    return OZ_OK;
}

/* One line a key, and when a wall takes its new motion. */
static void say(const OzWorker *worker, const OzChanges *changes, const OzScene *next)
{
    double time = oz_sim_time(worker->sim);
    char tap[48] = "";
    if (next->period > 0) {
        snprintf(tap, sizeof tap, ", tap %.2f", oz_motion_tap(next, time));
    }
    for (int i = 0; worker->leads && i < changes->count; i++) {
        const OzChange *c = &changes->rows[i];
        oz_log_line("step %lld (%.4g s%s): %s %s -> %s", (long long)oz_sim_step(worker->sim), time,
                    tap, c->path, c->old[0] ? c->old : "(none)", c->now[0] ? c->now : "(none)");
    }
    for (int w = 0; worker->leads && w < next->wall_count; w++) {
        const OzMotion *motion = &next->walls[w].motion;
        if (motion->present && motion->shake.since > time) {
            oz_log_line("walls.%d moves so from its next zero crossing on, %.4g s", w,
                        motion->shake.since);
        }
    }
}

static void caption_of(const OzChanges *changes, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < changes->count && used < size; i++) {
        const OzChange *c = &changes->rows[i];
        used += (size_t)snprintf(text + used, size - used, "%s%s %s -> %s", i ? "; " : "", c->path,
                                 c->old, c->now);
    }
}

/* One member's files and pictures; its scene becomes next, which is empty then. */
static OzStatus change_member(OzWorker *worker, int64_t m, OzScene *next, double seconds)
{
    OzStatus status = OZ_OK;
    OzOutputs *member = worker->members[m];
    OzChanges changes = {0};
    char caption[200] = "";
    OZ_TRY(oz_changes_find(&changes, &member->scene, next));
    if (m == 0 && !worker->is_quiet) {
        say(worker, &changes, next);
    }
    if (!worker->is_quiet) {
        caption_of(&changes, caption, sizeof caption);
    }
    if (m == 0 && worker->checkpoint) {
        OZ_TRY(oz_checkpoint_change(worker->checkpoint, next, &changes));
    }
    if (member->is_open) {
        OZ_TRY(oz_reload_log_add(member->reloads, oz_sim_step(worker->sim),
                                 oz_sim_time(worker->sim), &changes, seconds));
    }
    OZ_TRY(oz_outputs_take(member, next, caption));
done:
    oz_changes_free(&changes);
    return status;
}

/* The new simulation in the old one's place. */
static OzStatus put(OzWorker *worker, OzSwap *swap)
{
    OZ_PASS(oz_take_over_swap(swap->sim, worker->sim, swap->scenes));
    oz_sim_free(worker->sim);
    free_device(worker->device);
    worker->sim = swap->sim;
    worker->device = swap->device;
    swap->sim = NULL;
    swap->device = NULL;
    return OZ_OK;
}

/* These scenes, one a member, take over here; swap: with the simulation that was built. */
static OzStatus carry_out(OzWorker *worker, OzScene *next, OzSwap *swap)
{
    OzStatus status = OZ_OK;
    const OzScene **scenes = NULL;
    double time = oz_sim_time(worker->sim);
    OZ_TRY(point(&scenes, next, worker->member_count));
    for (int64_t m = 0; m < worker->member_count; m++) {
        oz_motion_take_over(&next[m], &worker->members[m]->scene, time);
    }
    if (swap) {
        OZ_TRY(put(worker, swap));
    } else {
        OZ_TRY(oz_take_over_apply(worker->sim, scenes));
    }
    if (worker->is_due) {
        worker->schedule = worker->before;
        worker->is_due = false;
    }
    for (int64_t m = 0; m < worker->member_count; m++) {
        OZ_TRY(change_member(worker, m, &next[m], swap ? swap->seconds : 0));
    }
    oz_schedule_take_over(&worker->schedule, &worker->members[0]->scene, oz_sim_step(worker->sim));
done:
    free(scenes);
    return status;
}

static void build(OzSwap *swap)
{
    OzWorker *worker = swap->worker;
    swap->status =
        oz_take_over_build(&swap->sim, worker->sim, swap->device, swap->scenes, worker->source_dir);
    snprintf(swap->text, sizeof swap->text, "%s", oz_status_text());
    swap->seconds = oz_clock_now() - swap->started;
    atomic_store(&swap->done, true);
}

static void *build_thread(void *swap)
{
    build(swap);
    return NULL;
}

static OzStatus make_swap(OzSwap **swap, OzWorker *worker, OzScene *next)
{
    OzStatus status = OZ_OK;
    OZ_TRY(OZ_NEW(swap, 1));
    (*swap)->worker = worker;
    (*swap)->next = next;
    (*swap)->started = oz_clock_now();
    OZ_TRY(point(&(*swap)->scenes, next, worker->member_count));
    OZ_TRY(OZ_NEW(&(*swap)->device, 1));
    OZ_TRY(oz_device_branch((*swap)->device, worker->root));
done:
    if (status != OZ_OK) {
        free_swap(*swap);
        *swap = NULL;
    }
    return status;
}

static OzStatus begin_build(OzWorker *worker, OzScene *next)
{
    OZ_PASS(make_swap(&worker->swap, worker, next));
    if (oz_thread_start(&worker->swap->thread, build_thread, worker->swap) != 0) {
        free_swap(worker->swap);
        worker->swap = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "cannot start a thread to build kernels in");
    }
    return OZ_OK;
}

/* The run goes on as it was. Companions that have taken the change already cannot. */
static OzStatus give_up(OzWorker *worker, const char *why)
{
    if (worker->is_ensemble) {
        return oz_status_fail(OZ_ERR_DEVICE, "the change cannot be made: %s", why);
    }
    oz_log_line("the change cannot be made, the run goes on without it: %s", why);
    char said[2048];
    snprintf(said, sizeof said, "the change cannot be made: %s", why);
    OZ_PASS(oz_reload_withdraw(worker->reload, worker->taken));
    oz_reload_announce(worker->reload, false, said);
    return OZ_OK;
}

static OzStatus end_build(OzWorker *worker)
{
    OzSwap *swap = worker->swap;
    OzStatus status = OZ_OK;
    pthread_join(swap->thread, NULL);
    worker->swap = NULL;
    if (swap->status == OZ_OK) {
        status = carry_out(worker, swap->next, swap);
        oz_reload_done(worker->reload, worker->taken++);
    } else {
        status = give_up(worker, swap->text);
    }
    free_swap(swap);
    return status;
}

static OzStatus serve_request(OzWorker *worker)
{
    OzReloadRequest *request = oz_reload_get(worker->reload, worker->taken);
    OzScene *next = &request->scenes[worker->first];
    if (request->how == OZ_TAKE_OVER_REBUILD) {
        return begin_build(worker, next);
    }
    OZ_PASS(carry_out(worker, next, NULL));
    oz_reload_done(worker->reload, worker->taken++);
    return OZ_OK;
}

int64_t oz_swap_next(const OzWorker *worker)
{
    const OzReplay *replay = worker->replay;
    if (!replay) {
        return INT64_MAX;
    }
    if (worker->taken < replay->count) {
        return replay->changes[worker->taken].step;
    }
    return replay->is_cut ? replay->end : INT64_MAX;
}

bool oz_swap_is_at_end(const OzWorker *worker)
{
    const OzReplay *replay = worker->replay;
    return replay && replay->is_cut && worker->taken == replay->count &&
           oz_sim_step(worker->sim) >= replay->end;
}

/* One member's next scene in a run that is repeated, and what it asks of the simulation. */
static OzStatus prepare(const OzWorker *worker, int64_t m, const OzReplayChange *change,
                        OzScene *next, OzTakeOver *how)
{
    const OzOutputs *member = worker->members[m];
    OZ_PASS(oz_scene_change(next, &member->scene, change->settings, change->count));
    return oz_take_over_compare(how, worker->device, &member->grains, &member->scene, next);
}

/* As the run that is repeated did it, or as a phase begins; built while it waits. */
static OzStatus repeat(OzWorker *worker, const OzReplayChange *change)
{
    OzStatus status = OZ_OK;
    OzScene *next = NULL;
    OzSwap *swap = NULL;
    bool rebuilds = false;
    if (worker->leads && change->what) {
        oz_log_line("%s, begins at step %lld", change->what, (long long)change->step);
    }
    OZ_TRY(OZ_NEW(&next, worker->member_count));
    for (int64_t m = 0; m < worker->member_count; m++) {
        OzTakeOver how = OZ_TAKE_OVER_APPLY;
        OZ_TRY(prepare(worker, m, change, &next[m], &how));
        rebuilds = rebuilds || how == OZ_TAKE_OVER_REBUILD;
    }
    if (rebuilds) {
        OZ_TRY(make_swap(&swap, worker, next));
        build(swap);
        OZ_TRY(swap->status);
    }
    worker->is_quiet = change->is_quiet;
    OZ_TRY(carry_out(worker, next, swap));
done:
    worker->is_quiet = false;
    free_swap(swap);
    for (int64_t m = 0; next && m < worker->member_count; m++) {
        oz_scene_free(&next[m]);
    }
    free(next);
    return status;
}

static void serve_signal(OzWorker *worker)
{
    if (worker->leads && worker->reload && oz_interrupt_take_reread()) {
        oz_watch_read(worker->reload);
    }
}

OzStatus oz_swap_serve(OzWorker *worker)
{
    serve_signal(worker);
    if (worker->replay) {
        while (worker->taken < worker->replay->count &&
               oz_sim_step(worker->sim) >= worker->replay->changes[worker->taken].step) {
            OZ_PASS(repeat(worker, &worker->replay->changes[worker->taken]));
            worker->taken++;
        }
        return OZ_OK;
    }
    if (worker->swap) {
        return atomic_load(&worker->swap->done) ? end_build(worker) : OZ_OK;
    }
    return oz_reload_waits(worker->reload, worker->taken) ? serve_request(worker) : OZ_OK;
}

void oz_swap_end(OzWorker *worker)
{
    if (worker->swap) {
        oz_log_line("the run is over: the kernels that were being built are not needed");
        pthread_join(worker->swap->thread, NULL);
        free_swap(worker->swap);
        worker->swap = NULL;
    }
}
