/* The trigrains model: oz_advance makes many steps in one launch, one work-group a member. */
#include "kernels/element_beams.h"
#include "kernels/element_contacts.h"
#include "kernels/element_loads.h"
#include "kernels/element_move.h"
#if OZ_SUBSTEPS > 1
#include "kernels/element_substeps.h"
#endif

/* Sizes of the structs that both sides share. */
kernel void oz_layout(global int *sizes)
{
    sizes[0] = (int)sizeof(OzElementParameters);
    sizes[1] = (int)sizeof(OzElementControl);
    sizes[2] = (int)sizeof(OzElementSizes);
    sizes[3] = (int)sizeof(scalar);
    sizes[4] = OZ_LANES;
}

/* The outer list anew; 0 when it was too small. */
OZ_INLINE int rebuild(OzElementWork *w)
{
    oz_element_lists_refer(w);
    oz_element_cells_clear(w);
    OZ_ELEMENT_BARRIER();
    oz_element_cells_bin(w);
    OZ_ELEMENT_BARRIER();
    if (w->item == 0) {
        oz_element_cells_scan(w);
    }
    OZ_ELEMENT_BARRIER();
    oz_element_cells_fill(w);
    OZ_ELEMENT_BARRIER();
    OZ_EACH(w, region, w->z.regions)
    {
        oz_element_lists_search(w, region);
    }
    OZ_ELEMENT_BARRIER();
    int holds = !w->control->full;
    OZ_ELEMENT_BARRIER();
    if (w->item == 0 && holds) {
        w->control->outer_holds = 1;
        w->control->rebuilds++;
    }
    OZ_ELEMENT_BARRIER();
    return holds;
}

/* The inner list anew; 0 when it was too small. */
OZ_INLINE int refresh(OzElementWork *w)
{
#if OZ_GROUP > 1
    oz_element_lists_reset(w);
    OZ_ELEMENT_BARRIER();
#endif
    OZ_EACH(w, region, w->z.regions)
    {
        oz_element_lists_select(w, region);
    }
    OZ_ELEMENT_BARRIER();
#if OZ_GROUP > 1
    oz_element_lists_order(w);
    OZ_ELEMENT_BARRIER();
#endif
    int holds = !w->control->full;
    OZ_ELEMENT_BARRIER();
    if (w->item == 0 && holds) {
        w->control->inner_holds = 1;
        w->control->refreshes++;
    }
    OZ_ELEMENT_BARRIER();
    return holds;
}

/* Makes the lists hold again. 0 when one is full and the launch must end. */
OZ_INLINE int renew(OzElementWork *w)
{
    oz_element_lists_measure(w);
    OZ_ELEMENT_BARRIER();
    int holds = w->control->outer_holds;
    OZ_ELEMENT_BARRIER();
    if (!holds) {
        holds = rebuild(w);
    }
    if (holds) {
        holds = refresh(w);
    }
    return holds;
}

/* Forces where elements are predicted; the lists hold. */
OZ_INLINE void push(OzElementWork *w, int step)
{
    OzElementSums sums;
    oz_element_sums_clear(&sums);
    OZ_EACH(w, region, w->z.regions)
    {
        oz_element_contacts_classify(w, region);
        oz_element_contacts_push(w, region, step, &sums);
    }
#if OZ_SUBSTEPS == 1
    if (OZ_BEAMS) {
        oz_element_beams_pull(w, step, &sums);
    }
#endif
#if OZ_LEDGER
    oz_element_sums_add(w, &sums);
#endif
    OZ_ELEMENT_BARRIER();
#if OZ_SUBSTEPS == 1
    oz_element_loads_contacts(w, w->load);
    if (OZ_BEAMS) {
        oz_element_loads_beams(w, w->load);
    }
#else
    oz_element_loads_contacts(w, w->slow_load);
#endif
    OZ_ELEMENT_BARRIER();
}

/* Elements to where the forces of a step are wanted. */
OZ_INLINE void move(OzElementWork *w, int step)
{
#if OZ_SUBSTEPS == 1
    oz_element_move_predict(w, step);
#else
    oz_element_substeps_run(w, step);
#endif
}

/* Ends a step, and moves elements for the next where that can be done with it; 1 when it was. */
OZ_INLINE int finish(OzElementWork *w, int step, int goes_on)
{
#if OZ_SUBSTEPS == 1
    oz_element_move_correct(w, step, goes_on);
    return goes_on;
#else
    oz_element_substeps_end(w, step);
    return 0;
#endif
}

#if OZ_GROUP > 1
#define OZ_ELEMENT_KERNEL __attribute__((reqd_work_group_size(OZ_GROUP, 1, 1))) kernel
#else
#define OZ_ELEMENT_KERNEL kernel
#endif

/* Walls' elements to where they are at the launch's first step; all records are made there. */
OZ_ELEMENT_KERNEL void oz_begin(OZ_ELEMENT_ARGUMENTS)
{
    OZ_ELEMENT_OPEN((int)get_group_id(0))
    real inverse_dt = REAL(1.0) / REAL(w.parameters->dt);
    OZ_EACH(&w, block, w.z.blocks)
    {
        real q[OZ_ELEMENT_STATE];
        for (int k = 0; k < OZ_ELEMENT_STATE; k++) {
            q[k] = w.state[(size_t)block * OZ_ELEMENT_STATE + k];
        }
        oz_element_move_label(&w, block);
        oz_element_move_record(&w, block, oz_element_move_body(q, inverse_dt));
    }
    if (OZ_MOVING) {
        OZ_ELEMENT_BARRIER();
        oz_element_move_walls(&w, 0);
    }
}

/* Makes the launch's steps from control->step to last, or ends earlier: control->step says how far
 * it came, and control->moved that the next step's places are moved already. */
OZ_ELEMENT_KERNEL void oz_advance(OZ_ELEMENT_ARGUMENTS, int last)
{
    OZ_ELEMENT_OPEN((int)get_group_id(0))
    int step = w.control->step, moved = w.control->moved;
    OZ_ELEMENT_BARRIER();
    for (;; step++) {
        int ends = w.control->stop_bits != 0 || step >= last;
        OZ_ELEMENT_BARRIER();
        if (!ends && !moved) {
            move(&w, step);
        }
        if (OZ_MOVING && !ends) {
            oz_element_move_walls(&w, step + 1);
        }
        moved |= !ends;
        OZ_ELEMENT_BARRIER();
        int stale = !w.control->inner_holds;
        OZ_ELEMENT_BARRIER();
        if (stale && !ends) {
            ends = !renew(&w);
        }
        if (ends) {
            break;
        }
        push(&w, step);
        moved = step + 1 < last && !w.control->stop_bits;
        OZ_ELEMENT_BARRIER();
        moved = finish(&w, step, moved);
        OZ_ELEMENT_BARRIER();
    }
    if (w.item == 0) {
        w.control->step = step;
        w.control->moved = moved;
    }
}
