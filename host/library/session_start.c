/* Scenes, settings, grains, settling. */
#include "library/session_start.h"

#include "base/memory.h"
#include "library/session_state.h"
#include "run/members.h"
#include "sim/settle.h"

#include <stdlib.h>

static OzStatus load(OzScene *scene, const OzSession *session, int setting_count)
{
    OZ_PASS(session->text ? oz_scene_parse(scene, session->path, session->text, session->settings,
                                           setting_count)
                          : oz_scene_load(scene, session->path, session->settings, setting_count));
    OzStatus status = OZ_OK;
    if (scene->sweep.count > 0) {
        status =
            oz_status_fail(OZ_ERR_INPUT, "%s: sweeps %s; expected one value of each (sweep: false)",
                           scene->path, scene->sweep.key);
    } else if (scene->phase_count > 0) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "%s: has phases; expected none (phases: false), their changes set "
                                "at their times",
                                scene->path);
    }
    if (status == OZ_OK) {
        return OZ_OK;
    }
    oz_scene_free(scene);
    return status;
}

OzStatus oz_session_start_open(OzSession *session, const char *path, const char *text)
{
    *session = (OzSession){.seen = -1, .listed = -1, .row_step = -1};
    OZ_PASS(oz_memory_text(&session->path, path));
    OZ_PASS(oz_memory_text(&session->text, text));
    return load(&session->scene, session, 0);
}

OzStatus oz_session_start_set(OzSession *session, char *setting)
{
    OzStatus status = OZ_OK;
    OzScene next = {0};
    size_t count = (size_t)session->setting_count;
    OZ_TRY(oz_memory_grow((void **)&session->settings, count, count + 1, sizeof *session->settings,
                          "settings"));
    session->settings[count] = setting;
    OZ_TRY(load(&next, session, (int)count + 1));
    session->setting_count++;
    setting = NULL;
    oz_scene_free(&session->scene);
    session->scene = next;
done:
    free(setting);
    return status;
}

static OzStatus place_and_settle(OzSession *session)
{
    double seconds = 0;
    OZ_PASS(oz_members_place(&session->grains, &session->scene));
    OZ_PASS(oz_members_judge(&session->scene, &session->grains, false));
    OZ_PASS(oz_session_build(session));
    return oz_settle_run(session->sim, &seconds, NULL, NULL);
}

OzStatus oz_session_start_run(OzSession *session)
{
    if (session->is_started) {
        return OZ_OK;
    }
    OzStatus status = session->loaded ? oz_session_state_take(session) : place_and_settle(session);
    status = status == OZ_OK ? oz_session_look(session) : status;
    session->is_started = status == OZ_OK;
    if (status != OZ_OK) {
        oz_session_unbuild(session);
    }
    return status;
}
