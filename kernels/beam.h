/* A damped elastic beam between the centres of mass of two triangles of one grain (Poeschel and
 * Buchholtz 1995, section 4): elongation and bending; shear is bending of both ends (their
 * appendix A). Moments have the length at rest under them and the shear force the length now, so
 * that forces are the gradient of one energy and momentum and angular momentum are conserved.
 * The includer says by OZ_DAMPING_SHEAR whether bending's damping moments are balanced by a shear
 * force (1), which conserves angular momentum, or stand alone (0), as in the paper. */
#pragma once

#include "kernels/element_law.h"
#include "kernels/turn.h"

#ifndef OZ_DAMPING_SHEAR
#error "define OZ_DAMPING_SHEAR before including kernels/beam.h"
#endif

typedef struct OzBeamEnd {
    OzVec2 position, velocity; /* of the triangle's centre of mass; any common origin and frame */
    real angle, angular_velocity; /* rad, rad/s; not wrapped */
} OzBeamEnd;

typedef struct OzBeamForce {
    OzVec2 force;            /* N, on b; a feels the opposite                              */
    real moment_a, moment_b; /* N m                                                        */
    real energy;             /* J, stored                                                  */
    real power_axial;        /* W, dissipated by elongation                                */
    real power_bending;      /* W, dissipated by bending; >= 0 when shear is balanced, else
                                the damping moments may also drive a turning grain         */
    real stretch;            /* length over length at rest                                 */
    real bend_a, bend_b;     /* rad, of each end against the beam's direction; of a no more
                                than OZ_TURN_MOST, beyond what a beam may bend              */
} OzBeamForce;

/* The same angle between -pi and pi. */
OZ_INLINE real oz_beam_wrap(real angle)
{
    const real turn = REAL(6.28318530717958647692);
    return angle - turn * oz_turn_round(angle * REAL(0.15915494309189533577));
}

/* rest_a and rest_b: the ends' angles less the direction from a to b, at rest. */
OZ_INLINE OzBeamForce oz_beam_force(OzBeamConstants constants, OzBeamEnd a, OzBeamEnd b,
                                    real rest_length, real rest_a, real rest_b)
{
    OzBeamForce f;
    OzVec2 apart = oz_minus2(b.position, a.position), passing = oz_minus2(b.velocity, a.velocity);
    real length = oz_larger(oz_length2(apart), REAL(OZ_TINY)), inverse = REAL(1.0) / length;
    OzVec2 axis = oz_scale2(apart, inverse), across = oz_left2(axis);
    real aim_a = a.angle - rest_a, aim_b = b.angle - rest_b; /* where each end sees the other */
    real turning = oz_dot2(passing, across) * inverse;       /* rad/s, of the direction       */
    real stretching = oz_dot2(passing, axis);
    real elongation = length - rest_length, inverse_rest = REAL(1.0) / rest_length;
    real bending = constants.bending * inverse_rest;
    real damping = constants.damping_bending * inverse_rest;
    real rate_a = a.angular_velocity - turning, rate_b = b.angular_velocity - turning;
    f.stretch = length * inverse_rest;
    f.bend_a = -oz_turn_between(oz_turn_of(aim_a), apart, length);
    f.bend_b = f.bend_a + oz_beam_wrap(aim_b - aim_a);
    real elastic_a = -bending * (REAL(4.0) * f.bend_a + REAL(2.0) * f.bend_b);
    real elastic_b = -bending * (REAL(2.0) * f.bend_a + REAL(4.0) * f.bend_b);
    f.moment_a = elastic_a - damping * rate_a;
    f.moment_b = elastic_b - damping * rate_b;
    real shear = OZ_DAMPING_SHEAR ? -(f.moment_a + f.moment_b) : -(elastic_a + elastic_b);
    real pull = -constants.stiffness * elongation - constants.damping * stretching;
    f.force = oz_along2(oz_scale2(axis, pull), shear * inverse, across);
    f.energy =
        REAL(0.5) * constants.stiffness * elongation * elongation +
        REAL(2.0) * bending * (f.bend_a * f.bend_a + f.bend_a * f.bend_b + f.bend_b * f.bend_b);
    f.power_axial = constants.damping * stretching * stretching;
    f.power_bending = OZ_DAMPING_SHEAR
                          ? damping * (rate_a * rate_a + rate_b * rate_b)
                          : damping * (rate_a * a.angular_velocity + rate_b * b.angular_velocity);
    return f;
}
