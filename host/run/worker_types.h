/* What a worker (run/worker.h) keeps. */
#pragma once

#include "base/stage.h"
#include "observe/schedule.h"
#include "run/checkpoint.h"
#include "run/outputs.h"
#include "run/reload.h"
#include "run/replay.h"
#include "sim/sim.h"

#include <stdatomic.h>

typedef struct OzSwap OzSwap; /* a simulation that is being built */

/* Zeroed is valid: what was not opened is not closed. Everything above `device` is set by who opens
 * it. It must not move in memory while open. */
typedef struct OzWorker {
    OzOutputs **members; /* borrowed; they fit together (oz_batch_fit_agrees)           */
    int64_t member_count;
    OzSchedule schedule;      /* of all of them                                        */
    OzSchedule before;        /* the same without the event that is next                    */
    int64_t event_step;       /* of the event that is next, or that has been looked at last */
    int event_due;            /* and what is due there                                      */
    bool is_due;              /* it has not been looked at yet                              */
    OzCheckpoint *checkpoint; /* borrowed: where its states go; NULL: it leaves none   */
    OzServe *serve;           /* borrowed: is shown where the run is; NULL: none       */
    bool is_ensemble;         /* a member that fails leaves the others alone           */
    bool leads;               /* shows progress                                        */
    double started;           /* wall clock, of the program                            */
    atomic_bool *ended;       /* shared: a worker that failed ends the others          */
    OzReload *reload;         /* borrowed: changes that are asked for; NULL: none can be       */
    const OzReplay *replay;   /* borrowed: changes known from the start; NULL: none            */
    int64_t first;            /* of its members in the group                                   */
    double pace;              /* simulated seconds a wall second at most; 0: any               */
    const OzDevice *root;     /* borrowed                                                      */
    const char *source_dir;   /* borrowed                                                      */
    OzDevice *device;         /* a branch, owned                                               */
    int64_t taken;            /* changes of the group that it has taken                        */
    bool is_quiet;            /* of the change in hand nothing is said                         */
    OzSwap *swap;             /* NULL: nothing is being built                                  */
    double glance_after;      /* wall clock before which nobody who looks on is shown a picture */
    double pace_clock, pace_time; /* wall clock, simulated time: where the pace is counted from */
    OzSim *sim;
    OzStage stage;            /* in hand, of the worker that leads                     */
    double first_step, spent; /* wall clock; from the first step to the last      */
    OzStatus status;          /* how it ended, and why                            */
    char text[4096];
} OzWorker;
