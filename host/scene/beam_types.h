/* What a scene says of beams, which hold the triangles of a grain of trigrains together. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

typedef enum OzDampingShear { OZ_SHEAR_NONE, OZ_SHEAR_BALANCED } OzDampingShear;
typedef enum OzStrengthCriterion {
    OZ_STRENGTH_SEPARATE,
    OZ_STRENGTH_LINEAR,
    OZ_STRENGTH_QUADRATIC
} OzStrengthCriterion;

/* What beams bear before they break (kernels/beam_strength.h); INFINITY: anything. */
typedef struct OzBeamStrengthValues {
    bool present;
    double tension, compression; /* N, along the beam, a metre deep    */
    double moment;               /* N m, the larger one of its two ends */
    OzStrengthCriterion criterion;
} OzBeamStrengthValues;

/* What beams bear before they give way for good (kernels/beam_yield.h); INFINITY: anything. */
typedef struct OzBeamYieldValues {
    bool present;
    double tension, compression; /* N   */
    double moment;               /* N m */
} OzBeamYieldValues;

typedef struct OzBeamValues {
    double stiffness;     /* E, N/m: force over elongation                            */
    double second_moment; /* I, m^3: E I / L is the bending stiffness                 */
    double damping;       /* gamma, kg/s                                              */
    OzDampingShear damping_shear;
    int64_t substeps;  /* steps of the beams in one of the contacts                */
    double length_min; /* m: grains with shorter beams are not made                */
    double area_min;   /* m^2: nor with smaller triangles                          */
    OzBeamStrengthValues strength;
    OzBeamYieldValues yield;
} OzBeamValues;

/* Whether anything becomes of the beams. */
static inline bool oz_beam_types_wear(const OzBeamValues *beams)
{
    return beams->strength.present || beams->yield.present;
}
