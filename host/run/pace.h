/* A run that goes no faster than somebody can watch it. */
#pragma once

#include "run/worker_types.h"

/* Simulated seconds a wall second at most, by --realtime: as asked, or as the scene's movie shows;
 * 0: as fast as it can. */
double oz_pace_of(const OzOptions *options, const OzScene *scene);

/* How far the worker's next launch may go: to its event, to a change of the run that it repeats,
 * and with a pace no farther than a fiftieth of a second shows. */
int64_t oz_pace_next(const OzWorker *worker);

/* With a pace, waits for the wall clock. Who has fallen behind does not race to catch up. */
void oz_pace_keep(OzWorker *worker);
