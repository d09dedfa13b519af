/* The steps of every model: the lists kept up to date, forces, motion. For small scenes oz_advance
 * makes many steps in one launch, one work-group a member. For large ones (OZ_RESORT) the same work
 * is a kernel for each phase, spread over all work-items: the host puts many phases in the queue
 * without waiting; a step's phases do nothing when an earlier one found the lists stale or stopped,
 * a list's phases when one was too small. A model says before:
 * OZ_STEP_BEFORE, oz_step_before(w, step, moved): bodies (unless moved already) and walls to where
 * a step's forces are wanted, if that is before them;
 * oz_step_forces(w, step): what pairs do;
 * oz_step_finish(w, step, last): motion by these; 1 when bodies are moved for the next step too,
 * which is not `last`;
 * OZ_STEP_SUMS, in large scenes oz_step_sum(w) and one work-item's oz_step_total(w, step): sums
 * over all bodies, when all have moved; OZ_STEP_AFTER, oz_step_after(w, step): what is left to do
 * when all have moved; with OZ_TILES, oz_step_tiles(w, step): forces and motion, tile by tile;
 * bodies are put in the order of cells (resort.h). OpenCL C only. */
#pragma once

#include "kernels/lists.h"

/* A kernel of small scenes for all members, one work-group each. */
#if OZ_GROUP > 1 && !OZ_RESORT
#define OZ_ADVANCE_KERNEL __attribute__((reqd_work_group_size(OZ_GROUP, 1, 1))) kernel void
#else
#define OZ_ADVANCE_KERNEL kernel void
#endif

#if OZ_RESORT

/* The host gives each phase one number: a step, or for oz_mark where the springs are. */
#define OZ_PHASE(name, ...)                                                                        \
    kernel void oz_##name(OZ_WORK_ARGUMENTS, int number)                                           \
    {                                                                                              \
        OZ_WORK_OPEN(0)                                                                            \
        OZ_WORK_AT(&w, w.control->step)                                                            \
        OZ_WORK_PLACES(&w, w.control->step + w.control->moved);                                    \
        (void)number;                                                                              \
        __VA_ARGS__;                                                                               \
    }

/* A phase of a step. */
#define OZ_STEP_PHASE(name, at, ...)                                                               \
    kernel void oz_##name(OZ_WORK_ARGUMENTS, int number)                                           \
    {                                                                                              \
        OZ_WORK_OPEN(0)                                                                            \
        OZ_WORK_AT(&w, at)                                                                         \
        __VA_ARGS__;                                                                               \
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

/* The step is made. */
OZ_INLINE void end_step(OzWork *w, int step)
{
    if (w->item == 0) {
        w->control->step = step + 1;
        w->control->moved = 0;
    }
}

/* Notes where the springs are now. */
OZ_INLINE void mark(OzWork *w, int truth)
{
    w->control->truth = truth;
    if (truth == OZ_SPRINGS_AT_OUTER) {
        w->control->outer_stale = 0;
    }
    if (truth == OZ_SPRINGS_AT_INNER) {
        w->control->stale_step = OZ_NEVER;
        w->control->stale_positions = OZ_NEVER;
    }
}

#if OZ_STEP_BEFORE
OZ_STEP_PHASE(
    before, number, if (due(&w, number) && marked(&w.control->stale_positions) >= number) {
        oz_step_before(&w, number, w.control->moved);
    })
#endif
#if OZ_TILES
OZ_STEP_PHASE(
    tiles, number, if (due_forces(&w, number)) {
        oz_step_tiles(&w, number);
        end_step(&w, number);
    })
#else
OZ_STEP_PHASE(pairs, number, if (due_forces(&w, number)) oz_step_forces(&w, number))
OZ_STEP_PHASE(
    grains, number, if (due_forces(&w, number)) {
        oz_step_finish(&w, number, number);
        end_step(&w, number);
    })
#endif
#if OZ_STEP_SUMS
/* These too ask whether that step was made; one work-item's is the second. */
OZ_STEP_PHASE(sum, number + 1, if (w.control->step == number + 1) oz_step_sum(&w))
OZ_STEP_PHASE(total, number + 1,
              if (w.control->step == number + 1 && w.item == 0) oz_step_total(&w, number))
#endif
#if OZ_STEP_AFTER
/* It asks whether that step was made, not whether it is still to be made. */
OZ_STEP_PHASE(after, number + 1, if (w.control->step == number + 1) oz_step_after(&w, number))
#endif
OZ_PHASE(measure, oz_lists_measure(&w); if (w.control->truth == OZ_SPRINGS_AT_INNER)
             OZ_EACH_REGION(&w) oz_springs_harvest(&w, region))
OZ_PHASE(mark, if (w.item == 0 && !w.control->full) mark(&w, number))
OZ_PHASE(save, OZ_EACH_REGION(&w) oz_springs_save(&w, region))
OZ_PHASE(clear, oz_lists_refer(&w); oz_cells_clear(&w))
OZ_PHASE(bin, oz_cells_bin(&w))
OZ_PHASE(scan, if (w.item == 0) oz_cells_scan(&w))
OZ_PHASE(fill, oz_cells_fill(&w))
OZ_PHASE(arrange, oz_cells_arrange(&w))
#if OZ_TILES
OZ_PHASE(plan, if (w.item == 0) oz_resort_plan(&w))
OZ_PHASE(move_out, OZ_EACH_REGION(&w) oz_resort_out(&w, region))
OZ_PHASE(move_in, OZ_EACH_REGION(&w) oz_resort_in(&w, region))
#endif
OZ_PHASE(search, OZ_EACH_REGION(&w) oz_search_region(&w, region))
OZ_PHASE(restore, if (!w.control->full && w.control->truth == OZ_SPRINGS_AT_SAVED)
                      OZ_EACH_REGION(&w) oz_springs_restore(&w, region))
OZ_PHASE(
    reset, if (!w.control->full) {
        oz_lists_measure(&w);
        oz_lists_reset(&w);
    })
OZ_PHASE(select, if (!w.control->full) OZ_EACH_REGION(&w) oz_lists_select(&w, region))
OZ_PHASE(order, oz_lists_order(&w))
OZ_PHASE(forget, if (!w.control->full) OZ_EACH_REGION(&w) oz_springs_forget(&w, region))

#else

/* Barriers (OZ_WORK_BARRIER) stand outside of conditions wherever that is possible: after a barrier
 * inside a condition a CPU driver compiles the rest of the kernel twice, once for each outcome. */

/* The inner list anew; 0 when a list was too small. */
OZ_INLINE int refresh(OzWork *w)
{
    oz_lists_reset(w);
    OZ_WORK_BARRIER();
    OZ_EACH_REGION(w)
    {
        oz_lists_select(w, region);
    }
    OZ_WORK_BARRIER();
    oz_lists_order(w);
    OZ_WORK_BARRIER();
    int holds = !w->control->full;
    OZ_WORK_BARRIER();
    if (holds) {
        OZ_EACH_REGION(w)
        {
            oz_springs_forget(w, region);
        }
        if (w->item == 0) {
            w->control->truth = OZ_SPRINGS_AT_INNER;
            w->control->stale_step = OZ_NEVER;
            w->control->refreshes++;
        }
    }
    OZ_WORK_BARRIER();
    return holds;
}

/* The outer list anew; 0 when it was too small. */
OZ_INLINE int rebuild(OzWork *w)
{
    int truth = w->control->truth;
    OZ_WORK_BARRIER();
    if (truth == OZ_SPRINGS_AT_OUTER) {
        OZ_EACH_REGION(w)
        {
            oz_springs_save(w, region);
        }
    }
    oz_lists_refer(w);
    oz_cells_clear(w);
    OZ_WORK_BARRIER();
    if (w->item == 0 && truth == OZ_SPRINGS_AT_OUTER) {
        w->control->truth = OZ_SPRINGS_AT_SAVED;
    }
    oz_cells_bin(w);
    OZ_WORK_BARRIER();
    if (w->item == 0) {
        oz_cells_scan(w);
    }
    OZ_WORK_BARRIER();
    oz_cells_fill(w);
    OZ_WORK_BARRIER();
    oz_cells_arrange(w);
    OZ_WORK_BARRIER();
    OZ_EACH_REGION(w)
    {
        oz_search_region(w, region);
    }
    OZ_WORK_BARRIER();
    int holds = !w->control->full;
    if (holds && truth != OZ_SPRINGS_AT_NONE) {
        OZ_EACH_REGION(w)
        {
            oz_springs_restore(w, region);
        }
    }
    OZ_WORK_BARRIER();
    if (w->item == 0 && holds) {
        w->control->truth = OZ_SPRINGS_AT_OUTER;
        w->control->outer_stale = 0;
        w->control->rebuilds++;
    }
    OZ_WORK_BARRIER();
    return holds;
}

/* Makes the lists hold again. 0 when one is full (or made by the host) and the launch must end. */
OZ_INLINE int renew(OzWork *w)
{
    int truth = w->control->truth;
    OZ_WORK_BARRIER();
    oz_lists_measure(w);
    if (truth == OZ_SPRINGS_AT_INNER) {
        OZ_EACH_REGION(w)
        {
            oz_springs_harvest(w, region);
        }
        if (w->item == 0) {
            w->control->truth = OZ_SPRINGS_AT_OUTER;
        }
    }
    OZ_WORK_BARRIER();
    int holds = w->control->truth == OZ_SPRINGS_AT_OUTER && !w->control->outer_stale;
    OZ_WORK_BARRIER();
#if !OZ_HOST_LISTS
    if (!holds) {
        holds = rebuild(w);
    }
#endif
    if (holds) {
        holds = refresh(w);
    }
    return holds;
}

/* Saves the tangential springs by the ids of their pairs, where a change of the lists' sizes leaves
 * them alone. The lists must be made again afterwards. */
OZ_ADVANCE_KERNEL oz_save_springs(OZ_WORK_ARGUMENTS)
{
    OZ_WORK_OPEN((int)get_group_id(0))
    OZ_WORK_PLACES(&w, w.control->step + w.control->moved);
    int truth = w.control->truth;
    OZ_WORK_BARRIER();
    OZ_EACH_REGION(&w)
    {
        if (truth == OZ_SPRINGS_AT_INNER) {
            oz_springs_harvest(&w, region);
        }
        if (truth == OZ_SPRINGS_AT_INNER || truth == OZ_SPRINGS_AT_OUTER) {
            oz_springs_save(&w, region);
        }
    }
    if (w.item == 0 && truth != OZ_SPRINGS_AT_NONE) {
        w.control->truth = OZ_SPRINGS_AT_SAVED;
    }
}

/* Makes the launch's steps from control->step to last and leaves lists that hold, or ends earlier:
 * control->step says how far it came, and control->moved that the next step's places are moved
 * already. */
OZ_ADVANCE_KERNEL oz_advance(OZ_WORK_ARGUMENTS, int last)
{
    OZ_WORK_OPEN((int)get_group_id(0))
    int step = w.control->step, moved = w.control->moved;
    OZ_WORK_BARRIER();
    for (;; step++) {
        int ends = w.control->stop_bits != 0;
        OZ_WORK_BARRIER();
#if OZ_STEP_BEFORE
        if (step < last && !ends) {
            oz_step_before(&w, step, moved);
            moved = 1;
        }
        OZ_WORK_BARRIER();
#endif
        OZ_WORK_PLACES(&w, step + moved);
        int stale = w.control->stale_step != OZ_NEVER || w.control->truth != OZ_SPRINGS_AT_INNER;
        OZ_WORK_BARRIER();
        if (stale && !ends) {
            ends = !renew(&w);
        }
        if (ends || step >= last) {
            break;
        }
        oz_step_forces(&w, step);
        OZ_WORK_BARRIER();
        moved = oz_step_finish(&w, step, last);
        OZ_WORK_BARRIER();
#if OZ_STEP_AFTER
        oz_step_after(&w, step);
        OZ_WORK_BARRIER();
#endif
    }
    if (w.item == 0) {
        w.control->step = step;
        w.control->moved = moved;
    }
}

#endif
