/* A simulation that begins with the grains of another one's state: places, velocities and springs,
 * at step 0 of scenes of its own. */
#pragma once

#include "base/state.h"
#include "sim/sim.h"

/* Before the first step: every member takes the state's member 0 as oz_sim_state_visit saved it,
 * whose entries begin with prefix ("worker/"). Who calls has seen to it that grains and walls are
 * the same. Words mean the same for the same step, precision, integrator and kinds of walls alone:
 * others are refused with OZ_ERR_INPUT by name, and a simulation that failed can only be freed.
 * Contacts that had no springs begin with none. */
OzStatus oz_branch_take(OzSim *sim, const OzState *state, const char *prefix);
