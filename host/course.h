/* Members of a run that share a simulation, on their way from the start to the last step. A run has
 * several courses at once, each with its own queue of the device and in its own thread, so that one
 * computes while another's state is looked at. */
#pragma once

#include "base/stage.h"
#include "compute/sim.h"
#include "observe/schedule.h"
#include "outputs.h"

#include <stdatomic.h>

/* Zeroed is valid: what was not opened is not closed. Everything above `device` is set by who opens
 * it. It must not move in memory while open. */
typedef struct OzCourse {
    OzOutputs **members; /* borrowed; they fit together (oz_company_fits)           */
    int64_t member_count;
    OzSchedule schedule; /* of all of them                                        */
    bool is_ensemble;    /* a member that fails leaves the others alone           */
    bool leads;          /* shows progress                                        */
    double started;      /* wall clock, of the program                            */
    atomic_bool *ended;  /* shared: a course that failed ends the others          */
    OzDevice device;     /* a branch                                              */
    OzSim *sim;
    OzStage stage;            /* in hand, of the course that leads                     */
    double first_step, spent; /* wall clock; from the first step to the last      */
    OzStatus status;          /* how it ended, and why                            */
    char text[4096];
} OzCourse;

/* Builds the simulation. */
OzStatus oz_course_open(OzCourse *course, const OzDevice *device, const char *source_dir);

/* Runs them side by side, members' outputs opened before, and closes those: whole after
 * interruption or success, so far as they came after a failure; each member's outcome says which.
 * Returns the first course's failure that was one of its own. */
OzStatus oz_course_run(OzCourse *courses, int count);

/* Frees the simulation. */
void oz_course_close(OzCourse *course);
