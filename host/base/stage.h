/* A piece of work that may take long without coming back (a kernel build, a placement): a person is
 * told when it does, by a thread that lives as long as the stage. */
#pragma once

#include <pthread.h>
#include <stdbool.h>

enum { OZ_STAGE_TEXT = 256 };

/* Lives where its user puts it, between begin and end; it must not move. */
typedef struct OzStage {
    pthread_t thread;
    pthread_mutex_t mutex;
    pthread_cond_t ended_now;
    bool has_thread, ended, announced;
    double started;           /* oz_clock_now                                */
    char name[OZ_STAGE_TEXT]; /* what is being done, as in "building kernels" */
    char text[OZ_STAGE_TEXT]; /* how far it is; "": the seconds spent so far  */
} OzStage;

/* Begins a stage of that name (printf style). Once it has lasted a second the log gets a line with
 * the name, and from then on oz_log_progress shows how far it is. A machine that has no thread left
 * goes without. */
void oz_stage_begin(OzStage *stage, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* How far it is, as the whole text that is shown; from any thread, as often as wanted. */
void oz_stage_say(OzStage *stage, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Ends it: nothing is shown any more when this returns. */
void oz_stage_end(OzStage *stage);
