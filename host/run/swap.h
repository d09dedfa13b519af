/* A worker's part in changing a running scene: between two launches it lets accepted requests
 * (run/reload.h), or those of an earlier run (run/replay.h), take over its simulation, its members'
 * outputs and its schedule. Programs are built in a thread while the old one goes on. */
#pragma once

#include "run/worker_types.h"

/* Takes what can be taken at this step. The schedule's event in hand is given back then. */
OzStatus oz_swap_serve(OzWorker *worker);

/* The step at which the worker must stop for a change or the end of the run that it repeats;
 * INT64_MAX without one. Whether it is at that end, which was no end of the scene's. */
int64_t oz_swap_next(const OzWorker *worker);
bool oz_swap_is_at_end(const OzWorker *worker);

/* Ends a build that nobody waits for any more. */
void oz_swap_end(OzWorker *worker);
