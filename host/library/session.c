/* Steps and looks. It knows no file of a run, and not where a session comes from. */
#include "library/session.h"

#include "base/memory.h"
#include "sim/read_snapshot.h"

#include <stdlib.h>
#include <string.h>

void oz_session_forget(OzSession *session)
{
    session->seen = session->listed = session->row_step = -1;
}

OzStatus oz_session_build(OzSession *session)
{
    const OzMember member = {&session->scene, &session->grains};
    OZ_PASS(OZ_NEW(&session->device, 1));
    OZ_PASS(oz_device_open(session->device, session->device_wanted, session->threads));
    OZ_PASS(oz_sim_create(&session->sim, session->device, &member, 1, NULL));
    OZ_PASS(oz_snapshot_create(&session->now, &session->scene, &session->grains));
    OZ_PASS(oz_series_create(&session->series, NULL, &session->scene, &session->grains));
    session->schedule = oz_schedule_create(&session->scene, -1);
    return OZ_OK;
}

void oz_session_unbuild(OzSession *session)
{
    oz_series_free(session->series);
    oz_snapshot_free(&session->now);
    oz_sim_free(session->sim);
    if (session->device) {
        oz_device_close(session->device);
    }
    free(session->device);
    oz_grains_free(&session->grains);
    free(session->force);
    free(session->torque);
    session->force = session->torque = NULL;
    session->series = NULL;
    session->sim = NULL;
    session->device = NULL;
    session->is_due = false;
    oz_session_forget(session);
}

void oz_session_free(OzSession *session)
{
    oz_renderer_free(session->renderer);
    oz_session_unbuild(session);
    oz_scene_free(&session->scene);
    if (session->loaded) {
        oz_state_free(session->loaded);
    }
    free(session->loaded);
    for (int i = 0; i < session->setting_count; i++) {
        free(session->settings[i]);
    }
    free(session->settings);
    free(session->device_wanted);
    free(session->row);
    free(session->text);
    free(session->path);
    *session = (OzSession){0};
}

OzStatus oz_session_see(OzSession *session, bool contacts)
{
    int64_t step = oz_sim_step(session->sim);
    if (session->seen == step && (!contacts || session->listed == step)) {
        return OZ_OK;
    }
    session->seen = session->listed = -1;
    OZ_PASS(oz_read_snapshot_snapshot(session->sim, 0, &session->now, contacts));
    session->seen = step;
    session->listed = contacts ? step : -1;
    return OZ_OK;
}

OzStatus oz_session_observe(OzSession *session)
{
    OzStatus status = OZ_OK;
    const double *cells = NULL;
    OZ_PASS(oz_session_see(session, true));
    if (session->row_step == session->seen) {
        return OZ_OK;
    }
    OZ_PASS(oz_series_write(session->series, &session->now));
    session->row_count = oz_series_row(session->series, &cells);
    free(session->row);
    OZ_TRY(OZ_NEW(&session->row, session->row_count));
    memcpy(session->row, cells, (size_t)session->row_count * sizeof *cells);
    session->row_step = session->seen;
done:
    return status;
}

static bool next_event(OzSession *session)
{
    if (!session->is_due) {
        session->before = session->schedule;
        session->is_due =
            oz_schedule_next(&session->schedule, &session->event_step, &session->event_due);
    }
    return session->is_due;
}

OzStatus oz_session_look(OzSession *session)
{
    while (next_event(session) && session->event_step <= oz_sim_step(session->sim)) {
        int due = session->event_due;
        session->is_due = false;
        if (due & (OZ_DUE_SAMPLE | OZ_DUE_ROW)) {
            OZ_PASS(oz_session_see(session, (due & OZ_DUE_ROW) != 0));
        }
        if (due & OZ_DUE_SAMPLE) {
            oz_series_sample(session->series, &session->now);
        }
        if (due & OZ_DUE_ROW) {
            OZ_PASS(oz_session_observe(session));
        }
    }
    /* Whose number may have changed. */
    return session->scene.beams.strength.present ? oz_session_see(session, false) : OZ_OK;
}

OzStatus oz_session_advance(OzSession *session, int64_t step)
{
    OzStatus status = OZ_OK;
    if (step > session->schedule.last_step) {
        double end = oz_step_clock_time(&session->schedule.clock, session->schedule.last_step);
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: step %lld lies beyond the scene's end, %.9g s; expected an "
                              "earlier time, or a later time.duration",
                              session->path, (long long)step, end);
    }
    while (status == OZ_OK && oz_sim_step(session->sim) < step) {
        bool stops = next_event(session) && session->event_step < step;
        status = oz_sim_advance(session->sim, stops ? session->event_step : step);
        status = status == OZ_OK ? oz_session_look(session) : status;
    }
    return status;
}
