/* Moving grains apart that overlap at the start (scene key settle.overlaps), without forces, so
 * that no spring throws them. */
#ifndef OZ_COMPUTE_PART_H
#define OZ_COMPUTE_PART_H

#include "model/grains.h"

/* Sweep after sweep, each two that overlap are moved apart along their contact's normal by their
 * depth, the lighter the farther, walls not at all, until none is deeper than half of
 * OZ_START_ROUNDING of the smaller radius. Turns and velocities stay. A line in the log says how
 * far grains were moved. Fails with OZ_ERR_INPUT when thousands of sweeps do not do: there is no
 * room. */
OzStatus oz_part_grains(OzGrains *grains, const OzScene *scene);

#endif
