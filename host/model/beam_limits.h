/* The largest step at which grains of beams, and contacts of elements, are stable. */
#pragma once

#include "model/grains.h"

/* What sets the largest step of a scene of elements. */
typedef struct OzBeamLimit {
    int64_t grain;       /* of the stiffest                                                    */
    int64_t beam;        /* that holds most of its fastest vibration; -1: a contact does       */
    double rate;         /* rad/s: fastest vibration of that grain, a whole edge in contact    */
    double damping;      /* 1/s: fastest loss of speed, twice the decay of a vibration         */
    double largest_step; /* s; INFINITY without anything stiff                                 */
} OzBeamLimit;

/* The step, s, below which a damped vibration is stable. rate is its angular frequency without
 * damping, rad/s; damping is the rate at which the damping force takes speed, 1/s. With w
 * for rate and c for damping: gear4: c dt / 0.3 + (w dt)^2 < 1 and w dt < 0.55 (an undamped
 * vibration grows by a hundredth in a period there); velocity-verlet: (w dt)^2 + 4 c dt < 4; rk4: c
 * dt / 2.78 + (w dt / 2.82)^2 < 1. */
double oz_beam_limits_step(OzIntegrator integrator, double rate, double damping);

/* For the scene's integrator and substeps. Every grain's beams are taken at rest; every element may
 * also press another, alike, with the whole of its longest edge (discs: hooke's binary hit, or
 * hertz at an overlap of a tenth of the radius). Fails with OZ_ERR_MEMORY. */
OzStatus oz_beam_limits_find(OzBeamLimit *limit, const OzScene *scene, const OzGrains *grains);
