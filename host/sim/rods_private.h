/* What the files of rods' simulation share among themselves: what the driver keeps for them, as
 * what it is. */
#pragma once

#include "sim/rods_fields.h"
#include "sim/sim_private.h"

/* Rods' own part of a simulation. */
typedef struct OzRods {
    double *spring_start;         /* one a member: J in tangential springs at time 0  */
    int wall_order[OZ_WALLS_MAX]; /* scene's wall of each kernel wall                 */
    bool primed;                  /* velocity-verlet knows its first acceleration     */
} OzRods;

OZ_SIM_VIEWS(oz_rods, OzRods, OzSwitches, OzSizes, OzControl, OzParameters)

/* Writes offset and velocity of every wall of a member, and how a sheared cell stands, for so many
 * steps (at most
 * sizes.motion_steps) from the present one on, and for their end; all the present one's while the
 * step has no length. */
OzStatus oz_rods_move_walls(OzSim *sim, int member, int steps);
