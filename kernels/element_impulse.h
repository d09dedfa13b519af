/* Impulses: what each element has pushed and turned each wall with so far, force times time, added
 * up in double step by step, contact by contact in the order of partners. Means of forces on walls
 * are differences of these sums. Only compiled when a scene asks for such means. OpenCL C only. */
#pragma once

#include "kernels/element_work.h"

#if OZ_IMPULSES

/* Adds what a touching pair's result pushes with, where its second element is a wall's: force, and
 * torque about the origin, which moves with the wall. */
OZ_INLINE void oz_element_impulse_add(OzWork *w, int p, int t, int step)
{
    int a = w->pair_a[p], b = w->pair_b[p];
    if (b < w->z.free_slots) {
        return;
    }
    int wall = w->wall[b];
    global const scalar *result = w->pair_force + (size_t)t * OZ_ELEMENT_LOAD;
    global const scalar *centre = w->record + (size_t)b * OZ_ELEMENT_RECORD + OZ_PR_POSITION;
    double x = centre[0], y = centre[1], dt = w->parameters->dt;
    if (OZ_MOVING) {
        size_t at = (size_t)(step + 1) * w->z.walls + wall;
        y -= w->motion[at * OZ_ELEMENT_MOTION + OZ_PM_OFFSET];
    }
    global double *sum =
        w->wall_impulse + ((size_t)a * w->z.walls + wall) * OZ_ELEMENT_IMPULSE_WORDS;
    sum[0] += dt * result[0];
    sum[1] += dt * result[1];
    sum[2] += dt * (x * result[1] - y * result[0] + result[3]);
}

/* A step's contacts. Many work-items do the same, each for its own elements. */
OZ_INLINE void oz_element_impulse_step(OzWork *w, int step)
{
#if OZ_SCATTER
    for (int t = 0; t < w->touch_count[0]; t++) {
        oz_element_impulse_add(w, w->touch[t], t, step);
    }
#else
    OZ_EACH(w, block, w->z.free_blocks)
    {
        for (int i = block * OZ_LANES; i < (block + 1) * OZ_LANES; i++) {
            for (int k = 0; i < w->control->free_count && k < w->pair_number[i]; k++) {
                int p = w->pair_first[i] + k, t = w->pair_hit[p];
                if (t >= 0) {
                    oz_element_impulse_add(w, p, t, step);
                }
            }
        }
    }
#endif
}

#endif
