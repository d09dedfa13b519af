/* Velocity Verlet with predicted velocity: forces see place and velocity of the same time, so
 * damped contacts stay second order. before: x += v dt + a dt^2/2, the turn with the spin of
 * mid-step; forces then see v + a dt after:  v += (a_old + a_new) dt/2 Tangential springs by the
 * trapezoidal rule (share 1/2). A first force evaluation with dt = 0 gives the first acceleration.
 */
#pragma once

#include "kernels/body.h"

OZ_INLINE void oz_velocity_verlet_before(OzBody *body, OzShape shape, real dt, scalar inverse_unit)
{
    OzVec3 u = oz_quaternion_axis(body->turn);
    OzVec3 middle = oz_along(body->velocity, REAL(0.5) * dt, body->acceleration);
    OzVec3 spin = oz_body_kick_spin(body->spin, body->torque, u, shape, REAL(0.5) * dt);
    oz_fixed_position_move(&body->position, &body->rest, oz_scale(middle, dt), inverse_unit);
    oz_body_turn(body, spin, shape, dt);
}

/* Velocity and spin that the forces of this step see. The turn's axis is already the new one: the
 * old torque is applied with it, an error of second order in a term of first. */
OZ_INLINE OzVec3 oz_velocity_verlet_seen_velocity(OzBody body, real dt)
{
    return oz_along(body.velocity, dt, body.acceleration);
}

OZ_INLINE OzVec3 oz_velocity_verlet_seen_spin(OzBody body, OzShape shape, real dt)
{
    return oz_body_kick_spin(body.spin, body.torque, oz_quaternion_axis(body.turn), shape, dt);
}

OZ_INLINE void oz_velocity_verlet_after(OzBody *body, OzShape shape, OzLoad load, real dt,
                                        scalar inverse_unit)
{
    (void)inverse_unit;
    OzVec3 u = oz_quaternion_axis(body->turn);
    OzVec3 acceleration = oz_scale(load.force, shape.inverse_mass);
    body->velocity =
        oz_along(body->velocity, REAL(0.5) * dt, oz_add(body->acceleration, acceleration));
    body->spin =
        oz_body_kick_spin(body->spin, oz_add(body->torque, load.torque), u, shape, REAL(0.5) * dt);
    body->acceleration = acceleration;
    body->torque = load.torque;
}
