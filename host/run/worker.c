/* Settling, walking from event to event, and the end; a thread for each worker but the first. */
#include "run/worker.h"

#include "base/clock.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/stage.h"
#include "base/thread.h"
#include "model/calibrate.h"
#include "run/pace.h"
#include "run/swap.h"
#include "run/worker_state.h"
#include "scene/mixing.h"
#include "sim/read_snapshot.h"
#include "sim/settle.h"
#include "sim/stiffness.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

OzStatus oz_worker_open(OzWorker *worker, const OzDevice *device, const char *source_dir)
{
    OzStatus status = OZ_OK;
    OzMember *members = NULL;
    OZ_TRY(OZ_NEW(&members, worker->member_count));
    for (int64_t m = 0; m < worker->member_count; m++) {
        members[m] = (OzMember){&worker->members[m]->scene, &worker->members[m]->grains};
    }
    worker->root = device;
    worker->source_dir = source_dir;
    OZ_TRY(OZ_NEW(&worker->device, 1));
    OZ_TRY(oz_device_branch(worker->device, device));
    OZ_TRY(oz_sim_create(&worker->sim, worker->device, members, (int)worker->member_count,
                         source_dir));
done:
    free(members);
    return status;
}

void oz_worker_close(OzWorker *worker)
{
    oz_swap_end(worker);
    oz_sim_free(worker->sim);
    if (worker->device) {
        oz_device_close(worker->device);
    }
    free(worker->device);
    worker->device = NULL;
    worker->sim = NULL;
}

/* A member of an ensemble that did not end well: said by name, remembered, and the others go on. */
static void lose(OzOutputs *member, OzStatus why, const char *text)
{
    member->outcome = why == OZ_ERR_BLOWUP ? OZ_OUTCOME_STOPPED : OZ_OUTCOME_FAILED;
    member->loss = why;
    oz_log_line("%s: %s", member->name, text);
}

/* Ends the outputs of members that a guard has stopped; a plain run says why at its end. */
static OzStatus drop_stopped(OzWorker *worker)
{
    for (int64_t m = 0; worker->is_ensemble && m < worker->member_count; m++) {
        OzOutputs *member = worker->members[m];
        const char *why = oz_sim_stopped(worker->sim, (int)m);
        if (why && member->is_open) {
            lose(member, OZ_ERR_BLOWUP, why);
            OZ_PASS(oz_outputs_close(member));
        }
    }
    return OZ_OK;
}

static bool must_end(const OzWorker *worker)
{
    return oz_interrupt_asked() || atomic_load(worker->ended);
}

/* A picture between those of the movie, for those who look on, if any. Reading the state takes at
 * most a twentieth of the time. A state that is no good is the next event's to find. */
static OzStatus show_glance(OzWorker *worker)
{
    OzOutputs *first = worker->members[0];
    double now = oz_clock_now();
    if (now < worker->glance_after || !oz_glances_wait(&first->glances)) {
        return OZ_OK;
    }
    OzStatus status = oz_read_snapshot_snapshot(worker->sim, 0, &first->now,
                                                oz_scene_shows_contacts(&first->scene));
    if (status == OZ_OK) {
        status = oz_glances_show(&first->glances, &first->now);
    }
    worker->glance_after = now + 20 * (oz_clock_now() - now);
    return status == OZ_ERR_BLOWUP ? OZ_OK : status;
}

/* Settling a large bed takes hours, which a kill must not lose. */
static OzStatus watch_settling(void *context, double time, double ratio)
{
    OzWorker *worker = context;
    if (worker->leads) {
        oz_stage_say(&worker->stage,
                     "settling: %.3f s, kinetic energy %.3g of what lifts all by a diameter", time,
                     ratio);
    }
    if (must_end(worker)) {
        return oz_status_fail(OZ_ERR_INTERRUPTED, "interrupted at %.9g s of settling", time);
    }
    oz_serve_settle(worker->serve, time);
    OZ_PASS(show_glance(worker));
    return oz_worker_state_save_if_due(worker);
}

/* What is doubtful about contacts at this step, for one member of those alike. */
static OzStatus tell_contacts(const OzWorker *worker)
{
    OzStiffness stiffness;
    OzOutputs *first = worker->members[0];
    if (!worker->leads || !first->is_open) {
        return OZ_OK;
    }
    oz_mixing_say(&first->scene);
    if (!oz_stiffness_applies(&first->scene)) {
        return OZ_OK;
    }
    oz_calibrate_say(&first->scene);
    OZ_PASS(oz_read_snapshot_snapshot(worker->sim, 0, &first->now, false));
    OZ_PASS(oz_stiffness_measure(&stiffness, &first->now));
    oz_stiffness_say(&stiffness, &first->scene);
    return OZ_OK;
}

static OzStatus look_at(OzWorker *worker, int64_t m, int due)
{
    OzStatus status = OZ_OK;
    OzOutputs *member = worker->members[m];
    OZ_TRY(
        oz_read_snapshot_snapshot(worker->sim, (int)m, &member->now, (due & OZ_DUE_LISTED) != 0));
    OZ_TRY(oz_outputs_look(member, due));
done:
    if (status == OZ_ERR_BLOWUP && worker->is_ensemble) {
        lose(member, status, oz_status_text());
        status = oz_outputs_close(member);
    }
    return status;
}

/* What is due at this step of every member that goes on; *open receives how many do. */
static OzStatus look(OzWorker *worker, int due, int64_t *open)
{
    *open = 0;
    for (int64_t m = 0; m < worker->member_count; m++) {
        if (worker->members[m]->is_open) {
            OZ_PASS(look_at(worker, m, due));
        }
        *open += worker->members[m]->is_open;
    }
    return OZ_OK;
}

/* A frame of the movie before time 0. */
static OzStatus show_settling(void *context, int m)
{
    int due = 0;
    OzWorker *worker = context;
    oz_schedule_settling(&worker->schedule, &due);
    return worker->members[m]->is_open ? look_at(worker, m, due) : OZ_OK;
}

/* What settling waited for pictures is not the steps'. */
static void count_from_here(const OzWorker *worker)
{
    if (worker->leads && worker->members[0]->render_queue) {
        oz_render_queue_take_times(worker->members[0]->render_queue);
    }
}

static OzStatus settle(OzWorker *worker)
{
    int due = 0;
    double seconds = 0, start = oz_clock_now();
    double interval = oz_schedule_settling(&worker->schedule, &due);
    if (worker->leads) {
        oz_stage_begin(&worker->stage, "settling");
    }
    OzStatus status =
        oz_settle_show(worker->sim, &seconds, watch_settling, worker, show_settling, interval);
    if (worker->leads) {
        oz_stage_end(&worker->stage);
    }
    count_from_here(worker);
    OZ_AFTER(status, drop_stopped(worker));
    if (status == OZ_ERR_INTERRUPTED) {
        OZ_AFTER(status, oz_worker_state_save_if_wanted(worker));
    }
    if (status == OZ_OK && seconds > 0) {
        const char *first = worker->members[0]->name;
        const char *others = worker->member_count > 1 ? " and companions " : " ";
        oz_log_line("%s%ssettling took %.3f s (%.1f s of computing%s)", first,
                    first[0] ? others : "", seconds, oz_clock_now() - start,
                    interval > 0 ? " and pictures" : "");
    }
    return status;
}

static void show_progress(const OzWorker *worker)
{
    double step = (double)oz_sim_step(worker->sim), last = (double)worker->schedule.last_step;
    double spent = oz_clock_now() - worker->first_step, rate = spent > 0 ? step / spent : 0;
    char left[48];
    if (worker->schedule.last_step == INT64_MAX) {
        oz_log_progress("%.4g s simulated, %.0f steps/s, until it is stopped",
                        oz_sim_time(worker->sim), rate);
        return;
    }
    oz_clock_words(rate > 0 ? (last - step) / rate : 0, left, sizeof left);
    oz_log_progress("%.1f %%: %.4g s simulated, %.0f steps/s, %s left",
                    last > 0 ? 100 * step / last : 100, oz_sim_time(worker->sim), rate, left);
}

static OzStatus launch(OzWorker *worker, int64_t step, double *shown)
{
    OzStatus status = oz_sim_launch(worker->sim, step);
    OZ_AFTER(status, drop_stopped(worker));
    oz_serve_show(worker->serve, &worker->members[0]->scene, oz_sim_step(worker->sim),
                  oz_sim_time(worker->sim), worker->schedule.last_step);
    status = status == OZ_OK ? show_glance(worker) : status;
    if (status == OZ_OK && worker->leads && oz_clock_now() - *shown > 0.2) {
        show_progress(worker);
        *shown = oz_clock_now();
    }
    if (status == OZ_OK && must_end(worker)) {
        status = oz_status_fail(OZ_ERR_INTERRUPTED, "interrupted at step %lld, time %.9g s",
                                (long long)oz_sim_step(worker->sim), oz_sim_time(worker->sim));
    }
    return status;
}

bool oz_worker_next_event(OzWorker *worker)
{
    if (!worker->is_due) {
        worker->before = worker->schedule;
        worker->is_due =
            oz_schedule_next(&worker->schedule, &worker->event_step, &worker->event_due);
    }
    return worker->is_due;
}

/* To the event in hand, unless a change comes between, which gives the event back. */
static OzStatus go(OzWorker *worker, double *shown)
{
    while (worker->is_due && !oz_swap_is_at_end(worker) &&
           oz_sim_step(worker->sim) < worker->event_step) {
        OZ_PASS(launch(worker, oz_pace_next(worker), shown));
        OZ_PASS(oz_swap_serve(worker));
        OZ_PASS(oz_worker_state_save_if_due(worker));
        oz_pace_keep(worker);
    }
    return OZ_OK;
}

static OzStatus look_at_event(OzWorker *worker, int64_t *open)
{
    if (worker->checkpoint && worker->event_due & OZ_DUE_CHECKPOINT) {
        OZ_PASS(oz_worker_state_save(worker, true));
    }
    if (worker->schedule.over) {
        OZ_PASS(oz_worker_state_save_if_wanted(worker));
    }
    OZ_PASS(look(worker, worker->event_due, open));
    worker->is_due = false;
    return OZ_OK;
}

static OzStatus walk(OzWorker *worker)
{
    OzStatus status = OZ_OK;
    int64_t open = worker->member_count;
    double shown = 0;
    worker->first_step = oz_clock_now();
    if (worker->leads) {
        oz_log_line("first step %.2f s after start", worker->first_step - worker->started);
    }
    OZ_TRY(oz_swap_serve(worker)); /* what was asked for before */
    OZ_TRY(oz_glances_begin(&worker->members[0]->glances));
    while (open > 0 && !oz_swap_is_at_end(worker) && oz_worker_next_event(worker)) {
        OZ_TRY(go(worker, &shown));
        if (worker->is_due && !oz_swap_is_at_end(worker)) {
            OZ_TRY(look_at_event(worker, &open));
        }
    }
done:
    if (status == OZ_ERR_INTERRUPTED) {
        OZ_AFTER(status, oz_worker_state_save_if_wanted(worker));
    }
    worker->spent = oz_clock_now() - worker->first_step;
    oz_log_progress(" ");
    return status;
}

/* Whether the device still has a state worth keeping: all went well, or what failed was not the
 * simulation. */
static bool has_state(OzStatus so_far)
{
    return so_far == OZ_OK || so_far == OZ_ERR_INTERRUPTED || so_far == OZ_ERR_FILE ||
           so_far == OZ_ERR_MOVIE || so_far == OZ_ERR_GRAPHICS;
}

/* The last state of a member, if there is one, and its outputs whole. */
static OzStatus end_member(OzWorker *worker, int64_t m, OzStatus so_far)
{
    OzStatus status = OZ_OK;
    OzOutputs *member = worker->members[m];
    if (has_state(so_far)) {
        OZ_TRY(oz_read_snapshot_snapshot(worker->sim, (int)m, &member->now, false));
        OZ_TRY(oz_glances_end(&member->glances, &member->now));
        OZ_TRY(oz_outputs_write_final(member));
        OZ_TRY(oz_outputs_note_end(member, oz_sim_step(worker->sim), oz_sim_time(worker->sim),
                                   so_far == OZ_OK ? "done" : "interrupted"));
    }
done:
    OZ_AFTER(status, oz_outputs_close(member));
    member->outcome = so_far == OZ_OK && status == OZ_OK ? OZ_OUTCOME_DONE
                      : so_far == OZ_ERR_INTERRUPTED     ? OZ_OUTCOME_INTERRUPTED
                                                         : OZ_OUTCOME_FAILED;
    return status;
}

/* Pictures may still wait to be drawn. */
static void end_all(OzWorker *worker, OzStatus *status)
{
    if (worker->leads) {
        oz_stage_begin(&worker->stage, "finishing files and pictures");
    }
    for (int64_t m = 0; m < worker->member_count; m++) {
        if (worker->members[m]->is_open) {
            OZ_AFTER(*status, end_member(worker, m, *status));
        }
    }
    if (worker->leads) {
        oz_stage_end(&worker->stage);
    }
}

/* Up to the first step. A state of it is there for whatever stops the run before the next one. */
static OzStatus begin(OzWorker *worker)
{
    bool settles = !oz_settle_is_over(worker->sim);
    if (settles) {
        OZ_PASS(settle(worker));
        OZ_PASS(tell_contacts(worker));
    }
    return settles || !worker->members[0]->goes_on ? oz_worker_state_save_if_wanted(worker) : OZ_OK;
}

static void run_one(OzWorker *worker)
{
    OzStatus status = begin(worker);
    status = status == OZ_OK ? walk(worker) : status;
    end_all(worker, &status);
    /* All its members were stopped: others may do better. */
    worker->status = status == OZ_ERR_BLOWUP && worker->is_ensemble ? OZ_OK : status;
    snprintf(worker->text, sizeof worker->text, "%s", oz_status_text());
    if (worker->status != OZ_OK) {
        atomic_store(worker->ended, true);
    }
}

static void *run_thread(void *worker)
{
    run_one(worker);
    return NULL;
}

/* A worker that was ended by another says that it was interrupted, which is not the reason. */
static OzStatus tell(const OzWorker *workers, int count)
{
    const OzWorker *guilty = NULL;
    for (int i = 0; i < count; i++) {
        const OzWorker *c = &workers[i];
        bool better = !guilty || guilty->status == OZ_ERR_INTERRUPTED;
        guilty = c->status != OZ_OK && better ? c : guilty;
    }
    return guilty ? oz_status_fail(guilty->status, "%s", guilty->text) : OZ_OK;
}

OzStatus oz_worker_run(OzWorker *workers, int count)
{
    OzStatus status = OZ_OK;
    pthread_t *threads = NULL;
    int started = 1;
    OZ_TRY(OZ_NEW(&threads, count));
    for (; started < count; started++) {
        int code = oz_thread_start(&threads[started], run_thread, &workers[started]);
        if (code != 0) {
            oz_log_line("no more threads than %d: %s", started, strerror(code));
            break;
        }
    }
    run_one(&workers[0]);
    for (int i = 1; i < started; i++) {
        pthread_join(threads[i], NULL);
    }
    for (; started < count; started++) {
        run_one(&workers[started]);
    }
    status = tell(workers, count);
done:
    free(threads);
    return status;
}
