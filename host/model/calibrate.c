/* Inverting the discrete maps of hits. */
#include "model/calibrate.h"

#include "base/log.h"
#include "model/predict.h"
#include "scene/mixing.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* K = kappa dt^2 and G = gamma dt of each integrator's map for the eigenvalues rho exp(+-i theta).
 */
static void invert_euler(double rho, double theta, double *stiffness, double *damping)
{
    *stiffness = 1 - 2 * rho * cos(theta) + rho * rho;
    *damping = 2 * (1 - rho * cos(theta));
}

static void invert_symplectic_euler(double rho, double theta, double *stiffness, double *damping)
{
    *stiffness = 1 - 2 * rho * cos(theta) + rho * rho;
    *damping = 1 - rho * rho;
}

/* z (z-1)^2 + K z^2 + G (z-1)(3z-1)/2 = 0 for z and its conjugate: two real equations in K and G.
 */
static void invert_velocity_verlet(double rho, double theta, double *stiffness, double *damping)
{
    double complex z = rho * cexp(I * theta);
    double complex a = z * z, b = (z - 1) * (3 * z - 1) / 2, c = -z * (z - 1) * (z - 1);
    double determinant = creal(a) * cimag(b) - creal(b) * cimag(a);
    *stiffness = (creal(c) * cimag(b) - creal(b) * cimag(c)) / determinant;
    *damping = (creal(a) * cimag(c) - creal(c) * cimag(a)) / determinant;
}

static void (*const inverses[])(double rho, double theta, double *stiffness, double *damping) = {
#define INVERSE(NAME, name, choice, flat_choice, share, first)                                     \
    [OZ_INTEGRATOR_##NAME] = invert_##name,
    OZ_INTEGRATORS(INVERSE)
#undef INVERSE
};

/* What is turned until the mean restitution is right, and what follows from it. */
typedef struct Search {
    const OzScene *scene;
    const OzContactValues *values;
    OzContactConstants constants;
    double count; /* steps of a hit */
} Search;

/* The eigenvalues of a hit that returns e in a whole number of steps. */
static void set_by_eigenvalues(Search *search, double e)
{
    double step = search->scene->step, stiffness, damping;
    inverses[search->scene->integrator](pow(e, 1 / search->count), pi / search->count, &stiffness,
                                        &damping);
    search->constants.stiffness = stiffness / (step * step);
    search->constants.damping = damping / step;
}

static void set_damping(Search *search, double damping)
{
    search->constants.damping = damping;
}

static double error_of(Search *search, void (*set)(Search *search, double turned), double turned)
{
    set(search, turned);
    OzPredictedHits hits = oz_predict_hits(search->scene->integrator, search->scene->step,
                                           &search->constants, search->values->attraction);
    return hits.mean - search->constants.restitution;
}

/* Secants; false when they do not close in. The mean over phases has kinks where a hit gets one
 * step longer, far smaller than the error that is mended. */
static bool solve(Search *search, void (*set)(Search *search, double turned), double first,
                  double second)
{
    double a = first, b = second;
    double error_a = error_of(search, set, a), error_b = error_of(search, set, b);
    for (int i = 0; i < 40 && fabs(error_b) > 1e-13 && error_a != error_b; i++) {
        double next = b - error_b * (b - a) / (error_b - error_a);
        a = b;
        error_a = error_b;
        b = next;
        error_b = error_of(search, set, b);
    }
    return fabs(error_b) < 1e-9;
}

/* A hit of the linear law that starts and ends with the spring. Whether it returns what was asked.
 */
static bool solve_linear(Search *search)
{
    double e = search->constants.restitution;
    set_by_eigenvalues(search, e);
    search->constants.duration = search->count * search->scene->step;
    return search->scene->integrator != OZ_INTEGRATOR_VELOCITY_VERLET ||
           solve(search, set_by_eigenvalues, e, 0.999 * e);
}

static bool solve_damping(Search *search)
{
    double damping = search->constants.damping;
    return solve(search, set_damping, damping,
                 1.01 * damping + 1e-3 / search->values->contact_time);
}

static OzCalibrated find_constants(OzContactConstants *constants, const OzScene *scene,
                                   const OzContactValues *values)
{
    OzContactConstants plain = oz_contact_constants_of(values, &scene->contact);
    Search search = {scene, values, plain, fmax(2, round(values->contact_time / scene->step))};
    bool linear = !plain.smooth && values->attraction == OZ_ATTRACTION_ALLOW;
    *constants = plain;
    if (values->law != OZ_LAW_HOOKE ||
        scene->contact.restitution_calibration != OZ_CALIBRATION_DISCRETE) {
        return OZ_CALIBRATED_NOT;
    }
    if (!(linear ? solve_linear(&search) : solve_damping(&search))) {
        return OZ_CALIBRATED_IN_VAIN;
    }
    *constants = search.constants;
    constants->tangential_stiffness = values->tangential_stiffness * constants->stiffness;
    constants->tangential_damping = values->tangential_damping * constants->damping;
    return linear && scene->integrator != OZ_INTEGRATOR_VELOCITY_VERLET ? OZ_CALIBRATED_EXACTLY
                                                                        : OZ_CALIBRATED_IN_THE_MEAN;
}

/* The constants found last: every look at the contacts asks again, and a search takes milliseconds.
 * What is found hangs on the key alone, all of which is compared, so it does not matter who asked
 * before. Each thread keeps its own and needs no lock. */
typedef struct Found {
    OzIntegrator integrator;
    double step;
    OzContactValues values, grains;
    OzContactConstants constants;
    OzCalibrated outcome;
} Found;

static const Found *find(const OzScene *scene, const OzContactValues *values)
{
    enum { KEPT = 64 };
    static _Thread_local Found kept[KEPT];
    static _Thread_local int next;
    for (int i = 0; i < KEPT; i++) {
        const Found *f = &kept[i];
        if (f->integrator == scene->integrator && f->step == scene->step &&
            memcmp(&f->values, values, sizeof *values) == 0 &&
            memcmp(&f->grains, &scene->contact, sizeof *values) == 0) {
            return f;
        }
    }
    Found *f = &kept[next++ % KEPT];
    *f = (Found){.integrator = scene->integrator, .step = scene->step};
    memcpy(&f->values, values, sizeof *values);
    memcpy(&f->grains, &scene->contact, sizeof *values);
    f->outcome = find_constants(&f->constants, scene, values);
    return f;
}

OzContactConstants oz_calibrate_contact(const OzScene *scene, const OzContactValues *values)
{
    return find(scene, values)->constants;
}

OzCalibrated oz_calibrate_outcome(const OzScene *scene, const OzContactValues *values)
{
    return find(scene, values)->outcome;
}

static void say(const OzScene *scene, const OzContactValues *values, const char *where)
{
    if (oz_calibrate_outcome(scene, values) == OZ_CALIBRATED_IN_VAIN) {
        oz_log_line("%s: warning: no damping returns %g at this step; calibrated as if continuous "
                    "(orzo check says what comes out)",
                    where, values->restitution);
    }
}

void oz_calibrate_say(const OzScene *scene)
{
    for (int i = 0; i < oz_mixing_contacts(scene); i++) {
        char where[64] = "contacts of grains";
        OzMixed mixed;
        oz_mixing_contact(&mixed, scene, i);
        if (mixed.wall >= 0) {
            snprintf(where, sizeof where, "contacts at wall %d", mixed.wall);
        }
        say(scene, &mixed.values, where);
    }
}
