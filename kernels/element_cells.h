/* The hashed grid that finds elements near each other: small elements sorted by cell, after them
 * those that reach too far for the cells, which everybody looks at. OpenCL C only. */
#ifndef OZ_KERNELS_ELEMENT_CELLS_H
#define OZ_KERNELS_ELEMENT_CELLS_H

#include "kernels/element_work.h"

/* Scalar number `word` of a slot in an array of blocks of `words` words. */
OZ_INLINE size_t oz_element_cells_at(int slot, int words, int word)
{
    return ((size_t)(slot / OZ_LANES) * words + word) * OZ_LANES + slot % OZ_LANES;
}

OZ_INLINE scalar oz_element_cells_reach(const OzElementWork *w, int slot)
{
    return (
        (global const scalar *)w->shape)[oz_element_cells_at(slot, OZ_ELEMENT_SHAPE, OZ_PS_REACH)];
}

/* A slot's skin in the outer list. */
OZ_INLINE scalar oz_element_cells_skin(const OzElementWork *w, int slot)
{
    global const scalar *words = (global const scalar *)w->reference_outer;
    return words[oz_element_cells_at(slot, OZ_ELEMENT_REFERENCE, OZ_PF_SKIN)];
}

OZ_INLINE int oz_element_cells_row(const OzElementWork *w, int y)
{
    return (y & (w->z.cells_y - 1)) * w->z.cells_x;
}

/* Elements of walls that are gone, and padding, are in no list. */
OZ_INLINE int oz_element_cells_listed(const OzElementWork *w, int slot)
{
    return w->body[slot] >= 0;
}

/* The cell of a slot's centre; the last one, which is no place, for what reaches too far. */
OZ_INLINE int oz_element_cells_of(const OzElementWork *w, int slot)
{
    global const OzElementParameters *p = w->parameters;
    global const scalar *record = w->record + (size_t)slot * OZ_ELEMENT_RECORD + OZ_PR_POSITION;
    if (oz_element_cells_reach(w, slot) > p->reach_small) {
        return w->z.cells;
    }
    int x = (int)floor(record[0] * p->inverse_cell), y = (int)floor(record[1] * p->inverse_cell);
    return oz_element_cells_row(w, y) + (x & (w->z.cells_x - 1));
}

OZ_INLINE void oz_element_cells_clear(OzElementWork *w)
{
    OZ_EACH(w, cell, w->z.cells + 2)
    {
        w->cell_first[cell] = 0;
    }
}

/* Counts a slot into the entry after its cell's. */
OZ_INLINE void oz_element_cells_bin(OzElementWork *w)
{
    OZ_EACH(w, slot, w->z.slots)
    {
        if (oz_element_cells_listed(w, slot)) {
            int cell = oz_element_cells_of(w, slot);
            w->cell_of[slot] = cell;
            OZ_ELEMENT_COUNT(&w->cell_first[cell + 1]);
        }
    }
}

/* Counts into first places, each one entry late: filling brings them into line. */
OZ_INLINE void oz_element_cells_scan(OzElementWork *w)
{
    int sum = 0;
    for (int cell = 1; cell < w->z.cells + 2; cell++) {
        int count = w->cell_first[cell];
        w->cell_first[cell] = sum;
        sum += count;
    }
}

OZ_INLINE void oz_element_cells_fill(OzElementWork *w)
{
    OZ_EACH(w, slot, w->z.slots)
    {
        if (oz_element_cells_listed(w, slot)) {
            int to = OZ_ELEMENT_COUNT(&w->cell_first[w->cell_of[slot] + 1]);
            global const scalar *record = w->record + (size_t)slot * OZ_ELEMENT_RECORD;
            w->sorted_x[to] = record[OZ_PR_POSITION];
            w->sorted_y[to] = record[OZ_PR_POSITION + 1];
            w->sorted_far[to] = oz_element_cells_reach(w, slot) + oz_element_cells_skin(w, slot);
            w->sorted_slot[to] = slot;
            w->sorted_body[to] = w->body[slot];
        }
    }
}

#endif
