/* The part of a step after the forces between grains: what a region's grains feel, and where they
 * go. OpenCL C only. */
#pragma once

#include "kernels/enclosure.h"
#include "kernels/near.h"
#include "kernels/lists.h"

#if OZ_PERIODIC
/* Brings back into the cell what has left it, and counts the cells gone by. */
OZ_INLINE void oz_motion_wrap(OzWork *w, int block, OzBody *body)
{
    OzSpace space = oz_work_space(w);
    fixed_position *place[3] = {&body->position.x, &body->position.y, &body->position.z};
    for (int k = 0; k < 3; k++) {
        real cells = oz_space_cells(*place[k], space, k);
        if (OZ_PERIODIC >> k & 1 && OZ_ANY(cells != REAL(0.0))) {
            scalar gone[OZ_LANES];
            OZ_LANES_STORE(cells, gone);
            *place[k] = oz_space_nearest(*place[k], space, k);
            for (int l = 0; l < OZ_LANES; l++) {
                w->image[3 * w->id[block * OZ_LANES + l] + k] += (int)gone[l];
            }
        }
    }
}
#endif

#if OZ_MOVES_BEFORE
/* The part of a step before the forces. */
OZ_INLINE void oz_motion_before_block(OzWork *w, int block, int step)
{
    real dt = REAL(w->parameters->dt);
    OzBody body = oz_grains_load(w, block);
    OzShape shape = oz_grains_shape(w, block);
    oz_integrate_before(&body, shape, dt, w->parameters->inverse_unit);
#if OZ_PERIODIC
    oz_motion_wrap(w, block, &body);
#endif
    oz_grains_store(w, block, body);
    oz_grains_record(w, 0, block, body, shape, oz_integrate_seen_velocity(body, dt),
                     oz_integrate_seen_spin(body, shape, dt));
    oz_lists_watch(w, block, oz_near_pose_of(body, shape),
                   OZ_RESORT ? &w->control->stale_positions : &w->control->stale_step, step);
}
#endif

/* The part of a step after the forces. */
OZ_INLINE void oz_motion_block(OzWork *w, int block, int step)
{
    global const OzParameters *p = w->parameters;
    OzBody body = oz_grains_load(w, block);
    OzShape shape = oz_grains_shape(w, block);
    OzLoad load = oz_loads_of(w, block);
    OzVec3 gravity = oz_vec3(REAL(p->gravity[0]), REAL(p->gravity[1]), REAL(p->gravity[2]));
    load.force = oz_along(load.force, shape.mass, gravity);
#if OZ_PUSHED
    oz_loads_push(w, block, &load);
#endif
    oz_integrate_after(&body, shape, load, REAL(p->dt), p->inverse_unit);
    real keep = REAL(1 - p->drag * p->dt);
    body.velocity = oz_scale(body.velocity, keep);
    body.spin = oz_scale(body.spin, keep);
    if ((block + 1) * OZ_LANES > w->z.count) { /* padding is pinned */
        mask present = oz_grains_present(w, block);
        body.velocity = oz_where(present, body.velocity);
        body.spin = oz_where(present, body.spin);
#if OZ_MOVES_BEFORE
        body.acceleration = oz_where(present, body.acceleration);
        body.torque = oz_where(present, body.torque);
#endif
    }
    oz_grains_guard(w, block, body, shape, step);
#if OZ_PERIODIC && !OZ_MOVES_BEFORE
    oz_motion_wrap(w, block, &body);
#endif
    oz_grains_store(w, block, body);
#if !OZ_MOVES_BEFORE || OZ_LEDGER || OZ_TILES
    oz_grains_record(w, 1, block, body, shape, body.velocity, body.spin);
#endif
#if !OZ_MOVES_BEFORE
    oz_lists_watch(w, block, oz_near_pose_of(body, shape), &w->control->stale_step, step);
#endif
}

OZ_INLINE void oz_motion_region(OzWork *w, int region, int step)
{
#if OZ_GATHER
    oz_loads_gather_region(w, region);
#endif
#if OZ_WALL_COUNT > 0
    oz_enclosure_region(w, region, step);
#endif
    for (int block = oz_work_block_begin(w, region); block < oz_work_block_end(w, region);
         block++) {
        oz_motion_block(w, block, step);
    }
}

#if OZ_MOVES_BEFORE
/* The part of a step before the forces. */
OZ_INLINE void oz_motion_before_region(OzWork *w, int region, int step)
{
    for (int block = oz_work_block_begin(w, region); block < oz_work_block_end(w, region);
         block++) {
        oz_motion_before_block(w, block, step);
    }
}
#endif
