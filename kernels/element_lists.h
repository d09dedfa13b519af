/* Neighbour lists. The outer list holds every pair of elements of different bodies whose gap was
 * below the sum of both outer skins when it was made from the grid; the inner list, those of them
 * whose gap is below the sum of both inner skins. An element's skins grow with its speed, so that
 * slow and fast ones use theirs up at about the same time. Both are ordered by first slot, then by
 * second: whatever the skins, touching pairs come in the same order. A list too small raises
 * control->full with the size needed, so that the host can enlarge it and repeat: no pair is ever
 * dropped. OpenCL C only. */
#ifndef OZ_KERNELS_ELEMENT_LISTS_H
#define OZ_KERNELS_ELEMENT_LISTS_H

#include "kernels/element_cells.h"
#include "kernels/element_near.h"

OZ_INLINE void oz_element_lists_full(OzElementWork *w, volatile global int *needed, int count)
{
    atomic_or(&w->control->full, 1);
    atomic_max(needed, count);
}

enum { OZ_ELEMENT_CANDIDATES = 256 };

/* The search of one element's partners: candidates by centre distance are collected, then tested by
 * the gap, a block of lanes at a time. */
typedef struct OzElementSearch {
    int slot, body;
    scalar x, y;  /* of its centre, m                                     */
    scalar reach; /* m, its own and its skin                              */
    real skin;    /* m, in every lane                                     */
    OzElement element;
    real radius;
    int out, limit; /* where its next pair goes; the end of the region's list */
    int wanted;     /* pairs found in this region, stored or not            */
    int count;      /* candidates                                           */
    int candidate[OZ_ELEMENT_CANDIDATES + 2 * OZ_LANES];
} OzElementSearch;

/* Skins in a list whose reference is given. */
OZ_INLINE real oz_element_lists_skins(global const real *reference, const int *slots)
{
    scalar skin[OZ_LANES];
    for (int l = 0; l < OZ_LANES; l++) {
        skin[l] = ((global const scalar *)
                       reference)[oz_element_cells_at(slots[l], OZ_ELEMENT_REFERENCE, OZ_PF_SKIN)];
    }
    return OZ_LANES_LOAD(skin);
}

/* Tests the collected candidates and stores the pairs. */
OZ_INLINE void oz_element_lists_flush(OzElementWork *w, OzElementSearch *s)
{
    for (int l = 0; l < OZ_LANES; l++) {
        s->candidate[s->count + l] = s->slot;
    }
    for (int first = 0; first < s->count; first += OZ_LANES) {
        int active[OZ_LANES];
        const int *slots = s->candidate + first;
        OzElement other = oz_element_work_element(w, slots);
        real margin = s->skin + oz_element_lists_skins(w->reference_outer, slots);
        mask hits = oz_element_pair_list_pair(w, &s->element, s->radius, &other, slots, margin) &
                    oz_lanes_mask_of(OZ_LANES_IOTA + first < s->count);
        int count = oz_lanes_compact(active, OZ_LANES_LOAD(slots), hits);
        s->wanted += count;
        for (int l = 0; l < count && s->out < s->limit; l++) {
            w->outer_a[s->out] = s->slot;
            w->outer_b[s->out++] = active[l];
        }
    }
    s->count = 0;
}

/* Candidates among the sorted elements first ... last. */
OZ_INLINE void oz_element_lists_sweep(OzElementWork *w, OzElementSearch *s, int first, int last)
{
    for (int k = first; k < last; k += OZ_LANES) {
        real x = OZ_LANES_LOAD(w->sorted_x + k) - s->x, y = OZ_LANES_LOAD(w->sorted_y + k) - s->y;
        real far = OZ_LANES_LOAD(w->sorted_far + k) + s->reach;
        index slots = OZ_LANES_LOAD(w->sorted_slot + k);
        mask mine =
            oz_lanes_mask_of((slots > s->slot) & (OZ_LANES_LOAD(w->sorted_body + k) != s->body) &
                             (OZ_LANES_IOTA + k < last));
        if (s->count > OZ_ELEMENT_CANDIDATES) {
            oz_element_lists_flush(w, s);
        }
        s->count +=
            oz_lanes_compact(s->candidate + s->count, slots, (x * x + y * y < far * far) & mine);
    }
}

/* One row of cells. */
OZ_INLINE void oz_element_lists_row(OzElementWork *w, OzElementSearch *s, int y, int low, int high)
{
    int row = oz_element_cells_row(w, y), start = low & (w->z.cells_x - 1);
    int cells = min(high - low + 1, w->z.cells_x);
    int stop = min(start + cells, w->z.cells_x), wrapped = start + cells - stop;
    oz_element_lists_sweep(w, s, w->cell_first[row + start], w->cell_first[row + stop]);
    if (wrapped > 0) {
        oz_element_lists_sweep(w, s, w->cell_first[row], w->cell_first[row + wrapped]);
    }
}

/* Candidates of an element: of a small one those in the cells around and the large ones, of a large
 * one all. */
OZ_INLINE void oz_element_lists_around(OzElementWork *w, OzElementSearch *s)
{
    global const OzElementParameters *p = w->parameters;
    int last = w->cell_first[w->z.cells + 1], large = w->cell_first[w->z.cells];
    if (oz_element_cells_reach(w, s->slot) > p->reach_small) {
        oz_element_lists_sweep(w, s, 0, last);
        return;
    }
    scalar far = s->reach + p->reach_small + p->outer_most;
    int x0 = (int)floor((s->x - far) * p->inverse_cell),
        x1 = (int)floor((s->x + far) * p->inverse_cell);
    int y0 = (int)floor((s->y - far) * p->inverse_cell),
        y1 = (int)floor((s->y + far) * p->inverse_cell);
    for (int y = y0; y <= min(y1, y0 + w->z.cells_y - 1); y++) {
        oz_element_lists_row(w, s, y, x0, x1);
    }
    oz_element_lists_sweep(w, s, large, last);
}

/* Sorts pairs first ... last of the outer list by their second element. */
OZ_INLINE void oz_element_lists_sort(OzElementWork *w, int first, int last)
{
    for (int i = first + 1; i < last; i++) {
        int kept = w->outer_b[i], to = i;
        while (to > first && w->outer_b[to - 1] > kept) {
            w->outer_b[to] = w->outer_b[to - 1];
            to--;
        }
        w->outer_b[to] = kept;
    }
}

/* The outer list of a region. */
OZ_INLINE void oz_element_lists_search(OzElementWork *w, int region)
{
    OzElementSearch s;
    int begin = region * w->z.outer_capacity;
    s.out = begin;
    s.limit = begin + w->z.outer_capacity;
    s.wanted = 0;
    s.count = 0;
    for (int i = region * w->z.region_slots; i < oz_element_work_region_end(w, region); i++) {
        global const scalar *record = w->record + (size_t)i * OZ_ELEMENT_RECORD;
        int own[OZ_LANES], first = s.out;
        for (int l = 0; l < OZ_LANES; l++) {
            own[l] = i;
        }
        s.slot = i;
        s.body = w->body[i];
        s.x = record[OZ_PR_POSITION];
        s.y = record[OZ_PR_POSITION + 1];
        s.reach = oz_element_cells_reach(w, i) + oz_element_cells_skin(w, i);
        s.skin = REAL(oz_element_cells_skin(w, i));
        s.radius = REAL(record[OZ_PR_RADIUS]);
        s.element = oz_element_work_element(w, own);
        oz_element_lists_around(w, &s);
        oz_element_lists_flush(w, &s);
        oz_element_lists_sort(w, first, s.out);
    }
    w->outer_count[region] = s.out - begin;
    for (int o = s.out; o < s.limit && (o - begin) % OZ_LANES != 0; o++) {
        w->outer_a[o] = 0; /* read with the last block, never taken */
        w->outer_b[o] = 0;
    }
    if (s.wanted > w->z.outer_capacity) {
        oz_element_lists_full(w, &w->control->outer_needed, s.wanted);
    }
}

/* What a block's elements move in `time` at their present speed, no less and no more than the
 * bounds. */
OZ_INLINE real oz_element_lists_skin(const OzElementWork *w, int block, const int *slots,
                                     scalar time, scalar least, scalar most)
{
    OzVec2 velocity;
    real angle, angular_velocity;
    oz_element_work_motion(w, slots, &velocity, &angle, &angular_velocity);
    real reach = w->shape[(size_t)block * OZ_ELEMENT_SHAPE + OZ_PS_REACH];
    real speed = oz_length2(velocity) + reach * oz_magnitude(angular_velocity);
    return oz_smaller(REAL(most), REAL(least) + speed * REAL(time));
}

OZ_INLINE void oz_element_lists_note(const OzElementWork *w, global real *reference,
                                     const int *slots, real skin)
{
    real at[4], motion[4];
    oz_lanes_load4(w->record, slots, OZ_ELEMENT_RECORD, OZ_PR_CORNER + 4, at);
    oz_lanes_load4(w->record, slots, OZ_ELEMENT_RECORD, OZ_PR_VELOCITY, motion);
    reference[OZ_PF_X] = at[2];
    reference[OZ_PF_Y] = at[3];
    reference[OZ_PF_ANGLE] = motion[2];
    reference[OZ_PF_SKIN] = skin;
}

/* How far, at most, any point of a block's elements at (x, y, angle) is from where the reference
 * has it. */
OZ_INLINE real oz_element_lists_moved(global const real *reference, real x, real y, real angle,
                                      real reach)
{
    OzVec2 way = oz_vec2(x - reference[OZ_PF_X], y - reference[OZ_PF_Y]);
    return oz_length2(way) + reach * oz_magnitude(angle - reference[OZ_PF_ANGLE]);
}

/* Takes the present places as the inner list's reference, gives each element its skin, and marks
 * the outer list as used up where it does not cover an element's motion since it was made and its
 * skin. */
OZ_INLINE void oz_element_lists_measure(OzElementWork *w)
{
    global const OzElementParameters *p = w->parameters;
    OZ_EACH(w, block, w->z.blocks)
    {
        int slots[OZ_LANES];
        oz_element_work_slots(block, slots);
        real skin =
            oz_element_lists_skin(w, block, slots, p->skin_time, p->skin_least, p->skin_most);
        global real *inner = w->reference_inner + (size_t)block * OZ_ELEMENT_REFERENCE;
        global const real *outer = w->reference_outer + (size_t)block * OZ_ELEMENT_REFERENCE;
        oz_element_lists_note(w, inner, slots, skin);
        real reach = w->shape[(size_t)block * OZ_ELEMENT_SHAPE + OZ_PS_REACH];
        real moved = oz_element_lists_moved(outer, inner[OZ_PF_X], inner[OZ_PF_Y],
                                            inner[OZ_PF_ANGLE], reach);
        if (OZ_ANY(moved + skin > outer[OZ_PF_SKIN])) {
            w->control->outer_holds = 0;
        }
    }
}

/* Takes the present places as the outer list's reference. */
OZ_INLINE void oz_element_lists_refer(OzElementWork *w)
{
    global const OzElementParameters *p = w->parameters;
    OZ_EACH(w, block, w->z.blocks)
    {
        int slots[OZ_LANES];
        oz_element_work_slots(block, slots);
        real skin =
            oz_element_lists_skin(w, block, slots, p->outer_time, p->outer_least, p->outer_most);
        oz_element_lists_note(w, w->reference_outer + (size_t)block * OZ_ELEMENT_REFERENCE, slots,
                              skin);
    }
}

#if OZ_GROUP > 1

OZ_INLINE void oz_element_lists_reset(OzElementWork *w)
{
    OZ_EACH(w, i, w->z.free_slots)
    {
        w->pair_number[i] = 0;
        w->back_number[i] = 0;
    }
}

/* Notes where a pair of the inner list is, for the gathering of forces. */
OZ_INLINE void oz_element_lists_index(OzElementWork *w, int a, int b, int to)
{
    if (w->pair_number[a]++ == 0) {
        w->pair_first[a] = to;
    }
    if (b < w->z.free_slots) {
        int back = OZ_ELEMENT_COUNT(&w->back_number[b]);
        if (back < w->z.back_capacity) {
            w->back[(size_t)b * w->z.back_capacity + back] = to;
        } else {
            oz_element_lists_full(w, &w->control->back_needed, back + 1);
        }
    }
}

/* Brings pairs in which an element is the second into the order of the first. */
OZ_INLINE void oz_element_lists_order(OzElementWork *w)
{
    OZ_EACH(w, i, w->control->free_count)
    {
        global int *back = w->back + (size_t)i * w->z.back_capacity;
        int count = min(w->back_number[i], w->z.back_capacity);
        for (int k = 1; k < count; k++) {
            int kept = back[k], to = k;
            while (to > 0 && back[to - 1] > kept) {
                back[to] = back[to - 1];
                to--;
            }
            back[to] = kept;
        }
    }
}

#else
#define oz_element_lists_index(w, a, b, to) ((void)0)
#endif

/* The region's inner list. Its last block is filled up with the list's first pair; the
 * classification knows the number of pairs and passes over these copies. */
OZ_INLINE void oz_element_lists_select(OzElementWork *w, int region)
{
    int outer = region * w->z.outer_capacity, outer_end = outer + w->outer_count[region];
    int begin = region * w->z.inner_capacity, count = 0, room = w->z.inner_capacity;
    for (int first = outer; first < outer_end; first += OZ_LANES) {
        int a[OZ_LANES], b[OZ_LANES], active[OZ_LANES];
        for (int l = 0; l < OZ_LANES; l++) {
            a[l] = w->outer_a[first + l];
            b[l] = w->outer_b[first + l];
        }
        real margin = oz_element_lists_skins(w->reference_inner, a) +
                      oz_element_lists_skins(w->reference_inner, b);
        mask hits = oz_element_pair_list_slots(w, a, b, margin) &
                    oz_lanes_mask_of(OZ_LANES_IOTA + first < outer_end);
        int hit_count = oz_lanes_compact(active, OZ_LANES_IOTA + first, hits);
        for (int l = 0; l < hit_count && count + l < room; l++) {
            int to = begin + count + l;
            w->pair_a[to] = w->outer_a[active[l]];
            w->pair_b[to] = w->outer_b[active[l]];
            oz_element_lists_index(w, w->pair_a[to], w->pair_b[to], to);
        }
        count += hit_count;
    }
    if (count > room) {
        oz_element_lists_full(w, &w->control->inner_needed, count);
    }
    w->pair_count[region] = min(count, room);
    for (int p = begin + min(count, room); (p - begin) % OZ_LANES != 0; p++) {
        w->pair_a[p] = 0;
        w->pair_b[p] = 0;
    }
}

#endif
