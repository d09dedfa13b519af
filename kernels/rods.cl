/* The rods model for small scenes: oz_advance makes many steps in one launch, one work-group a
 * member. */
#include "kernels/lists.h"
#include "kernels/motion.h"
#if OZ_LEDGER
#include "kernels/ledger.h"
#endif

#include "kernels/share.h"

#define EACH_REGION for (int region = item; region < w->z.regions; region += stride)

/* Barriers (OZ_WORK_BARRIER) stand outside of conditions wherever that is possible: after a barrier
 * inside a condition a CPU driver compiles the rest of the kernel twice, once for each outcome. */

/* The inner list anew; 0 when a list was too small. */
OZ_INLINE int refresh(OzWork *w, int item, int stride)
{
    EACH_REGION
    {
        oz_lists_reset(w, region);
    }
    OZ_WORK_BARRIER();
    EACH_REGION
    {
        oz_lists_select(w, region);
    }
    OZ_WORK_BARRIER();
    EACH_REGION
    {
        oz_lists_order(w, region);
    }
    OZ_WORK_BARRIER();
    int holds = !w->control->full;
    OZ_WORK_BARRIER();
    if (holds) {
        EACH_REGION
        {
            oz_springs_forget(w, region);
        }
        if (item == 0) {
            w->control->truth = OZ_SPRINGS_AT_INNER;
            w->control->stale_step = OZ_NEVER;
            w->control->refreshes++;
        }
    }
    OZ_WORK_BARRIER();
    return holds;
}

/* The outer list anew; 0 when it was too small. */
OZ_INLINE int rebuild(OzWork *w, int item, int stride)
{
    int truth = w->control->truth;
    OZ_WORK_BARRIER();
    if (truth == OZ_SPRINGS_AT_OUTER) {
        EACH_REGION
        {
            oz_springs_save(w, region);
        }
    }
    oz_cells_clear(w, item, stride);
    OZ_WORK_BARRIER();
    if (item == 0 && truth == OZ_SPRINGS_AT_OUTER) {
        w->control->truth = OZ_SPRINGS_AT_SAVED;
    }
    EACH_REGION
    {
        oz_cells_bin(w, region);
    }
    OZ_WORK_BARRIER();
    if (item == 0) {
        oz_cells_scan(w);
    }
    OZ_WORK_BARRIER();
    EACH_REGION
    {
        oz_cells_fill(w, region);
    }
    OZ_WORK_BARRIER();
    EACH_REGION
    {
        oz_cells_arrange(w, region);
    }
    OZ_WORK_BARRIER();
    EACH_REGION
    {
        oz_lists_search(w, region);
    }
    OZ_WORK_BARRIER();
    int holds = !w->control->full;
    if (holds && truth != OZ_SPRINGS_AT_NONE) {
        EACH_REGION
        {
            oz_springs_restore(w, region);
        }
    }
    if (holds) {
        EACH_REGION
        {
            oz_lists_refer(w, region);
        }
    }
    OZ_WORK_BARRIER();
    if (item == 0 && holds) {
        w->control->truth = OZ_SPRINGS_AT_OUTER;
        w->control->outer_stale = 0;
        w->control->rebuilds++;
    }
    OZ_WORK_BARRIER();
    return holds;
}

/* Makes the lists hold again. 0 when one is full (or made by the host) and the launch must end. */
OZ_INLINE int renew(OzWork *w, int item, int stride)
{
    int truth = w->control->truth;
    OZ_WORK_BARRIER();
    EACH_REGION
    {
        oz_lists_measure(w, region);
        if (truth == OZ_SPRINGS_AT_INNER) {
            oz_springs_harvest(w, region);
        }
    }
    if (item == 0 && truth == OZ_SPRINGS_AT_INNER) {
        w->control->truth = OZ_SPRINGS_AT_OUTER;
    }
    OZ_WORK_BARRIER();
    int holds = w->control->truth == OZ_SPRINGS_AT_OUTER && !w->control->outer_stale;
    OZ_WORK_BARRIER();
#if !OZ_HOST_LISTS
    if (!holds) {
        holds = rebuild(w, item, stride);
    }
#endif
    if (holds) {
        holds = refresh(w, item, stride);
    }
    return holds;
}

/* One step; the lists hold. */
OZ_INLINE void forces_and_motion(OzWork *w, int item, int stride, int step)
{
    EACH_REGION
    {
        oz_pairs_region(w, region, step);
    }
    OZ_WORK_BARRIER();
    EACH_REGION
    {
        oz_motion_region(w, region, step);
    }
    OZ_WORK_BARRIER();
#if OZ_LEDGER
    EACH_REGION
    {
        oz_ledger_region(w, region, step);
    }
    OZ_WORK_BARRIER();
#endif
}

#if OZ_MOVES_BEFORE
OZ_INLINE void move_before(OzWork *w, int item, int stride, int step)
{
    EACH_REGION
    {
        oz_motion_before_region(w, region, step);
    }
}
#endif

/* Saves the tangential springs by the ids of their pairs, where a change of the lists' sizes leaves
 * them alone. The lists must be made again afterwards. */
OZ_INLINE void save_springs(OzWork *w, int item, int stride)
{
    int truth = w->control->truth;
    OZ_WORK_BARRIER();
    EACH_REGION
    {
        if (truth == OZ_SPRINGS_AT_INNER) {
            oz_springs_harvest(w, region);
        }
        if (truth == OZ_SPRINGS_AT_INNER || truth == OZ_SPRINGS_AT_OUTER) {
            oz_springs_save(w, region);
        }
    }
    if (item == 0 && truth != OZ_SPRINGS_AT_NONE) {
        w->control->truth = OZ_SPRINGS_AT_SAVED;
    }
}

#if OZ_GROUP > 1
__attribute__((reqd_work_group_size(OZ_GROUP, 1, 1)))
#endif
kernel void
oz_save_springs(OZ_WORK_ARGUMENTS)
{
    OZ_WORK_OPEN((int)get_group_id(0))
    save_springs(&w, OZ_WORK_ITEM, OZ_WORK_STRIDE);
}

/* Makes the launch's steps from control->step to last and leaves lists that hold, or ends earlier:
 * control->step says how far it came, and control->moved that the next step's places are moved
 * already. */
#if OZ_GROUP > 1
__attribute__((reqd_work_group_size(OZ_GROUP, 1, 1)))
#endif
kernel void
oz_advance(OZ_WORK_ARGUMENTS, int last)
{
    OZ_WORK_OPEN((int)get_group_id(0))
    int item = OZ_WORK_ITEM, stride = OZ_WORK_STRIDE, step = w.control->step;
    int moved = w.control->moved;
    OZ_WORK_BARRIER();
    for (;; step++) {
        int ends = w.control->stop_bits != 0;
        OZ_WORK_BARRIER();
#if OZ_MOVES_BEFORE
        if (step < last && !ends && !moved) {
            move_before(&w, item, stride, step);
            moved = 1;
        }
        OZ_WORK_BARRIER();
#endif
        int stale = w.control->stale_step != OZ_NEVER || w.control->truth != OZ_SPRINGS_AT_INNER;
        OZ_WORK_BARRIER();
        if (stale && !ends) {
            ends = !renew(&w, item, stride);
        }
        if (ends || step >= last) {
            break;
        }
        forces_and_motion(&w, item, stride, step);
        moved = 0;
    }
    if (item == 0) {
        w.control->step = step;
        w.control->moved = moved;
    }
}
