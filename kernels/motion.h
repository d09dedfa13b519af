/* The part of a step after the forces between grains: what a region's grains feel, and where they
 * go. OpenCL C only. */
#pragma once

#include "kernels/enclosure.h"
#include "kernels/near.h"
#include "kernels/lists.h"
#include "kernels/drag.h"

/* Where it is marked that lists do not hold a step's places. */
#if OZ_MOVES_BEFORE && OZ_RESORT
#define OZ_MOTION_STALE(w) (&(w)->control->stale_positions)
#else
#define OZ_MOTION_STALE(w) (&(w)->control->stale_step)
#endif

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

#if OZ_SHEAR
/* The places of a block in the lattice of a tilt that is less by `turns` times the cell's length
 * over its width: y times that is added along x, to the last digit, so that images stay images. */
OZ_INLINE void oz_motion_turn(OzWork *w, int block, OzBody *body, int turns)
{
    global const OzParameters *p = w->parameters;
    place_kind x[OZ_LANES], y[OZ_LANES];
    scalar rest[OZ_LANES];
    OZ_LANES_STORE(body->position.x, x);
    OZ_LANES_STORE(body->position.y, y);
    OZ_LANES_STORE(body->rest.x, rest);
    for (int l = 0; l < OZ_LANES; l++) {
        global int *image = w->image + 3 * w->id[block * OZ_LANES + l];
#if defined(OZ_DOUBLE)
        x[l] += turns * (y[l] * (p->period[0] / p->period[1]));
#else
        long length = (int)p->period[0] + (int)p->period_rest[0];
        long width = (int)p->period[1] + (int)p->period_rest[1];
        long product = turns * length * y[l];
        x[l] += (int)(product / width);
        rest[l] += (scalar)(product % width) / (scalar)width;
#endif
        image[0] += turns * image[1];
    }
    body->position.x = (fixed_position)(OZ_LANES_LOAD(x));
    body->rest.x = OZ_LANES_LOAD(rest);
}

/* What a sheared cell does to a block that has moved from a place. */
OZ_INLINE void oz_motion_shear(OzWork *w, int block, OzBody *body, OzShape shape, OzBody from,
                               int step)
{
    OzSpace space = oz_work_space(w);
    int turns = (int)w->shear[OZ_SHEAR_WORDS * (step + 1) + OZ_H_TURNS];
    space.tilt += turns * (w->parameters->period[0] / w->parameters->period[1]);
    real less = oz_shear_follow(body, from.position, from.rest, space, w->parameters->inverse_unit);
    if (turns != 0) {
        oz_motion_turn(w, block, body, turns);
        OZ_WORK_MARK(OZ_MOTION_STALE(w), step);
        w->control->outer_stale = 1;
    }
#if OZ_LEDGER
    scalar lane[OZ_LANES];
    OZ_LANES_STORE(oz_shear_gain(shape.mass, less, body->velocity.x), lane);
    for (int l = 0; l < OZ_LANES && block * OZ_LANES + l < w->z.count; l++) {
        size_t row = (size_t)w->id[block * OZ_LANES + l] * OZ_LEDGER_WORDS;
        w->ledger[row + OZ_L_WORK_WALLS] += (double)lane[l];
    }
#endif
    (void)shape, (void)less;
}
#endif

#if OZ_MOVES_BEFORE
/* The part of a step before the forces. */
OZ_INLINE void oz_motion_before_block(OzWork *w, int block, int step)
{
    real dt = REAL(w->parameters->dt);
    OzBody body = oz_grains_load(w, block);
    OzShape shape = oz_grains_shape(w, block);
#if OZ_SHEAR
    OzBody from = body;
#endif
    oz_integrate_before(&body, shape, dt, w->parameters->inverse_unit);
#if OZ_SHEAR
    oz_motion_shear(w, block, &body, shape, from, step);
#endif
#if OZ_PERIODIC
    oz_motion_wrap(w, block, &body);
#endif
    oz_grains_store(w, block, body);
    oz_grains_record(w, 0, block, body, shape, oz_integrate_seen_velocity(body, dt),
                     oz_integrate_seen_spin(body, shape, dt));
    oz_lists_watch(w, block, oz_near_pose_of(body, shape), OZ_MOTION_STALE(w), step);
}
#endif

#if OZ_DRAG
/* A block's drag at the velocity and the rotation that its forces see. */
OZ_INLINE OzLoad oz_motion_drag(const OzWork *w, OzBody body, OzShape shape)
{
    real dt = REAL(w->parameters->dt);
    OzVec3 spin = oz_integrate_seen_spin(body, shape, dt);
    return oz_drag_load(w->parameters->fluid, shape, oz_integrate_seen_velocity(body, dt),
                        oz_body_rate(spin, oz_quaternion_axis(body.turn), shape));
}

#if OZ_LEDGER
/* Half of a drag's power at a velocity and a rotation. */
OZ_INLINE real oz_motion_power(OzLoad drag, OzVec3 velocity, OzVec3 spin, OzBody body,
                               OzShape shape)
{
    OzVec3 rate = oz_body_rate(spin, oz_quaternion_axis(body.turn), shape);
    return REAL(0.5) * (oz_dot(drag.force, velocity) + oz_dot(drag.torque, rate));
}

/* What the fluid took from a block in a step, as ledger.h does of contacts: by the mean of the
 * motion that forces saw and of the one after. */
OZ_INLINE void oz_motion_note_drag(OzWork *w, int block, OzLoad drag, OzBody before, OzBody after,
                                   OzShape shape)
{
    real dt = REAL(w->parameters->dt);
    OzVec3 spin = oz_integrate_seen_spin(before, shape, dt);
    real power =
        oz_motion_power(drag, oz_integrate_seen_velocity(before, dt), spin, before, shape) +
        oz_motion_power(drag, after.velocity, after.spin, after, shape);
    scalar lane[OZ_LANES];
    OZ_LANES_STORE(power, lane);
    for (int l = 0; l < OZ_LANES && block * OZ_LANES + l < w->z.count; l++) {
        size_t row = (size_t)w->id[block * OZ_LANES + l] * OZ_LEDGER_WORDS;
        w->ledger[row + OZ_L_DISSIPATED] -= (double)w->parameters->dt * (double)lane[l];
    }
}
#endif
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
#if OZ_DRAG
    OzLoad drag = oz_motion_drag(w, body, shape);
    load.force = oz_add(load.force, drag.force);
    load.torque = oz_add(load.torque, drag.torque);
#endif
#if OZ_DRAG && OZ_LEDGER
    OzBody before = body;
#endif
#if OZ_SHEAR && !OZ_MOVES_BEFORE
    OzBody from = body;
#endif
    oz_integrate_after(&body, shape, load, REAL(p->dt), p->inverse_unit);
#if OZ_DRAG && OZ_LEDGER
    oz_motion_note_drag(w, block, drag, before, body, shape);
#endif
#if OZ_SHEAR && !OZ_MOVES_BEFORE
    oz_motion_shear(w, block, &body, shape, from, step);
#endif
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
    oz_lists_watch(w, block, oz_near_pose_of(body, shape), OZ_MOTION_STALE(w), step);
#endif
}

OZ_INLINE void oz_motion_region(OzWork *w, int region, int step)
{
    OZ_WORK_PLACES(w, step + 1);
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
    OZ_WORK_PLACES(w, step + 1);
    for (int block = oz_work_block_begin(w, region); block < oz_work_block_end(w, region);
         block++) {
        oz_motion_before_block(w, block, step);
    }
}
#endif
