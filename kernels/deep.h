/* The guard of contacts' depth. Contacts deeper than guards.overlap.warn are counted; one deeper
 * than guards.overlap.stop, or whose shafts meet, stops the run. OpenCL C only. */
#pragma once

#include "kernels/work.h"

/* What the guard looks at, a contact a lane. */
typedef struct OzDeep {
    real overlap, rate; /* m, m/s                                                     */
    real unit, reach;   /* m, see depth.h                                             */
    mask counts;        /* lanes with a contact of their own                          */
    int kind;           /* OZ_DEEP_...                                                */
} OzDeep;

/* Counts a contact; of the launch's first step with any keeps the lowest id and the greatest depth.
 */
OZ_INLINE void oz_deep_count(OzWork *w, scalar depth, int kind, int step, int grain)
{
    global OzControl *control = w->control;
    atomic_inc(&control->deep_count);
    if (step <= control->deep_step) {
        atomic_min(&control->deep_step, step);
        atomic_min(&control->deep_index, grain);
        atomic_max(&control->deep_depth, convert_int_sat(depth * (scalar)OZ_DEEP_SHARE));
        atomic_or(&control->deep_kinds, kind);
    }
}

/* Where at least one contact is deep. */
OZ_INLINE void oz_deep_judge(OzWork *w, OzDeep deep, const int *slots, int step)
{
    global const OzParameters *p = w->parameters;
    mask warn = deep.counts & oz_depth_beyond(deep.overlap, deep.unit, p->deep_warn);
    mask stop = deep.counts & oz_depth_beyond(deep.overlap, deep.unit, p->deep_stop);
    mask met = deep.counts & oz_depth_meets(deep.overlap, deep.rate, deep.reach, p->dt);
    scalar depth[OZ_LANES];
    int hit[OZ_LANES];
    OZ_LANES_STORE(deep.overlap / deep.unit, depth);
    oz_lanes_store_mask(warn, hit);
    for (int l = 0; l < OZ_LANES; l++) {
        if (hit[l] && slots[l] < w->z.count && oz_work_is_own(w, slots[l])) {
            oz_deep_count(w, depth[l], deep.kind, step, w->id[slots[l]]);
        }
    }
    oz_work_stop_lanes(w, stop, OZ_STOP_DEEP, step, slots);
    oz_work_stop_lanes(w, met, OZ_STOP_MET, step, slots);
}

/* slots: of the first grain. Tells whether any contact was worth a look: those below deep_look are
 * passed over. A step moves an end by half a radius at most, so that no contact gets from there to
 * where shafts meet without being looked at. */
OZ_INLINE int oz_deep_guard(OzWork *w, OzDeep deep, const int *slots, int step)
{
    mask look = deep.counts & oz_depth_beyond(deep.overlap, deep.unit, w->parameters->deep_look);
    int found = OZ_ANY(look);
    if (found) {
        oz_deep_judge(w, deep, slots, step);
    }
    return found;
}
