/* Moving elements: prediction, records for contacts and beams, correction, guards. State words are
 * a coordinate and its derivatives times dt^n / n!. Velocity-verlet is the same scheme with two
 * derivatives: its velocity is predicted with the old acceleration for forces that depend on it.
 * OpenCL C only. */
#pragma once

#include "kernels/element_near.h"
#include "kernels/gear.h"
#include "kernels/turn.h"

#include "kernels/lists.h"

OZ_INLINE void oz_element_move_predict_one(real *q)
{
#if OZ_ORDER == 5
    OzGear gear = {{q[0], q[1], q[2], q[3], q[4]}};
    gear = oz_gear_predict(gear);
    OZ_UNROLL
    for (int k = 0; k < 5; k++) {
        q[k] = gear.value[k];
    }
#else
    q[0] += q[1] + q[2];
    q[1] += REAL(2.0) * q[2];
#endif
}

OZ_INLINE void oz_element_move_correct_one(real *q, real acceleration, real half_step2)
{
#if OZ_ORDER == 5
    OzGear gear = {{q[0], q[1], q[2], q[3], q[4]}};
    gear = oz_gear_correct(gear, acceleration, half_step2);
    OZ_UNROLL
    for (int k = 0; k < 5; k++) {
        q[k] = gear.value[k];
    }
#else
    q[1] += acceleration * half_step2 - q[2];
    q[2] = acceleration * half_step2;
#endif
}

/* Writes a block's records, but for what never changes. */
OZ_INLINE void oz_element_move_record(OzWork *w, int block, OzPose body)
{
    global const real *shape = w->shape + (size_t)block * OZ_ELEMENT_SHAPE;
    global scalar *record = w->record + (size_t)block * OZ_LANES * OZ_ELEMENT_RECORD;
    OzVec2 turn = oz_turn_of(body.angle);
    real words[OZ_PR_RADIUS];
    OZ_UNROLL
    for (int c = 0; c < 3; c++) {
        real x = shape[OZ_PS_CORNER + 2 * c], y = shape[OZ_PS_CORNER + 2 * c + 1];
        words[2 * c] = body.position.x + (turn.x * x - turn.y * y);
        words[2 * c + 1] = body.position.y + (turn.y * x + turn.x * y);
    }
    words[OZ_PR_POSITION] = body.position.x;
    words[OZ_PR_POSITION + 1] = body.position.y;
    words[OZ_PR_VELOCITY] = body.velocity.x;
    words[OZ_PR_VELOCITY + 1] = body.velocity.y;
    words[OZ_PR_ANGLE] = body.angle;
    words[OZ_PR_ANGULAR_VELOCITY] = body.angular_velocity;
    OZ_UNROLL
    for (int k = 0; k < OZ_PR_RADIUS; k += 4) {
        oz_lanes_store4(record, OZ_ELEMENT_RECORD, k, words + k);
    }
}

/* What never changes: radius and mass. */
OZ_INLINE void oz_element_move_label(OzWork *w, int block)
{
    global const real *shape = w->shape + (size_t)block * OZ_ELEMENT_SHAPE;
    real words[4] = {shape[OZ_PS_RADIUS], shape[OZ_PS_INVERSE_MASS], REAL(0.0), REAL(0.0)};
    oz_lanes_store4(w->record + (size_t)block * OZ_LANES * OZ_ELEMENT_RECORD, OZ_ELEMENT_RECORD,
                    OZ_PR_RADIUS, words);
}

/* Marks the inner list as used up where a block has moved too far for it, to where a step's forces
 * are wanted. */
OZ_INLINE void oz_element_move_watch(OzWork *w, int block, OzPose pose, int step)
{
    oz_lists_watch(w, block, pose,
                   OZ_RESORT ? &w->control->stale_positions : &w->control->stale_step, step);
}

/* Stops where an element goes too far in one step. way, turn: in this step. */
OZ_INLINE void oz_element_move_check_stride(OzWork *w, int block, OzVec2 way, real turn,
                                            int step)
{
    global const real *shape = w->shape + (size_t)block * OZ_ELEMENT_SHAPE;
    mask fast = !oz_near_within(way, oz_magnitude(turn), shape[OZ_PS_REACH],
                                shape[OZ_PS_STRIDE_MOST]);
    if (OZ_ANY(fast)) {
        int slots[OZ_LANES];
        oz_work_slots(block, slots);
        oz_work_stop_lanes(w, fast, OZ_ELEMENT_STOP_FAST, step, slots);
    }
}

OZ_INLINE OzPose oz_element_move_body(const OzWork *w, int block, const real *q, real inverse_dt)
{
    OzPose body;
    body.position = oz_vec2(q[0], q[OZ_ORDER]);
    body.angle = q[2 * OZ_ORDER];
    body.velocity = oz_vec2(q[1] * inverse_dt, q[OZ_ORDER + 1] * inverse_dt);
    body.angular_velocity = q[2 * OZ_ORDER + 1] * inverse_dt;
    body.reach = w->shape[(size_t)block * OZ_ELEMENT_SHAPE + OZ_PS_REACH];
    return body;
}

/* A block to the end of a step, as far as its derivatives tell: its state's words, and its records.
 */
OZ_INLINE void oz_element_move_ahead(OzWork *w, int block, real *q, real inverse_dt,
                                     int step)
{
    OZ_UNROLL
    for (int c = 0; c < 3; c++) {
        oz_element_move_predict_one(q + c * OZ_ORDER);
    }
    OzPose body = oz_element_move_body(w, block, q, inverse_dt);
    oz_element_move_check_stride(w, block, oz_vec2(q[1], q[OZ_ORDER + 1]), q[2 * OZ_ORDER + 1],
                                 step);
    oz_element_move_record(w, block, body);
    oz_element_move_watch(w, block, body, step);
}

OZ_INLINE void oz_element_move_load(const OzWork *w, int block, real *q)
{
    OZ_UNROLL
    for (int k = 0; k < OZ_ELEMENT_STATE; k++) {
        q[k] = w->state[(size_t)block * OZ_ELEMENT_STATE + k];
    }
}

OZ_INLINE void oz_element_move_store(OzWork *w, int block, const real *q)
{
    OZ_UNROLL
    for (int k = 0; k < OZ_ELEMENT_STATE; k++) {
        w->state[(size_t)block * OZ_ELEMENT_STATE + k] = q[k];
    }
}

/* Free elements to the end of a step; walls are moved apart. */
OZ_INLINE void oz_element_move_predict(OzWork *w, int step)
{
    real inverse_dt = REAL(1.0) / REAL(w->parameters->dt);
    OZ_EACH(w, block, w->z.free_blocks)
    {
        real q[OZ_ELEMENT_STATE];
        oz_element_move_load(w, block, q);
        oz_element_move_ahead(w, block, q, inverse_dt, step);
        oz_element_move_store(w, block, q);
    }
}

/* One word of the walls' motion at a step, for each lane's wall. */
OZ_INLINE real oz_element_move_wall_word(const OzWork *w, int block, int step, int word)
{
    scalar value[OZ_LANES];
    for (int l = 0; l < OZ_LANES; l++) {
        int wall = w->wall[block * OZ_LANES + l];
        value[l] = w->motion[((size_t)step * w->z.walls + wall) * OZ_ELEMENT_MOTION + word];
    }
    return OZ_LANES_LOAD(value);
}

/* A wall's elements where its motion has them: turned about its point, then up. The state holds
 * them untouched. */
OZ_INLINE OzPose oz_element_move_carried(const OzWork *w, int block, int step)
{
    global const real *state = w->state + (size_t)block * OZ_ELEMENT_STATE;
    OzVec2 point = oz_vec2(oz_element_move_wall_word(w, block, step, OZ_PM_POINT),
                           oz_element_move_wall_word(w, block, step, OZ_PM_POINT + 1));
    OzVec2 turn = oz_vec2(oz_element_move_wall_word(w, block, step, OZ_PM_COS),
                          oz_element_move_wall_word(w, block, step, OZ_PM_SIN));
    OzVec2 arm = oz_minus2(oz_vec2(state[0], state[OZ_ORDER]), point);
    OzPose body;
    arm = oz_vec2(turn.x * arm.x - turn.y * arm.y, turn.y * arm.x + turn.x * arm.y);
    body.position = oz_add2(point, arm);
    body.position.y += oz_element_move_wall_word(w, block, step, OZ_PM_OFFSET);
    body.angular_velocity = oz_element_move_wall_word(w, block, step, OZ_PM_ANGULAR_VELOCITY);
    body.velocity = oz_scale2(oz_left2(arm), body.angular_velocity);
    body.velocity.y += oz_element_move_wall_word(w, block, step, OZ_PM_VELOCITY);
    body.angle = state[2 * OZ_ORDER] + oz_element_move_wall_word(w, block, step, OZ_PM_ANGLE);
    body.reach = w->shape[(size_t)block * OZ_ELEMENT_SHAPE + OZ_PS_REACH];
    return body;
}

/* Walls' elements to where they are at a step of the launch, the end of the one before. */
OZ_INLINE void oz_element_move_walls(OzWork *w, int step)
{
    OZ_EACH(w, k, w->z.blocks - w->z.free_blocks)
    {
        int block = w->z.free_blocks + k;
        OzPose body = oz_element_move_carried(w, block, step);
        oz_element_move_record(w, block, body);
        oz_element_move_watch(w, block, body, step - 1);
    }
}

/* Lanes all of whose state's words are finite: x - x is 0 for these alone. */
OZ_INLINE mask oz_element_move_is_number(const real *q)
{
    mask number = q[0] - q[0] == REAL(0.0);
    OZ_UNROLL
    for (int k = 1; k < OZ_ELEMENT_STATE; k++) {
        number = number & (q[k] - q[k] == REAL(0.0));
    }
    return number;
}

/* Stops where a block's state is no number or far away. */
OZ_INLINE void oz_element_move_check(OzWork *w, int block, const real *q, int step)
{
    global const OzParameters *p = w->parameters;
    real x = oz_magnitude(q[0] - REAL(p->middle[0]));
    real y = oz_magnitude(q[OZ_ORDER] - REAL(p->middle[1]));
    mask number = oz_element_move_is_number(q);
    mask lost = !((x < REAL(p->domain)) & (y < REAL(p->domain)) & number);
    if (OZ_ANY(lost)) {
        int slots[OZ_LANES];
        oz_work_slots(block, slots);
        oz_work_stop_lanes(w, lost & number, OZ_ELEMENT_STOP_ESCAPED, step, slots);
        oz_work_stop_lanes(w, !number, OZ_ELEMENT_STOP_NAN, step, slots);
    }
}

/* Corrects a block's prediction by what its forces really are, which are used up. */
OZ_INLINE void oz_element_move_back(OzWork *w, int block, real *q, int step)
{
    global const OzParameters *p = w->parameters;
    global const real *shape = w->shape + (size_t)block * OZ_ELEMENT_SHAPE;
    real half_step2 = REAL((scalar)0.5 * p->dt * p->dt), drag = REAL(p->drag / p->dt);
    int slots[OZ_LANES];
    real load[4];
    oz_work_slots(block, slots);
    oz_lanes_load4(w->load, slots, OZ_ELEMENT_LOAD, 0, load);
    OZ_UNROLL
    for (int k = 0; k < OZ_ELEMENT_LOAD; k++) {
        ((global real *)w->load)[(size_t)block * OZ_ELEMENT_LOAD + k] = REAL(0.0);
    }
    real lightness = shape[OZ_PS_INVERSE_MASS];
    real weight = lightness > REAL(0.0) ? REAL(1.0) : REAL(0.0); /* padding stays where it is */
    real x = load[0] * lightness + weight * REAL(p->gravity[0]) - drag * q[1];
    real y = load[1] * lightness + weight * REAL(p->gravity[1]) - drag * q[OZ_ORDER + 1];
    real turn = load[2] * shape[OZ_PS_INVERSE_INERTIA] - drag * q[2 * OZ_ORDER + 1];
    oz_element_move_correct_one(q, x, half_step2);
    oz_element_move_correct_one(q + OZ_ORDER, y, half_step2);
    oz_element_move_correct_one(q + 2 * OZ_ORDER, turn, half_step2);
    oz_element_move_check(w, block, q, step);
}

/* Ends a step and, where another follows, begins it, in one pass over the elements: state and
 * records are read once. */
OZ_INLINE void oz_element_move_correct(OzWork *w, int step, int goes_on)
{
    real inverse_dt = REAL(1.0) / REAL(w->parameters->dt);
    OZ_EACH(w, block, w->z.free_blocks)
    {
        real q[OZ_ELEMENT_STATE];
        oz_element_move_load(w, block, q);
        oz_element_move_back(w, block, q, step);
        if (goes_on) {
            oz_element_move_ahead(w, block, q, inverse_dt, step + 1);
        }
        oz_element_move_store(w, block, q);
    }
}
