/* The hashed grid: grains counted into cells and laid out in the order of cells. Cell coordinates
 * wrap around, so space is unbounded; a distance test tells apart what shares a cell. OpenCL C
 * only. */
#ifndef OZ_KERNELS_CELLS_H
#define OZ_KERNELS_CELLS_H

#include "kernels/work.h"

/* Cell coordinate of a place's coordinate; unbounded, wrapped only where it becomes an index. */
OZ_INLINE int oz_cells_of(const OzWork *w, fixed_position_kind fixed_position)
{
    global const OzParameters *p = w->parameters;
    return (int)floor((scalar)fixed_position * p->length_unit * p->inverse_cell);
}

/* Cells of the grid's second axis that are gone through before the next of the third: grains are
 * sorted in the order of cells, and those that meet should stand so near each other that a cache
 * holds all between. */
#define OZ_CELLS_STRIP 16

/* The cell at coordinates along the grid's axes. Neighbours along the first follow each other. */
OZ_INLINE int oz_cells_index(const OzWork *w, int first, int second, int third)
{
    int strip = min(OZ_CELLS_STRIP, w->z.cells_along[1]);
    int across = second & (w->z.cells_along[1] - 1);
    int slab = (across / strip) * w->z.cells_along[2] + (third & (w->z.cells_along[2] - 1));
    int row = slab * strip + (across & (strip - 1));
    return row * w->z.cells_along[0] + (first & (w->z.cells_along[0] - 1));
}

OZ_INLINE void oz_cells_fixed_position(const OzWork *w, int slot,
                                       fixed_position_kind fixed_position[3])
{
    global const fixed_position_kind *record =
        (global const fixed_position_kind *)(w->record + (size_t)slot * OZ_RECORD + OZ_R_POSITION);
    fixed_position[0] = record[0];
    fixed_position[1] = record[1];
    fixed_position[2] = record[2];
}

/* Half-length + radius of a grain, m, from its shape. The length of the shaft's vector would not
 * do: its rounding changes as the grain turns, so that two grains of equal reach would change their
 * order in a pair. */
OZ_INLINE scalar oz_cells_reach(const OzWork *w, int slot)
{
    if (OZ_EQUAL) {
        return w->parameters->reach_max;
    }
    global const scalar *words = (global const scalar *)w->shape;
    return words[oz_lanes_at(slot, OZ_SHAPE, OZ_B_RADIUS)] +
           words[oz_lanes_at(slot, OZ_SHAPE, OZ_B_HALF_LENGTH)];
}

OZ_INLINE void oz_cells_clear(OzWork *w, int item, int stride)
{
    for (int c = item; c < w->z.cells + 2; c += stride) {
        w->cell_first[c] = 0;
    }
}

/* Counts the region's grains by cell. The count of cell c goes into cell_first[c + 2]: after the
 * scan and the filling, each of which moves entries by one place, cell c holds the slots
 * cell_first[c] ... cell_first[c + 1]. */
OZ_INLINE void oz_cells_bin(OzWork *w, int region)
{
    for (int i = oz_work_region_begin(w, region); i < oz_work_region_end(w, region); i++) {
        fixed_position_kind fixed_position[3];
        oz_cells_fixed_position(w, i, fixed_position);
        int cell = oz_cells_index(w, oz_cells_of(w, fixed_position[w->z.axis[0]]),
                                  oz_cells_of(w, fixed_position[w->z.axis[1]]),
                                  oz_cells_of(w, fixed_position[w->z.axis[2]]));
        w->cell_of[i] = cell;
        OZ_WORK_COUNT(&w->cell_first[cell + 2]);
    }
}

OZ_INLINE void oz_cells_scan(OzWork *w)
{
    int sum = 0;
    for (int c = 0; c < w->z.cells + 2; c++) {
        sum += w->cell_first[c];
        w->cell_first[c] = sum;
    }
}

/* Slots in the order of cells; within a cell, in any order. */
OZ_INLINE void oz_cells_fill(OzWork *w, int region)
{
    for (int i = oz_work_region_begin(w, region); i < oz_work_region_end(w, region); i++) {
        int to = OZ_WORK_COUNT(&w->cell_first[w->cell_of[i] + 1]);
        w->sorted_slot[to] = i;
    }
}

/* Sorts the slots of a cell by id, so that the order of grains does not depend on which work-item
 * was faster. */
OZ_INLINE void oz_cells_arrange_one(OzWork *w, int first, int last)
{
    for (int i = first + 1; i < last; i++) {
        int kept = w->sorted_slot[i], key = w->id[kept], to = i;
        while (to > first && w->id[w->sorted_slot[to - 1]] > key) {
            w->sorted_slot[to] = w->sorted_slot[to - 1];
            to--;
        }
        w->sorted_slot[to] = kept;
    }
}

/* Where a slot's skin in the outer list is kept. */
OZ_INLINE size_t oz_cells_skin_index(int slot)
{
    return oz_lanes_at(slot, OZ_REFERENCE, OZ_REFERENCE_SKIN);
}

/* A grain's skin in the outer list: what it moves in outer_time at its present speed, within
 * bounds. */
OZ_INLINE scalar oz_cells_skin(const OzWork *w, int slot)
{
    global const OzParameters *p = w->parameters;
    global const scalar *record = w->record + (size_t)slot * OZ_RECORD;
    global const scalar *a = record + OZ_R_SHAFT, *v = record + OZ_R_VELOCITY,
                        *r = record + OZ_R_RATE;
    scalar speed = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (!OZ_ROUND) {
        speed += sqrt((a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) *
                      (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]));
    }
    return fmin(p->outer_most, p->outer_least + speed * p->outer_time);
}

/* The region's share of cells: slots sorted, and what the search needs of the grains laid out
 * beside. */
OZ_INLINE void oz_cells_arrange(OzWork *w, int region)
{
    int begin = (int)((long)w->z.cells * region / w->z.regions);
    int end = (int)((long)w->z.cells * (region + 1) / w->z.regions);
    for (int cell = begin; cell < end; cell++) {
        oz_cells_arrange_one(w, w->cell_first[cell], w->cell_first[cell + 1]);
    }
    for (int to = w->cell_first[begin]; to < w->cell_first[end]; to++) {
        int i = w->sorted_slot[to];
        fixed_position_kind fixed_position[3];
        oz_cells_fixed_position(w, i, fixed_position);
        w->sorted_x[to] = fixed_position[0];
        w->sorted_y[to] = fixed_position[1];
        w->sorted_z[to] = fixed_position[2];
        w->sorted_id[to] = w->id[i];
        scalar skin = oz_cells_skin(w, i);
        w->sorted_skin[to] = skin;
        ((global scalar *)w->reference_outer)[oz_cells_skin_index(i)] = skin;
        if (!OZ_EQUAL) {
            w->sorted_reach[to] = oz_cells_reach(w, i);
        }
    }
}

#endif
