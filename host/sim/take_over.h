/* Another scene takes over from the one that a simulation runs: what that asks of the simulation,
 * found by comparing what its kernels are made of, and doing it. The scenes have the same grains,
 * walls of the same kinds and the same precision (who calls has refused others), and their walls'
 * motions go on from the running ones (oz_motion_take_over). */
#pragma once

#include "sim/sim.h"

typedef enum OzTakeOver {
    OZ_TAKE_OVER_APPLY,  /* other parameters                                        */
    OZ_TAKE_OVER_REBUILD /* another program: kernel switches, or sizes of arrays    */
} OzTakeOver;

/* What the next scene of these grains asks for where another one runs on this device. Refuses with
 * OZ_ERR_INPUT what the running simulation has no state for. */
OzStatus oz_take_over_compare(OzTakeOver *how, const OzDevice *device, const OzGrains *grains,
                              const OzScene *running, const OzScene *next);

/* Between launches, from this step on: `next`, one scene a member, runs. Members that a guard has
 * stopped keep theirs. Scenes are copied. Fails with the simulation as it was while no scene has
 * been taken. */
OzStatus oz_take_over_apply(OzSim *sim, const OzScene *const *next);

/* Makes the simulation that shall go on from `running` with these scenes: programs are built here,
 * which may take seconds and can be done in a thread of its own while the running one makes steps
 * (device: a branch of its own). The caller frees it. */
OzStatus oz_take_over_build(OzSim **sim, const OzSim *running, const OzDevice *device,
                            const OzScene *const *next, const char *source_dir);

/* Between launches: gives it the state of the running one, springs included, and the scenes, whose
 * motions are those of this moment. The running one is then to be freed. */
OzStatus oz_take_over_swap(OzSim *sim, OzSim *running, const OzScene *const *next);
