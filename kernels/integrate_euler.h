/* Explicit Euler, the "forward Euler" of Pournin et al. (2005): places move with the old
 * velocities. First order; the tangential spring enters the force before it is advanced (share 0);
 * gains energy in every contact (restitution comes out too high). */
#pragma once

#include "kernels/body.h"

OZ_INLINE void oz_euler_after(OzBody *body, OzShape shape, OzLoad load, real dt,
                              scalar inverse_unit)
{
    OzVec3 u = oz_quaternion_axis(body->turn);
    oz_fixed_position_move(&body->position, &body->rest, oz_scale(body->velocity, dt),
                           inverse_unit);
    oz_body_turn(body, body->spin, shape, dt);
    body->velocity = oz_along(body->velocity, dt * shape.inverse_mass, load.force);
    body->spin = oz_body_kick_spin(body->spin, load.torque, u, shape, dt);
}
