/* What the integrator makes of each kind of contact of a scene, for `orzo check`, the refusal of
 * unstable steps, and all that advises. */
#pragma once

#include "model/grains.h"
#include "model/predict.h"
#include "scene/mixing.h"

/* One kind of contact of a scene. */
typedef struct OzPrediction {
    int wall;                     /* index of the wall, -1: grain against grain              */
    int one, other;               /* kinds of the grains (scene/mixing.h), at a wall the same */
    OzContactValues values;       /* as the scene has them                                   */
    OzContactConstants constants; /* as used; Hertzian laws: tangent at a hit's deepest point */
    double speed;                 /* m/s, Hertzian laws: of the hit that is predicted; else 0 */
    double mass_low, mass_high;   /* kg, least and greatest effective mass; k_n, c_n follow  */
    double steps;                 /* duration of a hit / step                                */
    OzPredictedHits hits;         /* restitution really given                                */
    double closed_form;           /* rho^(pi/theta); NaN when overdamped or attraction is clamped */
    double radius;                /* of the largest eigenvalue                               */
    double largest_step;          /* s, stable below it; 0: no step is                       */
    double margin;                /* largest_step / step; INFINITY is possible               */
    bool stable;                  /* margin > 1, or nothing acts at all                      */
    bool tangential_stable;       /* a sticking tangential spring is stable too: warn if not */
} OzPrediction;

/* *rows receives one row for pairs of grains of each two materials, then one for each wall with
 * each of these: without materials one of two grains, then one a wall. The caller frees it. */
OzStatus oz_prediction_rows(OzPrediction **rows, int *count, const OzScene *scene,
                            const OzGrains *grains);
