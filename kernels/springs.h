/* Tangential springs, and rolling ones beside them, on their way through a rebuild of the lists:
 * inner -> outer -> saved by ids -> outer -> inner (control->truth says where they are). OpenCL C
 * only. */
#pragma once

#include "kernels/member.h"

#if OZ_HISTORY
OZ_INLINE void oz_springs_copy(global scalar *to, global const scalar *from)
{
    to[0] = from[0];
    to[1] = from[1];
    to[2] = from[2];
}

/* Whether a pair of the outer list remembers anything. */
OZ_INLINE int oz_springs_any(const OzWork *w, int outer)
{
    global const scalar *h = w->outer_history + (size_t)outer * 3;
    int any = h[0] != 0 || h[1] != 0 || h[2] != 0;
#if OZ_ROLLING_SPRING
    global const scalar *r = w->outer_rolling + (size_t)outer * 3;
    any = any || r[0] != 0 || r[1] != 0 || r[2] != 0;
#endif
    return any;
}

/* A spring of the outer list to the inner one. */
OZ_INLINE void oz_springs_take(OzWork *w, int outer, int to)
{
    oz_springs_copy(w->pair_history + (size_t)to * OZ_SPRING, w->outer_history + (size_t)outer * 3);
#if OZ_ROLLING_SPRING
    oz_springs_copy(w->pair_rolling + (size_t)to * OZ_SPRING, w->outer_rolling + (size_t)outer * 3);
#endif
}
#endif

/* Inner springs back to the outer list. */
OZ_INLINE void oz_springs_harvest(OzWork *w, int region)
{
#if OZ_HISTORY
    int begin = region * w->z.inner_capacity, count = w->pair_count[region];
    for (int p = begin; p < begin + count; p++) {
        size_t to = (size_t)w->pair_outer[p] * 3, from = (size_t)p * OZ_SPRING;
        oz_springs_copy(w->outer_history + to, w->pair_history + from);
#if OZ_ROLLING_SPRING
        oz_springs_copy(w->outer_rolling + to, w->pair_rolling + from);
#endif
    }
#endif
}

/* Empties the outer list's springs once the inner list has them: one whose pair has left the inner
 * list was let go, and must not be found again when the pair comes back. */
OZ_INLINE void oz_springs_forget(OzWork *w, int region)
{
#if OZ_HISTORY
    int blocks = (w->outer_count[region] + OZ_LANES - 1) / OZ_LANES;
    global real *words = (global real *)w->outer_history;
    size_t first = 3 * (size_t)(region * w->z.outer_capacity / OZ_LANES);
    words += first;
    for (int k = 0; k < 3 * blocks; k++) {
        words[k] = REAL(0.0);
    }
#if OZ_ROLLING_SPRING
    words = (global real *)w->outer_rolling + first;
    for (int k = 0; k < 3 * blocks; k++) {
        words[k] = REAL(0.0);
    }
#endif
#endif
}

/* Springs of the outer list to the saved list, keyed by ids. */
OZ_INLINE void oz_springs_save(OzWork *w, int region)
{
#if OZ_HISTORY
    oz_work_tile(w, region);
    int begin = region * w->z.outer_capacity, saved = region * w->z.inner_capacity, count = 0;
    for (int o = begin; o < begin + w->outer_count[region]; o++) {
        int own = oz_work_is_own(w, w->outer_a[o]); /* else another tile saves its copy */
        if (own && oz_springs_any(w, o)) {
            int to = saved + count++;
            w->saved_a[to] = w->id[w->outer_a[o]];
            w->saved_b[to] = w->id[w->outer_b[o]];
            oz_springs_copy(w->saved_history + (size_t)to * 3, w->outer_history + (size_t)o * 3);
#if OZ_ROLLING_SPRING
            oz_springs_copy(w->saved_rolling + (size_t)to * 3, w->outer_rolling + (size_t)o * 3);
#endif
        }
    }
    w->saved_count[region] = count;
#endif
}

/* A saved spring to a pair of the outer list. */
OZ_INLINE void oz_springs_put(OzWork *w, int from, int to)
{
#if OZ_HISTORY
    oz_springs_copy(w->outer_history + (size_t)to * 3, w->saved_history + (size_t)from * 3);
#if OZ_ROLLING_SPRING
    oz_springs_copy(w->outer_rolling + (size_t)to * 3, w->saved_rolling + (size_t)from * 3);
#endif
#endif
}

#if OZ_HISTORY && OZ_TILES

/* A saved spring to its pair in a tile's outer list, which is in the order of ids. */
OZ_INLINE void oz_springs_restore_to(OzWork *w, int tile, int from)
{
    int a = w->saved_a[from], b = w->saved_b[from];
    int low = tile * w->z.outer_capacity, end = low + w->outer_count[tile], high = end;
    while (low < high) {
        int middle = (low + high) / 2;
        int first = w->id[w->outer_a[middle]], second = w->id[w->outer_b[middle]];
        if (first < a || (first == a && second < b)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    if (low < end && w->id[w->outer_a[low]] == a && w->id[w->outer_b[low]] == b) {
        oz_springs_put(w, from, low);
    }
}

/* To the lists of both grains' tiles. */
OZ_INLINE void oz_springs_restore_one(OzWork *w, int from)
{
    int tile_a = w->slot_of[w->saved_a[from]] / w->z.region_slots;
    int tile_b = w->slot_of[w->saved_b[from]] / w->z.region_slots;
    oz_springs_restore_to(w, tile_a, from);
    if (tile_b != tile_a) {
        oz_springs_restore_to(w, tile_b, from);
    }
}

#elif OZ_HISTORY

OZ_INLINE void oz_springs_restore_one(OzWork *w, int from)
{
    int a = w->slot_of[w->saved_a[from]], b = w->slot_of[w->saved_b[from]];
    int first = w->outer_first[a], last = first + w->outer_number[a];
    for (int o = first; o < last; o++) {
        if (w->outer_b[o] == b) {
            oz_springs_put(w, from, o);
        }
    }
}

#endif

/* Saved springs to their places in the new outer list. A spring whose pair is not listed any more
 * cannot be: it touched, so its gap is below the skin. */
OZ_INLINE void oz_springs_restore(OzWork *w, int region)
{
#if OZ_HISTORY
    int begin = region * w->z.inner_capacity;
    for (int from = begin; from < begin + w->saved_count[region]; from++) {
        oz_springs_restore_one(w, from);
    }
#endif
}
