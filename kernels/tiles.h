/* Lists of tiles (member.h): pairs with a grain of another tile that is their first are strays.
 * They are found out of order, put aside, sorted and merged into the others. OpenCL C only. */
#pragma once

#include "kernels/member.h"

/* Strays are put aside where the inner list will be, by their ids. */
typedef struct OzStrays {
    int begin, end, limit; /* in pair_a and pair_b */
    int wanted;            /* found, stored or not */
} OzStrays;

/* The sorted grains from k on that are of other tiles. */
OZ_INLINE mask oz_tiles_foreign(const OzWork *w, int k)
{
    index slots = OZ_LANES_LOAD(w->sorted_slot + k);
    return oz_lanes_mask_of((slots < w->own_begin) | (slots >= w->own_end));
}

/* Whether a pair of a grain of this tile with another is a stray. */
OZ_INLINE int oz_tiles_is_stray(const OzWork *w, int slot, int other)
{
    return !oz_work_is_own(w, other) && oz_near_leads(w, other, slot);
}

OZ_INLINE void oz_tiles_add_stray(OzWork *w, OzStrays *strays, int first, int second)
{
    strays->wanted++;
    if (strays->end < strays->limit) {
        w->pair_a[strays->end] = w->id[first];
        w->pair_b[strays->end++] = w->id[second];
    }
}

/* Steps of Shell's sort, from the widest gap on: 1 is the last, then 0. */
OZ_INLINE int oz_tiles_gap(int before)
{
    return before > 1 ? before / 3 + (before == 2) : 0;
}

/* No strays yet; the ids of the tile's grains to cell_of, which the grid needs no more, sorted. */
OZ_INLINE void oz_tiles_begin(OzWork *w, OzStrays *strays, int region)
{
    int begin = w->own_begin, end = w->own_end;
    strays->begin = strays->end = region * w->z.inner_capacity;
    strays->limit = strays->begin + w->z.inner_capacity;
    strays->wanted = 0;
    for (int i = begin; i < end; i++) {
        w->cell_of[i] = w->id[i];
    }
    for (int gap = (end - begin) / 3 + 1; gap > 0; gap = oz_tiles_gap(gap)) {
        for (int i = begin + gap; i < end; i++) {
            int kept = w->cell_of[i], to = i;
            while (to - gap >= begin && w->cell_of[to - gap] > kept) {
                w->cell_of[to] = w->cell_of[to - gap];
                to -= gap;
            }
            w->cell_of[to] = kept;
        }
    }
}

/* Whether the pair of ids (a, b) comes after the pair (c, d). */
OZ_INLINE int oz_tiles_after(int a, int b, int c, int d)
{
    return a != c ? a > c : b > d;
}

OZ_INLINE void oz_tiles_sort(OzWork *w, const OzStrays *strays)
{
    for (int gap = (strays->end - strays->begin) / 3 + 1; gap > 0; gap = oz_tiles_gap(gap)) {
        for (int i = strays->begin + gap; i < strays->end; i++) {
            int a = w->pair_a[i], b = w->pair_b[i], to = i;
            while (to - gap >= strays->begin &&
                   oz_tiles_after(w->pair_a[to - gap], w->pair_b[to - gap], a, b)) {
                w->pair_a[to] = w->pair_a[to - gap];
                w->pair_b[to] = w->pair_b[to - gap];
                to -= gap;
            }
            w->pair_a[to] = a;
            w->pair_b[to] = b;
        }
    }
}

/* Merges the strays into the outer list's pairs begin ... out, which are in the order of ids. The
 * list's new end; the old one when there is no room up to the limit, which the caller knows too. */
OZ_INLINE int oz_tiles_merge(OzWork *w, const OzStrays *strays, int begin, int out, int limit)
{
    int own = out - 1, stray = strays->end - 1, end = out + strays->end - strays->begin;
    if (strays->wanted > strays->end - strays->begin || end > limit) {
        return out;
    }
    oz_tiles_sort(w, strays);
    for (int to = end - 1; stray >= strays->begin; to--) {
        int a = w->pair_a[stray], b = w->pair_b[stray];
        if (own >= begin && oz_tiles_after(w->id[w->outer_a[own]], w->id[w->outer_b[own]], a, b)) {
            w->outer_a[to] = w->outer_a[own];
            w->outer_b[to] = w->outer_b[own--];
        } else {
            w->outer_a[to] = w->slot_of[a];
            w->outer_b[to] = w->slot_of[b];
            stray--;
        }
    }
    return end;
}
