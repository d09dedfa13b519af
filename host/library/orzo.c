/* liborzo's calls: each enters, does one thing with its session, and leaves. */
#include "library/orzo_private.h"

#include "base/memory.h"
#include "library/session_change.h"
#include "library/session_draw.h"
#include "library/session_state.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

_Static_assert((int)ORZO_ERR_INPUT == OZ_ERR_INPUT && (int)ORZO_ERR_MEMORY == OZ_ERR_MEMORY &&
                   (int)ORZO_ERR_FILE == OZ_ERR_FILE && (int)ORZO_ERR_DEVICE == OZ_ERR_DEVICE &&
                   (int)ORZO_ERR_BLOWUP == OZ_ERR_BLOWUP &&
                   (int)ORZO_ERR_GRAPHICS == OZ_ERR_GRAPHICS &&
                   (int)ORZO_ERR_MOVIE == OZ_ERR_MOVIE &&
                   (int)ORZO_ERR_INTERRUPTED == OZ_ERR_INTERRUPTED,
               "the header's statuses are the house's");

const char *orzo_version(void)
{
    return ORZO_VERSION;
}

const char *orzo_error(void)
{
    return oz_status_text();
}

static OzStatus open_session(OrzoSim **out, const char *path, const char *text)
{
    OrzoSim *sim = NULL;
    *out = NULL;
    OZ_PASS(oz_entry_create(&sim));
    OzEntry entry = oz_entry_enter(sim);
    OzStatus status = oz_session_start_open(&sim->session, path, text);
    oz_entry_leave(&entry);
    if (status == OZ_OK) {
        *out = sim;
    } else {
        oz_entry_free(sim);
    }
    return status;
}

OrzoStatus orzo_open(OrzoSim **sim, const char *path)
{
    return (OrzoStatus)open_session(sim, path, NULL);
}

OrzoStatus orzo_open_text(OrzoSim **sim, const char *text)
{
    return (OrzoStatus)open_session(sim, "scene", text);
}

void orzo_close(OrzoSim *sim)
{
    if (sim) {
        OzEntry entry = oz_entry_enter(sim);
        oz_session_free(&sim->session);
        oz_entry_leave(&entry);
        oz_entry_free(sim);
    }
}

static OzStatus set(OzSession *session, const char *key, const char *value)
{
    char *setting = NULL;
    int length = value ? asprintf(&setting, "%s=%s", key, value) : asprintf(&setting, "-%s", key);
    if (length < 0) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a setting");
    }
    if (!session->is_started && !session->loaded) {
        return oz_session_start_set(session, setting);
    }
    OzStatus status = oz_session_start_run(session);
    status = status == OZ_OK ? oz_session_change_set(session, setting) : status;
    free(setting);
    return status;
}

OrzoStatus orzo_set(OrzoSim *sim, const char *key, const char *value)
{
    OzEntry entry = oz_entry_enter(sim);
    OzStatus status = set(&sim->session, key, value);
    oz_entry_leave(&entry);
    return (OrzoStatus)status;
}

static OzStatus check_early(const OzSession *session, const char *what)
{
    return session->is_started
               ? oz_status_fail(OZ_ERR_INPUT, "%s: %s; expected it before the simulation starts",
                                session->path, what)
               : OZ_OK;
}

OrzoStatus orzo_set_device(OrzoSim *sim, const char *device, int threads)
{
    OzSession *session = &sim->session;
    OzStatus status = check_early(session, "another device");
    if (status == OZ_OK) {
        free(session->device_wanted);
        session->threads = threads;
        status = oz_memory_text(&session->device_wanted, device);
    }
    return (OrzoStatus)status;
}

OrzoStatus orzo_set_log(OrzoSim *sim, const char *path)
{
    OzStatus status = check_early(&sim->session, "another log");
    return (OrzoStatus)(status == OZ_OK ? oz_log_open(sim->log, path) : status);
}

OrzoStatus orzo_start(OrzoSim *sim)
{
    ORZO_STARTED(sim, OZ_OK);
}

static OzStatus run_to(OzSession *session, double time)
{
    return oz_session_advance(session, oz_step_clock_nearest(&session->schedule.clock, time));
}

OrzoStatus orzo_run_to(OrzoSim *sim, double time)
{
    ORZO_STARTED(sim, run_to(&sim->session, time));
}

OrzoStatus orzo_run_steps(OrzoSim *sim, int64_t steps)
{
    ORZO_STARTED(sim, oz_session_advance(&sim->session, oz_sim_step(sim->session.sim) + steps));
}

double orzo_time(const OrzoSim *sim)
{
    return sim->session.is_started ? oz_sim_time(sim->session.sim) : 0;
}

int64_t orzo_step(const OrzoSim *sim)
{
    return sim->session.is_started ? oz_sim_step(sim->session.sim) : 0;
}

double orzo_step_length(const OrzoSim *sim)
{
    return sim->session.scene.step;
}

double orzo_end(const OrzoSim *sim)
{
    return sim->session.scene.duration;
}

double orzo_period(const OrzoSim *sim)
{
    return sim->session.scene.period;
}

OrzoStatus orzo_push(OrzoSim *sim, const int64_t *grains, int64_t count, const double *force,
                     const double *torque)
{
    ORZO_STARTED(sim, oz_session_change_push(&sim->session, grains, count, force, torque));
}

OrzoStatus orzo_drive_wall(OrzoSim *sim, int wall, double speed)
{
    ORZO_STARTED(sim, oz_session_change_drive(&sim->session, wall, speed));
}

OrzoStatus orzo_scene(const OrzoSim *sim, char **text)
{
    size_t length = 0;
    OzEntry entry = oz_entry_enter(sim);
    OzStatus status = oz_scene_text(&sim->session.scene, text, &length);
    oz_entry_leave(&entry);
    return (OrzoStatus)status;
}

void orzo_free(void *memory)
{
    free(memory);
}

void orzo_picture_size(const OrzoSim *sim, int *width, int *height)
{
    oz_session_draw_size(&sim->session, width, height);
}

static OzStatus draw(OzSession *session, uint8_t *pixels, int64_t room)
{
    int width = 0, height = 0;
    oz_session_draw_size(session, &width, &height);
    if (room != (int64_t)width * height * 4) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: room for %lld bytes of a picture; expected %d x %d x 4",
                              session->path, (long long)room, width, height);
    }
    return oz_session_draw_picture(session, pixels);
}

OrzoStatus orzo_draw(OrzoSim *sim, uint8_t *pixels, int64_t room)
{
    ORZO_STARTED(sim, draw(&sim->session, pixels, room));
}

OrzoStatus orzo_save(OrzoSim *sim, const char *path)
{
    ORZO_STARTED(sim, oz_session_state_write(&sim->session, path));
}

static OzStatus load(OrzoSim **out, const char *path)
{
    OzStatus status = OZ_OK;
    OzState *state = NULL;
    char *text = NULL;
    OZ_TRY(oz_session_state_read(&state, &text, path));
    OZ_TRY(open_session(out, path, text ? text : ""));
    (*out)->session.loaded = state;
    state = NULL;
done:
    if (state) {
        oz_state_free(state);
    }
    free(state);
    free(text);
    return status;
}

OrzoStatus orzo_load(OrzoSim **sim, const char *path)
{
    *sim = NULL;
    return (OrzoStatus)load(sim, path);
}
