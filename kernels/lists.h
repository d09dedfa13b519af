/* Neighbour lists. The outer list holds every pair whose gap was below the sum of both grains'
 * outer skins when it was made from the hashed grid. The inner list, which the forces walk, holds
 * those of them whose gap was below the sum of both grains' inner skins when it was made. A grain's
 * skins grow with its speed, so that slow and fast ones use theirs up at about the same time. The
 * inner list is made anew from the outer one as long as that covers every grain's motion and skin.
 * A list too small raises control->full with the sizes needed and leaves the springs where
 * control->truth says, so that the host can enlarge it and repeat: no pair is dropped. A pair's
 * first grain is the one with the longer reach (half-length + radius), then the lower id. OpenCL C
 * only. */
#ifndef OZ_KERNELS_LISTS_H
#define OZ_KERNELS_LISTS_H

#include "kernels/cells.h"
#include "kernels/grains.h"
#include "kernels/springs.h"

OZ_INLINE void oz_lists_full(OzWork *w)
{
    atomic_or(&w->control->full, 1);
}

/* The search of one grain's partners: candidates by centre distance are collected, then tested by
 * the gap of the capsules, a block of lanes at a time. */
enum { OZ_CANDIDATES = 256 };

typedef struct OzSearch {
    int slot, id;                          /* of the grain                                  */
    fixed_position_kind fixed_position[3]; /* its place                                     */
    OzGrain grain;                         /* its geometry, the same in every lane          */
    scalar reach;                          /* m, half-length + radius                       */
    scalar skin;                           /* m, in the outer list                          */
    scalar far;                            /* m, centre distance of the farthest partner    */
    int out;                               /* where its next pair goes in the outer list    */
    int limit;                             /* end of the region's outer list                */
    int wanted;                            /* pairs found in this region, stored or not     */
    int count;                             /* candidates                                    */
    int candidate[OZ_CANDIDATES + 2 * OZ_LANES];
} OzSearch;

/* Tests the collected candidates and stores the pairs. */
OZ_INLINE void oz_lists_flush(OzWork *w, OzSearch *s)
{
    for (int l = 0; l < OZ_LANES; l++) {
        s->candidate[s->count + l] = s->slot;
    }
    for (int first = 0; first < s->count; first += OZ_LANES) {
        int active[OZ_LANES];
        OzGrain other = oz_work_geometry(w, s->candidate + first);
        real radii, distance2 = oz_pairs_distance2(w, s->grain, other, &radii);
        real near = radii + REAL(s->skin) +
                    oz_lanes_fetch(w->reference_outer, s->candidate + first, OZ_REFERENCE,
                                   OZ_REFERENCE_SKIN);
        mask hits = (distance2 < near * near) & oz_lanes_mask_of(OZ_LANES_IOTA + first < s->count);
        int count = oz_lanes_compact(active, OZ_LANES_LOAD(s->candidate + first), hits);
        s->wanted += count;
        for (int l = 0; l < count && s->out < s->limit; l++) {
            w->outer_a[s->out] = s->slot;
            w->outer_b[s->out++] = active[l];
        }
    }
    s->count = 0;
}

/* Candidates among the sorted grains first ... last. */
OZ_INLINE void oz_lists_sweep(OzWork *w, OzSearch *s, int first, int last)
{
    scalar unit = w->parameters->length_unit;
    for (int k = first; k < last; k += OZ_LANES) {
        OzFixedPosition apart;
        apart.x = OZ_LANES_LOAD(w->sorted_x + k) - s->fixed_position[0];
        apart.y = OZ_LANES_LOAD(w->sorted_y + k) - s->fixed_position[1];
        apart.z = OZ_LANES_LOAD(w->sorted_z + k) - s->fixed_position[2];
        OzVec3 d = oz_vec3(oz_fixed_position_to_real(apart.x) * unit,
                           oz_fixed_position_to_real(apart.y) * unit,
                           oz_fixed_position_to_real(apart.z) * unit);
        mask mine = oz_lanes_mask_of((OZ_LANES_LOAD(w->sorted_id + k) > s->id) &
                                     (OZ_LANES_IOTA + k < last));
        real skins = OZ_LANES_LOAD(w->sorted_skin + k) + REAL(s->skin);
        real far = REAL(2 * s->reach) + skins;
        if (!OZ_EQUAL) {
            real reach = OZ_LANES_LOAD(w->sorted_reach + k), own = REAL(s->reach);
            mask here = oz_lanes_mask_of(OZ_LANES_IOTA + k < last);
            mine = ((reach < own) & here) | ((reach == own) & mine);
            far = reach + REAL(s->reach) + skins;
        }
        if (s->count > OZ_CANDIDATES) {
            oz_lists_flush(w, s);
        }
        s->count += oz_lanes_compact(s->candidate + s->count, OZ_LANES_LOAD(w->sorted_slot + k),
                                     (oz_dot(d, d) < far * far) & mine);
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
            int kept = w->outer_b[i], key = w->id[kept], to = i;
            while (to - gap >= first && w->id[w->outer_b[to - gap]] > key) {
                w->outer_b[to] = w->outer_b[to - gap];
                to -= gap;
            }
            w->outer_b[to] = kept;
        }
    }
}

/* Distance of a coordinate from the cells at `offset` of its own, m: 0 within. frac: where in its
 * cell. */
OZ_INLINE scalar oz_lists_off(int offset, scalar frac, scalar cell)
{
    scalar off = offset > 0 ? offset - frac : offset < 0 ? frac - (offset + 1) : 0;
    return off * cell;
}

/* One row of cells along the grid's first axis, `off2` (m^2) away across it: only as long as the
 * sphere of reach about `at` (m) is wide there. */
OZ_INLINE void oz_lists_row(OzWork *w, OzSearch *s, int row, scalar at, scalar off2)
{
    scalar inverse = w->parameters->inverse_cell;
    scalar width = sqrt(s->far * s->far - off2);
    int low = (int)floor((at - width) * inverse), high = (int)floor((at + width) * inverse);
    int start = low & (w->z.cells_along[0] - 1), cells = min(high - low + 1, w->z.cells_along[0]);
    int stop = min(start + cells, w->z.cells_along[0]), wrapped = start + cells - stop;
    oz_lists_sweep(w, s, w->cell_first[row + start], w->cell_first[row + stop]);
    if (wrapped > 0) {
        oz_lists_sweep(w, s, w->cell_first[row], w->cell_first[row + wrapped]);
    }
}

OZ_INLINE void oz_lists_around(OzWork *w, OzSearch *s)
{
#if OZ_ALL_PAIRS
    oz_lists_sweep(w, s, 0, w->z.count);
#else
    global const OzParameters *p = w->parameters;
    scalar cell = 1 / p->inverse_cell, position[3];
    for (int k = 0; k < 3; k++) {
        position[k] = (scalar)s->fixed_position[w->z.axis[k]] * p->length_unit;
    }
    scalar second = position[1] * p->inverse_cell, third = position[2] * p->inverse_cell;
    int at_second = (int)floor(second), at_third = (int)floor(third);
    for (int d3 = -1; d3 <= 1; d3++) {
        scalar off3 = oz_lists_off(d3, third - at_third, cell);
        for (int d2 = -1; d2 <= 1; d2++) {
            scalar off = oz_lists_off(d2, second - at_second, cell), off2 = off3 * off3 + off * off;
            if (off2 < s->far * s->far) {
                int row = oz_cells_index(w, 0, at_second + d2, at_third + d3);
                oz_lists_row(w, s, row, position[0], off2);
            }
        }
    }
#endif
}

/* The outer list of the region's grains, sorted by first slot, then by second id. */
OZ_INLINE void oz_lists_search(OzWork *w, int region)
{
    OzSearch s;
    s.out = region * w->z.outer_capacity;
    s.limit = s.out + w->z.outer_capacity;
    s.wanted = 0;
    int begin = s.out;
    for (int i = oz_work_region_begin(w, region); i < oz_work_region_end(w, region); i++) {
        s.slot = i;
        s.id = w->id[i];
        s.reach = oz_cells_reach(w, i);
        s.skin = ((global const scalar *)w->reference_outer)[oz_cells_skin_index(i)];
        s.far = s.reach + w->parameters->reach_max + s.skin + w->parameters->outer_most;
        s.count = 0;
        int own[OZ_LANES];
        for (int l = 0; l < OZ_LANES; l++) {
            own[l] = i;
        }
        s.grain = oz_work_geometry(w, own);
        oz_cells_fixed_position(w, i, s.fixed_position);
        int first = s.out;
        oz_lists_around(w, &s);
        oz_lists_flush(w, &s);
        oz_lists_sort(w, first, s.out);
        w->outer_first[i] = first;
        w->outer_number[i] = s.out - first;
    }
    w->outer_count[region] = s.out - begin;
    for (int o = s.out; o < s.limit && (o - begin) % OZ_LANES != 0; o++) {
        w->outer_a[o] = 0; /* read with the last block, never taken */
        w->outer_b[o] = 0;
    }
    if (s.wanted > w->z.outer_capacity) {
        oz_lists_full(w);
        atomic_max(&w->control->outer_needed, s.wanted);
    }
    oz_springs_forget(w, region);
}

/* Notes where a block of grains is. */
OZ_INLINE void oz_lists_note(global real *reference, OzBody body, OzVec3 shaft)
{
    reference[0] = oz_fixed_position_bits(body.position.x);
    reference[1] = oz_fixed_position_bits(body.position.y);
    reference[2] = oz_fixed_position_bits(body.position.z);
    oz_work_store3(reference + 3, shaft);
}

/* Takes the present places as the outer list's reference. */
OZ_INLINE void oz_lists_refer(OzWork *w, int region)
{
    int begin = oz_work_block_begin(w, region), end = oz_work_block_end(w, region);
    for (int block = begin; block < end; block++) {
        OzBody body = oz_grains_load(w, block);
        OzShape shape = oz_grains_shape(w, block);
        OzVec3 shaft = oz_scale(oz_quaternion_axis(body.turn), shape.half_length);
        oz_lists_note(w->reference_outer + (size_t)block * OZ_REFERENCE, body, shaft);
    }
}

/* A grain's skin: what it moves in skin_time at its present speed, no less and no more than the
 * bounds. */
OZ_INLINE real oz_lists_skin(const OzWork *w, OzBody body, OzShape shape, OzVec3 axis)
{
    global const OzParameters *p = w->parameters;
    OzVec3 rate = oz_body_rate(body.spin, axis, shape);
    real speed =
        sqrt(oz_dot(body.velocity, body.velocity)) + shape.half_length * sqrt(oz_dot(rate, rate));
    return oz_smaller(REAL(p->skin_most), REAL(p->skin_least) + speed * REAL(p->skin_time));
}

/* Takes the present places as the inner list's reference, gives each grain its skin, and marks the
 * outer list stale where it does not cover a grain's motion since it was made and its skin. */
OZ_INLINE void oz_lists_measure(OzWork *w, int region)
{
    int begin = oz_work_block_begin(w, region), end = oz_work_block_end(w, region);
    for (int block = begin; block < end; block++) {
        OzBody body = oz_grains_load(w, block);
        OzShape shape = oz_grains_shape(w, block);
        OzVec3 axis = oz_quaternion_axis(body.turn), shaft = oz_scale(axis, shape.half_length);
        real skin = oz_lists_skin(w, body, shape, axis);
        global const real *outer = w->reference_outer + (size_t)block * OZ_REFERENCE;
        real left =
            outer[OZ_REFERENCE_SKIN] - skin; /* outer_least is above skin_most: never negative */
        mask holds = oz_grains_moved2(w, outer, body, shaft) <= left * left;
        if (OZ_ANY(!holds)) {
            w->control->outer_stale = 1;
        }
        oz_lists_note(w->reference_inner + (size_t)block * OZ_REFERENCE, body, shaft);
        w->reference_inner[(size_t)block * OZ_REFERENCE + OZ_REFERENCE_SKIN] = skin;
        scalar lane[OZ_LANES];
        OZ_LANES_STORE(skin, lane);
        for (int l = 0; l < OZ_LANES; l++) {
            w->record[(size_t)(block * OZ_LANES + l) * OZ_RECORD + OZ_R_SKIN] = lane[l];
        }
    }
}

/* back[l] receives a number for pair l: how many pairs with the same second grain have been counted
 * before it. All numbers of a block are taken before any of its pairs is written, because counting
 * with atomics waits until what was written before has arrived. */
OZ_INLINE void oz_lists_count(OzWork *w, const int *outer, int count, int *back)
{
#if !OZ_SCATTER
    for (int l = 0; l < count; l++) {
        back[l] = OZ_WORK_COUNT(&w->back_number[w->outer_b[outer[l]]]);
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
#if !OZ_SCATTER
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
        w->pair_b[p] = w->z.slots;
    }
}

OZ_INLINE void oz_lists_reset(OzWork *w, int region)
{
#if !OZ_SCATTER
    int end = min((region + 1) * w->z.region_slots, w->z.slots);
    for (int i = oz_work_region_begin(w, region); i < end; i++) {
        w->pair_number[i] = 0;
        w->pair_first[i] = 0;
        w->back_number[i] = 0;
    }
#endif
}

/* Skins of the grains in slots. */
OZ_INLINE real oz_lists_skins(const OzWork *w, const int *slots)
{
    real words[4];
    oz_lanes_load4(w->record, slots, OZ_RECORD, OZ_R_VELOCITY, words);
    return words[OZ_R_SKIN - OZ_R_VELOCITY];
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
        real radii, distance2 = oz_pairs_distance2(w, oz_work_geometry(w, a),
                                                   oz_work_geometry(w, b), &radii);
        real near = radii + oz_lists_skins(w, a) + oz_lists_skins(w, b);
        mask hits = (distance2 < near * near) & oz_lanes_mask_of(OZ_LANES_IOTA + first < outer_end);
        int hit_count = oz_lanes_compact(active, OZ_LANES_IOTA + first, hits);
        int taken = min(hit_count, max(w->z.inner_capacity - count, 0)), back[OZ_LANES];
        oz_lists_count(w, active, taken, back);
        for (int l = 0; l < taken; l++) {
            oz_lists_take(w, active[l], begin + count + l, back[l]);
        }
        count += hit_count;
    }
    if (count > w->z.inner_capacity) {
        oz_lists_full(w);
        atomic_max(&w->control->inner_needed, count);
        return;
    }
    oz_lists_pad(w, begin, count);
    w->pair_count[region] = count;
    for (int p = begin; p < begin + count; p += OZ_LANES) {
        w->pair_active[p / OZ_LANES] = -1; /* any may have a spring */
    }
}

/* Sorts each grain's pairs in which it is the second by the first one's id. */
OZ_INLINE void oz_lists_order(OzWork *w, int region)
{
#if !OZ_SCATTER
    for (int i = oz_work_region_begin(w, region); i < oz_work_region_end(w, region); i++) {
        int count = w->back_number[i];
        if (count > w->z.back_capacity) {
            oz_lists_full(w);
            atomic_max(&w->control->back_needed, count);
            continue;
        }
        global int *back = w->back + (size_t)i * w->z.back_capacity;
        for (int k = 1; k < count; k++) {
            int kept = back[k], key = w->id[w->pair_a[kept]], to = k;
            while (to > 0 && w->id[w->pair_a[back[to - 1]]] > key) {
                back[to] = back[to - 1];
                to--;
            }
            back[to] = kept;
        }
        if (!OZ_EQUAL) {
            int before = 0;
            while (before < count && w->id[w->pair_a[back[before]]] < w->id[i]) {
                before++;
            }
            w->back_before[i] = before;
        }
    }
#endif
}

#endif
