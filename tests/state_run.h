/* A run of a scene in a test, as the program makes it, that can be left between two launches and
 * taken up again from a state. */
#ifndef OZ_TESTS_STATE_RUN_H
#define OZ_TESTS_STATE_RUN_H

#include "device_rig.h"

#include "base/file.h"
#include "base/memory.h"
#include "run/worker.h"
#include "run/worker_state.h"
#include "sim/sim_state.h"

enum { MEMBERS_MOST = 2 };

typedef struct Run {
    OzOutputs *members[MEMBERS_MOST];
    OzWorker worker;
    OzOptions options;
    OzRenderQueue *render_queue;
    char folders[MEMBERS_MOST][300];
} Run;

static inline void open_member(Run *run, int m, const char *text, const char *folder, bool goes_on)
{
    char seed[32], *settings[] = {seed};
    snprintf(seed, sizeof seed, "seed=%d", m + 1);
    snprintf(run->folders[m], sizeof run->folders[m], "%s_%d", folder, m + 1);
    must(oz_memory_new((void **)&run->members[m], 1, sizeof(OzOutputs), "outputs"));
    OzOutputs *member = run->members[m];
    must(oz_scene_parse(&member->scene, "state.yaml", text, settings, 1));
    must(oz_insert_grains(&member->grains, &member->scene));
    must(oz_file_make_folder(run->folders[m]));
    must(oz_memory_text(&member->folder, run->folders[m]));
    member->goes_on = goes_on;
}

/* goes_on: with the files that are in the folders already. */
static inline void open_run(Run *run, const char *text, int members, const OzDevice *device,
                            const char *folder, bool goes_on)
{
    *run = (Run){.options = {.no_video = true}};
    must(oz_render_queue_create(&run->render_queue));
    for (int m = 0; m < members; m++) {
        open_member(run, m, text, folder, goes_on);
    }
    run->worker = (OzWorker){.members = run->members,
                             .member_count = members,
                             .schedule = oz_schedule_create(&run->members[0]->scene, -1)};
    must(oz_worker_open(&run->worker, device, NULL));
    for (int m = 0; m < members; m++) {
        must(oz_outputs_open(run->members[m], &run->options, "none", run->render_queue));
    }
}

/* Frees all of it, files left as they are. */
static inline void close_run(Run *run)
{
    oz_worker_close(&run->worker);
    for (int m = 0; m < MEMBERS_MOST; m++) {
        oz_outputs_free(run->members[m]);
    }
    oz_render_queue_free(run->render_queue);
}

/* What is due at the event's step, as the program looks at it. */
static inline void look_at_event(Run *run)
{
    OzWorker *worker = &run->worker;
    for (int m = 0; m < worker->member_count; m++) {
        bool row = (worker->event_due & OZ_DUE_LISTED) != 0;
        must(oz_read_snapshot_snapshot(worker->sim, m, &run->members[m]->now, row));
        must(oz_outputs_look(run->members[m], worker->event_due));
    }
    worker->is_due = false;
}

/* To a step, or to the end: events on the way are looked at, the one at that step is not. */
static inline void walk_run(Run *run, int64_t until)
{
    OzWorker *worker = &run->worker;
    while (oz_worker_next_event(worker)) {
        while (oz_sim_step(worker->sim) < worker->event_step) {
            int64_t next = until < worker->event_step ? until : worker->event_step;
            if (oz_sim_step(worker->sim) >= until) {
                return;
            }
            must(oz_sim_launch(worker->sim, next));
        }
        if (worker->event_step >= until) {
            return;
        }
        look_at_event(run);
    }
}

/* The rest of the run, and the last state of every member as its final.csv. */
static inline void end_run(Run *run)
{
    walk_run(run, INT64_MAX);
    for (int m = 0; m < run->worker.member_count; m++) {
        must(oz_read_snapshot_snapshot(run->worker.sim, m, &run->members[m]->now, false));
        must(oz_outputs_write_final(run->members[m]));
    }
}

static inline void save_run(Run *run, OzState *state)
{
    OzStateVisit visit = oz_state_save(state);
    must(oz_worker_state_visit(&run->worker, &visit));
}

static inline void load_run(Run *run, OzState *state)
{
    OzStateVisit visit = oz_state_load(state);
    must(oz_worker_state_visit(&run->worker, &visit));
    must(oz_state_finish(&visit));
}

static inline bool same_in_folders(const char *a, const char *b, int member, const char *name)
{
    char path[400], *one = NULL, *other = NULL;
    size_t length = 0, other_length = 0;
    snprintf(path, sizeof path, "%s_%d/%s", a, member + 1, name);
    must(oz_file_read(&one, &length, path));
    snprintf(path, sizeof path, "%s_%d/%s", b, member + 1, name);
    must(oz_file_read(&other, &other_length, path));
    bool same = length == other_length && length > 0 && memcmp(one, other, length) == 0;
    free(one);
    free(other);
    return same;
}

#endif
