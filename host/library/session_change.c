/* Scenes that take over from the running one, as in run/swap.c, without a run's files. */
#include "library/session_change.h"

#include "model/motion.h"
#include "run/members.h"
#include "scene/changes.h"
#include "sim/take_over.h"

/* The simulation that runs the next scene, in place of the one that ran. */
static OzStatus rebuild(OzSession *session, const OzScene *next)
{
    OzSim *sim = NULL;
    OZ_PASS(oz_take_over_build(&sim, session->sim, session->device, &next, NULL));
    OzStatus status = oz_take_over_swap(sim, session->sim, &next);
    oz_sim_free(status == OZ_OK ? session->sim : sim);
    session->sim = status == OZ_OK ? sim : session->sim;
    return status;
}

/* Between steps: next becomes the session's own, and is empty then. */
static OzStatus take_over(OzSession *session, OzScene *next)
{
    OzTakeOver how = OZ_TAKE_OVER_APPLY;
    OZ_PASS(oz_members_judge_step(next, &session->grains, false));
    OZ_PASS(oz_take_over_compare(&how, session->device, &session->grains, &session->scene, next));
    oz_motion_take_over(next, &session->scene, oz_sim_time(session->sim));
    const OzScene *taken = next;
    OZ_PASS(how == OZ_TAKE_OVER_REBUILD ? rebuild(session, next)
                                        : oz_take_over_apply(session->sim, &taken));
    if (session->is_due) {
        session->schedule = session->before;
        session->is_due = false;
    }
    oz_scene_free(&session->scene);
    session->scene = *next;
    *next = (OzScene){0};
    OZ_PASS(oz_series_take(session->series));
    oz_schedule_take_over(&session->schedule, &session->scene, oz_sim_step(session->sim));
    session->is_framed = false;
    oz_session_forget(session);
    return OZ_OK;
}

OzStatus oz_session_change_set(OzSession *session, char *setting)
{
    OzStatus status = OZ_OK;
    OzScene next = {0};
    OzChanges changes = {0};
    OZ_TRY(oz_scene_change(&next, &session->scene, &setting, 1));
    OZ_TRY(oz_changes_find(&changes, &session->scene, &next));
    if (changes.count > 0) {
        OZ_TRY(take_over(session, &next));
    }
done:
    oz_changes_free(&changes);
    oz_scene_free(&next);
    return status;
}
