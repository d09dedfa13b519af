/* Whether grains start soundly: overlaps with each other and with walls, grains that no wall will
 * catch. Springs that start compressed throw grains apart at speeds that nobody asked for. */
#pragma once

#include "sim/start_overlap.h"

/* Grains beyond this number are not looked at: it would take longer than a second. */
#define OZ_START_COUNT_MOST 200000

/* Looks at the start of a scene. Two kinds of overlap are not counted: those of rounding, and those
 * whose force a contact of a bed at rest may bear (oz_start_overlap_load). An overlap is refused
 * when its share is above OZ_START_MOST. Grains that were all read from a file go on as they were:
 * of their overlaps those alone are refused that guards.overlap.stop would stop. Grains placed at
 * random have no overlaps, so a scene of these alone is not looked at. */
OzStatus oz_start_look(OzStart *start, const OzScene *scene, const OzGrains *grains);

/* Fails with OZ_ERR_INPUT where no run should begin, naming pair, depth and stored energy, unless
 * forced; a warning in the log for other overlaps, and for grains that nothing will catch. */
OzStatus oz_start_judge(const OzScene *scene, const OzGrains *grains, bool force);
