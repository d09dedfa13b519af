/* The straight line of a run: members of a plan in groups that fit together, each group spread over
 * workers that run side by side. A plain run is a group of one. */
#include "run/run.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/memory.h"
#include "plot/plot.h"
#include "run/costs.h"
#include "run/from_keep.h"
#include "run/groups.h"
#include "run/pace.h"
#include "run/replay.h"
#include "run/swap.h"
#include "run/watch.h"
#include "run/worker_state.h"
#include "scene/trace.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Everything one run owns. Zeroed is valid: what was not opened is not closed. */
typedef struct Run {
    const OzOptions *options;
    OzLog *log; /* of all its threads */
    OzGroups groups;
    OzDevice device;
    OzRenderQueue *render_queue; /* of all members */
    OzServe *serve;              /* NULL: it is not served */
    char *folder;
    OzFolder owned; /* the folder, in use                                */
    OzWorker *workers;
    OzCheckpoint *checkpoints; /* one a worker */
    int worker_count;
    OzReload *reload; /* what asks for changes           */
    OzWatch *watch;   /* of the scene's files            */
    atomic_bool ended;
    double started; /* wall clock */
} Run;

static OzStatus open_log(const Run *run)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    OZ_TRY(oz_file_join(&path, run->folder, "log.txt"));
    OZ_TRY(oz_folder_note(run->folder, "log.txt"));
    OZ_TRY((run->groups.resume ? oz_log_go_on : oz_log_open)(run->log, path));
done:
    free(path);
    return status;
}

/* Members' folders that are there already, before anything is touched. */
static OzStatus check_member_folders(const Run *run, const OzFolderUse *use)
{
    OzStatus status = OZ_OK;
    char *name = NULL, *folder = NULL;
    for (int64_t i = 0;
         run->groups.plan.is_ensemble && i < run->groups.plan.count && status == OZ_OK; i++) {
        OZ_TRY(oz_members_name(&run->groups.plan, i, &name));
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
    use.keep = run->groups.resume != NULL;
    OZ_PASS(oz_outputs_choose_folder(&run->folder, run->options, run->groups.plan.scene.name));
    if (run->groups.resume) {
        return oz_folder_open(&run->owned, run->folder, &use);
    }
    OZ_PASS(oz_inputs_check(&run->groups.plan.inputs, run->folder, &use));
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

static OzStatus begin_log(const Run *run)
{
    const OzCheckpointHead *head = run->groups.resume ? &run->groups.resume->heads[0] : NULL;
    OZ_PASS(open_log(run));
    if (head) {
        oz_log_line("orzo %s: %s goes on at step %lld (%.9g s)%s", ORZO_VERSION, run->folder,
                    (long long)head->step, head->time, head->settles ? " of settling" : "");
    } else {
        oz_log_line("orzo %s: %s, %lld grains", ORZO_VERSION, run->groups.plan.scene.path,
                    (long long)run->groups.loaded->grains.count);
        oz_trace_say(&run->groups.loaded->scene);
    }
    if (!head) {
        OZ_PASS(oz_from_keep_copy(&run->groups.plan.from, run->folder));
        OZ_PASS(oz_groups_keep_changes(&run->groups, run->folder));
    }
    return run->groups.plan.is_ensemble && !head
               ? oz_outputs_write_scene(&run->groups.plan.scene, run->folder)
               : OZ_OK;
}

/* Those who look on see pictures of the first member. */
static OzStatus open_live(Run *run)
{
    const OzOptions *options = run->options;
    OZ_PASS(oz_render_queue_create(&run->render_queue));
    OzLive *live = oz_render_queue_live(run->render_queue);
    atomic_store(&live->wants_latest, options->latest);
    return options->stream ? oz_movie_stream_create(&live->stream, options->stream) : OZ_OK;
}

/* What takes changes. A run that repeats another one takes that one's alone, and one that has
 * phases theirs. */
static OzStatus open_reload(Run *run)
{
    const OzScene *scene = &run->groups.plan.scene;
    if (oz_groups_has_changes(&run->groups)) {
        return OZ_OK;
    }
    return oz_reload_create(&run->reload, run->options, scene);
}

static OzStatus open_run(Run *run)
{
    const OzOptions *options = run->options;
    const OzScene *scene = &run->groups.plan.scene;
    OZ_PASS(check_interrupt());
    if (!run->groups.resume && !run->groups.loaded) {
        return oz_status_fail(run->groups.loss, "%s: no member can be run",
                              run->groups.plan.scene.path);
    }
    OZ_PASS(open_live(run));
    OZ_PASS(open_folder(run));
    OZ_PASS(begin_log(run));
    OZ_PASS(oz_device_open(&run->device, options->device, options->threads));
    oz_log_line("device: %s", run->device.name);
    if (run->groups.plan.is_ensemble && (options->stream || options->latest)) {
        oz_log_line("--stream and --latest show the first member");
    }
    run->groups.device = &run->device;
    OZ_PASS(open_reload(run));
    if (options->serve) {
        OZ_PASS(oz_serve_open(&run->serve, options, scene, run->reload, run->render_queue));
    }
    return options->watch && run->reload ? oz_watch_start(&run->watch, run->reload, scene) : OZ_OK;
}

static int choose_worker_count(const Run *run)
{
    int64_t most = oz_groups_most_workers(&run->groups);
    int64_t parts = oz_groups_is_begun(&run->groups)
                        ? run->groups.resume->count - run->groups.resume->next
                        : run->groups.member_count;
    return (int)(parts < most ? parts : most);
}

/* Where the states of worker k go. */
static OzStatus open_checkpoint(Run *run, int k)
{
    OzWorker *worker = &run->workers[k];
    OzCheckpoint *checkpoint = &run->checkpoints[k];
    const OzScene *scene = &worker->members[0]->scene;
    const OzCheckpoints *asked = &scene->checkpoint;
    if (asked->every <= 0 && asked->interval_taps <= 0 && asked->count == 0) {
        return OZ_OK;
    }
    checkpoint->folder = run->folder;
    checkpoint->is_ensemble = run->groups.plan.is_ensemble;
    checkpoint->every = asked->every;
    checkpoint->next = asked->every > 0 ? oz_clock_now() + asked->every : INFINITY;
    checkpoint->period = scene->period;
    checkpoint->head.first = worker->members[0]->number;
    checkpoint->head.count = worker->member_count;
    worker->checkpoint = checkpoint;
    return oz_checkpoint_head_fill(&checkpoint->head, run->options, scene,
                                   run->groups.plan.is_ensemble, run->device.name);
}

static OzStatus open_workers(Run *run)
{
    int count = choose_worker_count(run);
    int64_t first = 0;
    OZ_PASS(OZ_NEW(&run->workers, count));
    OZ_PASS(OZ_NEW(&run->checkpoints, count));
    for (int k = 0; k < count; k++) {
        OzWorker *worker = &run->workers[run->worker_count++];
        int64_t next = oz_groups_is_begun(&run->groups)
                           ? first + run->groups.resume->heads[run->groups.resume->next + k].count
                           : run->groups.member_count * (k + 1) / count;
        *worker = (OzWorker){.members = &run->groups.members[first],
                             .member_count = next - first,
                             .schedule = run->groups.schedule,
                             .is_ensemble = run->groups.plan.is_ensemble,
                             .leads = k == 0,
                             .serve = k == 0 ? run->serve : NULL,
                             .started = run->started,
                             .reload = run->reload,
                             .replay = oz_groups_replay(&run->groups, k),
                             .taken = oz_groups_taken(&run->groups, k),
                             .first = first,
                             .pace = oz_pace_of(run->options, &run->groups.members[0]->scene),
                             .ended = &run->ended};
        OZ_PASS(oz_worker_open(worker, &run->device, run->options->source_dir));
        OZ_PASS(open_checkpoint(run, k));
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
    for (int64_t m = 0; m < run->groups.member_count; m++) {
        OzOutputs *member = run->groups.members[m];
        OZ_PASS(check_interrupt());
        OZ_PASS(choose_member_folder(run, member));
        member->serve = member->number == 0 ? run->serve : NULL;
        OZ_PASS(oz_outputs_open(member, run->options, run->device.name, run->render_queue));
    }
    if (oz_schedule_missed(&run->groups.schedule, missed, sizeof missed)) {
        oz_log_line("warning: %s", missed);
    }
    if (run->groups.plan.is_ensemble) {
        oz_log_line("%s to %s: %lld side by side, %d launches at a time",
                    run->groups.members[0]->name,
                    run->groups.members[run->groups.member_count - 1]->name,
                    (long long)run->groups.member_count, run->worker_count);
    }
    return OZ_OK;
}

/* Notes what became of the group's members, and frees it. */
static OzStatus end_group(Run *run, OzStatus status, bool ran)
{
    if (ran) {
        oz_costs_log(run->workers, run->worker_count, run->groups.member_count, run->render_queue);
    }
    for (int64_t m = 0; m < run->groups.member_count; m++) {
        OzOutputs *member = run->groups.members[m];
        member->outcome = member->is_open ? OZ_OUTCOME_FAILED : member->outcome;
        OZ_AFTER(status, oz_outputs_close(member));
        run->groups.outcomes[member->number] = member->outcome;
        run->groups.loss = run->groups.loss == OZ_OK ? member->loss : run->groups.loss;
        oz_outputs_free(member);
    }
    for (int k = 0; k < run->worker_count; k++) {
        oz_worker_close(&run->workers[k]);
        oz_checkpoint_free(&run->checkpoints[k]);
    }
    if (run->groups.resume) {
        run->groups.resume->next += run->worker_count;
    }
    free(run->workers);
    free(run->checkpoints);
    run->workers = NULL;
    run->checkpoints = NULL;
    run->worker_count = 0;
    run->groups.member_count = 0;
    return status;
}

/* Each worker takes its state up. */
static OzStatus take_states(Run *run)
{
    for (int k = 0; k < run->worker_count; k++) {
        OzResume *resume = run->groups.resume;
        OZ_PASS(oz_worker_state_take(&run->workers[k], &resume->states[resume->next + k],
                                     resume->heads[resume->next + k].device));
    }
    return OZ_OK;
}

/* Members can be changed while they run. */
static OzStatus run_workers(Run *run)
{
    OzStatus status = OZ_OK;
    if (run->reload) {
        OZ_TRY(oz_reload_enter(run->reload, &run->device, run->groups.members,
                               run->groups.member_count, run->worker_count));
        OZ_TRY(oz_resume_change(run->groups.resume, run->reload));
    }
    status = oz_worker_run(run->workers, run->worker_count);
done:
    for (int k = 0; k < run->worker_count; k++) {
        oz_swap_end(&run->workers[k]);
    }
    if (run->reload) {
        oz_reload_leave(run->reload);
    }
    return status;
}

static OzStatus run_group(Run *run)
{
    OzStatus status = OZ_OK;
    bool ran = false;
    OZ_TRY(oz_groups_gather(&run->groups));
    OZ_TRY(open_group(run));
    OZ_TRY(oz_groups_is_begun(&run->groups)
               ? take_states(run)
               : oz_from_begin(&run->groups.plan.from, run->workers, run->worker_count));
    ran = true;
    OZ_TRY(run_workers(run));
done:
    return end_group(run, status, ran);
}

static void close_run(Run *run)
{
    oz_reload_free(run->reload);
    oz_render_queue_free(run->render_queue);
    oz_device_close(&run->device);
    oz_groups_free(&run->groups);
    oz_folder_close(&run->owned);
    free(run->folder);
}

/* What was observed, as curves. They can be drawn again, so that they are not what a run fails by.
 */
static void plot_series(const Run *run)
{
    char why[4096];
    snprintf(why, sizeof why, "%s", oz_status_text());
    if (run->owned.path && !run->options->no_video && oz_plot_series(run->owned.path) != OZ_OK) {
        oz_log_line("warning: no series.png: %s", oz_status_text());
    }
    oz_status_fail(OZ_OK, "%s", why);
}

static OzStatus run_all(const OzOptions *options, OzResume *resume)
{
    Run run = {.options = options, .started = oz_clock_now()};
    OzStatus status = OZ_OK;
    bool more = false;
    OzLog *before = oz_log_used();
    OZ_TRY(oz_log_create(&run.log, oz_log_stream(), true));
    oz_log_use(run.log);
    OZ_TRY(oz_groups_open(&run.groups, options, resume));
    OZ_TRY(open_run(&run));
    OZ_TRY(oz_groups_find(&run.groups, &more));
    while (more) {
        OZ_TRY(run_group(&run));
        OZ_TRY(oz_groups_find(&run.groups, &more));
    }
done:
    OZ_AFTER(status, oz_groups_write_tables(&run.groups, run.owned.path));
    if (status == OZ_OK || status == OZ_ERR_INTERRUPTED) {
        plot_series(&run);
    }
    if (status == OZ_OK) {
        status = oz_groups_tell_losses(&run.groups);
    }
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    }
    if (status != OZ_OK && status != OZ_ERR_INPUT && run.owned.path) {
        oz_resume_say(run.owned.path, status);
    }
    oz_watch_end(run.watch); /* which tells the page */
    oz_serve_close(run.serve, status);
    close_run(&run);
    oz_log_use(before);
    oz_log_free(run.log);
    return status;
}

/* A run's folder stands for its scene as it began. */
static OzStatus repeat_run(const OzOptions *asked)
{
    OzStatus status = OZ_OK;
    OzOptions options = *asked;
    char *scene = NULL, *from = NULL, *out = NULL;
    OZ_TRY(oz_resume_take_seeds(&options, asked->paths[0]));
    OZ_TRY(oz_from_keep_find(&from, asked->paths[0]));
    OZ_TRY(oz_file_join(&scene, asked->paths[0], "scene.yaml"));
    OZ_TRY(oz_replay_choose_folder(&out, asked->out, asked->paths[0]));
    options.replay_folder = asked->paths[0];
    options.out = out;
    options.from = from;
    options.paths[0] = scene;
done:
    if (status == OZ_OK) {
        status = run_all(&options, NULL);
    } else {
        oz_log_line("%s", oz_status_text());
    }
    free(from);
    free(scene);
    free(out);
    return status;
}

OzStatus oz_run_scene(const OzOptions *options)
{
    return options->replay ? repeat_run(options) : run_all(options, NULL);
}

OzStatus oz_run_resume(const OzOptions *options)
{
    OzResume resume = {0};
    OzStatus status = oz_resume_open(&resume, options);
    if (status == OZ_OK) {
        status = run_all(&resume.options, &resume);
    } else {
        oz_log_line("%s", oz_status_text());
    }
    oz_resume_free(&resume);
    return status;
}
