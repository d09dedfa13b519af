/* Members of a run that share a simulation, on their way from the start to the last step. A run has
 * several workers at once, each with its own queue of the device and in its own thread, so that one
 * computes while another's state is looked at. */
#pragma once

#include "run/worker_types.h"

/* Builds the simulation. */
OzStatus oz_worker_open(OzWorker *worker, const OzDevice *device, const char *source_dir);

/* Runs them side by side, members' outputs opened before, and closes those: whole after
 * interruption or success, so far as they came after a failure; each member's outcome says which.
 * Returns the first worker's failure that was one of its own. */
OzStatus oz_worker_run(OzWorker *workers, int count);

/* Takes the schedule's next event in hand, unless there is one; false at the end. */
bool oz_worker_next_event(OzWorker *worker);

/* Frees the simulation. */
void oz_worker_close(OzWorker *worker);
