/* The straight line of a run: members of a plan in groups that share launches, each group from its
 * start to its last step. A plain run is a group of one. */
#include "run.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/memory.h"
#include "compute/drive.h"
#include "compute/stiffness.h"
#include "ensemble.h"
#include "model/calibrate.h"
#include "observe/schedule.h"
#include "outputs.h"
#include "plan.h"
#include "room.h"

#include <stdlib.h>
#include <string.h>

/* What became of a member. */
typedef enum Outcome { NOT_STARTED, DONE, STOPPED, INTERRUPTED, FAILED } Outcome;
static const char *const outcome_names[] = {"not started", "done", "stopped", "interrupted",
                                            "failed"};

/* Everything one run owns. Zeroed is valid: what was not opened is not closed. */
typedef struct Run {
    const OzOptions *options;
    OzPlan plan;
    OzDevice device;
    OzStudio *studio; /* of all members */
    char *folder;
    OzOutputs **members;        /* of the group in hand */
    int64_t member_count, most; /* most: that there is room for at a time            */
    OzOutputs *loaded;          /* the next group's first, NULL at the end           */
    int64_t loaded_count;       /* members of the plan that were loaded or could not be */
    Outcome *outcomes;          /* of each member of the plan                        */
    OzDrive *drive;
    OzSchedule schedule;
    double started, first_step, spent; /* wall clock; spent: from the first step to the last */
    OzStatus loss;                     /* why the first member that did not end well did not */
} Run;

/* Does a thing after a failure, whose text it keeps; returns the failure, or the thing's outcome
 * after none. */
#define AFTER(status, later)                                                                       \
    do {                                                                                           \
        char text_[16384];                                                                         \
        snprintf(text_, sizeof text_, "%s", oz_status_text());                                     \
        OzStatus later_ = (later);                                                                 \
        (status) = (status) == OZ_OK ? later_ : oz_status_fail((status), "%s", text_);             \
    } while (0)

static OzStatus open_log(const Run *run)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    OZ_TRY(oz_file_join(&path, run->folder, "log.txt"));
    OZ_TRY(oz_log_open(path));
done:
    free(path);
    return status;
}

/* A member of an ensemble that did not end well: said by name, remembered, and the others go on. */
static void lose(Run *run, int64_t number, OzStatus why, const char *text)
{
    char *name = NULL;
    run->outcomes[number] = why == OZ_ERR_BLOWUP ? STOPPED : FAILED;
    run->loss = run->loss == OZ_OK ? why : run->loss;
    if (oz_plan_name(&run->plan, number, &name) == OZ_OK) {
        oz_log_line("%s: %s", name, text);
    }
    free(name);
}

/* The plan's next member that can be loaded into *loaded; NULL when there is none left. A plain
 * run's one scene must load. */
static OzStatus load_next(Run *run, OzOutputs **loaded)
{
    OzStatus status = OZ_OK;
    OzOutputs *member = NULL;
    *loaded = NULL;
    while (!*loaded && run->loaded_count < run->plan.count && !oz_interrupt_asked()) {
        OZ_TRY(OZ_NEW(&member, 1));
        member->number = run->loaded_count++;
        OzStatus own = oz_plan_load(&run->plan, member->number, &member->scene, &member->grains);
        if (own == OZ_OK) {
            *loaded = member;
        } else if (run->plan.is_ensemble) {
            lose(run, member->number, own, oz_status_text());
            oz_outputs_free(member);
        } else {
            status = own;
            goto done;
        }
        member = NULL;
    }
done:
    oz_outputs_free(member);
    return status;
}

/* How many members like the first are run at a time. */
static OzStatus choose_most(Run *run)
{
    OzStatus status = OZ_OK;
    OzMember first = {&run->loaded->scene, &run->loaded->grains};
    double bytes = 0;
    OZ_TRY(oz_room_most(run->options, &run->device, &first, &run->most, &bytes));
    if (run->plan.is_ensemble) {
        oz_log_line("%lld members of about %.3g MB; up to %lld at a time",
                    (long long)run->plan.count, bytes / 1e6, (long long)run->most);
    }
    run->most = run->most < run->plan.count ? run->most : run->plan.count;
    OZ_TRY(OZ_NEW(&run->members, run->most));
done:
    return status;
}

static OzStatus open_run(Run *run)
{
    OzStatus status = OZ_OK;
    const OzOptions *options = run->options;
    OZ_TRY(oz_plan_create(&run->plan, options));
    OZ_TRY(OZ_NEW(&run->outcomes, run->plan.count));
    OZ_TRY(load_next(run, &run->loaded));
    if (!run->loaded) {
        status = oz_status_fail(run->loss, "%s: no member can be run", run->plan.scene.path);
        goto done;
    }
    OZ_TRY(oz_outputs_choose_folder(&run->folder, options, run->plan.scene.name));
    OZ_TRY(open_log(run));
    oz_log_line("orzo %s: %s, %lld grains", ORZO_VERSION, run->plan.scene.path,
                (long long)run->loaded->grains.count);
    OZ_TRY(oz_studio_create(&run->studio));
    OZ_TRY(oz_device_open(&run->device, options->device, options->threads));
    oz_log_line("device: %s", run->device.name);
    OZ_TRY(choose_most(run));
done:
    return status;
}

/* Whether a loaded member can go side by side with the group's first. */
static bool joins(const Run *run, const OzOutputs *member)
{
    const OzOutputs *first = run->members[0];
    OzMember a = {&first->scene, &first->grains}, b = {&member->scene, &member->grains};
    OzSchedule events = oz_schedule_create(&member->scene, run->options->until);
    return oz_schedule_agrees(&run->schedule, &events) && oz_drive_fits(&run->device, &a, &b);
}

/* The loaded member and those after it that can join it; the one that cannot begins the next group.
 */
static OzStatus gather_group(Run *run)
{
    OzStatus status = OZ_OK;
    run->members[0] = run->loaded;
    run->member_count = 1;
    run->loaded = NULL;
    run->schedule = oz_schedule_create(&run->members[0]->scene, run->options->until);
    OZ_TRY(load_next(run, &run->loaded));
    while (run->loaded && run->member_count < run->most && joins(run, run->loaded)) {
        run->members[run->member_count++] = run->loaded;
        run->loaded = NULL;
        OZ_TRY(load_next(run, &run->loaded));
    }
done:
    return status;
}

static OzStatus create_sim(Run *run)
{
    OzStatus status = OZ_OK;
    OzMember *members = NULL;
    OZ_TRY(OZ_NEW(&members, run->member_count));
    for (int64_t m = 0; m < run->member_count; m++) {
        members[m] = (OzMember){&run->members[m]->scene, &run->members[m]->grains};
    }
    OZ_TRY(oz_drive_create(&run->drive, &run->device, members, (int)run->member_count,
                           run->options->source_dir));
done:
    free(members);
    return status;
}

static OzStatus open_group(Run *run)
{
    OzStatus status = OZ_OK;
    OZ_TRY(create_sim(run));
    oz_interrupt_hold();
    for (int64_t m = 0; m < run->member_count; m++) {
        OzOutputs *member = run->members[m];
        OZ_TRY(oz_plan_name(&run->plan, member->number, &member->name));
        OZ_TRY(member->name[0] ? oz_file_join(&member->folder, run->folder, member->name)
                               : oz_file_join(&member->folder, NULL, run->folder));
        OZ_TRY(oz_outputs_open(member, run->options, run->device.name, run->studio));
    }
    if (run->plan.is_ensemble) {
        oz_log_line("%s to %s: %lld side by side", run->members[0]->name,
                    run->members[run->member_count - 1]->name, (long long)run->member_count);
    }
done:
    return status;
}

static bool show_settling(void *context, double time, double ratio)
{
    (void)context;
    oz_log_progress("settling: %.3f s, kinetic energy %.3g N m g d", time, ratio);
    return !oz_interrupt_asked();
}

/* Ends the outputs of members that a guard has stopped; a plain run says why at its end. */
static OzStatus drop_stopped(Run *run)
{
    OzStatus status = OZ_OK;
    for (int64_t m = 0; run->plan.is_ensemble && m < run->member_count; m++) {
        OzOutputs *member = run->members[m];
        const char *why = oz_drive_stopped(run->drive, (int)m);
        if (why && member->is_open) {
            lose(run, member->number, OZ_ERR_BLOWUP, why);
            OZ_TRY(oz_outputs_close(member));
        }
    }
done:
    return status;
}

static OzStatus settle(Run *run)
{
    double seconds = 0, start = oz_clock_now();
    OzStatus status = oz_drive_settle(run->drive, &seconds, show_settling, NULL);
    oz_log_progress(" ");
    AFTER(status, drop_stopped(run));
    if (status == OZ_OK && seconds > 0) {
        oz_log_line("settled in %.3f s (%.1f s of computing)", seconds, oz_clock_now() - start);
    }
    return status;
}

/* What is doubtful about contacts at this step, for one member of those alike. */
static OzStatus tell_contacts(Run *run)
{
    OzStatus status = OZ_OK;
    OzStiffness stiffness;
    OzOutputs *first = run->members[0];
    if (!first->is_open || !oz_stiffness_applies(&first->scene)) {
        return OZ_OK;
    }
    oz_calibrate_say(&first->scene);
    OZ_TRY(oz_drive_capture(run->drive, 0, &first->now, false));
    OZ_TRY(oz_stiffness_measure(&stiffness, &first->now));
    oz_stiffness_say(&stiffness, &first->scene);
done:
    return status;
}

static OzStatus look_at(Run *run, int64_t m, int due)
{
    OzStatus status = OZ_OK;
    OzOutputs *member = run->members[m];
    OZ_TRY(oz_drive_capture(run->drive, (int)m, &member->now, (due & OZ_DUE_ROW) != 0));
    OZ_TRY(oz_outputs_look(member, due));
done:
    if (status == OZ_ERR_BLOWUP && run->plan.is_ensemble) {
        lose(run, member->number, status, oz_status_text());
        status = oz_outputs_close(member);
    }
    return status;
}

/* What is due at this step of every member that goes on; *open receives how many do. */
static OzStatus look(Run *run, int due, int64_t *open)
{
    OzStatus status = OZ_OK;
    *open = 0;
    for (int64_t m = 0; m < run->member_count; m++) {
        if (run->members[m]->is_open) {
            OZ_TRY(look_at(run, m, due));
        }
        *open += run->members[m]->is_open;
    }
done:
    return status;
}

static void show_progress(const Run *run)
{
    double step = (double)oz_drive_step(run->drive), last = (double)run->schedule.last_step;
    double spent = oz_clock_now() - run->first_step, rate = spent > 0 ? step / spent : 0;
    oz_log_progress("%5.1f %%  %.4f s  %.0f steps/s  %.0f s left",
                    last > 0 ? 100 * step / last : 100, step * run->schedule.scene->step, rate,
                    rate > 0 ? (last - step) / rate : 0);
}

static OzStatus launch(Run *run, int64_t step, double *shown)
{
    OzStatus status = oz_drive_launch(run->drive, step);
    AFTER(status, drop_stopped(run));
    if (status == OZ_OK && oz_clock_now() - *shown > 0.2) {
        show_progress(run);
        *shown = oz_clock_now();
    }
    if (status == OZ_OK && oz_interrupt_asked()) {
        status = oz_status_fail(OZ_ERR_INTERRUPTED, "interrupted at step %lld, time %.9g s",
                                (long long)oz_drive_step(run->drive),
                                (double)oz_drive_step(run->drive) * run->schedule.scene->step);
    }
    return status;
}

static OzStatus walk(Run *run)
{
    OzStatus status = OZ_OK;
    int64_t step = 0, open = run->member_count;
    int due = 0;
    double shown = 0;
    run->first_step = oz_clock_now();
    oz_log_line("first step %.2f s after start", run->first_step - run->started);
    while (open > 0 && oz_schedule_next(&run->schedule, &step, &due)) {
        while (oz_drive_step(run->drive) < step) {
            OZ_TRY(launch(run, step, &shown));
        }
        OZ_TRY(look(run, due, &open));
    }
done:
    run->spent = oz_clock_now() - run->first_step;
    oz_log_progress(" ");
    return status;
}

static void log_costs(const Run *run)
{
    OzSimCounts counts = oz_drive_counts(run->drive);
    double steps = counts.steps > 0 ? (double)counts.steps : 1;
    OzStudioTimes pictures = oz_studio_take_times(run->studio);
    oz_log_line("%lld steps in %.2f s, %.2f s of them waiting for pictures: %.1f us a step without "
                "(beside it drawing %.2f s, encoding %.2f s); list refreshed every %.1f, rebuilt "
                "every %.0f steps",
                (long long)counts.steps, run->spent, pictures.waited,
                1e6 * (run->spent - pictures.waited) / steps, pictures.drawing, pictures.encoding,
                steps / (double)(counts.refreshes ? counts.refreshes : 1),
                steps / (double)(counts.rebuilds ? counts.rebuilds : 1));
    if (counts.crossed > 0) {
        oz_log_line("warning: %lld contacts of crossing shafts had no normal",
                    (long long)counts.crossed);
    }
}

/* The last state of a member, if the run ended well or was interrupted, and its outputs whole. */
static OzStatus end_member(Run *run, int64_t m, OzStatus so_far)
{
    OzStatus status = OZ_OK;
    OzOutputs *member = run->members[m];
    bool whole = member->series && (so_far == OZ_OK || so_far == OZ_ERR_INTERRUPTED);
    if (whole) {
        OZ_TRY(oz_drive_capture(run->drive, (int)m, &member->now, false));
        OZ_TRY(oz_outputs_write_final(member));
    }
done:
    run->outcomes[member->number] = so_far == OZ_OK && status == OZ_OK ? DONE
                                    : so_far == OZ_ERR_INTERRUPTED     ? INTERRUPTED
                                                                       : FAILED;
    AFTER(status, oz_outputs_close(member));
    return status;
}

static OzStatus end_group(Run *run, OzStatus status)
{
    for (int64_t m = 0; m < run->member_count; m++) {
        if (run->members[m]->is_open) {
            AFTER(status, end_member(run, m, status));
        }
        oz_outputs_free(run->members[m]);
    }
    if (run->drive && run->first_step > 0) {
        log_costs(run);
    }
    run->member_count = 0;
    run->first_step = 0;
    oz_drive_free(run->drive);
    run->drive = NULL;
    /* All its members were stopped: the next group may do better. */
    return status == OZ_ERR_BLOWUP && run->plan.is_ensemble ? OZ_OK : status;
}

static OzStatus run_group(Run *run)
{
    OzStatus status = OZ_OK;
    OZ_TRY(gather_group(run));
    OZ_TRY(open_group(run));
    OZ_TRY(settle(run));
    OZ_TRY(tell_contacts(run));
    OZ_TRY(walk(run));
done:
    return end_group(run, status);
}

/* Once a member has been opened there is something to tell. */
static OzStatus write_tables(const Run *run)
{
    OzStatus status = OZ_OK;
    OzEnsemble *ensemble = NULL;
    char *name = NULL;
    if (!run->plan.is_ensemble || !run->members) {
        return OZ_OK;
    }
    OZ_TRY(oz_ensemble_create(&ensemble, run->folder, run->plan.scene.sweep.key));
    for (int64_t i = 0; i < run->plan.count; i++) {
        free(name);
        OZ_TRY(oz_plan_name(&run->plan, i, &name));
        OzEnsembleRow row = {name, oz_plan_seed(&run->plan, i), oz_plan_value(&run->plan, i),
                             outcome_names[run->outcomes[i]], run->outcomes[i] != NOT_STARTED};
        OZ_TRY(oz_ensemble_add(ensemble, &row));
    }
done:
    free(name);
    AFTER(status, oz_ensemble_finish(ensemble));
    return status;
}

static OzStatus tell_losses(const Run *run)
{
    int64_t lost = 0;
    for (int64_t i = 0; i < run->plan.count; i++) {
        lost += run->outcomes[i] == STOPPED || run->outcomes[i] == FAILED;
    }
    return lost == 0 ? OZ_OK
                     : oz_status_fail(run->loss, "%lld of %lld members did not reach their end",
                                      (long long)lost, (long long)run->plan.count);
}

static void close_run(Run *run)
{
    oz_outputs_free(run->loaded);
    oz_studio_free(run->studio);
    oz_device_close(&run->device);
    oz_plan_free(&run->plan);
    free(run->members);
    free(run->outcomes);
    free(run->folder);
}

OzStatus oz_run_scene(const OzOptions *options)
{
    Run run = {.options = options, .started = oz_clock_now()};
    OzStatus status = OZ_OK;
    oz_interrupt_watch();
    OZ_TRY(open_run(&run));
    while (run.loaded) {
        OZ_TRY(run_group(&run));
    }
done:
    AFTER(status, write_tables(&run));
    if (status == OZ_OK) {
        status = tell_losses(&run);
    }
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    }
    close_run(&run);
    oz_log_open(NULL);
    return status;
}
