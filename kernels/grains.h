/* Grains in memory and in motion: their arrays, the integrator under the loads of pairs and walls,
 * the guards. One grain a lane. OpenCL C only. */
#pragma once

#include "kernels/loads.h"

OZ_INLINE OzShape oz_grains_shape(const OzWork *w, int block)
{
    OzShape shape;
#if OZ_EQUAL
    global const OzParameters *p = w->parameters;
    shape.radius = REAL(p->radius);
    shape.half_length = REAL(p->half_length);
    shape.mass = REAL(p->mass);
    shape.inverse_mass = REAL(p->inverse_mass);
    shape.inverse_inertia = REAL(p->inverse_inertia);
    shape.inverse_inertia_axis = REAL(p->inverse_inertia_axis);
    (void)block;
#else
    global const real *words = w->shape + (size_t)block * OZ_SHAPE;
    shape.radius = words[OZ_B_RADIUS];
    shape.half_length = words[OZ_B_HALF_LENGTH];
    shape.mass = words[OZ_B_MASS];
    shape.inverse_mass = REAL(1.0) / shape.mass;
    shape.inverse_inertia = words[OZ_B_INVERSE_INERTIA];
    shape.inverse_inertia_axis = words[OZ_B_INVERSE_AXIS];
#endif
    return shape;
}

OZ_INLINE OzQuaternion oz_grains_load_quaternion(global const real *words)
{
    OzQuaternion q = {words[0], words[1], words[2], words[3]};
    return q;
}

OZ_INLINE void oz_grains_store_quaternion(global real *words, OzQuaternion q)
{
    words[0] = q.x;
    words[1] = q.y;
    words[2] = q.z;
    words[3] = q.w;
}

OZ_INLINE OzBody oz_grains_load(const OzWork *w, int block)
{
    global const real *words = w->state + (size_t)block * OZ_STATE;
    OzBody body;
    body.position.x = oz_fixed_position_of_bits(words[OZ_S_POSITION]);
    body.position.y = oz_fixed_position_of_bits(words[OZ_S_POSITION + 1]);
    body.position.z = oz_fixed_position_of_bits(words[OZ_S_POSITION + 2]);
    body.rest = oz_work_load3(words + OZ_S_REST);
    body.velocity = oz_work_load3(words + OZ_S_VELOCITY);
    body.spin = oz_work_load3(words + OZ_S_SPIN);
    body.turn = oz_grains_load_quaternion(words + OZ_S_TURN);
    body.turn_rest = oz_grains_load_quaternion(words + OZ_S_TURN_REST);
#if OZ_MOVES_BEFORE
    body.acceleration = oz_work_load3(words + OZ_S_ACCELERATION);
    body.torque = oz_work_load3(words + OZ_S_TORQUE);
#endif
    return body;
}

OZ_INLINE void oz_grains_store(OzWork *w, int block, OzBody body)
{
    global real *words = w->state + (size_t)block * OZ_STATE;
    words[OZ_S_POSITION] = oz_fixed_position_bits(body.position.x);
    words[OZ_S_POSITION + 1] = oz_fixed_position_bits(body.position.y);
    words[OZ_S_POSITION + 2] = oz_fixed_position_bits(body.position.z);
    oz_work_store3(words + OZ_S_REST, body.rest);
    oz_work_store3(words + OZ_S_VELOCITY, body.velocity);
    oz_work_store3(words + OZ_S_SPIN, body.spin);
    oz_grains_store_quaternion(words + OZ_S_TURN, body.turn);
    oz_grains_store_quaternion(words + OZ_S_TURN_REST, body.turn_rest);
#if OZ_MOVES_BEFORE
    oz_work_store3(words + OZ_S_ACCELERATION, body.acceleration);
    oz_work_store3(words + OZ_S_TORQUE, body.torque);
#endif
}

#if OZ_TILES
#define OZ_GRAINS_HALF(w, name, next) ((next) ? (w)->name##_next : (w)->name)
#else
#define OZ_GRAINS_HALF(w, name, next) ((w)->name)
#endif

#if OZ_FINE
/* What the record leaves of a block's places and turns. */
OZ_INLINE void oz_grains_record_fine(global scalar *records, int block, OzBody body)
{
    real rest[4] = {body.rest.x, body.rest.y, body.rest.z, REAL(0.0)};
    real turn[4] = {body.turn.x, body.turn.y, body.turn.z, body.turn.w};
    real turn_rest[4] = {body.turn_rest.x, body.turn_rest.y, body.turn_rest.z, body.turn_rest.w};
    global scalar *out = records + (size_t)block * OZ_LANES * OZ_FINE_RECORD;
    oz_lanes_store4(out, OZ_FINE_RECORD, OZ_N_REST, rest);
    oz_lanes_store4(out, OZ_FINE_RECORD, OZ_N_TURN, turn);
    oz_lanes_store4(out, OZ_FINE_RECORD, OZ_N_TURN_REST, turn_rest);
}
#endif

/* The record that pairs read; next, with tiles: in the half that the step writes. */
OZ_INLINE void oz_grains_record(OzWork *w, int next, int block, OzBody body, OzShape shape,
                                OzVec3 velocity, OzVec3 spin)
{
    OzVec3 u = oz_quaternion_axis(body.turn), rate = oz_body_rate(spin, u, shape);
    OzVec3 shaft = oz_scale(u, shape.half_length);
    real a[4] = {oz_fixed_position_bits(body.position.x), oz_fixed_position_bits(body.position.y),
                 oz_fixed_position_bits(body.position.z), shape.radius};
    real b[4] = {shaft.x, shaft.y, shaft.z, shape.mass};
    real skin = w->reference_inner[(size_t)block * OZ_REFERENCE + OZ_REFERENCE_SKIN];
    real c[4] = {velocity.x, velocity.y, velocity.z, skin};
    real d[4] = {rate.x, rate.y, rate.z, OZ_AT_CONTACT ? shape.inverse_inertia : REAL(0.0)};
    global scalar *out = OZ_GRAINS_HALF(w, record, next) + (size_t)block * OZ_LANES * OZ_RECORD;
    oz_lanes_store4(out, OZ_RECORD, OZ_R_POSITION, a);
    oz_lanes_store4(out, OZ_RECORD, OZ_R_SHAFT, b);
    oz_lanes_store4(out, OZ_RECORD, OZ_R_VELOCITY, c);
    oz_lanes_store4(out, OZ_RECORD, OZ_R_RATE, d);
#if OZ_FINE
    oz_grains_record_fine(OZ_GRAINS_HALF(w, fine, next), block, body);
#endif
}

/* Lanes that hold grains; the others pad the last block. */
OZ_INLINE mask oz_grains_present(const OzWork *w, int block)
{
    int here[OZ_LANES];
    scalar number[OZ_LANES];
    for (int l = 0; l < OZ_LANES; l++) {
        here[l] = block * OZ_LANES + l < w->z.count;
        number[l] = (scalar)here[l];
    }
    return OZ_LANES_LOAD(number) > REAL(0.5);
}

/* Lanes whose place is within the domain. Coordinates are compared one by one: the larger of two
 * numbers would hide that one of them is NaN. */
OZ_INLINE mask oz_grains_inside(const OzWork *w, OzBody body)
{
    real domain = REAL(w->parameters->domain);
    return (oz_magnitude(oz_fixed_position_to_real(body.position.x)) < domain) &
           (oz_magnitude(oz_fixed_position_to_real(body.position.y)) < domain) &
           (oz_magnitude(oz_fixed_position_to_real(body.position.z)) < domain);
}

/* Stops the run at NaN, at a grain outside of the domain, and at a step too long for a grain's
 * radius. Comparisons ask for what is sound: with NaN they are false, so that NaN stops the run
 * too. */
OZ_INLINE void oz_grains_guard(OzWork *w, int block, OzBody body, OzShape shape, int step)
{
    real allowed = REAL(OZ_BODY_STEP_SHARE) * shape.radius;
    real step2 = oz_body_step2(body, shape, REAL(w->parameters->dt));
    mask number = oz_body_is_number(body), inside = oz_grains_inside(w, body);
    mask slow = (step2 < allowed * allowed) & oz_body_is_turn(body),
         wrong = !(number & inside & slow);
    if (OZ_ANY(wrong)) {
        int slots[OZ_LANES];
        for (int l = 0; l < OZ_LANES; l++) {
            slots[l] = block * OZ_LANES + l;
        }
        oz_work_stop_lanes(w, !number, OZ_STOP_NAN, step, slots);
        oz_work_stop_lanes(w, number & !inside, OZ_STOP_ESCAPED, step, slots);
        oz_work_stop_lanes(w, number & !slow, OZ_STOP_FAST, step, slots);
    }
}
