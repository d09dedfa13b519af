/* When a beam breaks, and what is lost by it. Of the elastic part of what it carries, f is the
 * axial force over the one that it bears, of pull and of pressure each its own, and m the larger
 * moment of its two ends over the one that it bears. It breaks where separate   f >= 1 or m >= 1
 *   linear     f + m >= 1
 *   quadratic  f^2 + m >= 1 (Herrmann, Hansen and Roux 1989; D'Addetta, Kun and Ramm 2002)
 * and is gone from the very evaluation of forces that finds it so. */
#pragma once

#include "kernels/beam.h"

/* How near a beam is to breaking: it does at 1. f: its force, as it is at rest_length. */
OZ_INLINE real oz_beam_strength_load(OzBeamConstants constants, OzBeamStrength strength,
                                     const OzBeamForce *f, real rest_length)
{
    real tension = constants.stiffness * rest_length * (f->stretch - REAL(1.0));
    real bending = REAL(2.0) * constants.bending / rest_length;
    real moment_a = oz_magnitude(bending * (REAL(2.0) * f->bend_a + f->bend_b));
    real moment_b = oz_magnitude(bending * (f->bend_a + REAL(2.0) * f->bend_b));
    real axial = oz_larger(tension * strength.pulled, -tension * strength.pressed);
    real bent = oz_larger(moment_a, moment_b) * strength.bent;
    real share = strength.quadratic * axial + (REAL(1.0) - strength.quadratic);
    real sum = axial * share + bent;
    return strength.together > 0 ? sum : oz_larger(axial, bent);
}

/* What a beam stored, J, a time before it had these ends and force: forces that are evaluated once
 * a step act from half a step before, so a beam that is gone now was held until then. Its energy
 * grows by what its ends do to it and damping does not take. */
OZ_INLINE real oz_beam_strength_stored(const OzBeamForce *f, OzBeamEnd a, OzBeamEnd b, real before)
{
    OzVec2 passing = oz_minus2(b.velocity, a.velocity);
    real power = oz_dot2(f->force, passing) + f->moment_a * a.angular_velocity +
                 f->moment_b * b.angular_velocity;
    return f->energy + before * (power + f->power_axial + f->power_bending);
}

/* Leaves nothing of what broken beams would do. */
OZ_INLINE void oz_beam_strength_drop(OzBeamForce *f, mask broken)
{
    f->force = oz_choose2(broken, oz_vec2(REAL(0.0), REAL(0.0)), f->force);
    f->moment_a = broken ? REAL(0.0) : f->moment_a;
    f->moment_b = broken ? REAL(0.0) : f->moment_b;
    f->energy = broken ? REAL(0.0) : f->energy;
    f->power_axial = broken ? REAL(0.0) : f->power_axial;
    f->power_bending = broken ? REAL(0.0) : f->power_bending;
    f->stretch = broken ? REAL(1.0) : f->stretch;
    f->bend_a = broken ? REAL(0.0) : f->bend_a;
    f->bend_b = broken ? REAL(0.0) : f->bend_b;
}

/* Triangles of one grain may overlap, and do where it is pressed or bent. When it breaks between
 * them they meet as strangers in the midst of a contact whose energy nobody has put in. So a
 * contact begins anew there: of depth s, the root of the integral of depth W over the overlap, only
 * what is beyond the least depth s0 since then counts, with the potential Y (s - s0)^2 in the place
 * of Y W and the share 1 - s0 / s of the force. s0 falls with s while they part, and never rises
 * again: no energy is made, and a contact that has opened once is like any other. depth: s, root of
 * m^3; least: s0, which the caller keeps as it is returned. */
OZ_INLINE real oz_beam_strength_least(real depth, real least)
{
    return oz_smaller(depth, least);
}

OZ_INLINE real oz_beam_strength_share(real depth, real least)
{
    return REAL(1.0) - oz_beam_strength_least(depth, least) / oz_larger(depth, REAL(OZ_TINY));
}
