/* A simulation of trigrains on a device: owns every device array, the step count and the time.
 * Several scenes of the same kind (seeds, sweeps) may run side by side as members of one
 * simulation. */
#ifndef OZ_COMPUTE_PIECE_SIM_H
#define OZ_COMPUTE_PIECE_SIM_H

#include "compute/sim.h"

typedef struct OzPieceSim OzPieceSim;

/* Builds the kernels and uploads the start. Members must fit together (compute/piece_company.h).
 * What a member does is the same to the bit whatever its companions. */
OzStatus oz_piece_sim_create(OzPieceSim **sim, const OzDevice *device, const OzMember *members,
                             int member_count, const char *source_dir);
void oz_piece_sim_free(OzPieceSim *sim); /* NULL is fine */

/* One launch towards the given step, of at most about 50 ms. Fails with OZ_ERR_DEVICE if the device
 * stopped. A member that a guard stopped stays at the step where it happened while the others go
 * on; once none is left it fails with OZ_ERR_BLOWUP (the message names grain, step and time). */
OzStatus oz_piece_sim_launch(OzPieceSim *sim, int64_t step);

/* Steps made since time 0. */
int64_t oz_piece_sim_step(const OzPieceSim *sim);

/* What a guard said when it stopped the member; NULL while it goes on. */
const char *oz_piece_sim_stopped(const OzPieceSim *sim, int member);

OzSimCounts oz_piece_sim_counts(const OzPieceSim *sim);

/* What a scene becomes on a device: switches, what is left out, arrays and their sizes (`orzo
 * check`). */
OzStatus oz_piece_sim_describe(const OzDevice *device, const OzScene *scene, const OzGrains *grains,
                               FILE *file);

#endif
