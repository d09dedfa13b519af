/* The hashed grid: bodies counted into cells and laid out in the order of cells, after them those
 * that reach too far for the cells, which everybody looks at. Cell coordinates wrap around, so
 * space is unbounded; a distance test tells apart what shares a cell. What a body is, a model's
 * near.h or element_near.h says: OZ_NEAR_SLOTS(w) slots may hold one, oz_near_listed of them do;
 * its place in OZ_DIMENSIONS words of kind place_kind, in OZ_NEAR_UNIT(w) m; its reach, m;
 * OZ_NEAR_IS_LARGE(w, slot). OpenCL C only. */
#pragma once

#include "kernels/member.h"

/* Cell coordinate of a place's coordinate; unbounded, wrapped only where it becomes an index. */
OZ_INLINE int oz_cells_of(const OzWork *w, place_kind place)
{
    return (int)floor((scalar)place * OZ_NEAR_UNIT(w) * w->parameters->inverse_cell);
}

#if OZ_DIMENSIONS == 3
/* Cells of the grid's second axis that are gone through before the next of the third: bodies are
 * sorted in the order of cells, and those that meet should stand so near each other that a cache
 * holds all between. */
#define OZ_CELLS_STRIP 16

/* The row of cells along the first axis at coordinates along the others. */
OZ_INLINE int oz_cells_row(const OzWork *w, int second, int third)
{
    int strip = min(OZ_CELLS_STRIP, w->z.cells_along[1]);
    int across = second & (w->z.cells_along[1] - 1);
    int slab = (across / strip) * w->z.cells_along[2] + (third & (w->z.cells_along[2] - 1));
    return slab * strip + (across & (strip - 1));
}
#else
OZ_INLINE int oz_cells_row(const OzWork *w, int second, int third)
{
    return second & (w->z.cells_along[1] - 1);
}
#endif

/* The cell at coordinates along the grid's axes. Neighbours along the first follow each other. */
OZ_INLINE int oz_cells_index(const OzWork *w, int first, int second, int third)
{
    int along = w->z.cells_along[0];
    return oz_cells_row(w, second, third) * along + (first & (along - 1));
}

/* The cell of a slot's body; the last one, which is no place, for what reaches too far. */
OZ_INLINE int oz_cells_at(const OzWork *w, int slot)
{
    place_kind place[3];
    oz_near_place(w, slot, place);
    return OZ_NEAR_IS_LARGE(w, slot) ? w->z.cells
                                     : oz_cells_index(w, oz_cells_of(w, place[w->z.axis[0]]),
                                                      oz_cells_of(w, place[w->z.axis[1]]),
                                                      oz_cells_of(w, place[w->z.axis[2]]));
}

/* A slot's skin in the outer list. */
OZ_INLINE scalar oz_cells_skin(const OzWork *w, int slot)
{
    global const scalar *words = (global const scalar *)w->reference_outer;
    return words[oz_lanes_at(slot, OZ_REFERENCE, OZ_REFERENCE_SKIN)];
}

OZ_INLINE void oz_cells_clear(OzWork *w)
{
    OZ_EACH(w, cell, w->z.cells + 2)
    {
        w->cell_first[cell] = 0;
    }
}

/* Counts each body into the entry after its cell's. */
OZ_INLINE void oz_cells_bin(OzWork *w)
{
    OZ_EACH(w, slot, OZ_NEAR_SLOTS(w))
    {
        if (oz_near_listed(w, slot)) {
            int cell = oz_cells_at(w, slot);
            w->cell_of[slot] = cell;
            OZ_WORK_COUNT(&w->cell_first[cell + 1]);
        }
    }
}

/* Counts into first places, each one entry late: filling brings them into line, so that cell c
 * holds the bodies cell_first[c] ... cell_first[c + 1]. */
OZ_INLINE void oz_cells_scan(OzWork *w)
{
    int sum = 0;
    for (int cell = 1; cell < w->z.cells + 2; cell++) {
        int count = w->cell_first[cell];
        w->cell_first[cell] = sum;
        sum += count;
    }
}

/* Slots in the order of cells; within a cell, in any order. */
OZ_INLINE void oz_cells_fill(OzWork *w)
{
    OZ_EACH(w, slot, OZ_NEAR_SLOTS(w))
    {
        if (oz_near_listed(w, slot)) {
            int to = OZ_WORK_COUNT(&w->cell_first[w->cell_of[slot] + 1]);
            w->sorted_slot[to] = slot;
        }
    }
}

/* Sorts the slots of a cell by id, so that the order of bodies does not depend on which work-item
 * was faster. */
OZ_INLINE void oz_cells_arrange_one(OzWork *w, int first, int last)
{
    for (int i = first + 1; i < last; i++) {
        int kept = w->sorted_slot[i], key = OZ_WORK_ID(w, kept), to = i;
        while (to > first && OZ_WORK_ID(w, w->sorted_slot[to - 1]) > key) {
            w->sorted_slot[to] = w->sorted_slot[to - 1];
            to--;
        }
        w->sorted_slot[to] = kept;
    }
}

/* Lays out what the search needs of a body. */
OZ_INLINE void oz_cells_lay(OzWork *w, int to)
{
    int slot = w->sorted_slot[to];
    place_kind place[3];
    oz_near_place(w, slot, place);
    w->sorted_x[to] = place[0];
    w->sorted_y[to] = place[1];
#if OZ_DIMENSIONS == 3
    w->sorted_z[to] = place[2];
#endif
    w->sorted_far[to] = oz_near_reach(w, slot) + oz_cells_skin(w, slot);
    oz_near_lay(w, to, slot);
}

/* Slots that are to be the order of memory sorted within each cell, and everything laid out. */
OZ_INLINE void oz_cells_arrange(OzWork *w)
{
#if OZ_RESORT
    OZ_EACH(w, cell, w->z.cells + 1)
    {
        oz_cells_arrange_one(w, w->cell_first[cell], w->cell_first[cell + 1]);
        for (int to = w->cell_first[cell]; to < w->cell_first[cell + 1]; to++) {
            oz_cells_lay(w, to);
        }
    }
#else
    OZ_EACH(w, to, w->cell_first[w->z.cells + 1])
    {
        oz_cells_lay(w, to);
    }
#endif
}
