/* A simulation on a device: owns every device array, the step count and the time. Several scenes of
 * the same kind (seeds, sweeps) may run side by side as members of one simulation. */
#pragma once

#include "compute/device.h"
#include "model/grains.h"
#include "model/step_clock.h"

#include <stdio.h>

typedef struct OzSim OzSim;

/* What a run has cost so far; refreshes and rebuilds are those of a mean member, crossed all
 * members'. */
typedef struct OzSimCounts {
    int64_t steps, launches, refreshes, rebuilds, growths, crossed;
} OzSimCounts;

/* Builds the kernels and uploads the start. Members must fit together (sim/batch_fit.h). What a
 * member does is the same to the bit whatever its companions. */
OzStatus oz_sim_create(OzSim **sim, const OzDevice *device, const OzMember *members,
                       int member_count, const char *source_dir);
void oz_sim_free(OzSim *sim); /* NULL is fine */

/* One launch towards the given step, of at most about 50 ms. Fails with OZ_ERR_DEVICE if the device
 * stopped. A member that a guard stopped stays at the step where it happened while the others go
 * on; once none is left it fails with OZ_ERR_BLOWUP (the message names grain, step and time). */
OzStatus oz_sim_launch(OzSim *sim, int64_t step);

/* All the way to the given step. */
OzStatus oz_sim_advance(OzSim *sim, int64_t step);

/* Steps made since time 0; their time, s; and the clock, which tells of other steps. Borrowed. */
int64_t oz_sim_step(const OzSim *sim);
double oz_sim_time(const OzSim *sim);
const OzStepClock *oz_sim_clock(const OzSim *sim);

/* The scene that a member runs, walls' phases included. Borrowed, until another one takes over. */
const OzScene *oz_sim_scene(const OzSim *sim, int member);

/* What a guard said when it stopped the member; NULL while it goes on. */
const char *oz_sim_stopped(const OzSim *sim, int member);

OzSimCounts oz_sim_counts(const OzSim *sim);

/* What a scene becomes on a device: switches, what is left out, arrays and their sizes (`orzo
 * check`). */
OzStatus oz_sim_describe(const OzDevice *device, const OzScene *scene, const OzGrains *grains,
                         FILE *file);
