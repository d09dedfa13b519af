/* What every element feels: results of pairs and of beams, added up in the order of partners, those
 * of contacts first. One work-item hands each result to both elements; many work-items gather, each
 * for its own elements, in the same order. Loads are zero before: who uses them up clears them.
 * OpenCL C only. */
#pragma once

#include "kernels/element_work.h"

/* A result as the second element feels it, and as the first does. */
OZ_INLINE scalar4 oz_element_loads_second(scalar4 result)
{
    return (scalar4)(result.x, result.y, result.w, 0);
}

OZ_INLINE scalar4 oz_element_loads_first(scalar4 result)
{
    return (scalar4)(-result.x, -result.y, result.z, 0);
}

#if OZ_SCATTER

OZ_INLINE void oz_element_loads_contacts(OzWork *w, global scalar *load)
{
    global scalar4 *loads = (global scalar4 *)load;
    global const scalar4 *results = (global const scalar4 *)w->pair_force;
    for (int t = 0; t < w->touch_count[0]; t++) {
        int p = w->touch[t], a = w->pair_a[p], b = w->pair_b[p];
        loads[a] += oz_element_loads_first(results[t]);
        loads[b] += oz_element_loads_second(results[t]);
    }
}

OZ_INLINE void oz_element_loads_beams(OzWork *w, global scalar *load)
{
    global scalar4 *loads = (global scalar4 *)load;
    global const scalar4 *results = (global const scalar4 *)w->beam_force;
    for (int k = 0; k < w->control->beam_count; k++) {
        int a = w->beam_a[k], b = w->beam_b[k];
        loads[a] += oz_element_loads_first(results[k]);
        loads[b] += oz_element_loads_second(results[k]);
    }
}

#else

/* Contacts in which an element is the second have partners before it, the others after it. */
OZ_INLINE void oz_element_loads_contacts_of(OzWork *w, global scalar4 *loads, int i)
{
    global const scalar4 *results = (global const scalar4 *)w->pair_force;
    global const int *back = w->back + (size_t)i * w->z.back_capacity;
    scalar4 sum = loads[i];
    for (int k = 0; k < w->back_number[i]; k++) {
        int t = w->pair_hit[back[k]];
        if (t >= 0) {
            sum += oz_element_loads_second(results[t]);
        }
    }
    for (int k = 0; k < w->pair_number[i]; k++) {
        int t = w->pair_hit[w->pair_first[i] + k];
        if (t >= 0) {
            sum += oz_element_loads_first(results[t]);
        }
    }
    loads[i] = sum;
}

OZ_INLINE void oz_element_loads_beams_of(OzWork *w, global scalar4 *loads, int i)
{
    global const scalar4 *results = (global const scalar4 *)w->beam_force;
    scalar4 sum = loads[i];
    for (int k = w->beam_first[i]; k < w->beam_first[i + 1]; k++) {
        int beam = w->beam_of[k];
        sum += w->beam_a[beam] == i ? oz_element_loads_first(results[beam])
                                    : oz_element_loads_second(results[beam]);
    }
    loads[i] = sum;
}

/* A work-item's own elements are those of the blocks that it moves. */
#define OZ_ELEMENT_LOADS(name)                                                                     \
    OZ_INLINE void oz_element_loads_##name(OzWork *w, global scalar *load)                         \
    {                                                                                              \
        OZ_EACH(w, block, w->z.free_blocks)                                                        \
        {                                                                                          \
            for (int i = block * OZ_LANES; i < (block + 1) * OZ_LANES; i++) {                      \
                if (i < w->control->free_count) {                                                  \
                    oz_element_loads_##name##_of(w, (global scalar4 *)load, i);                    \
                }                                                                                  \
            }                                                                                      \
        }                                                                                          \
    }

OZ_ELEMENT_LOADS(contacts)
OZ_ELEMENT_LOADS(beams)

#endif
