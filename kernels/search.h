/* The search for the outer list: of each body, the partners in the cells around it. Lists are named
 * in lists.h. OpenCL C only. */
#pragma once

#include "kernels/images.h"
#include "kernels/springs.h"
#if OZ_TILES
#include "kernels/tiles.h"
#endif

OZ_INLINE void oz_search_full(OzWork *w, volatile global int *needed, int count)
{
    atomic_or(&w->control->full, 1);
    atomic_max(needed, count);
}

/* The search of one body's partners: candidates by centre distance are collected, then tested by
 * the gap, a block of lanes at a time. */
enum { OZ_CANDIDATES = 256 };

typedef struct OzSearch {
    int slot;            /* of the body                                           */
    place_kind place[3]; /* its place                                             */
    OzNear body;         /* its geometry, the same in every lane                  */
    scalar skin;         /* m, in the outer list                                  */
    scalar reach;        /* m, its own and its skin                               */
    scalar far;          /* m, centre distance of the farthest partner in a cell  */
    int out;             /* where its next pair goes in the outer list            */
    int limit;           /* end of the region's outer list                        */
    int wanted;          /* pairs found in this region, stored or not             */
#if OZ_TILES
    OzStrays strays;
#endif
    int count; /* candidates */
    int candidate[OZ_CANDIDATES + 2 * OZ_LANES];
} OzSearch;

/* Stores a pair of the body and another one. */
OZ_INLINE void oz_search_store(OzWork *w, OzSearch *s, int other)
{
    s->wanted++;
#if OZ_TILES
    if (oz_tiles_is_stray(w, s->slot, other)) {
        oz_tiles_add_stray(w, &s->strays, other, s->slot);
        return;
    }
#endif
    if (s->out < s->limit) {
        w->outer_a[s->out] = s->slot;
        w->outer_b[s->out++] = other;
    }
}

/* Tests the collected candidates and stores the pairs. */
OZ_INLINE void oz_search_flush(OzWork *w, OzSearch *s)
{
    for (int l = 0; l < OZ_LANES; l++) {
        s->candidate[s->count + l] = s->slot;
    }
    for (int first = 0; first < s->count; first += OZ_LANES) {
        int active[OZ_LANES];
        const int *slots = s->candidate + first;
        OzNear other = oz_near_load(w, slots);
        real margin = REAL(s->skin) +
                      oz_lanes_fetch(w->reference_outer, slots, OZ_REFERENCE, OZ_REFERENCE_SKIN);
        mask hits = oz_near_pairs(w, &s->body, &other, margin) &
                    oz_lanes_mask_of(OZ_LANES_IOTA + first < s->count);
        int count = oz_lanes_compact(active, OZ_LANES_LOAD(slots), hits);
        for (int l = 0; l < count; l++) {
            oz_search_store(w, s, active[l]);
        }
    }
    s->count = 0;
}

/* Candidates among the sorted bodies first ... last. */
OZ_INLINE void oz_search_sweep(OzWork *w, OzSearch *s, int first, int last)
{
    scalar unit = OZ_NEAR_UNIT(w);
    for (int k = first; k < last; k += OZ_LANES) {
        real x = OZ_NEAR_REAL(OZ_LANES_LOAD(w->sorted_x + k) - s->place[0]) * unit;
        real y = OZ_NEAR_REAL(OZ_LANES_LOAD(w->sorted_y + k) - s->place[1]) * unit;
#if OZ_SHEAR
        x += oz_work_space(w).tilt * y;
#endif
        real distance2 = x * x + y * y;
#if OZ_DIMENSIONS == 3
        real z = OZ_NEAR_REAL(OZ_LANES_LOAD(w->sorted_z + k) - s->place[2]) * unit;
        distance2 += z * z;
#endif
        real far = OZ_LANES_LOAD(w->sorted_far + k) + REAL(s->reach);
        mask seconds = oz_near_seconds(w, k, s->slot);
#if OZ_TILES
        seconds = seconds | oz_tiles_foreign(w, k);
#endif
#if OZ_NEAR_PERIODIC
        seconds = seconds & oz_images_nearest(w, x, y, z);
#endif
        seconds = seconds & oz_lanes_mask_of(OZ_LANES_IOTA + k < last);
        if (s->count > OZ_CANDIDATES) {
            oz_search_flush(w, s);
        }
        s->count += oz_lanes_compact(s->candidate + s->count, OZ_LANES_LOAD(w->sorted_slot + k),
                                     (distance2 < far * far) & seconds);
    }
}

/* Sorts each gap-th of the pairs first ... last of the outer list by the second body's id. */
OZ_INLINE void oz_search_sort_by(OzWork *w, int first, int last, int gap)
{
    for (int i = first + gap; i < last; i++) {
        int kept = w->outer_b[i], key = OZ_WORK_ID(w, kept), to = i;
        while (to - gap >= first && OZ_WORK_ID(w, w->outer_b[to - gap]) > key) {
            w->outer_b[to] = w->outer_b[to - gap];
            to -= gap;
        }
        w->outer_b[to] = kept;
    }
}

/* Sorts pairs first ... last by the second body's id. Short lists are usual; long ones must not
 * take the square of their length (Shell 1959). */
OZ_INLINE void oz_search_sort(OzWork *w, int first, int last)
{
    if (last - first > 64) {
        for (int gap = (last - first) / 3 + 1; gap > 1; gap = gap > 2 ? gap / 3 + 1 : 1) {
            oz_search_sort_by(w, first, last, gap);
        }
    }
    oz_search_sort_by(w, first, last, 1);
}

/* One row of cells along the grid's first axis, as long as `width` on both sides of `at` (m). */
OZ_INLINE void oz_search_row(OzWork *w, OzSearch *s, int row, scalar at, scalar width)
{
    scalar inverse = w->parameters->inverse_cell;
    int low = (int)floor((at - width) * inverse), high = (int)floor((at + width) * inverse);
    int start = low & (w->z.cells_along[0] - 1), cells = min(high - low + 1, w->z.cells_along[0]);
    int stop = min(start + cells, w->z.cells_along[0]), wrapped = start + cells - stop;
    oz_search_sweep(w, s, w->cell_first[row + start], w->cell_first[row + stop]);
    if (wrapped > 0) {
        oz_search_sweep(w, s, w->cell_first[row], w->cell_first[row + wrapped]);
    }
}

OZ_INLINE scalar oz_search_at(const OzWork *w, const OzSearch *s, int axis)
{
    return (scalar)s->place[w->z.axis[axis]] * OZ_NEAR_UNIT(w);
}

#if OZ_DIMENSIONS == 3
/* Distance of a coordinate from the cells at `offset` of its own, m: 0 within. frac: where in its.
 */
OZ_INLINE scalar oz_search_off(int offset, scalar frac, scalar cell)
{
    scalar off = offset > 0 ? offset - frac : offset < 0 ? frac - (offset + 1) : 0;
    return off * cell;
}

/* Candidates in the cells around, each row only as long as the sphere of reach is wide there. */
OZ_INLINE void oz_search_cells(OzWork *w, OzSearch *s)
{
    scalar inverse = w->parameters->inverse_cell, cell = 1 / inverse, far2 = s->far * s->far;
    scalar second = oz_search_at(w, s, 1) * inverse, third = oz_search_at(w, s, 2) * inverse;
    int at_second = (int)floor(second), at_third = (int)floor(third);
    for (int d3 = -1; d3 <= 1; d3++) {
        scalar off3 = oz_search_off(d3, third - at_third, cell);
        for (int d2 = -1; d2 <= 1; d2++) {
            scalar off = oz_search_off(d2, second - at_second, cell),
                   off2 = off3 * off3 + off * off;
            if (off2 < far2) {
                int row = oz_cells_index(w, 0, at_second + d2, at_third + d3);
                oz_search_row(w, s, row, oz_search_at(w, s, 0),
                              sqrt(far2 - off2) + OZ_NEAR_SLANT(w, s->far));
            }
        }
    }
}

#else
/* Candidates in the cells around: in a plane the root that would shorten a row costs more than it
 * saves. */
OZ_INLINE void oz_search_cells(OzWork *w, OzSearch *s)
{
    scalar inverse = w->parameters->inverse_cell, at = oz_search_at(w, s, 1);
    int low = (int)floor((at - s->far) * inverse), high = (int)floor((at + s->far) * inverse);
    for (int second = low; second <= high; second++) {
        oz_search_row(w, s, oz_cells_index(w, 0, second, 0), oz_search_at(w, s, 0), s->far);
    }
}

#endif

/* Candidates of a body: of a small one those in the cells around and the large ones, of a large one
 * all. */
OZ_INLINE void oz_search_around(OzWork *w, OzSearch *s)
{
    if (OZ_ALL_PAIRS || OZ_NEAR_IS_LARGE(w, s->slot)) {
        oz_search_sweep(w, s, 0, w->cell_first[w->z.cells + 1]);
        return;
    }
    oz_search_cells(w, s);
    oz_search_sweep(w, s, w->cell_first[w->z.cells], w->cell_first[w->z.cells + 1]);
}

/* The same of a body and of its images, where space repeats itself. */
OZ_INLINE void oz_search_images(OzWork *w, OzSearch *s)
{
#if OZ_NEAR_PERIODIC
    OzImages images = oz_images_of(w, s->place, s->far);
    while (oz_images_next(&images, s->place)) {
        oz_search_around(w, s);
    }
#else
    oz_search_around(w, s);
#endif
}

/* The pairs of which the body in a slot is the first, sorted by the second's id. */
OZ_INLINE void oz_search_one(OzWork *w, OzSearch *s, int slot)
{
    int own[OZ_LANES], first = s->out;
    for (int l = 0; l < OZ_LANES; l++) {
        own[l] = slot;
    }
    s->slot = slot;
    s->skin = oz_cells_skin(w, slot);
    s->reach = oz_near_reach(w, slot) + s->skin;
    s->far = s->reach + w->parameters->reach_max + w->parameters->outer_most;
    s->count = 0;
    s->body = oz_near_load(w, own);
    oz_near_place(w, slot, s->place);
    oz_search_images(w, s);
    oz_search_flush(w, s);
    oz_search_sort(w, first, s->out);
#if OZ_HISTORY && !OZ_TILES
    w->outer_first[slot] = first;
    w->outer_number[slot] = s->out - first;
#endif
}

/* Pairs of all bodies of a region, in the order of their ids. */
OZ_INLINE void oz_search_all(OzWork *w, OzSearch *s, int region)
{
    int begin = oz_work_region_begin(w, region), end = oz_work_region_end(w, region);
#if OZ_TILES
    oz_work_tile(w, region);
    oz_tiles_begin(w, &s->strays, region);
    for (int i = begin; i < end; i++) {
        oz_search_one(w, s, w->slot_of[w->cell_of[i]]);
    }
    s->out = oz_tiles_merge(w, &s->strays, s->limit - w->z.outer_capacity, s->out, s->limit);
#else
    for (int i = begin; i < end; i++) {
        oz_search_one(w, s, i);
    }
#endif
}

/* The outer list of a region's bodies. */
OZ_INLINE void oz_search_region(OzWork *w, int region)
{
    OzSearch s;
    int begin = region * w->z.outer_capacity;
    s.out = begin;
    s.limit = begin + w->z.outer_capacity;
    s.wanted = 0;
    oz_search_all(w, &s, region);
    w->outer_count[region] = s.out - begin;
    for (int o = s.out; o < s.limit && (o - begin) % OZ_LANES != 0; o++) {
        w->outer_a[o] = 0; /* read with the last block, never taken */
        w->outer_b[o] = 0;
    }
    if (s.wanted > w->z.outer_capacity) {
        oz_search_full(w, &w->control->outer_needed, s.wanted);
    }
#if OZ_TILES
    if (s.strays.wanted > w->z.inner_capacity) {
        oz_search_full(w, &w->control->inner_needed, s.strays.wanted);
    }
#endif
    oz_springs_forget(w, region);
}
