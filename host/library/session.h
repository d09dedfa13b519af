/* One simulation without a run's files: a scene, its grains, a device, the steps, and what is seen
 * of a state. What liborzo's calls (library/orzo.h) do, in the house's own words. */
#pragma once

#include "draw/renderer.h"
#include "observe/schedule.h"
#include "observe/series.h"
#include "sim/sim.h"

#include <pthread.h>

/* Zeroed is valid: what was not made is not freed. It must not move in memory. */
typedef struct OzSession {
    char *path;      /* of the scene, or its name in messages; owned */
    char *text;      /* of a scene without a file; NULL: path is one; owned */
    char **settings; /* "key=value" before the start, owned                */
    int setting_count;
    char *device_wanted;
    int threads;
    OzState *loaded; /* what it begins with; NULL: grains are placed; owned */
    OzScene scene;   /* as it runs                                           */
    OzGrains grains;
    OzDevice *device; /* owned */
    OzSim *sim;
    bool is_started;
    OzSchedule schedule, before; /* of samples and rows; without the event that is next */
    int64_t event_step;
    int event_due;
    bool is_due;
    OzSnapshot now;
    int64_t seen, listed;        /* steps of which `now` is, of which its contacts are; -1: none */
    OzSeries *series;            /* without a file                                               */
    double *row;                 /* its last one; owned                                          */
    int64_t row_count, row_step; /* cells; the row's step, -1: none                       */
    char column[OZ_COLUMN_NAME]; /* whose name was asked for last */
    OzRenderer *renderer;
    pthread_t drawer; /* the thread that made it */
    OzLook look;
    bool is_framed;
    double *force, *torque; /* from outside, 3 a grain; NULL: none yet; owned */
} OzSession;

/* Device, simulation, snapshot and series for the scene and the grains, which are there. What a
 * failure left is freed by oz_session_unbuild, which leaves the scene. */
OzStatus oz_session_build(OzSession *session);
void oz_session_unbuild(OzSession *session);

void oz_session_free(OzSession *session);

/* What is due up to the step that it is at: the series takes samples and rows. */
OzStatus oz_session_look(OzSession *session);

/* On to this step, by way of what is due. Refuses steps beyond the scene's end. */
OzStatus oz_session_advance(OzSession *session, int64_t step);

/* session->now is this state, with its contacts if asked for. */
OzStatus oz_session_see(OzSession *session, bool contacts);

/* The same, and session->row is of this state. */
OzStatus oz_session_observe(OzSession *session);

/* Forgets what was seen: the state, or what it is seen by, has changed. */
void oz_session_forget(OzSession *session);
