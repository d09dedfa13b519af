/* Neighbour lists. The outer list holds every pair whose gap was below the sum of both bodies'
 * outer skins when it was made from the hashed grid. The inner list, which the forces walk, holds
 * those of them whose gap was below the sum of both inner skins when it was made. A body's skins
 * grow with its speed, so that slow and fast ones use theirs up at about the same time. The inner
 * list is made anew from the outer one as long as that covers every body's motion and skin. A list
 * too small raises control->full with the sizes needed and leaves the springs where control->truth
 * says, so that the host can enlarge it and repeat: no pair is dropped. Both lists are ordered by
 * the first's id (without tiles by its slot: there the same, or loads are gathered), then by the
 * second's: whatever the skins, touching pairs come in the same order. OpenCL C only. */
#pragma once

#include "kernels/cells.h"
#include "kernels/springs.h"
#if OZ_TILES
#include "kernels/tiles.h"
#endif

OZ_INLINE void oz_lists_full(OzWork *w, volatile global int *needed, int count)
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
OZ_INLINE void oz_lists_store(OzWork *w, OzSearch *s, int other)
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
OZ_INLINE void oz_lists_flush(OzWork *w, OzSearch *s)
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
            oz_lists_store(w, s, active[l]);
        }
    }
    s->count = 0;
}

/* Candidates among the sorted bodies first ... last. */
OZ_INLINE void oz_lists_sweep(OzWork *w, OzSearch *s, int first, int last)
{
    scalar unit = OZ_NEAR_UNIT(w);
    for (int k = first; k < last; k += OZ_LANES) {
        real x = OZ_NEAR_REAL(OZ_LANES_LOAD(w->sorted_x + k) - s->place[0]) * unit;
        real y = OZ_NEAR_REAL(OZ_LANES_LOAD(w->sorted_y + k) - s->place[1]) * unit;
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
        seconds = seconds & oz_lanes_mask_of(OZ_LANES_IOTA + k < last);
        if (s->count > OZ_CANDIDATES) {
            oz_lists_flush(w, s);
        }
        s->count += oz_lanes_compact(s->candidate + s->count, OZ_LANES_LOAD(w->sorted_slot + k),
                                     (distance2 < far * far) & seconds);
    }
}

/* Sorts pairs first ... last of the outer list by the second grain's id (Shell's gaps: short lists
 * are usual, long ones must not take the square of their length). */
OZ_INLINE void oz_lists_sort(OzWork *w, int first, int last)
{
    int count = last - first;
    for (int gap = count > 64 ? count / 3 + 1 : 1; gap > 0;
         gap = gap > 1 ? gap / 3 + (gap == 2) : 0) {
        for (int i = first + gap; i < last; i++) {
            int kept = w->outer_b[i], key = OZ_WORK_ID(w, kept), to = i;
            while (to - gap >= first && OZ_WORK_ID(w, w->outer_b[to - gap]) > key) {
                w->outer_b[to] = w->outer_b[to - gap];
                to -= gap;
            }
            w->outer_b[to] = kept;
        }
    }
}

/* One row of cells along the grid's first axis, as long as `width` on both sides of `at` (m). */
OZ_INLINE void oz_lists_row(OzWork *w, OzSearch *s, int row, scalar at, scalar width)
{
    scalar inverse = w->parameters->inverse_cell;
    int low = (int)floor((at - width) * inverse), high = (int)floor((at + width) * inverse);
    int start = low & (w->z.cells_along[0] - 1), cells = min(high - low + 1, w->z.cells_along[0]);
    int stop = min(start + cells, w->z.cells_along[0]), wrapped = start + cells - stop;
    oz_lists_sweep(w, s, w->cell_first[row + start], w->cell_first[row + stop]);
    if (wrapped > 0) {
        oz_lists_sweep(w, s, w->cell_first[row], w->cell_first[row + wrapped]);
    }
}

OZ_INLINE scalar oz_lists_at(const OzWork *w, const OzSearch *s, int axis)
{
    return (scalar)s->place[w->z.axis[axis]] * OZ_NEAR_UNIT(w);
}

#if OZ_DIMENSIONS == 3
/* Distance of a coordinate from the cells at `offset` of its own, m: 0 within. frac: where in its. */
OZ_INLINE scalar oz_lists_off(int offset, scalar frac, scalar cell)
{
    scalar off = offset > 0 ? offset - frac : offset < 0 ? frac - (offset + 1) : 0;
    return off * cell;
}

/* Candidates in the cells around, each row only as long as the sphere of reach is wide there. */
OZ_INLINE void oz_lists_cells(OzWork *w, OzSearch *s)
{
    scalar inverse = w->parameters->inverse_cell, cell = 1 / inverse, far2 = s->far * s->far;
    scalar second = oz_lists_at(w, s, 1) * inverse, third = oz_lists_at(w, s, 2) * inverse;
    int at_second = (int)floor(second), at_third = (int)floor(third);
    for (int d3 = -1; d3 <= 1; d3++) {
        scalar off3 = oz_lists_off(d3, third - at_third, cell);
        for (int d2 = -1; d2 <= 1; d2++) {
            scalar off = oz_lists_off(d2, second - at_second, cell), off2 = off3 * off3 + off * off;
            if (off2 < far2) {
                int row = oz_cells_index(w, 0, at_second + d2, at_third + d3);
                oz_lists_row(w, s, row, oz_lists_at(w, s, 0), sqrt(far2 - off2));
            }
        }
    }
}

#else
/* Candidates in the cells around: in a plane the root that would shorten a row costs more than it
 * saves. */
OZ_INLINE void oz_lists_cells(OzWork *w, OzSearch *s)
{
    scalar inverse = w->parameters->inverse_cell, at = oz_lists_at(w, s, 1);
    int low = (int)floor((at - s->far) * inverse), high = (int)floor((at + s->far) * inverse);
    for (int second = low; second <= high; second++) {
        oz_lists_row(w, s, oz_cells_index(w, 0, second, 0), oz_lists_at(w, s, 0), s->far);
    }
}

#endif

/* Candidates of a body: of a small one those in the cells around and the large ones, of a large one
 * all. */
OZ_INLINE void oz_lists_around(OzWork *w, OzSearch *s)
{
    if (OZ_ALL_PAIRS || OZ_NEAR_IS_LARGE(w, s->slot)) {
        oz_lists_sweep(w, s, 0, w->cell_first[w->z.cells + 1]);
        return;
    }
    oz_lists_cells(w, s);
    oz_lists_sweep(w, s, w->cell_first[w->z.cells], w->cell_first[w->z.cells + 1]);
}

/* The pairs of which the body in a slot is the first, sorted by the second's id. */
OZ_INLINE void oz_lists_search_one(OzWork *w, OzSearch *s, int slot)
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
    oz_lists_around(w, s);
    oz_lists_flush(w, s);
    oz_lists_sort(w, first, s->out);
#if OZ_HISTORY && !OZ_TILES
    w->outer_first[slot] = first;
    w->outer_number[slot] = s->out - first;
#endif
}

/* Pairs of all bodies of a region, in the order of their ids. */
OZ_INLINE void oz_lists_search_all(OzWork *w, OzSearch *s, int region)
{
    int begin = oz_work_region_begin(w, region), end = oz_work_region_end(w, region);
#if OZ_TILES
    oz_work_tile(w, region);
    oz_tiles_begin(w, &s->strays, region);
    for (int i = begin; i < end; i++) {
        oz_lists_search_one(w, s, w->slot_of[w->cell_of[i]]);
    }
    s->out = oz_tiles_merge(w, &s->strays, s->limit - w->z.outer_capacity, s->out, s->limit);
#else
    for (int i = begin; i < end; i++) {
        oz_lists_search_one(w, s, i);
    }
#endif
}

/* The outer list of a region's bodies. */
OZ_INLINE void oz_lists_search(OzWork *w, int region)
{
    OzSearch s;
    int begin = region * w->z.outer_capacity;
    s.out = begin;
    s.limit = begin + w->z.outer_capacity;
    s.wanted = 0;
    oz_lists_search_all(w, &s, region);
    w->outer_count[region] = s.out - begin;
    for (int o = s.out; o < s.limit && (o - begin) % OZ_LANES != 0; o++) {
        w->outer_a[o] = 0; /* read with the last block, never taken */
        w->outer_b[o] = 0;
    }
    if (s.wanted > w->z.outer_capacity) {
        oz_lists_full(w, &w->control->outer_needed, s.wanted);
    }
#if OZ_TILES
    if (s.strays.wanted > w->z.inner_capacity) {
        oz_lists_full(w, &w->control->inner_needed, s.strays.wanted);
    }
#endif
    oz_springs_forget(w, region);
}

/* A body's skin: what it moves in `time` at its present speed, within the bounds. */
OZ_INLINE real oz_lists_skin(OzPose pose, scalar time, scalar least, scalar most)
{
    return oz_smaller(REAL(most), REAL(least) + oz_near_speed(pose) * REAL(time));
}

/* Takes a block's present places as the outer list's reference, and gives each body its skin. */
OZ_INLINE void oz_lists_refer_block(OzWork *w, int block)
{
    global const OzParameters *p = w->parameters;
    global real *reference = w->reference_outer + (size_t)block * OZ_REFERENCE;
    OzPose pose = oz_near_pose(w, block);
    oz_near_note(reference, pose);
    reference[OZ_REFERENCE_SKIN] =
        oz_lists_skin(pose, p->outer_time, p->outer_least, p->outer_most);
}

OZ_INLINE void oz_lists_refer(OzWork *w)
{
    OZ_EACH(w, block, w->z.blocks)
    {
        oz_lists_refer_block(w, block);
    }
}

/* Takes the present places as the inner list's reference, gives each body its skin, and marks the
 * outer list stale where it does not cover a body's motion since it was made and its skin. */
OZ_INLINE void oz_lists_measure(OzWork *w)
{
    global const OzParameters *p = w->parameters;
    OZ_EACH(w, block, w->z.blocks)
    {
        OzPose pose = oz_near_pose(w, block);
        real skin = oz_lists_skin(pose, p->skin_time, p->skin_least, p->skin_most);
        global const real *outer = w->reference_outer + (size_t)block * OZ_REFERENCE;
        global real *inner = w->reference_inner + (size_t)block * OZ_REFERENCE;
        real left =
            outer[OZ_REFERENCE_SKIN] - skin; /* outer_least is above skin_most: never negative */
        if (OZ_ANY(!oz_near_stays(w, outer, pose, left))) {
            w->control->outer_stale = 1;
        }
        oz_near_note(inner, pose);
        inner[OZ_REFERENCE_SKIN] = skin;
        scalar lane[OZ_LANES];
        OZ_LANES_STORE(skin, lane);
        for (int l = 0; l < OZ_LANES; l++) {
            w->record[(size_t)(block * OZ_LANES + l) * OZ_RECORD + OZ_R_SKIN] = lane[l];
        }
    }
}

/* Marks lists that do not hold a block's bodies any more with a step. */
OZ_INLINE void oz_lists_watch(OzWork *w, int block, OzPose pose, global int *mark, int step)
{
    global const real *reference = w->reference_inner + (size_t)block * OZ_REFERENCE;
    if (OZ_ANY(!oz_near_stays(w, reference, pose, reference[OZ_REFERENCE_SKIN]))) {
        OZ_WORK_MARK(mark, step);
    }
}

/* back[l] receives a number for pair l: how many pairs with the same second grain have been counted
 * before it. All numbers of a block are taken before any of its pairs is written, because counting
 * with atomics waits until what was written before has arrived. */
OZ_INLINE void oz_lists_count(OzWork *w, const int *outer, int count, int *back)
{
#if OZ_GATHER
    for (int l = 0; l < count; l++) {
        int b = w->outer_b[outer[l]];
        back[l] = OZ_NEAR_MOVES(w, b) ? OZ_WORK_COUNT(&w->back_number[b]) : w->z.back_capacity;
    }
#endif
}

/* Puts one pair of the outer list into the inner one. back is the pair's number among those with
 * the same second grain (oz_lists_count). */
OZ_INLINE void oz_lists_take(OzWork *w, int outer, int to, int back)
{
    int a = w->outer_a[outer], b = w->outer_b[outer];
    w->pair_a[to] = a;
    w->pair_b[to] = b;
#if OZ_GATHER
    if (w->pair_number[a]++ == 0) {
        w->pair_first[a] = to;
    }
    if (back < w->z.back_capacity) {
        w->back[(size_t)b * w->z.back_capacity + back] = to;
    }
#endif
#if OZ_HISTORY
    global scalar *history = w->pair_history + (size_t)to * OZ_SPRING;
    w->pair_outer[to] = outer;
    history[0] = w->outer_history[3 * (size_t)outer];
    history[1] = w->outer_history[3 * (size_t)outer + 1];
    history[2] = w->outer_history[3 * (size_t)outer + 2];
#endif
}

/* Fills the last block of a region's inner list with pairs that never touch. */
OZ_INLINE void oz_lists_pad(OzWork *w, int begin, int count)
{
    for (int p = begin + count; (p - begin) % OZ_LANES != 0; p++) {
        w->pair_a[p] = 0;
        w->pair_b[p] = OZ_NEAR_NONE(w);
    }
}

OZ_INLINE void oz_lists_reset(OzWork *w)
{
#if OZ_GATHER
    OZ_EACH(w, i, OZ_WORK_SLOTS(w))
    {
        w->pair_number[i] = 0;
        w->pair_first[i] = 0;
        w->back_number[i] = 0;
    }
#endif
}

/* Skins, in the inner list, of the bodies in slots. */
OZ_INLINE real oz_lists_skins(const OzWork *w, const int *slots)
{
    real words[4];
    oz_lanes_load4(w->record, slots, OZ_RECORD, OZ_R_SKIN / 4 * 4, words);
    return words[OZ_R_SKIN % 4];
}

/* The region's inner list. */
OZ_INLINE void oz_lists_select(OzWork *w, int region)
{
    int outer = region * w->z.outer_capacity, outer_end = outer + w->outer_count[region];
    int begin = region * w->z.inner_capacity, count = 0;
    for (int first = outer; first < outer_end; first += OZ_LANES) {
        int a[OZ_LANES], b[OZ_LANES], active[OZ_LANES];
        for (int l = 0; l < OZ_LANES; l++) {
            a[l] = w->outer_a[first + l];
            b[l] = w->outer_b[first + l];
        }
        OzNear one = oz_near_load(w, a), other = oz_near_load(w, b);
        real margin = oz_lists_skins(w, a) + oz_lists_skins(w, b);
        mask hits = oz_near_pairs(w, &one, &other, margin) &
                    oz_lanes_mask_of(OZ_LANES_IOTA + first < outer_end);
        int hit_count = oz_lanes_compact(active, OZ_LANES_IOTA + first, hits);
        int taken = min(hit_count, max(w->z.inner_capacity - count, 0)), back[OZ_LANES];
        oz_lists_count(w, active, taken, back);
        for (int l = 0; l < taken; l++) {
            oz_lists_take(w, active[l], begin + count + l, back[l]);
        }
        count += hit_count;
    }
    if (count > w->z.inner_capacity) {
        oz_lists_full(w, &w->control->inner_needed, count);
        return;
    }
    oz_lists_pad(w, begin, count);
    w->pair_count[region] = count;
    oz_near_fresh(w, begin, count);
}

/* Sorts each body's pairs in which it is the second by the first one's id. */
OZ_INLINE void oz_lists_order(OzWork *w)
{
#if OZ_GATHER
    OZ_EACH(w, i, OZ_WORK_BODIES(w))
    {
        int count = w->back_number[i];
        if (count > w->z.back_capacity) {
            oz_lists_full(w, &w->control->back_needed, count);
            continue;
        }
        global int *back = w->back + (size_t)i * w->z.back_capacity;
        for (int k = 1; k < count; k++) {
            int kept = back[k], key = OZ_WORK_ID(w, w->pair_a[kept]), to = k;
            while (to > 0 && OZ_WORK_ID(w, w->pair_a[back[to - 1]]) > key) {
                back[to] = back[to - 1];
                to--;
            }
            back[to] = kept;
        }
#if OZ_NEAR_MIXED
        int before = 0;
        while (before < count && w->id[w->pair_a[back[before]]] < w->id[i]) {
            before++;
        }
        w->back_before[i] = before;
#endif
    }
#endif
}
