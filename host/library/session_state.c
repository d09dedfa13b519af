/* What a session keeps, visited for saving and loading. */
#include "library/session_state.h"

#include "base/memory.h"
#include "model/motion.h"
#include "run/members.h"
#include "run/state_file.h"
#include "sim/sim_state.h"

#include <stdlib.h>
#include <string.h>

static OzStatus visit_head(OzStateVisit *visit, char **scene, char **device, bool *is_pushed)
{
    OZ_PASS(oz_state_enter(visit, "library", 1));
    OZ_PASS(oz_state_text(visit, "scene", scene));
    OZ_PASS(oz_state_text(visit, "device", device));
    OZ_PASS(oz_state_bool(visit, "is_pushed", is_pushed));
    oz_state_leave(visit);
    return OZ_OK;
}

/* Forces from outside: the kernels have theirs, in their own units. */
static OzStatus visit_forces(OzSession *session, OzStateVisit *visit)
{
    int64_t count = session->force ? 3 * session->grains.count : 0;
    OZ_PASS(oz_state_array(visit, "force", "N", OZ_STATE_DOUBLE, &session->force, &count));
    OZ_PASS(oz_state_array(visit, "torque", "N m", OZ_STATE_DOUBLE, &session->torque, &count));
    if (count == 0) {
        free(session->force);
        free(session->torque);
        session->force = session->torque = NULL;
    }
    return OZ_OK;
}

static OzStatus visit_rest(OzSession *session, OzStateVisit *visit)
{
    OZ_PASS(oz_schedule_state(session->is_due ? &session->before : &session->schedule, visit));
    OZ_PASS(oz_sim_state_visit(session->sim, visit));
    OZ_PASS(oz_series_state(session->series, visit));
    OZ_PASS(visit_forces(session, visit));
    OZ_PASS(oz_state_index(visit, "row_step", &session->row_step, -1, INT64_MAX));
    OZ_PASS(oz_state_array(visit, "row", "as the columns", OZ_STATE_DOUBLE, &session->row,
                           &session->row_count));
    if (visit->is_loading) {
        oz_motion_copy(&session->scene, oz_sim_scene(session->sim, 0));
        oz_schedule_find_end(&session->schedule);
    }
    return OZ_OK;
}

OzStatus oz_session_state_write(OzSession *session, const char *path)
{
    OzStatus status = OZ_OK;
    OzState state = {0};
    OzStateVisit visit = oz_state_save(&state);
    char *text = NULL, *device = NULL;
    size_t length = 0;
    OZ_TRY(oz_scene_text(&session->scene, &text, &length));
    OZ_TRY(oz_memory_text(&device, session->device->name));
    OZ_TRY(visit_head(&visit, &text, &device, &session->scene.is_pushed));
    OZ_TRY(visit_rest(session, &visit));
    OZ_TRY(oz_state_file_write(&state, path));
done:
    oz_state_free(&state);
    free(text);
    free(device);
    return status;
}

OzStatus oz_session_state_read(OzState **state, char **text, const char *path)
{
    OzStatus status = OZ_OK;
    char *device = NULL;
    bool is_pushed = false;
    *text = NULL;
    OZ_TRY(OZ_NEW(state, 1));
    OZ_TRY(oz_state_file_read(*state, path));
    OzStateVisit visit = oz_state_load(*state);
    OZ_TRY(visit_head(&visit, text, &device, &is_pushed));
done:
    free(device);
    if (status != OZ_OK) {
        free(*text);
        oz_state_free(*state);
        free(*state);
        *text = NULL;
        *state = NULL;
    }
    return status;
}

/* Builds it for the scene and the device that wrote the state: words of one mean nothing to
 * another.
 */
static OzStatus take_head(OzSession *session, OzStateVisit *visit)
{
    OzStatus status = OZ_OK;
    char *text = NULL, *device = NULL;
    OZ_TRY(visit_head(visit, &text, &device, &session->scene.is_pushed));
    OZ_TRY(oz_session_build(session));
    if (!device || strcmp(device, session->device->name) != 0) {
        status =
            oz_status_fail(OZ_ERR_INPUT, "%s: made by %s and this is %s; expected the same device",
                           session->path, device ? device : "none", session->device->name);
    }
done:
    free(text);
    free(device);
    return status;
}

OzStatus oz_session_state_take(OzSession *session)
{
    OzStateVisit visit = oz_state_load(session->loaded);
    OZ_PASS(oz_members_place(&session->grains, &session->scene));
    OZ_PASS(take_head(session, &visit));
    OZ_PASS(visit_rest(session, &visit));
    OZ_PASS(oz_state_finish(&visit));
    return OZ_OK;
}
