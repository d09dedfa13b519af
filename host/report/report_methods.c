/* Methods, steps and truth by model. */
#include "report/report_methods.h"

static const OzReportMethod rods[] = {
#define BOTH(NAME, name, choice, flat_choice, share, first)                                        \
    {OZ_INTEGRATOR_##NAME, OZ_PRECISION_FLOAT, 0, false},                                          \
        {OZ_INTEGRATOR_##NAME, OZ_PRECISION_DOUBLE, 0, false},
    OZ_INTEGRATORS(BOTH)
#undef BOTH
};

static const OzReportMethod trigrains[] = {
    {OZ_INTEGRATOR_GEAR4, OZ_PRECISION_DOUBLE, 0, true},
    {OZ_INTEGRATOR_VELOCITY_VERLET, OZ_PRECISION_DOUBLE, 0, true},
    {OZ_INTEGRATOR_VELOCITY_VERLET, OZ_PRECISION_DOUBLE, 4, true},
    {OZ_INTEGRATOR_RK4, OZ_PRECISION_DOUBLE, 0, true},
    {OZ_INTEGRATOR_GEAR4, OZ_PRECISION_DOUBLE, 0, false},
    {OZ_INTEGRATOR_VELOCITY_VERLET, OZ_PRECISION_DOUBLE, 0, false},
    {OZ_INTEGRATOR_VELOCITY_VERLET, OZ_PRECISION_DOUBLE, 4, false},
    {OZ_INTEGRATOR_GEAR4, OZ_PRECISION_FLOAT, 0, false},
    {OZ_INTEGRATOR_VELOCITY_VERLET, OZ_PRECISION_FLOAT, 0, false},
};

/* Rods: beds are run at 20 to 60 steps; below 10 no hit is resolved, and at 1000 float's rounding
 * shows. Halving the truth's step again moves it by less than a tenth of the error of the finest
 * point. Trigrains: gear4 is stable from about 12 on, substeps of beams help below; at 640 float's
 * rounding shows. */
static const OzReportMethods models[] = {
    [OZ_MODEL_RODS] = {.cycle = "contact",
                       .methods = rods,
                       .count = sizeof rods / sizeof rods[0],
                       .steps = {10, 14, 20, 30, 50, 100, 200, 500, 1000},
                       .quick = {20, 50, 200},
                       .truth = OZ_INTEGRATOR_VELOCITY_VERLET,
                       .truth_steps = 10000},
    [OZ_MODEL_TRIGRAINS] = {.cycle = "period",
                            .methods = trigrains,
                            .count = sizeof trigrains / sizeof trigrains[0],
                            .steps = {5, 8, 14, 20, 40, 80, 160, 320, 640},
                            .quick = {20, 40, 80},
                            .truth = OZ_INTEGRATOR_GEAR4,
                            .truth_steps = 3000},
};

const OzReportMethods *oz_report_methods_of(OzModelKind model)
{
    return &models[model];
}
