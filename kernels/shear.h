/* A periodic cell that is sheared: flow along x, gradient along y (Lees & Edwards 1972). Places are
 * kept in the frame of its lattice, x' = x - tilt y, in which grains that the flow carries along
 * stand still and the cell is a box; velocities are those about the flow, c = v - rate y e_x
 * (SLLOD: Evans & Morriss 1984, whose equation dc/dt = F/m - rate c_y e_x this is). So neither a
 * border nor where the origin lies shows: nothing jumps where a grain leaves the cell. The
 * integrators move grains as in open space and know nothing of it: what a grain went along y is
 * taken off afterwards, which makes each step that of the same integrator with the true velocities.
 * Rotations, axes and springs are the true ones. The tilt is kept within half a cell's length over
 * its width: beyond, the lattice is that of a tilt less by all of it, and places change to it
 * (motion.h). */
#pragma once

#include "kernels/body.h"
#include "kernels/space.h"

/* Takes off what a move from a place (and its rest) went along y; tilt: at the move's end. Returns
 * by how much the velocity along x became less, m/s. */
OZ_INLINE real oz_shear_follow(OzBody *body, OzFixedPosition from, OzVec3 rest, OzSpace space,
                               scalar inverse_unit)
{
    real counts = oz_fixed_position_to_real(body->position.y - from.y) + (body->rest.y - rest.y);
    real way = counts * space.unit, less = space.rate * way;
    OzVec3 back = oz_vec3(-space.tilt * way, REAL(0.0), REAL(0.0));
    oz_fixed_position_move(&body->position, &body->rest, back, inverse_unit);
    body->velocity.x -= less;
    return less;
}

/* The kinetic energy, J, that a mass has from the shear when its velocity along x has become less
 * by that: what the shear's work is but for contacts. */
OZ_INLINE real oz_shear_gain(real mass, real less, real velocity_x)
{
    return -mass * less * (velocity_x + REAL(0.5) * less);
}

/* Power, W, that the shear puts into a pair with a force on b; apart_y = y_a - y_b: both sides are
 * drawn along by the flow at rates that differ by it. */
OZ_INLINE real oz_shear_power(OzVec3 force, real apart_y, OzSpace space)
{
    return space.rate * force.x * apart_y;
}
