/* A simulation whatever its model: what runs, benches and inspection use. Each call is answered by
 * the simulation of the scene's model, rods (compute/sim.h) or trigrains (compute/piece_sim.h);
 * there the contracts are given in full. */
#ifndef OZ_COMPUTE_DRIVE_H
#define OZ_COMPUTE_DRIVE_H

#include "compute/settle.h"
#include "compute/sim.h"
#include "observe/snapshot.h"

#include <stdbool.h>

typedef struct OzDrive OzDrive;

/* Builds the kernels and uploads the start of members that fit together (one model). */
OzStatus oz_drive_create(OzDrive **drive, const OzDevice *device, const OzMember *members,
                         int member_count, const char *source_dir);
void oz_drive_free(OzDrive *drive); /* NULL is fine */

/* One launch towards the given step, of at most about 50 ms; all the way to it. */
OzStatus oz_drive_launch(OzDrive *drive, int64_t step);
OzStatus oz_drive_advance(OzDrive *drive, int64_t step);

/* Steps made since time 0. */
int64_t oz_drive_step(const OzDrive *drive);

/* What a guard said when it stopped the member; NULL while it goes on. */
const char *oz_drive_stopped(const OzDrive *drive, int member);

OzSimCounts oz_drive_counts(const OzDrive *drive);

/* Lets the grains come to rest as scene.settle says; *seconds receives the simulated time. */
OzStatus oz_drive_settle(OzDrive *drive, double *seconds, OzSettleWatch watch, void *context);

/* The state of a member now; contacts: the sums over contacts and the ledger too. */
OzStatus oz_drive_capture(OzDrive *drive, int member, OzSnapshot *snapshot, bool contacts);

/* What a scene becomes on a device (`orzo check`). */
OzStatus oz_drive_describe(const OzDevice *device, const OzScene *scene, const OzGrains *grains,
                           FILE *file);

/* Whether two scenes can share launches; how many members like this one fit the device's memory at
 * a time, at least 1, and what one needs. */
bool oz_drive_fits(const OzDevice *device, const OzMember *a, const OzMember *b);
OzStatus oz_drive_most(const OzDevice *device, const OzMember *member, int64_t *most,
                       double *bytes);

#endif
