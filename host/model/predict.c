/* The discrete contact: eigenvalues, stability limits and restitution of each integrator. */
#include "model/predict.h"

#include <complex.h>
#include <math.h>

/* One hit in units of step and approach speed: overlap grows while rate > 0. */
typedef struct Hit {
    double overlap, rate, acceleration;
    double stiffness, damping; /* K = kappa dt^2, G = gamma dt; Hertzian: force over overlap^1.5,
                                  and G or alpha */
    bool clamp, smooth;
    OzLaw law;
} Hit;

/* The forces of the laws, pushing apart, at an overlap x. */
static double repulsion_hooke(const Hit *hit, double x, double rate)
{
    double swing2 = hit->stiffness * x * x;
    double damping = hit->damping * (hit->smooth ? sqrt(swing2 / (swing2 + rate * rate)) : 1);
    return hit->stiffness * x + damping * rate;
}

static double repulsion_hertz(const Hit *hit, double x, double rate)
{
    return hit->stiffness * x * sqrt(x) + hit->damping * rate;
}

static double repulsion_hertz_mindlin(const Hit *hit, double x, double rate)
{
    return hit->stiffness * x * sqrt(x) + hit->damping * sqrt(hit->stiffness * sqrt(x)) * rate;
}

#define ROW(NAME, name, choice, linear, stiffness, damping) [OZ_LAW_##NAME] = repulsion_##name,
static double (*const repulsions[])(const Hit *hit, double x, double rate) = {OZ_LAWS(ROW)};
#undef ROW

static double hit_acceleration(const Hit *hit, double rate)
{
    double repulsion = repulsions[hit->law](hit, fmax(hit->overlap, 0), rate);
    if (hit->overlap <= 0 || (hit->clamp && repulsion < 0)) {
        return 0;
    }
    return -repulsion;
}

static void step_euler(Hit *hit)
{
    double acceleration = hit_acceleration(hit, hit->rate);
    hit->overlap += hit->rate;
    hit->rate += acceleration;
}

static void step_symplectic_euler(Hit *hit)
{
    hit->rate += hit_acceleration(hit, hit->rate);
    hit->overlap += hit->rate;
}

static void step_velocity_verlet(Hit *hit)
{
    double before = hit->acceleration;
    hit->overlap += hit->rate + 0.5 * before;
    hit->acceleration = hit_acceleration(hit, hit->rate + before);
    hit->rate += 0.5 * (before + hit->acceleration);
}

/* z^3 + c[2] z^2 + c[1] z + c[0]: the characteristic polynomials, physics of one lasting contact.
 * The Eulers' are of second degree, here times z. */
static void polynomial_euler(double K, double G, double c[3])
{
    c[2] = G - 2;
    c[1] = 1 - G + K;
    c[0] = 0;
}

static void polynomial_symplectic_euler(double K, double G, double c[3])
{
    c[2] = G + K - 2;
    c[1] = 1 - G;
    c[0] = 0;
}

/* z (z-1)^2 + K z^2 + G (z-1)(3z-1)/2 */
static void polynomial_velocity_verlet(double K, double G, double c[3])
{
    c[2] = K - 2 + 1.5 * G;
    c[1] = 1 - 2 * G;
    c[0] = 0.5 * G;
}

/* K < G and G < 2 + K/2, the second binding beyond critical damping only. */
static double limit_euler(double kappa, double gamma)
{
    double over = gamma * gamma - 4 * kappa;
    if (over <= 0) {
        return kappa > 0 ? gamma / kappa : INFINITY;
    }
    return 4 / (gamma + sqrt(over));
}

/* K + 2G < 4 */
static double limit_symplectic_euler(double kappa, double gamma)
{
    return 4 / (gamma + sqrt(gamma * gamma + 4 * kappa));
}

/* K + 4G < 4 */
static double limit_velocity_verlet(double kappa, double gamma)
{
    return 2 / (gamma + sqrt(gamma * gamma + kappa));
}

static const struct {
    void (*step)(Hit *hit);
    void (*polynomial)(double K, double G, double coefficients[3]);
    double (*limit)(double kappa, double gamma);
} methods[] = {
#define METHOD(NAME, name, choice, flat_choice, share, first)                                      \
    [OZ_INTEGRATOR_##NAME] = {step_##name, polynomial_##name, limit_##name},
    OZ_INTEGRATORS(METHOD)
#undef METHOD
};

double oz_predict_largest_step(OzIntegrator integrator, double stiffness, double damping)
{
    return methods[integrator].limit(stiffness, damping);
}

/* All three roots at once (Weierstrass 1891, Durand 1960, Kerner 1966), started away from symmetry.
 */
static void find_roots(const double c[3], double complex roots[3])
{
    for (int i = 0; i < 3; i++) {
        roots[i] = cpow(0.4 + 0.9 * I, i);
    }
    for (int round = 0; round < 200; round++) {
        for (int i = 0; i < 3; i++) {
            double complex z = roots[i];
            double complex apart = (z - roots[(i + 1) % 3]) * (z - roots[(i + 2) % 3]);
            if (cabs(apart) > 0) {
                roots[i] -= (((z + c[2]) * z + c[1]) * z + c[0]) / apart;
            }
        }
    }
}

/* A double root comes out split by the root of the rounding error: below 1e-7 an imaginary part is
 * none. */
OzEigenvalues oz_predict_eigenvalues(OzIntegrator integrator, double stiffness, double damping)
{
    OzEigenvalues values = {0};
    double coefficients[3];
    double complex roots[3];
    methods[integrator].polynomial(stiffness, damping, coefficients);
    find_roots(coefficients, roots);
    for (int i = 0; i < 3; i++) {
        values.radius = fmax(values.radius, cabs(roots[i]));
        if (cimag(roots[i]) > 1e-7) {
            values.rho = cabs(roots[i]);
            values.theta = carg(roots[i]);
        }
    }
    if (!(values.theta > 0)) {
        values.rho = values.radius;
    }
    return values;
}

/* Restitution of a hit that enters at the given share of a step, or NaN when it does not end. */
static double follow_hit(OzIntegrator integrator, Hit hit, double share, int64_t step_limit)
{
    hit.overlap = share - 1;
    hit.rate = 1;
    hit.acceleration = 0;
    for (int64_t n = 0; n < step_limit; n++) {
        methods[integrator].step(&hit);
        bool apart = hit.overlap <= 0 && hit.rate < 0;
        if (apart && !(fabs(hit.acceleration) > 0)) {
            return -hit.rate;
        }
    }
    return NAN;
}

/* A hundred times the duration is far beyond any hit that ends; the bound keeps contact times of
 * millions of steps from taking minutes. */
static int64_t hit_step_limit(double duration, double step)
{
    return (int64_t)fmin(100 * duration / step + 100, 2e6);
}

static OzPredictedHits average_hits(OzIntegrator integrator, Hit hit, int64_t step_limit)
{
    OzPredictedHits hits = {.mean = 0, .low = INFINITY, .high = -INFINITY};
    for (int phase = 0; phase < OZ_PREDICT_PHASES; phase++) {
        double share = (phase + 0.5) / OZ_PREDICT_PHASES;
        double restitution = follow_hit(integrator, hit, share, step_limit);
        hits.mean += restitution / OZ_PREDICT_PHASES;
        hits.low = fmin(hits.low, restitution);
        hits.high = fmax(hits.high, restitution);
    }
    return isnan(hits.mean) ? (OzPredictedHits){NAN, NAN, NAN} : hits;
}

OzPredictedHits oz_predict_hits(OzIntegrator integrator, double step,
                                const OzContactConstants *constants, OzAttraction attraction)
{
    Hit hit = {.stiffness = constants->stiffness * step * step,
               .damping = constants->damping * step,
               .clamp = attraction == OZ_ATTRACTION_CLAMP,
               .smooth = constants->smooth,
               .law = constants->law};
    return average_hits(integrator, hit, hit_step_limit(constants->duration, step));
}

OzPredictedHits oz_predict_hertz_hits(const OzScene *scene, const OzContactValues *values,
                                      const OzHertzHit *hertz)
{
    double step = scene->step;
    Hit hit = {.stiffness = hertz->stiffness * sqrt(hertz->speed) * step * step * sqrt(step),
               .damping = hertz->damping * (values->law == OZ_LAW_HERTZ ? step : 1),
               .clamp = values->attraction == OZ_ATTRACTION_CLAMP,
               .law = values->law};
    return average_hits(scene->integrator, hit, hit_step_limit(hertz->linear.duration, step));
}
