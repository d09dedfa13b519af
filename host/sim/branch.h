/* A simulation that begins with the grains of another one's state: places, velocities and springs,
 * at step 0 of scenes of its own. */
#pragma once

#include "base/state.h"
#include "sim/sim.h"

/* A member as oz_sim_state_visit saved it, in entries that begin with prefix ("worker/"). */
typedef struct OzBranchSource {
    const OzState *state;
    const char *prefix;
    int member;
    double strain; /* of its cell then (scene/boundary.h), from which the new one's goes on */
} OzBranchSource;

/* Before the first step: every member takes the one of its own source. Who calls has seen to it
 * that grains and walls are the same. Words mean the same for the same step, precision, integrator
 * and kinds of walls alone: others are refused with OZ_ERR_INPUT by name, and a simulation that
 * failed can only be freed. Contacts that had no springs begin with none. */
OzStatus oz_branch_take(OzSim *sim, const OzBranchSource *sources);
