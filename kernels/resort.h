/* Putting grains into an order in which neighbours in space are neighbours in memory, so that tiles
 * are compact: cell by cell along Morton's curve (Morton 1966), which goes through each cube of
 * cells before the next. Out to the spare array in the new order, then back. OpenCL C only. */
#pragma once

#include "kernels/lists.h"
#include "kernels/near.h"

/* Words of a slot's springs at walls, tangential and rolling. */
#define OZ_RESORT_SPRINGS (OZ_HISTORY ? 3 * OZ_WALL_ENDS : 0)
#define OZ_RESORT_ROLLING (OZ_ROLLING_SPRING ? 3 * OZ_WALL_ENDS : 0)
#define OZ_RESORT_WALLS   (1 + OZ_STATE + OZ_SHAPE)

OZ_INLINE void oz_resort_out_words(global scalar *to, global const scalar *from, int slot,
                                   int words)
{
    for (int k = 0; k < words; k++) {
        to[k] = from[oz_lanes_at(slot, words, k)];
    }
}

OZ_INLINE void oz_resort_in_words(global scalar *to, global const scalar *from, int slot, int words)
{
    for (int k = 0; k < words; k++) {
        to[oz_lanes_at(slot, words, k)] = from[k];
    }
}

/* The next cell on the curve: its coordinates' bits, from the lowest on, take turns. */
OZ_INLINE void oz_resort_next(const OzWork *w, int *at)
{
    for (int bit = 1;; bit *= 2) {
        for (int k = 0; k < 3; k++) {
            if (bit < w->z.cells_along[k]) {
                at[k] ^= bit;
                if (at[k] & bit) {
                    return;
                }
            }
        }
        if (bit >= w->z.cells) {
            return; /* the last cell: all are back at zero */
        }
    }
}

/* The first new slot of each cell. */
OZ_INLINE void oz_resort_plan(OzWork *w)
{
    int at[3] = {0, 0, 0}, slot = 0;
    for (int k = 0; k < w->z.cells; k++) {
        int cell = oz_cells_index(w, at[0], at[1], at[2]);
        w->cell_slot[cell] = slot;
        slot += w->cell_first[cell + 1] - w->cell_first[cell];
        oz_resort_next(w, at);
    }
}

/* Grains out to their new slots, those of the region's places in the order of the grid's cells. */
OZ_INLINE void oz_resort_out(OzWork *w, int region)
{
    for (int k = oz_work_region_begin(w, region); k < oz_work_region_end(w, region); k++) {
        int from = w->sorted_slot[k], cell = w->cell_of[from];
        int slot = w->cell_slot[cell] + k - w->cell_first[cell];
        global scalar *to = w->spare + (size_t)slot * OZ_SPARE;
        w->sorted_slot[k] = slot;
        ((global int *)to)[0] = w->id[from];
        oz_resort_out_words(to + 1, (global const scalar *)w->state, from, OZ_STATE);
        if (!OZ_EQUAL) {
            oz_resort_out_words(to + 1 + OZ_STATE, (global const scalar *)w->shape, from, OZ_SHAPE);
        }
        to += OZ_RESORT_WALLS;
        oz_resort_out_words(to, (global const scalar *)w->wall_history, from, OZ_RESORT_SPRINGS);
        to += OZ_RESORT_SPRINGS;
        oz_resort_out_words(to, (global const scalar *)w->wall_rolling, from, OZ_RESORT_ROLLING);
        to += OZ_RESORT_ROLLING;
        oz_resort_out_words(to, (global const scalar *)w->mesh_memory, from, OZ_MESH_WORDS);
    }
}

/* The region's records and references, from its grains. */
OZ_INLINE void oz_resort_records(OzWork *w, int region)
{
    real dt = REAL(w->parameters->dt);
    for (int block = oz_work_block_begin(w, region); block < oz_work_block_end(w, region);
         block++) {
        OzBody body = oz_grains_load(w, block);
        OzShape shape = oz_grains_shape(w, block);
        oz_grains_record(w, 0, block, body, shape, oz_integrate_seen_velocity(body, dt),
                         oz_integrate_seen_spin(body, shape, dt));
        oz_lists_refer_block(w, block);
    }
}

/* The grains that oz_resort_out has put aside, into the region's slots. */
OZ_INLINE void oz_resort_in(OzWork *w, int region)
{
    for (int slot = oz_work_region_begin(w, region); slot < oz_work_region_end(w, region); slot++) {
        global const scalar *from = w->spare + (size_t)slot * OZ_SPARE;
        int id = ((global const int *)from)[0];
        w->id[slot] = id;
        w->slot_of[id] = slot;
        oz_resort_in_words((global scalar *)w->state, from + 1, slot, OZ_STATE);
        if (!OZ_EQUAL) {
            oz_resort_in_words((global scalar *)w->shape, from + 1 + OZ_STATE, slot, OZ_SHAPE);
        }
        from += OZ_RESORT_WALLS;
        oz_resort_in_words((global scalar *)w->wall_history, from, slot, OZ_RESORT_SPRINGS);
        from += OZ_RESORT_SPRINGS;
        oz_resort_in_words((global scalar *)w->wall_rolling, from, slot, OZ_RESORT_ROLLING);
        from += OZ_RESORT_ROLLING;
        oz_resort_in_words((global scalar *)w->mesh_memory, from, slot, OZ_MESH_WORDS);
    }
    for (int k = oz_work_block_begin(w, region) * OZ_WALL_ENDS;
         k < oz_work_block_end(w, region) * OZ_WALL_ENDS; k++) {
        w->wall_active[k] = -1; /* any may have a spring */
    }
    oz_resort_records(w, region);
}
