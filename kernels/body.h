/* One grain in motion, and the moves that integrators are made of: kick (velocities by a force) and
 * drift (places and turns by velocities).
 * `spin` holds the angular momentum in the world frame (switch OZ_GYROSCOPIC 1: the full Euler
 * equations; constant in a free drift) or the angular velocity (0: the equation of Pournin et al.
 * 2005, eq. 9, without the gyroscopic term). */
#pragma once

#include "kernels/vec3.h"

typedef struct OzShape {
    real radius, half_length;  /* m                                              */
    real mass;                 /* kg                                             */
    real inverse_mass;         /* 1/kg                                           */
    real inverse_inertia;      /* 1/(kg m^2), about an axis across the shaft     */
    real inverse_inertia_axis; /* 1/(kg m^2), about the shaft                    */
} OzShape;

typedef struct OzBody {
    OzFixedPosition position;
    OzVec3 rest;     /* what place could not hold yet, units                            */
    OzVec3 velocity; /* m/s                                                             */
    OzVec3 spin;     /* kg m^2/s or rad/s, see above                                    */
    OzQuaternion turn;
    OzQuaternion turn_rest; /* what turn could not hold yet                                 */
    OzVec3 acceleration;    /* m/s^2, of the step before (OZ_MOVES_BEFORE)                     */
    OzVec3 torque;          /* N m, of the step before                                         */
} OzBody;

/* Force and torque on a grain, gravity included. */
typedef struct OzLoad {
    OzVec3 force, torque;
} OzLoad;

/* inverse inertia applied to a world vector, for a body with shaft axis u. */
OZ_INLINE OzVec3 oz_body_inverse_inertia(OzVec3 v, OzVec3 u, OzShape shape)
{
    real extra = (shape.inverse_inertia_axis - shape.inverse_inertia) * oz_dot(v, u);
    return oz_along(oz_scale(v, shape.inverse_inertia), extra, u);
}

/* Angular velocity, rad/s in the world frame. */
OZ_INLINE OzVec3 oz_body_rate(OzVec3 spin, OzVec3 u, OzShape shape)
{
    return OZ_GYROSCOPIC ? oz_body_inverse_inertia(spin, u, shape) : spin;
}

OZ_INLINE real oz_body_length2(OzQuaternion q)
{
    return q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
}

/* Whether place, velocity, spin and turn are numbers. Squares must be too: what overflows there is
 * none either. */
OZ_INLINE mask oz_body_is_number(OzBody body)
{
    real motion2 = oz_dot(body.velocity, body.velocity) + oz_dot(body.spin, body.spin);
    return oz_fixed_position_is_number(body.position) & (motion2 <= REAL(OZ_HUGE)) &
           (oz_body_length2(body.turn) <= REAL(OZ_HUGE));
}

/* Whether the turn's length has stayed near one: turns of much more than 1 rad a step ruin it. */
OZ_INLINE mask oz_body_is_turn(OzBody body)
{
    real length2 = oz_body_length2(body.turn);
    return (length2 > REAL(0.9)) & (length2 < REAL(1.1));
}

/* How far an end of the shaft, or of a grain less long than thick its surface, goes in dt, squared,
 * m^2: the centre's way and the turn's as if across each other, and all the spin across the shaft.
 */
OZ_INLINE real oz_body_step2(OzBody body, OzShape shape, real dt)
{
    real reach = oz_larger(shape.half_length, shape.radius);
    real turn2 = oz_dot(body.spin, body.spin) * (reach * reach);
    if (OZ_GYROSCOPIC) {
        turn2 = turn2 * shape.inverse_inertia * shape.inverse_inertia;
    }
    return (oz_dot(body.velocity, body.velocity) + turn2) * dt * dt;
}

/* The share of its radius that an end may go in a step. Two grains that meet then come no deeper
 * than a radius before their contact is seen, which the guard of depth looks at, and none passes
 * through a wall. */
#define OZ_BODY_STEP_SHARE 0.5

/* spin after a torque has acted for dt. */
OZ_INLINE OzVec3 oz_body_kick_spin(OzVec3 spin, OzVec3 torque, OzVec3 u, OzShape shape, real dt)
{
    OzVec3 push = OZ_GYROSCOPIC ? torque : oz_body_inverse_inertia(torque, u, shape);
    return oz_along(spin, dt, push);
}

/* Turns the body for dt at constant spin. With the angular momentum L constant this is the exact
 * free motion of an axisymmetric body: a turn about L at |L|/I, after a turn about its own axis at
 * (L.u)(1/I_axis - 1/I). */
OZ_INLINE void oz_body_turn(OzBody *body, OzVec3 spin, OzShape shape, real dt)
{
    OzQuaternion change = oz_quaternion_to_unit(body->turn);
    OzVec3 turned_by = oz_scale(spin, dt);
    if (OZ_GYROSCOPIC) {
        OzVec3 u = oz_quaternion_axis(body->turn);
        real own = (shape.inverse_inertia_axis - shape.inverse_inertia) * oz_dot(spin, u) * dt;
        OzQuaternion about_axis = oz_quaternion_turn(oz_vec3(REAL(0.0), REAL(0.0), own));
        change = oz_quaternion_add(change, oz_quaternion_times(body->turn, about_axis));
        turned_by = oz_scale(turned_by, shape.inverse_inertia);
    }
    OzQuaternion before = oz_quaternion_add(body->turn, change);
    OzQuaternion about_spin = oz_quaternion_times(oz_quaternion_turn(turned_by), before);
    oz_quaternion_move(&body->turn, &body->turn_rest, oz_quaternion_add(change, about_spin));
}
