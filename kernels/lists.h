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

#include "kernels/search.h"

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
    oz_near_refer(w, block);
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
        oz_near_measure(w, block);
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
    w->pair_outer[to] = outer;
    oz_springs_take(w, outer, to);
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
        oz_search_full(w, &w->control->inner_needed, count);
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
            oz_search_full(w, &w->control->back_needed, count);
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
