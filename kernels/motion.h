/* The part of a step after the forces between grains: what a region's grains feel, and where they go. OpenCL C
 * only. */
#ifndef OZ_KERNELS_MOTION_H
#define OZ_KERNELS_MOTION_H

#include "kernels/enclosure.h"

OZ_INLINE void oz_motion_region(OzWork *w, int region, int step)
{
#if !OZ_SCATTER
    oz_loads_gather_region(w, region);
#endif
#if OZ_WALL_COUNT > 0
    oz_enclosure_region(w, region, step);
#endif
    for (int block = oz_work_block_begin(w, region); block < oz_work_block_end(w, region); block++) {
        oz_grains_block(w, block, step);
    }
}

#if OZ_MOVES_BEFORE
/* The part of a step before the forces. */
OZ_INLINE void oz_motion_before_region(OzWork *w, int region, int step)
{
    for (int block = oz_work_block_begin(w, region); block < oz_work_block_end(w, region); block++) {
        oz_grains_before(w, block, step);
    }
}
#endif

#endif
