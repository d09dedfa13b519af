/* The constants of what acts on elements: triangles' overlaps, discs' contacts, beams; and how far
 * beams may go. Scalars only. */
#pragma once

#include "kernels/real.h"

/* Guards. A beam beyond them has folded or torn in all but name: its linear law says nothing there,
 * and a step too long folds beams while every speed looks fine. */
#define OZ_BEAM_STRETCH_LEAST 0.5
#define OZ_BEAM_STRETCH_MOST  1.5
#define OZ_BEAM_BEND_MOST     1.0 /* rad */

typedef struct OzBeamConstants {
    scalar stiffness;       /* N/m: E                        */
    scalar bending;         /* N m^2: E I                    */
    scalar damping;         /* kg/s: gamma                   */
    scalar damping_bending; /* kg m^3/s: gamma I             */
} OzBeamConstants;

/* What a beam bears, as one over it: 0 bears anything (kernels/beam_strength.h). */
typedef struct OzBeamStrength {
    scalar pulled, pressed; /* 1/N                                                  */
    scalar bent;            /* 1/(N m)                                              */
    scalar together;        /* 1: force and moment add up, 0: each for itself        */
    scalar quadratic;       /* 1: the force counts by its square                    */
} OzBeamStrength;

typedef struct OzDiscLaw {
    scalar hertz;              /* 0: linear, 1: power 3/2                              */
    scalar clamp;              /* 1: the normal force never pulls                      */
    scalar stiffness;          /* linear: 1/s^2, k / m*; power 3/2: N/m^(3/2)          */
    scalar damping;            /* 1/s                                                  */
    scalar tangential_damping; /* 1/s                                                  */
    scalar friction;
} OzDiscLaw;
