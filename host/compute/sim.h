/* A simulation on a device: owns every device array, the step count and the time. Several scenes of the same
 * kind (seeds, sweeps) may run side by side as members of one simulation. */
#ifndef OZ_COMPUTE_SIM_H
#define OZ_COMPUTE_SIM_H

#include "compute/device.h"
#include "model/grains.h"

#include <stdio.h>

typedef struct OzSim OzSim;

/* One scene of a simulation; both are borrowed and must outlive it. */
typedef struct OzMember {
    const OzScene *scene;
    const OzGrains *grains;
} OzMember;

/* What a run has cost so far. */
typedef struct OzSimCounts {
    int64_t steps, launches, refreshes, rebuilds, growths, crossed;
} OzSimCounts;

/* Builds the kernels and uploads the start. Members must agree in switches, grain count and step. */
OzStatus oz_sim_create(OzSim **sim, const OzDevice *device, const OzMember *members,
                       int member_count, const char *source_dir);
void oz_sim_free(OzSim *sim); /* NULL is fine */

/* One launch towards the given step, of at most about 50 ms. Fails with OZ_ERR_DEVICE if the device stopped,
 * with OZ_ERR_BLOWUP if a guard spoke (the message names grain, step and time); the state is then that of
 * the step where it happened. */
OzStatus oz_sim_launch(OzSim *sim, int64_t step);

/* All the way to the given step. */
OzStatus oz_sim_advance(OzSim *sim, int64_t step);

/* Steps made since time 0. */
int64_t oz_sim_step(const OzSim *sim);

OzSimCounts oz_sim_counts(const OzSim *sim);

/* What a scene becomes on a device: switches, what is left out, arrays and their sizes (`orzo check`). */
OzStatus oz_sim_describe(const OzDevice *device, const OzScene *scene, const OzGrains *grains,
                         FILE *file);

#endif
