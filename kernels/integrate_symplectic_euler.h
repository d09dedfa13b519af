/* Symplectic Euler: velocities first, then places with the new velocities. First order in position
 * and velocity, without secular drift of energy for a spring. Tangential springs are advanced
 * before the force (share 1): the velocity seen is the one that moved the grain here. */
#pragma once

#include "kernels/body.h"

OZ_INLINE void oz_symplectic_euler_after(OzBody *body, OzShape shape, OzLoad load, real dt,
                                         scalar inverse_unit)
{
    OzVec3 u = oz_quaternion_axis(body->turn);
    body->velocity = oz_along(body->velocity, dt * shape.inverse_mass, load.force);
    body->spin = oz_body_kick_spin(body->spin, load.torque, u, shape, dt);
    oz_fixed_position_move(&body->position, &body->rest, oz_scale(body->velocity, dt),
                           inverse_unit);
    oz_body_turn(body, body->spin, shape, dt);
}
