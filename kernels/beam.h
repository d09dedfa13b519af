/* A damped elastic beam between the centres of mass of two triangles of one grain (Poeschel and
 * Buchholtz 1995, section 4): elongation and bending; shear is bending of both ends (their
 * appendix A). Moments have the length at rest under them and the shear force the length now, so
 * that forces are the gradient of one energy and momentum and angular momentum are conserved.
 * The includer says by OZ_DAMPING_SHEAR whether bending's damping moments are balanced by a shear
 * force (1), which conserves angular momentum, or stand alone (0), as in the paper. */
#ifndef OZ_KERNELS_BEAM_H
#define OZ_KERNELS_BEAM_H

#include "kernels/piece_law.h"
#include "kernels/vec2.h"

#ifndef OZ_DAMPING_SHEAR
#error "define OZ_DAMPING_SHEAR before including kernels/beam.h"
#endif

typedef struct OzBeamEnd {
    OzVec2 position, velocity; /* of the triangle's centre of mass; any common origin and frame */
    real angle, spin;          /* rad, rad/s; not wrapped                                       */
} OzBeamEnd;

typedef struct OzBeamForce {
    OzVec2 force;            /* N, on b; a feels the opposite                              */
    real moment_a, moment_b; /* N m                                                        */
    real energy;             /* J, stored                                                  */
    real power_axial;        /* W, dissipated by elongation                                */
    real power_bending;      /* W, dissipated by bending; >= 0 when shear is balanced, else
                                the damping moments may also drive a turning grain         */
    real stretch;            /* length over length at rest                                 */
    real bend_a, bend_b;     /* rad, -pi..pi, of each end against the beam's direction     */
} OzBeamForce;

/* The same angle between -pi and pi. */
OZ_INLINE real oz_beam_wrap(real angle)
{
    const real turn = REAL(6.28318530717958647692);
    return angle - turn * rint(angle / turn);
}

/* rest_a and rest_b: the ends' angles less the direction from a to b, at rest. */
OZ_INLINE OzBeamForce oz_beam_force(OzBeamConstants constants, OzBeamEnd a, OzBeamEnd b,
                                    real rest_length, real rest_a, real rest_b)
{
    OzBeamForce f;
    OzVec2 apart = oz_minus2(b.position, a.position), passing = oz_minus2(b.velocity, a.velocity);
    real length = oz_larger(oz_length2(apart), REAL(OZ_TINY));
    OzVec2 axis = oz_scale2(apart, REAL(1.0) / length), across = oz_left2(axis);
    real direction = atan2(apart.y, apart.x);
    real turning = oz_dot2(passing, across) / length; /* rad/s, of the direction */
    real stretching = oz_dot2(passing, axis);
    real elongation = length - rest_length;
    real bending = constants.bending / rest_length;
    real damping = constants.damping_bending / rest_length;
    real rate_a = a.spin - turning, rate_b = b.spin - turning;
    f.stretch = length / rest_length;
    f.bend_a = oz_beam_wrap(a.angle - rest_a - direction);
    f.bend_b = oz_beam_wrap(b.angle - rest_b - direction);
    real elastic_a = -bending * (REAL(4.0) * f.bend_a + REAL(2.0) * f.bend_b);
    real elastic_b = -bending * (REAL(2.0) * f.bend_a + REAL(4.0) * f.bend_b);
    f.moment_a = elastic_a - damping * rate_a;
    f.moment_b = elastic_b - damping * rate_b;
    real shear = OZ_DAMPING_SHEAR ? -(f.moment_a + f.moment_b) : -(elastic_a + elastic_b);
    real pull = -constants.stiffness * elongation - constants.damping * stretching;
    f.force = oz_along2(oz_scale2(axis, pull), shear / length, across);
    f.energy = REAL(0.5) * constants.stiffness * elongation * elongation +
               REAL(2.0) * bending *
                   (f.bend_a * f.bend_a + f.bend_a * f.bend_b + f.bend_b * f.bend_b);
    f.power_axial = constants.damping * stretching * stretching;
    f.power_bending = OZ_DAMPING_SHEAR ? damping * (rate_a * rate_a + rate_b * rate_b)
                                       : damping * (rate_a * a.spin + rate_b * b.spin);
    return f;
}

#endif
