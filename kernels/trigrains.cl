/* The trigrains model: oz_advance makes many steps in one launch, one work-group a member. */
#include "kernels/piece_beams.h"
#include "kernels/piece_contacts.h"
#include "kernels/piece_loads.h"
#include "kernels/piece_move.h"
#if OZ_SUBSTEPS > 1
#include "kernels/piece_substeps.h"
#endif

/* Sizes of the structs that both sides share. */
kernel void oz_layout(global int *sizes)
{
    sizes[0] = (int)sizeof(OzPieceParameters);
    sizes[1] = (int)sizeof(OzPieceControl);
    sizes[2] = (int)sizeof(OzPieceSizes);
    sizes[3] = (int)sizeof(scalar);
    sizes[4] = OZ_LANES;
}

/* The outer list anew; 0 when it was too small. */
OZ_INLINE int rebuild(OzPieceWork *w)
{
    oz_piece_lists_refer(w);
    oz_piece_cells_clear(w);
    OZ_PIECE_MEET();
    oz_piece_cells_bin(w);
    OZ_PIECE_MEET();
    if (w->item == 0) {
        oz_piece_cells_scan(w);
    }
    OZ_PIECE_MEET();
    oz_piece_cells_fill(w);
    OZ_PIECE_MEET();
    OZ_EACH(w, region, w->z.regions)
    {
        oz_piece_lists_search(w, region);
    }
    OZ_PIECE_MEET();
    int holds = !w->control->full;
    OZ_PIECE_MEET();
    if (w->item == 0 && holds) {
        w->control->outer_holds = 1;
        w->control->rebuilds++;
    }
    OZ_PIECE_MEET();
    return holds;
}

/* The inner list anew; 0 when it was too small. */
OZ_INLINE int refresh(OzPieceWork *w)
{
#if OZ_GROUP > 1
    oz_piece_lists_reset(w);
    OZ_PIECE_MEET();
#endif
    OZ_EACH(w, region, w->z.regions)
    {
        oz_piece_lists_select(w, region);
    }
    OZ_PIECE_MEET();
#if OZ_GROUP > 1
    oz_piece_lists_order(w);
    OZ_PIECE_MEET();
#endif
    int holds = !w->control->full;
    OZ_PIECE_MEET();
    if (w->item == 0 && holds) {
        w->control->inner_holds = 1;
        w->control->refreshes++;
    }
    OZ_PIECE_MEET();
    return holds;
}

/* Makes the lists hold again. 0 when one is full and the launch must end. */
OZ_INLINE int renew(OzPieceWork *w)
{
    oz_piece_lists_measure(w);
    OZ_PIECE_MEET();
    int holds = w->control->outer_holds;
    OZ_PIECE_MEET();
    if (!holds) {
        holds = rebuild(w);
    }
    if (holds) {
        holds = refresh(w);
    }
    return holds;
}

/* Forces where pieces are predicted; the lists hold. */
OZ_INLINE void push(OzPieceWork *w, int step)
{
    OzPieceSums sums;
    oz_piece_sums_clear(&sums);
    OZ_EACH(w, region, w->z.regions)
    {
        oz_piece_contacts_classify(w, region);
        oz_piece_contacts_push(w, region, step, &sums);
    }
#if OZ_SUBSTEPS == 1
    if (OZ_BEAMS) {
        oz_piece_beams_pull(w, step, &sums);
    }
#endif
#if OZ_LEDGER
    oz_piece_sums_add(w, &sums);
#endif
    OZ_PIECE_MEET();
#if OZ_SUBSTEPS == 1
    oz_piece_loads_contacts(w, w->load);
    if (OZ_BEAMS) {
        oz_piece_loads_beams(w, w->load);
    }
#else
    oz_piece_loads_contacts(w, w->slow_load);
#endif
    OZ_PIECE_MEET();
}

/* Pieces to where the forces of a step are wanted. */
OZ_INLINE void move(OzPieceWork *w, int step)
{
#if OZ_SUBSTEPS == 1
    oz_piece_move_predict(w, step);
#else
    oz_piece_substeps_run(w, step);
#endif
}

/* Ends a step, and moves pieces for the next where that can be done with it; 1 when it was. */
OZ_INLINE int finish(OzPieceWork *w, int step, int goes_on)
{
#if OZ_SUBSTEPS == 1
    oz_piece_move_correct(w, step, goes_on);
    return goes_on;
#else
    oz_piece_substeps_end(w, step);
    return 0;
#endif
}

#if OZ_GROUP > 1
#define OZ_PIECE_KERNEL __attribute__((reqd_work_group_size(OZ_GROUP, 1, 1))) kernel
#else
#define OZ_PIECE_KERNEL kernel
#endif

/* Walls' pieces to where they are at the launch's first step; all records are made there. */
OZ_PIECE_KERNEL void oz_begin(OZ_PIECE_ARGUMENTS)
{
    OZ_PIECE_OPEN((int)get_group_id(0))
    real inverse_dt = REAL(1.0) / REAL(w.parameters->dt);
    OZ_EACH(&w, block, w.z.blocks)
    {
        real q[OZ_PIECE_STATE];
        for (int k = 0; k < OZ_PIECE_STATE; k++) {
            q[k] = w.state[(size_t)block * OZ_PIECE_STATE + k];
        }
        oz_piece_move_label(&w, block);
        oz_piece_move_record(&w, block, oz_piece_move_body(q, inverse_dt));
    }
    if (OZ_MOVING) {
        OZ_PIECE_MEET();
        oz_piece_move_walls(&w, 0);
    }
}

/* Makes the launch's steps from control->step to last, or ends earlier: control->step says how far it came, and
 * control->moved that the next step's places are moved already. */
OZ_PIECE_KERNEL void oz_advance(OZ_PIECE_ARGUMENTS, int last)
{
    OZ_PIECE_OPEN((int)get_group_id(0))
    int step = w.control->step, moved = w.control->moved;
    OZ_PIECE_MEET();
    for (;; step++) {
        int ends = w.control->stop_bits != 0 || step >= last;
        OZ_PIECE_MEET();
        if (!ends && !moved) {
            move(&w, step);
        }
        if (OZ_MOVING && !ends) {
            oz_piece_move_walls(&w, step + 1);
        }
        moved |= !ends;
        OZ_PIECE_MEET();
        int stale = !w.control->inner_holds;
        OZ_PIECE_MEET();
        if (stale && !ends) {
            ends = !renew(&w);
        }
        if (ends) {
            break;
        }
        push(&w, step);
        moved = step + 1 < last && !w.control->stop_bits;
        OZ_PIECE_MEET();
        moved = finish(&w, step, moved);
        OZ_PIECE_MEET();
    }
    if (w.item == 0) {
        w.control->step = step;
        w.control->moved = moved;
    }
}
