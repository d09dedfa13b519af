/* Simulated time of steps. A run is a sequence of stretches, each of steps of one length: within a
 * stretch the time of step k is start + (k - first) x dt, so it does not depend on how the steps
 * were made, and no rounding adds up. */
#pragma once

#include "base/state.h"

#include <stdint.h>

typedef struct OzStepClock {
    int64_t first; /* step that the present stretch began at */
    double start;  /* s, time of that step                   */
    double dt;     /* s, of the steps since                  */
} OzStepClock;

/* A run's first stretch: step 0 is at time 0. */
OzStepClock oz_step_clock_begin(double dt);

/* Time of a step of the present stretch, s. */
double oz_step_clock_time(const OzStepClock *clock, int64_t step);

/* The step nearest to a time, s (INT64_MAX where none is, as for INFINITY). */
int64_t oz_step_clock_nearest(const OzStepClock *clock, double time);

/* A new stretch from this step on. With the same dt the clock stays as it is, to the bit. */
void oz_step_clock_change(OzStepClock *clock, int64_t step, double dt);

/* Saves or loads it, under this name (base/state.h). */
OzStatus oz_step_clock_state(OzStepClock *clock, OzStateVisit *visit, const char *name);
