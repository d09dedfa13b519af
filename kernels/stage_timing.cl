/* The parts of a step again and again on a scene that stands still (dt = 0), so that each can be
 * timed by itself: for `orzo bench`. Lists are renewed in small scenes only, by their one
 * work-group. */
#include "kernels/rods.cl"

#define OZ_REPEAT(name, ...)                                                                       \
    kernel void oz_repeat_##name(OZ_WORK_ARGUMENTS, int repeats)                                   \
    {                                                                                              \
        OZ_WORK_OPEN(0)                                                                            \
        OZ_WORK_AT(&w, w.control->step)                                                            \
        for (int k = 0; k < repeats; k++) {                                                        \
            __VA_ARGS__;                                                                           \
            OZ_WORK_BARRIER();                                                                     \
        }                                                                                          \
    }

OZ_REPEAT(pairs, oz_step_forces(&w, 0))
#if OZ_MOVES_BEFORE
OZ_REPEAT(grains, oz_step_before(&w, 0, 0); oz_step_finish(&w, 0, 0))
#else
OZ_REPEAT(grains, oz_step_finish(&w, 0, 0))
#endif
#if !OZ_RESORT
OZ_REPEAT(refresh, renew(&w))
OZ_REPEAT(rebuild, if (w.item == 0) w.control->outer_stale = 1; OZ_WORK_BARRIER(); renew(&w))
#endif
