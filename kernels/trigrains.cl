/* The trigrains model. */
#include "kernels/element_beams.h"
#include "kernels/element_contacts.h"
#include "kernels/element_impulse.h"
#include "kernels/element_loads.h"
#include "kernels/element_move.h"
#if OZ_SUBSTEPS > 1
#include "kernels/element_substeps.h"
#endif

#define OZ_STEP_BEFORE 1
#define OZ_STEP_AFTER  0

/* Elements to where the forces of a step are wanted, walls to its end. */
OZ_INLINE void oz_step_before(OzWork *w, int step, int moved)
{
    if (!moved) {
#if OZ_SUBSTEPS == 1
        oz_element_move_predict(w, step);
#else
        oz_element_substeps_run(w, step);
#endif
    }
    if (OZ_MOVING) {
        oz_element_move_walls(w, step + 1);
    }
}

/* Forces where elements are predicted; the lists hold. */
OZ_INLINE void oz_step_forces(OzWork *w, int step)
{
    OzElementSums sums;
    oz_element_sums_clear(&sums);
    OZ_EACH_REGION(w)
    {
        oz_element_contacts_classify(w, region);
        oz_element_contacts_push(w, region, step, &sums);
    }
#if OZ_SUBSTEPS == 1
    if (OZ_BEAMS) {
        oz_element_beams_pull(w, step, 1, &sums);
    }
#endif
#if OZ_LEDGER
    oz_element_sums_add(w, &sums);
#endif
}

OZ_INLINE void add_up(OzWork *w)
{
#if OZ_SUBSTEPS == 1
    oz_element_loads_contacts(w, w->load);
    if (OZ_BEAMS) {
        oz_element_loads_beams(w, w->load);
    }
#else
    oz_element_loads_contacts(w, w->slow_load);
#endif
}

/* Ends a step, and moves elements for the next where that can be done with it. */
OZ_INLINE int oz_step_finish(OzWork *w, int step, int last)
{
    int goes_on = OZ_SUBSTEPS == 1 && step + 1 < last && !w->control->stop_bits;
    add_up(w);
#if OZ_IMPULSES
    oz_element_impulse_step(w, step);
#endif
#if !OZ_RESORT
    OZ_WORK_BARRIER();
#endif
#if OZ_SUBSTEPS == 1
    oz_element_move_correct(w, step, goes_on);
#else
    oz_element_substeps_end(w, step);
#endif
    return goes_on;
}

#include "kernels/advance.h"

/* Walls' elements to where they are at the launch's first step; all records are made there. */
OZ_ADVANCE_KERNEL oz_begin(OZ_WORK_ARGUMENTS)
{
    OZ_WORK_OPEN(OZ_RESORT ? 0 : (int)get_group_id(0))
    real inverse_dt = REAL(1.0) / REAL(w.parameters->dt);
    OZ_EACH(&w, block, w.z.blocks)
    {
        real q[OZ_ELEMENT_STATE];
        oz_element_move_label(&w, block);
        oz_element_move_load(&w, block, q);
        if (!OZ_MOVING || block < w.z.free_blocks) {
            oz_element_move_record(&w, block, oz_element_move_body(&w, block, q, inverse_dt));
        }
    }
    if (OZ_MOVING) {
        oz_element_move_walls(&w, 0);
    }
}
