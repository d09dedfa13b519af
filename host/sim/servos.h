/* Servo walls of a simulation: their constants, whether they are held, where they stand. They are
 * numbered in the order of the scene's walls. */
#pragma once

#define OZ_HOST
#include "kernels/layout.h"
#include "model/snapshot.h"

typedef struct OzSim OzSim;

/* Fills the servos' constants; order: the scene's wall of each of count kernel walls. */
void oz_servos_fill(OzParameters *parameters, const int *order, int count, const OzScene *scene,
                    const OzGrains *grains);

/* Between launches: pistons stand while walls do. */
OzStatus oz_servos_hold(OzSim *sim, int member);

/* Where a member's servos stand, into a snapshot. */
OzStatus oz_servos_read(const OzSim *sim, int member, OzSnapshot *snapshot);
