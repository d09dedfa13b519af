/* The straight line of a run: members of a plan in groups that fit together, each group spread over
 * workers that run side by side. A plain run is a group of one. */
#include "run/run.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/memory.h"
#include "run/capacity.h"
#include "run/ensemble_tables.h"
#include "run/members.h"
#include "run/outputs.h"
#include "run/worker.h"
#include "sim/batch_fit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const outcome_names[] = {[OZ_OUTCOME_NOT_STARTED] = "not started",
                                            [OZ_OUTCOME_DONE] = "done",
                                            [OZ_OUTCOME_STOPPED] = "stopped",
                                            [OZ_OUTCOME_INTERRUPTED] = "interrupted",
                                            [OZ_OUTCOME_FAILED] = "failed"};

/* Everything one run owns. Zeroed is valid: what was not opened is not closed. */
typedef struct Run {
    const OzOptions *options;
    OzLog *log; /* of all its threads */
    OzMembers plan;
    OzDevice device;
    OzRenderQueue *render_queue; /* of all members */
    char *folder;
    OzFolder owned;             /* the folder, in use                                */
    OzOutputs **members;        /* of the group in hand */
    int64_t member_count, most; /* most: that there is room for at a time            */
    OzOutputs *loaded;          /* the next group's first, NULL at the end           */
    int64_t loaded_count;       /* members of the plan that were loaded or could not be */
    OzOutcome *outcomes;        /* of each member of the plan                        */
    OzSchedule schedule;        /* of the group                                      */
    OzWorker *workers;
    int worker_count;
    atomic_bool ended;
    double started; /* wall clock */
    OzStatus loss;  /* why the first member that did not end well did not */
} Run;

static OzStatus open_log(const Run *run)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    OZ_TRY(oz_file_join(&path, run->folder, "log.txt"));
    OZ_TRY(oz_folder_note(run->folder, "log.txt"));
    OZ_TRY(oz_log_open(run->log, path));
done:
    free(path);
    return status;
}

/* A member of an ensemble that cannot be run: said by name, remembered, and the others go on. */
static void lose(Run *run, int64_t number, OzStatus why, const char *text)
{
    char *name = NULL;
    run->outcomes[number] = OZ_OUTCOME_FAILED;
    run->loss = run->loss == OZ_OK ? why : run->loss;
    if (oz_members_name(&run->plan, number, &name) == OZ_OK) {
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
        OzStatus own = oz_members_load(&run->plan, member->number, &member->scene, &member->grains);
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
    OzMember first = {&run->loaded->scene, &run->loaded->grains};
    double bytes = 0;
    OZ_PASS(oz_capacity_most(run->options, &run->device, &first, &run->most, &bytes));
    if (run->plan.is_ensemble) {
        oz_log_line("%lld members of about %.3g MB; up to %lld at a time",
                    (long long)run->plan.count, bytes / 1e6, (long long)run->most);
    }
    run->most = run->most < run->plan.count ? run->most : run->plan.count;
    return OZ_NEW(&run->members, run->most);
}

/* Members' folders that are there already, before anything is touched. */
static OzStatus check_member_folders(const Run *run, const OzFolderUse *use)
{
    OzStatus status = OZ_OK;
    char *name = NULL, *folder = NULL;
    for (int64_t i = 0; run->plan.is_ensemble && i < run->plan.count && status == OZ_OK; i++) {
        OZ_TRY(oz_members_name(&run->plan, i, &name));
        OZ_TRY(oz_file_join(&folder, run->folder, name));
        status = oz_file_exists(folder) ? oz_folder_check(folder, use) : OZ_OK;
        free(folder);
        free(name);
        folder = name = NULL;
    }
done:
    free(folder);
    free(name);
    return status;
}

/* Chooses the folder and takes it. */
static OzStatus open_folder(Run *run)
{
    OzFolderUse use = oz_outputs_use(run->options->overwrite);
    OZ_PASS(oz_outputs_choose_folder(&run->folder, run->options, run->plan.scene.name));
    OZ_PASS(oz_inputs_check(&run->plan.inputs, run->folder, &use));
    OZ_PASS(oz_folder_check(run->folder, &use));
    OZ_PASS(check_member_folders(run, &use));
    return oz_folder_open(&run->owned, run->folder, &use);
}

static OzStatus check_interrupt(void)
{
    return oz_interrupt_asked()
               ? oz_status_fail(OZ_ERR_INTERRUPTED, "interrupted before the first step")
               : OZ_OK;
}

static OzStatus open_run(Run *run)
{
    const OzOptions *options = run->options;
    OZ_PASS(oz_members_create(&run->plan, options));
    OZ_PASS(OZ_NEW(&run->outcomes, run->plan.count));
    OZ_PASS(load_next(run, &run->loaded));
    OZ_PASS(check_interrupt());
    if (!run->loaded) {
        return oz_status_fail(run->loss, "%s: no member can be run", run->plan.scene.path);
    }
    OZ_PASS(open_folder(run));
    OZ_PASS(open_log(run));
    oz_log_line("orzo %s: %s, %lld grains", ORZO_VERSION, run->plan.scene.path,
                (long long)run->loaded->grains.count);
    OZ_PASS(oz_render_queue_create(&run->render_queue));
    OZ_PASS(oz_device_open(&run->device, options->device, options->threads));
    oz_log_line("device: %s", run->device.name);
    return choose_most(run);
}

/* Whether a loaded member can go side by side with the group's first. */
static bool joins(const Run *run, const OzOutputs *member)
{
    const OzOutputs *first = run->members[0];
    OzMember a = {&first->scene, &first->grains}, b = {&member->scene, &member->grains};
    OzSchedule events = oz_schedule_create(&member->scene, run->options->until);
    return oz_schedule_agrees(&run->schedule, &events) && oz_batch_fit_agrees(&run->device, &a, &b);
}

/* The loaded member and those after it that can join it; the one that cannot begins the next group.
 */
static OzStatus gather_group(Run *run)
{
    run->members[0] = run->loaded;
    run->member_count = 1;
    run->loaded = NULL;
    run->schedule = oz_schedule_create(&run->members[0]->scene, run->options->until);
    OZ_PASS(load_next(run, &run->loaded));
    while (run->loaded && run->member_count < run->most && joins(run, run->loaded)) {
        run->members[run->member_count++] = run->loaded;
        run->loaded = NULL;
        OZ_PASS(load_next(run, &run->loaded));
    }
    return OZ_OK;
}

/* One a thread of a CPU; a GPU takes all members at once. */
static int choose_worker_count(const Run *run)
{
    int64_t most = run->device.is_cpu ? run->device.units : 1;
    return (int)(run->member_count < most ? run->member_count : most);
}

static OzStatus open_workers(Run *run)
{
    int count = choose_worker_count(run);
    int64_t first = 0;
    OZ_PASS(OZ_NEW(&run->workers, count));
    for (int k = 0; k < count; k++) {
        OzWorker *worker = &run->workers[run->worker_count++];
        int64_t next = run->member_count * (k + 1) / count;
        *worker = (OzWorker){.members = &run->members[first],
                             .member_count = next - first,
                             .schedule = run->schedule,
                             .is_ensemble = run->plan.is_ensemble,
                             .leads = k == 0,
                             .started = run->started,
                             .ended = &run->ended};
        OZ_PASS(oz_worker_open(worker, &run->device, run->options->source_dir));
        first = next;
    }
    return OZ_OK;
}

/* A member's folder lies in the run's, which says so; a plain run's is the run's own. */
static OzStatus choose_member_folder(const Run *run, OzOutputs *member)
{
    OzStatus status = OZ_OK;
    char *name = NULL;
    if (!member->name[0]) {
        return oz_file_join(&member->folder, NULL, run->folder);
    }
    if (asprintf(&name, "%s/", member->name) < 0) {
        name = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a folder's name");
    }
    OZ_TRY(oz_folder_note(run->folder, name));
    OZ_TRY(oz_file_join(&member->folder, run->folder, member->name));
done:
    free(name);
    return status;
}

static OzStatus open_group(Run *run)
{
    char missed[512];
    OZ_PASS(open_workers(run));
    for (int64_t m = 0; m < run->member_count; m++) {
        OzOutputs *member = run->members[m];
        OZ_PASS(check_interrupt());
        OZ_PASS(oz_members_name(&run->plan, member->number, &member->name));
        OZ_PASS(choose_member_folder(run, member));
        OZ_PASS(oz_outputs_open(member, run->options, run->device.name, run->render_queue));
    }
    if (oz_schedule_missed(&run->schedule, missed, sizeof missed)) {
        oz_log_line("warning: %s", missed);
    }
    if (run->plan.is_ensemble) {
        oz_log_line("%s to %s: %lld side by side, %d launches at a time", run->members[0]->name,
                    run->members[run->member_count - 1]->name, (long long)run->member_count,
                    run->worker_count);
    }
    return OZ_OK;
}

/* Of all workers together: counts of a mean member, the longest time. */
static OzSimCounts add_counts(const Run *run, double *spent)
{
    OzSimCounts sum = {0};
    *spent = 0;
    for (int k = 0; k < run->worker_count; k++) {
        const OzWorker *worker = &run->workers[k];
        OzSimCounts counts = oz_sim_counts(worker->sim);
        sum.steps = counts.steps > sum.steps ? counts.steps : sum.steps;
        sum.refreshes += counts.refreshes * worker->member_count;
        sum.rebuilds += counts.rebuilds * worker->member_count;
        sum.crossed += counts.crossed;
        *spent = worker->spent > *spent ? worker->spent : *spent;
    }
    sum.refreshes /= run->member_count;
    sum.rebuilds /= run->member_count;
    return sum;
}

/* Where the time went; of pictures only when there were any. */
static void log_costs(const Run *run)
{
    double spent = 0;
    char waiting[96] = "", beside[160] = "";
    OzSimCounts counts = add_counts(run, &spent);
    OzRenderQueueTimes pictures = oz_render_queue_take_times(run->render_queue);
    double steps = counts.steps > 0 ? (double)counts.steps : 1;
    double waited = pictures.waited / run->worker_count;
    if (spent <= 0) {
        return; /* ended before its first step */
    }
    if (pictures.waited > 0) {
        snprintf(waiting, sizeof waiting, ", of which %.2f s waiting for pictures", waited);
        snprintf(beside, sizeof beside,
                 ", that waiting left out; beside it drawing %.2f s and encoding %.2f s",
                 pictures.drawing, pictures.encoding);
    }
    oz_log_line("%lld steps in %.2f s%s; %.1f us a step%s; list refreshed every %.1f, rebuilt "
                "every %.0f steps",
                (long long)counts.steps, spent, waiting, 1e6 * (spent - waited) / steps, beside,
                steps / (double)(counts.refreshes ? counts.refreshes : 1),
                steps / (double)(counts.rebuilds ? counts.rebuilds : 1));
    if (counts.crossed > 0) {
        oz_log_line("warning: %lld contacts of crossing shafts had no normal",
                    (long long)counts.crossed);
    }
}

/* Notes what became of the group's members, and frees it. */
static OzStatus end_group(Run *run, OzStatus status, bool ran)
{
    if (ran) {
        log_costs(run);
    }
    for (int64_t m = 0; m < run->member_count; m++) {
        OzOutputs *member = run->members[m];
        member->outcome = member->is_open ? OZ_OUTCOME_FAILED : member->outcome;
        OZ_AFTER(status, oz_outputs_close(member));
        run->outcomes[member->number] = member->outcome;
        run->loss = run->loss == OZ_OK ? member->loss : run->loss;
        oz_outputs_free(member);
    }
    for (int k = 0; k < run->worker_count; k++) {
        oz_worker_close(&run->workers[k]);
    }
    free(run->workers);
    run->workers = NULL;
    run->worker_count = 0;
    run->member_count = 0;
    return status;
}

static OzStatus run_group(Run *run)
{
    OzStatus status = OZ_OK;
    bool ran = false;
    OZ_TRY(gather_group(run));
    OZ_TRY(open_group(run));
    ran = true;
    OZ_TRY(oz_worker_run(run->workers, run->worker_count));
done:
    return end_group(run, status, ran);
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
    OZ_TRY(oz_ensemble_tables_create(&ensemble, run->folder, run->plan.scene.sweep.key));
    for (int64_t i = 0; i < run->plan.count; i++) {
        free(name);
        OZ_TRY(oz_members_name(&run->plan, i, &name));
        OzEnsembleRow row = {name, oz_members_seed(&run->plan, i), oz_members_value(&run->plan, i),
                             outcome_names[run->outcomes[i]],
                             run->outcomes[i] != OZ_OUTCOME_NOT_STARTED};
        OZ_TRY(oz_ensemble_tables_add(ensemble, &row));
    }
done:
    free(name);
    OZ_AFTER(status, oz_ensemble_tables_finish(ensemble));
    return status;
}

static OzStatus tell_losses(const Run *run)
{
    int64_t lost = 0;
    for (int64_t i = 0; i < run->plan.count; i++) {
        lost += run->outcomes[i] == OZ_OUTCOME_STOPPED || run->outcomes[i] == OZ_OUTCOME_FAILED;
    }
    return lost == 0 ? OZ_OK
                     : oz_status_fail(run->loss, "%lld of %lld members did not reach their end",
                                      (long long)lost, (long long)run->plan.count);
}

static void close_run(Run *run)
{
    oz_outputs_free(run->loaded);
    oz_render_queue_free(run->render_queue);
    oz_device_close(&run->device);
    oz_members_free(&run->plan);
    free(run->members);
    free(run->outcomes);
    oz_folder_close(&run->owned);
    free(run->folder);
}

OzStatus oz_run_scene(const OzOptions *options)
{
    Run run = {.options = options, .started = oz_clock_now()};
    OzStatus status = OZ_OK;
    OzLog *before = oz_log_used();
    OZ_TRY(oz_log_create(&run.log, oz_log_stream(), true));
    oz_log_use(run.log);
    OZ_TRY(open_run(&run));
    while (run.loaded) {
        OZ_TRY(run_group(&run));
    }
done:
    OZ_AFTER(status, write_tables(&run));
    if (status == OZ_OK) {
        status = tell_losses(&run);
    }
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    }
    close_run(&run);
    oz_log_use(before);
    oz_log_free(run.log);
    return status;
}
