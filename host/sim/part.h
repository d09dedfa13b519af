/* Moving grains apart that overlap at the start (scene key settle.overlaps), without forces, so
 * that no spring throws them. */
#pragma once

#include "model/grains.h"

/* Works in sweeps over all overlaps. Each moves the two bodies apart along their contact's normal
 * by the depth of the overlap: the lighter one goes farther, a wall stays. Sweeps end when no
 * overlap is deeper than half of OZ_START_ROUNDING of the smaller radius. Directions and velocities
 * stay as they are. A line in the log says how far grains were moved. Fails with OZ_ERR_INPUT when
 * thousands of sweeps are not enough, because there is no room. */
OzStatus oz_part_grains(OzGrains *grains, const OzScene *scene);
