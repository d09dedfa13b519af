/* The rods model for large scenes: the same work as oz_advance, phase by phase, every work-item
 * looking after one region. The host puts many phases in the queue without waiting; a step's phases
 * do nothing when an earlier one found the lists stale or stopped, a list's phases when one was too
 * small. */
#include "kernels/motion.h"
#include "kernels/resort.h"
#if OZ_LEDGER
#include "kernels/ledger.h"
#endif
#include "kernels/share.h"

/* Opens the region of this work-item; `w` and `region` exist afterwards. */
#define OPEN_REGION                                                                                \
    OZ_WORK_OPEN(0)                                                                                \
    int region = (int)get_global_id(0);                                                            \
    if (region >= z.regions) {                                                                     \
        return;                                                                                    \
    }

/* A word that other work-items may mark in this very phase. */
OZ_INLINE int marked(global int *word)
{
    return atomic_or(word, 0);
}

/* Whether a step is to be made: no earlier one has stopped or used up the lists. What a work-item
 * marks in this step makes no difference to the others. */
OZ_INLINE int due(const OzWork *w, int step)
{
    return w->control->truth == OZ_SPRINGS_AT_INNER && marked(&w->control->stale_step) >= step &&
           marked(&w->control->stop_step) >= step && !w->control->full;
}

/* Whether the lists hold the places at which a step's forces are asked for. */
OZ_INLINE int due_forces(const OzWork *w, int step)
{
    return due(w, step) && marked(&w->control->stale_positions) > step;
}

#if OZ_MOVES_BEFORE
kernel void oz_before(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION
    if (due(&w, step) && marked(&w.control->stale_positions) >= step && !w.control->moved) {
        oz_motion_before_region(&w, region, step);
    }
}
#endif

kernel void oz_pairs(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION
    if (due_forces(&w, step)) {
        oz_pairs_region(&w, region, step);
    }
}

kernel void oz_grains(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION
    if (!due_forces(&w, step)) {
        return;
    }
    oz_motion_region(&w, region, step);
    if (region == 0) {
        w.control->step = step + 1;
        w.control->moved = 0;
    }
}

#if OZ_LEDGER
/* Runs after oz_grains in a step, so it asks whether that step was made, not whether it is still to
 * be made. */
kernel void oz_ledger(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION
    if (w.control->step == step + 1) {
        oz_ledger_region(&w, region, step);
    }
}
#endif

kernel void oz_measure(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION(void) step;
    oz_lists_measure(&w, region);
    if (w.control->truth == OZ_SPRINGS_AT_INNER) {
        oz_springs_harvest(&w, region);
    }
}

/* Sets where the springs are; by one work-item. */
kernel void oz_mark(OZ_WORK_ARGUMENTS, int truth)
{
    OZ_WORK_OPEN(0)
    if (get_global_id(0) != 0 || w.control->full) {
        return;
    }
    w.control->truth = truth;
    if (truth == OZ_SPRINGS_AT_OUTER) {
        w.control->outer_stale = 0;
    }
    if (truth == OZ_SPRINGS_AT_INNER) {
        w.control->stale_step = OZ_NEVER;
        w.control->stale_positions = OZ_NEVER;
    }
}

kernel void oz_save(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION(void) step;
    oz_springs_save(&w, region);
}

kernel void oz_clear(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION(void) step;
    oz_cells_clear(&w, region, w.z.regions);
}

kernel void oz_bin(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION(void) step;
    oz_cells_bin(&w, region);
}

kernel void oz_scan(OZ_WORK_ARGUMENTS, int step)
{
    OZ_WORK_OPEN(0)
    (void)step;
    if (get_global_id(0) == 0) {
        oz_cells_scan(&w);
    }
}

kernel void oz_fill(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION(void) step;
    oz_cells_fill(&w, region);
}

kernel void oz_arrange(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION(void) step;
    oz_cells_arrange(&w, region);
}

kernel void oz_move_out(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION(void) step;
    oz_resort_out(&w, region);
}

kernel void oz_move_in(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION(void) step;
    oz_resort_in(&w, region);
}

kernel void oz_search(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION(void) step;
    oz_lists_search(&w, region);
    oz_lists_refer(&w, region);
}

kernel void oz_restore(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION(void) step;
    if (!w.control->full && w.control->truth == OZ_SPRINGS_AT_SAVED) {
        oz_springs_restore(&w, region);
    }
}

kernel void oz_reset(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION(void) step;
    if (!w.control->full) {
        oz_lists_measure(&w, region);
        oz_lists_reset(&w, region);
    }
}

kernel void oz_select(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION(void) step;
    if (!w.control->full) {
        oz_lists_select(&w, region);
    }
}

kernel void oz_order(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION(void) step;
    oz_lists_order(&w, region);
}

kernel void oz_forget(OZ_WORK_ARGUMENTS, int step)
{
    OPEN_REGION(void) step;
    if (!w.control->full) {
        oz_springs_forget(&w, region);
    }
}
