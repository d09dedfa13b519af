/* The columns of when a row is, for THE list in observe/observables.c: each as OzColumn asks. */
#pragma once

#include "observe/column.h"

bool oz_moment_step(const OzObservation *observation, double *value);
bool oz_moment_time(const OzObservation *observation, double *value);

/* None without a wall that is shaken. */
bool oz_moment_tap(const OzObservation *observation, double *value);

/* index: 0 the phase in its cycle, 1 the cycle, from 1; at a phase's first step it has begun. */
bool oz_moment_phase(const OzObservation *observation, double *value);
