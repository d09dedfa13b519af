/* Visiting what a worker holds, and putting it into files and back. */
#include "run/worker_state.h"

#include "base/log.h"
#include "model/motion.h"
#include "sim/settle.h"
#include "sim/sim_state.h"

#include <string.h>

/* Walls that had changed are in phase again, and what lies at taps where these are. */
static void take_phases(OzWorker *worker)
{
    for (int64_t m = 0; m < worker->member_count; m++) {
        oz_motion_copy(&worker->members[m]->scene, oz_sim_scene(worker->sim, (int)m));
    }
    oz_schedule_find_end(&worker->schedule);
}

OzStatus oz_worker_state_visit(OzWorker *worker, OzStateVisit *visit)
{
    OZ_PASS(oz_state_enter(visit, "worker", 2));
    OZ_PASS(oz_schedule_state(worker->is_due ? &worker->before : &worker->schedule, visit));
    OZ_PASS(oz_sim_state_visit(worker->sim, visit));
    if (visit->is_loading) {
        take_phases(worker);
    }
    for (int64_t m = 0; m < worker->member_count; m++) {
        oz_state_enter_one(visit, "member", m);
        OZ_PASS(oz_outputs_state(worker->members[m], visit));
        oz_state_leave(visit);
    }
    oz_state_leave(visit);
    return OZ_OK;
}

static OzStatus check_taken(const OzWorker *worker, const char *device)
{
    int64_t step = oz_sim_step(worker->sim), last = worker->schedule.last_step;
    bool settles = !oz_settle_is_over(worker->sim); /* whose steps come before the run's */
    if (strcmp(device, worker->device->name) != 0) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "the state was made by %s and this is %s; expected the same device",
                              device, worker->device->name);
    }
    if (step == last && !settles) {
        oz_log_line("the run is at its end, %.9g s: no step is left to make",
                    oz_sim_time(worker->sim));
    }
    if (step > last && !settles) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "the run is at %.9g s already (step %lld), beyond the end asked for, "
                              "%.9g s; expected a later one (--until, --set time.duration)",
                              oz_sim_time(worker->sim), (long long)step,
                              oz_step_clock_time(&worker->schedule.clock, last));
    }
    return OZ_OK;
}

OzStatus oz_worker_state_take(OzWorker *worker, OzState *state, const char *device)
{
    OzStatus status = OZ_OK;
    OzCheckpointHead head = {0};
    OzStateVisit visit = oz_state_load(state);
    OZ_TRY(oz_checkpoint_head_state(&head, &visit));
    OZ_TRY(oz_worker_state_visit(worker, &visit));
    OZ_TRY(oz_state_finish(&visit));
    OZ_TRY(check_taken(worker, device));
done:
    oz_checkpoint_head_free(&head);
    oz_state_free(state);
    return status;
}

/* A state that cannot be had leaves a simulation that is not to be trusted. */
OzStatus oz_worker_state_save(OzWorker *worker, bool kept)
{
    OzState state = {0};
    OzStateVisit visit = oz_state_save(&state);
    OzCheckpointHead *head = &worker->checkpoint->head;
    head->step = oz_sim_step(worker->sim);
    head->time = oz_sim_time(worker->sim);
    head->settles = !oz_settle_is_over(worker->sim);
    head->taken = worker->replay ? worker->taken : 0;
    OzStatus status = oz_checkpoint_head_state(head, &visit);
    status = status == OZ_OK ? oz_worker_state_visit(worker, &visit) : status;
    if (status == OZ_OK) {
        status = oz_checkpoint_write(worker->checkpoint, &state, kept);
        if (status != OZ_OK && !kept) {
            oz_log_line("warning: the state is not kept: %s", oz_status_text());
            status = OZ_OK;
        }
    }
    oz_state_free(&state);
    return status;
}

OzStatus oz_worker_state_save_if_due(OzWorker *worker)
{
    bool due = worker->checkpoint && oz_checkpoint_is_due(worker->checkpoint);
    return due ? oz_worker_state_save(worker, false) : OZ_OK;
}

OzStatus oz_worker_state_save_if_wanted(OzWorker *worker)
{
    bool wanted = worker->checkpoint && worker->checkpoint->every > 0;
    return wanted ? oz_worker_state_save(worker, false) : OZ_OK;
}
