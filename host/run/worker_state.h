/* The state of a worker: all that the rest of its members' run depends on, saved and loaded. */
#pragma once

#include "run/worker_types.h"

/* Saves or loads (base/state.h), between launches and not while members are looked at; also while
 * they settle. The event that is next belongs to the rest, so that a run which has loaded may end
 * elsewhere. Opened and not run yet, a worker that has loaded goes on from there. */
OzStatus oz_worker_state_visit(OzWorker *worker, OzStateVisit *visit);

/* Loads the state of a file (run/checkpoint.h), which this device must have made, and frees it. The
 * run must not end before it. */
OzStatus oz_worker_state_take(OzWorker *worker, OzState *state, const char *device);

/* Puts the state into its file; kept: into another one, which later ones do not replace. Where that
 * file cannot be written the run goes on, unless the scene has asked for it. */
OzStatus oz_worker_state_save(OzWorker *worker, bool kept);

/* When the time for one has come; at a beginning or an ending, if states are wanted at all. */
OzStatus oz_worker_state_save_if_due(OzWorker *worker);
OzStatus oz_worker_state_save_if_wanted(OzWorker *worker);
