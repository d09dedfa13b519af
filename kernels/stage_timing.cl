/* The parts of a step again and again on a scene that stands still (dt = 0), so that each can be
 * timed by itself: for `orzo bench`. Lists are renewed in small scenes only, by their one
 * work-group. */
#include "kernels/rods.cl"

/* The work-items of a large scene are spread over many work-groups. */
#if OZ_RESORT
#define FIRST ((int)get_global_id(0))
#define EVERY ((int)get_global_size(0))
#else
#define FIRST OZ_WORK_ITEM
#define EVERY OZ_WORK_STRIDE
#endif

kernel void oz_repeat_pairs(OZ_WORK_ARGUMENTS, int repeats)
{
    OZ_WORK_OPEN(0)
    for (int k = 0; k < repeats; k++) {
        for (int region = FIRST; region < z.regions; region += EVERY) {
            oz_pairs_region(&w, region, 0);
        }
        OZ_WORK_BARRIER();
    }
}

kernel void oz_repeat_grains(OZ_WORK_ARGUMENTS, int repeats)
{
    OZ_WORK_OPEN(0)
    for (int k = 0; k < repeats; k++) {
        for (int region = FIRST; region < z.regions; region += EVERY) {
#if OZ_MOVES_BEFORE
            oz_motion_before_region(&w, region, 0);
#endif
            oz_motion_region(&w, region, 0);
        }
        OZ_WORK_BARRIER();
    }
}

#if !OZ_RESORT

kernel void oz_repeat_refresh(OZ_WORK_ARGUMENTS, int repeats)
{
    OZ_WORK_OPEN(0)
    for (int k = 0; k < repeats; k++) {
        renew(&w, OZ_WORK_ITEM, OZ_WORK_STRIDE);
        OZ_WORK_BARRIER();
    }
}

kernel void oz_repeat_rebuild(OZ_WORK_ARGUMENTS, int repeats)
{
    OZ_WORK_OPEN(0)
    for (int k = 0; k < repeats; k++) {
        if (OZ_WORK_ITEM == 0) {
            w.control->outer_stale = 1;
        }
        OZ_WORK_BARRIER();
        renew(&w, OZ_WORK_ITEM, OZ_WORK_STRIDE);
        OZ_WORK_BARRIER();
    }
}

#endif
