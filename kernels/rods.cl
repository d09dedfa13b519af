/* The rods model. */
#include "kernels/motion.h"
#include "kernels/resort.h"
#if OZ_LEDGER
#include "kernels/ledger.h"
#endif

#define OZ_STEP_BEFORE OZ_MOVES_BEFORE
#define OZ_STEP_AFTER  OZ_LEDGER
#define OZ_STEP_SUMS   (OZ_SERVOS > 0)

#if OZ_MOVES_BEFORE
OZ_INLINE void oz_step_before(OzWork *w, int step, int moved)
{
    OZ_EACH_REGION(w)
    {
        if (!moved) {
            oz_motion_before_region(w, region, step);
        }
    }
#if OZ_SERVOS > 0
    if (!moved && w->item == 0) {
        oz_servo_move_before(w, step);
    }
#endif
}
#endif

OZ_INLINE void oz_step_forces(OzWork *w, int step)
{
    OZ_EACH_REGION(w)
    {
        oz_pairs_region(w, region, step);
    }
}

OZ_INLINE int oz_step_finish(OzWork *w, int step, int last)
{
    OZ_EACH_REGION(w)
    {
        oz_motion_region(w, region, step);
    }
#if OZ_SERVOS > 0 && !OZ_RESORT
    OZ_WORK_BARRIER();
    oz_servo_sum(w);
    OZ_WORK_BARRIER();
    if (w->item == 0) {
        oz_servo_move(w, step);
    }
#endif
    return 0;
}

#if OZ_TILES
OZ_INLINE void oz_step_tiles(OzWork *w, int step)
{
    OZ_EACH_REGION(w)
    {
        oz_pairs_region(w, region, step);
        oz_motion_region(w, region, step);
    }
}
#endif

#if OZ_RESORT && OZ_STEP_SUMS
OZ_INLINE void oz_step_sum(OzWork *w)
{
    oz_servo_sum(w);
}

OZ_INLINE void oz_step_total(OzWork *w, int step)
{
    oz_servo_move(w, step);
}
#endif

#if OZ_LEDGER
OZ_INLINE void oz_step_after(OzWork *w, int step)
{
    OZ_EACH_REGION(w)
    {
        oz_ledger_region(w, region, step);
    }
}
#endif

#include "kernels/advance.h"
