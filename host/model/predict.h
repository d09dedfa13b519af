/* What an integrator makes of a contact at a given step: the exact discrete map of a binary hit of
 * two centres. Serves `orzo check`, the refusal of unstable steps, and every test of restitution.
 * Masses drop out: the map knows K = kappa dt^2 and G = gamma dt alone. */
#pragma once

#include "model/contact.h"
#include "model/hertz.h"

/* Integrators that move rods: the first of the list (OzIntegrator). */
#define OZ_PREDICT_ONE(NAME, name, choice, flat_choice, share, first) +1
enum { OZ_PREDICT_INTEGRATORS = 0 OZ_INTEGRATORS(OZ_PREDICT_ONE) };

/* Phases of first touch over which a prediction is averaged. */
#define OZ_PREDICT_PHASES 64

/* Restitution over the phases of first touch, evenly spread over one step. NaN when hits do not
 * end. */
typedef struct OzPredictedHits {
    double mean, low, high;
} OzPredictedHits;

/* Restitution by stepping a 1-D contact with the scene's integrator, for OZ_PREDICT_PHASES phases.
 */
OzPredictedHits oz_predict_hits(OzIntegrator integrator, double step,
                                const OzContactConstants *constants, OzAttraction attraction);

/* The same of a hit by a Hertzian law. In units of step and approach speed its constants depend on
 * the speed. */
OzPredictedHits oz_predict_hertz_hits(const OzScene *scene, const OzContactValues *values,
                                      const OzHertzHit *hertz);

/* Eigenvalues of one lasting contact's map. rho exp(+-i theta) is the complex pair; theta (rad a
 * step) is 0 when there is none, and rho then the largest real one's magnitude. */
typedef struct OzEigenvalues {
    double rho, theta;
    double radius; /* magnitude of the largest of all: a contact that lasts grows above 1 */
} OzEigenvalues;

/* stiffness is K = kappa dt^2, damping is G = gamma dt. */
OzEigenvalues oz_predict_eigenvalues(OzIntegrator integrator, double stiffness, double damping);

/* The step below which a lasting contact of stiffness kappa (1/s^2) and damping gamma (1/s) is
 * stable, s; INFINITY without either, 0 when no step is stable (explicit Euler without damping). */
double oz_predict_largest_step(OzIntegrator integrator, double stiffness, double damping);
