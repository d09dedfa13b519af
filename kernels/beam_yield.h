/* Beams that give way: perfectly plastic, without hardening. An axial force or an end's moment
 * never grows beyond what it yields at; beyond, the length at rest, or the end's angle at rest,
 * follows, so that the force is what it yields at. A moment of one end depends on the angles of
 * both, as 4 : 2, so that an end that yields relieves the other one by half; where that is not
 * enough both yield. What is done against these forces is lost. */
#pragma once

#include "kernels/beam.h"

/* What a beam is at rest, and what was lost on the way there. */
typedef struct OzBeamRest {
    real length, a, b; /* m; rad, of its ends less its direction */
    real lost;         /* J                                      */
    mask yields;
} OzBeamRest;

/* The shape at rest after a force that was found with `rest`; limits: one over what is borne. */
OZ_INLINE OzBeamRest oz_beam_yield(OzBeamConstants constants, OzBeamStrength limits,
                                   const OzBeamForce *f, OzBeamRest rest)
{
    OzBeamRest next = rest;
    real one = REAL(1.0), two = REAL(2.0);
    real tension = constants.stiffness * rest.length * (f->stretch - one);
    real axial =
        tension / oz_larger(one, oz_larger(tension * limits.pulled, -tension * limits.pressed));
    real grown = (tension - axial) / oz_larger(REAL(constants.stiffness), REAL(OZ_TINY));
    next.length = rest.length + grown;
    next.lost = axial * grown;
    real k = two * constants.bending / rest.length; /* of a longer beam it is less */
    real bent = k * (f->bend_a * f->bend_a + f->bend_a * f->bend_b + f->bend_b * f->bend_b);
    next.lost += bent * (one - rest.length / next.length);
    k = two * constants.bending / next.length;
    real a = k * (two * f->bend_a + f->bend_b), b = k * (f->bend_a + two * f->bend_b);
    mask first = oz_magnitude(a) >= oz_magnitude(b);
    real large = first ? a : b, small = first ? b : a;
    real large_held = large / oz_larger(one, oz_magnitude(large * limits.bent));
    real over = large - large_held, relieved = small - REAL(0.5) * over;
    real small_held = relieved / oz_larger(one, oz_magnitude(relieved * limits.bent));
    mask both = small_held != relieved;
    real under = small - small_held, third = one / (REAL(3.0) * k + REAL(OZ_TINY));
    real large_turn = both ? (two * over - under) * third : over / (two * k + REAL(OZ_TINY));
    real small_turn = both ? (two * under - over) * third : REAL(0.0);
    next.a = rest.a + (first ? large_turn : small_turn);
    next.b = rest.b + (first ? small_turn : large_turn);
    next.lost += large_held * large_turn + small_held * small_turn;
    next.yields = (tension != axial) | (over != REAL(0.0));
    return next;
}
