/* Scenes that take over from the running one, as in run/swap.c, without a run's files. */
#include "library/session_change.h"

#include "base/memory.h"
#include "model/motion.h"
#include "run/members.h"
#include "scene/changes.h"
#include "sim/push.h"
#include "sim/take_over.h"

#include <math.h>
#include <stdlib.h>

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
    next->is_pushed = next->is_pushed || session->scene.is_pushed;
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

/* Room for forces, in the kernels too. */
static OzStatus make_room(OzSession *session)
{
    OzStatus status = OZ_OK;
    OzScene next = {0};
    double *force = NULL, *torque = NULL;
    OZ_PASS(oz_push_check(&session->scene));
    if (session->force) {
        return OZ_OK;
    }
    OZ_TRY(OZ_NEW(&force, 3 * session->grains.count));
    OZ_TRY(OZ_NEW(&torque, 3 * session->grains.count));
    if (!session->scene.is_pushed) {
        OZ_TRY(oz_scene_copy(&next, &session->scene));
        next.is_pushed = true;
        OZ_TRY(take_over(session, &next));
    }
    session->force = force;
    session->torque = torque;
    force = torque = NULL;
done:
    oz_scene_free(&next);
    free(force);
    free(torque);
    return status;
}

static OzStatus check_push(const OzSession *session, const int64_t *grains, int64_t count,
                           const double *force, const double *torque)
{
    int64_t most = session->grains.count;
    for (int64_t k = 0; k < count; k++) {
        int64_t i = grains ? grains[k] : k;
        if (i < 0 || i >= most) {
            return oz_status_fail(OZ_ERR_INPUT, "%s: there is no grain %lld; expected 0 to %lld",
                                  session->path, (long long)i, (long long)most - 1);
        }
        for (int64_t c = 3 * k; c < 3 * k + 3; c++) {
            if ((force && !isfinite(force[c])) || (torque && !isfinite(torque[c]))) {
                return oz_status_fail(OZ_ERR_INPUT,
                                      "%s: the force or torque on grain %lld is not a number",
                                      session->path, (long long)i);
            }
        }
    }
    return OZ_OK;
}

OzStatus oz_session_change_push(OzSession *session, const int64_t *grains, int64_t count,
                                const double *force, const double *torque)
{
    OZ_PASS(check_push(session, grains, count, force, torque));
    OZ_PASS(make_room(session));
    for (int64_t k = 0; k < 3 * count; k++) {
        int64_t i = 3 * (grains ? grains[k / 3] : k / 3) + k % 3;
        session->force[i] = force ? force[k] : 0;
        session->torque[i] = torque ? torque[k] : 0;
    }
    return oz_push_grains(session->sim, 0, session->force, session->torque);
}

OzStatus oz_session_change_drive(OzSession *session, int wall, double speed)
{
    if (wall < 0 || wall >= session->scene.wall_count || !isfinite(speed) ||
        !session->scene.walls[wall].motion.present) {
        return oz_status_fail(
            OZ_ERR_INPUT,
            "%s: wall %d at %g m/s; expected a speed of a wall that the scene has "
            "and gives a motion (motion: {frequency: 1, amplitude: 0} is one)",
            session->path, wall, speed);
    }
    oz_push_wall(session->sim, 0, wall, speed);
    oz_motion_copy(&session->scene, oz_sim_scene(session->sim, 0));
    oz_session_forget(session);
    return OZ_OK;
}
