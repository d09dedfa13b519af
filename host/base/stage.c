/* Stages: one waiting thread each. Knows nothing of what is being done. */
#include "base/stage.h"

#include "base/clock.h"
#include "base/log.h"
#include "base/thread.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

/* s: what is shorter needs no words. */
#define SILENT 1.0

/* s between looks: often enough for a terminal; in a pipe the log lets few of them through. */
#define TICK 0.25

static struct timespec moment_of(double clock)
{
    struct timespec moment = {.tv_sec = (time_t)clock};
    moment.tv_nsec = (long)(1e9 * (clock - (double)moment.tv_sec));
    return moment;
}

/* With the mutex held. */
static void show(OzStage *stage)
{
    if (!stage->announced) {
        stage->announced = true;
        oz_log_line("%s ...", stage->name);
    } else if (stage->text[0]) {
        oz_log_progress("%s", stage->text);
    } else {
        oz_log_progress("%s: %.0f s", stage->name, oz_clock_now() - stage->started);
    }
}

static void *watch(void *of)
{
    OzStage *stage = of;
    double next = stage->started + SILENT;
    pthread_mutex_lock(&stage->mutex);
    while (!stage->ended) {
        struct timespec until = moment_of(next);
        if (pthread_cond_timedwait(&stage->ended_now, &stage->mutex, &until) == ETIMEDOUT) {
            show(stage);
            next = oz_clock_now() + TICK;
        }
    }
    pthread_mutex_unlock(&stage->mutex);
    return NULL;
}

void oz_stage_begin(OzStage *stage, const char *format, ...)
{
    pthread_condattr_t monotonic;
    va_list arguments;
    memset(stage, 0, sizeof *stage);
    stage->started = oz_clock_now();
    va_start(arguments, format);
    vsnprintf(stage->name, sizeof stage->name, format, arguments);
    va_end(arguments);
    pthread_mutex_init(&stage->mutex, NULL);
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_cond_init(&stage->ended_now, &monotonic);
    pthread_condattr_destroy(&monotonic);
    stage->has_thread = oz_thread_start(&stage->thread, watch, stage) == 0;
}

void oz_stage_say(OzStage *stage, const char *format, ...)
{
    va_list arguments;
    pthread_mutex_lock(&stage->mutex);
    va_start(arguments, format);
    vsnprintf(stage->text, sizeof stage->text, format, arguments);
    va_end(arguments);
    pthread_mutex_unlock(&stage->mutex);
}

void oz_stage_end(OzStage *stage)
{
    pthread_mutex_lock(&stage->mutex);
    stage->ended = true;
    pthread_cond_signal(&stage->ended_now);
    pthread_mutex_unlock(&stage->mutex);
    if (stage->has_thread) {
        pthread_join(stage->thread, NULL);
    }
    if (stage->announced) {
        oz_log_progress(" ");
    }
    pthread_cond_destroy(&stage->ended_now);
    pthread_mutex_destroy(&stage->mutex);
}
