/* The contact's constants against an integrated contact, and the prediction of what each integrator
 * makes of it against known figures, exact inverses and limits. */
#include "model/contact.h"
#include "model/predict.h"
#include "model/prediction.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

static const double pi = 3.14159265358979323846;

enum { INTEGRATOR_COUNT = 3 };

static OzContactValues make_values(double restitution, OzAttraction attraction)
{
    return (OzContactValues){.contact_time = 6e-4,
                             .restitution = restitution,
                             .friction = 0.3,
                             .tangential_stiffness = 2.0 / 7,
                             .tangential_damping = 2.0 / 7,
                             .attraction = attraction};
}

/* Follows one hit of the continuous law with Runge and Kutta's fourth order in steps of 1e-5 t_c,
 * until the bodies part or, with clamp, until nothing pushes any more. */
static void integrate_hit(const OzContactConstants *c, double time, OzAttraction attraction,
                          double *restitution, double *duration)
{
    double h = 1e-5 * time, x = 0, v = 1;
    for (int64_t n = 1;; n++) {
        double k1 = -c->stiffness * x - c->damping * v;
        double v2 = v + 0.5 * h * k1;
        double k2 = -c->stiffness * (x + 0.5 * h * v) - c->damping * v2;
        double v3 = v + 0.5 * h * k2;
        double k3 = -c->stiffness * (x + 0.5 * h * v2) - c->damping * v3;
        double v4 = v + h * k3;
        double k4 = -c->stiffness * (x + h * v3) - c->damping * v4;
        x += h * (v + 2 * v2 + 2 * v3 + v4) / 6;
        v += h * (k1 + 2 * k2 + 2 * k3 + k4) / 6;
        bool pulls = c->stiffness * x + c->damping * v <= 0;
        if (v < 0 && (attraction == OZ_ATTRACTION_CLAMP ? pulls : x <= 0)) {
            *restitution = -v;
            *duration = (double)n * h;
            return;
        }
    }
}

static void test_constants_give_what_was_asked(void **state)
{
    (void)state;
    double asked[] = {0.01, 0.05, 0.1353, 0.3, 0.6, 0.9, 1};
    for (int attraction = 0; attraction < 2; attraction++) {
        for (size_t i = 0; i < sizeof asked / sizeof *asked; i++) {
            OzContactValues values = make_values(asked[i], (OzAttraction)attraction);
            OzContactConstants constants = oz_contact_constants(&values);
            double restitution, duration;
            integrate_hit(&constants, 6e-4, values.attraction, &restitution, &duration);
            /* The end is found to one step of 1e-5 t_c; over it a pulling dashpot changes the speed
             * by at most c_n e 1e-5 t_c / m* = 2e-5 e |ln e| < 1e-5. */
            assert_true(fabs(restitution - asked[i]) < 1e-5);
            assert_true(fabs(duration - constants.duration) < 2e-5 * 6e-4);
        }
    }
}

static void test_constants_of_the_paper(void **state)
{
    (void)state;
    OzContactValues values = make_values(0.4, OZ_ATTRACTION_ALLOW);
    OzContactConstants constants = oz_contact_constants(&values);
    /* a few roundings of the same products in another order */
    assert_true(fabs(constants.stiffness * 36e-8 / (pi * pi + pow(log(0.4), 2)) - 1) < 2e-15);
    assert_true(fabs(constants.damping * 6e-4 / (-2 * log(0.4)) - 1) < 2e-15);
    /* a share, multiplied once */
    assert_true(fabs(constants.tangential_stiffness / constants.stiffness - 2.0 / 7) < 1e-15);
    assert_true(fabs(constants.tangential_damping / constants.damping - 2.0 / 7) < 1e-15);
    values.restitution = 0;
    assert_true(oz_contact_constants(&values).restitution == OZ_CONTACT_RESTITUTION_LEAST);
}

/* The three branches as Schwager & Poeschel (2007) print them, b = c / (2 m*). */
static double printed_restitution(double b, double w0)
{
    double w = sqrt(fabs(w0 * w0 - b * b));
    if (b < w0 / sqrt(2)) {
        return exp(-(b / w) * (pi - atan(2 * b * w / (w * w - b * b))));
    }
    if (b < w0) {
        return exp(-(b / w) * atan(2 * b * w / (b * b - w * w)));
    }
    return exp(-(b / w) * log((b + w) / (b - w)));
}

static void test_clamped_restitution(void **state)
{
    (void)state;
    double last = 1.0000001;
    for (double ratio = 0.013; ratio < 8; ratio += 0.01) {
        double restitution = oz_contact_clamped_restitution(ratio);
        /* rounding, multiplied by b / w where damping is nearly critical: 1e-14 */
        assert_true(fabs(restitution / printed_restitution(ratio, 1) - 1) < 1e-13);
        assert_true(restitution < last);
        last = restitution;
    }
    assert_true(oz_contact_clamped_restitution(0) == 1);
    /* Critical damping: exp(-2), from both sides; the slope there is of order one. */
    assert_true(fabs(oz_contact_clamped_restitution(1) - exp(-2)) < 1e-12);
    assert_true(fabs(oz_contact_clamped_restitution(1 - 1e-8) - exp(-2)) < 1e-7);
    assert_true(fabs(oz_contact_clamped_restitution(1 + 1e-8) - exp(-2)) < 1e-7);
}

static OzPredictedHits hits_of(OzIntegrator integrator, double restitution, OzAttraction attraction,
                               double steps)
{
    OzContactValues values = make_values(restitution, attraction);
    OzContactConstants constants = oz_contact_constants(&values);
    return oz_predict_hits(integrator, 6e-4 / steps, &constants, attraction);
}

/* Known figures at the paper's 30 steps a contact, from a separate calculation over 40 phases. */
static void test_known_restitutions(void **state)
{
    (void)state;
    double asked[] = {0.1, 0.2, 0.4, 0.8, 1.0};
    double euler[] = {0.127, 0.246, 0.479, 0.944, 1.178};
    double symplectic[] = {0.087, 0.190, 0.394, 0.799, 1.000};
    for (int i = 0; i < 5; i++) {
        OzPredictedHits a = hits_of(OZ_INTEGRATOR_EULER, asked[i], OZ_ATTRACTION_ALLOW, 30);
        OzPredictedHits b =
            hits_of(OZ_INTEGRATOR_SYMPLECTIC_EULER, asked[i], OZ_ATTRACTION_ALLOW, 30);
        /* Three printed digits, and other phases. */
        assert_true(fabs(a.mean - euler[i]) < 1e-3);
        assert_true(fabs(b.mean - symplectic[i]) < 1e-3);
        assert_true(a.low <= a.mean && a.mean <= a.high);
    }
}

/* Both attraction rules, every integrator: ten times the steps, at most a fifth of the error. */
static void test_restitution_as_the_step_shrinks(void **state)
{
    (void)state;
    for (int i = 0; i < INTEGRATOR_COUNT; i++) {
        for (int attraction = 0; attraction < 2; attraction++) {
            OzAttraction rule = (OzAttraction)attraction;
            double coarse = fabs(hits_of((OzIntegrator)i, 0.4, rule, 300.3).mean - 0.4);
            double fine = fabs(hits_of((OzIntegrator)i, 0.4, rule, 3000.3).mean - 0.4);
            /* of first order at least: some of 1 / 300, and ten times less at a tenth of the step;
             * the phases are not the same, hence a fifth */
            assert_true(coarse < 0.01);
            assert_true(fine < 0.2 * coarse);
        }
    }
}

/* With an eigenvalue's angle of pi / n, n whole, the hit returns rho^n = e at every phase. */
static void test_whole_steps_are_exact(void **state)
{
    (void)state;
    for (int i = OZ_INTEGRATOR_EULER; i <= OZ_INTEGRATOR_SYMPLECTIC_EULER; i++) {
        double n = 30, e = 0.4, rho = pow(e, 1 / n), theta = pi / n;
        double even = 1 - rho * rho, turn = 2 * (1 - rho * cos(theta));
        OzContactConstants constants = {.stiffness = 1 - 2 * rho * cos(theta) + rho * rho,
                                        .damping = i == OZ_INTEGRATOR_EULER ? turn : even,
                                        .duration = n};
        OzEigenvalues values =
            oz_predict_eigenvalues((OzIntegrator)i, constants.stiffness, constants.damping);
        OzPredictedHits hits = oz_predict_hits((OzIntegrator)i, 1, &constants, OZ_ATTRACTION_ALLOW);
        /* roundings of a root and an arc tangent */
        assert_true(fabs(values.rho - rho) < 1e-14 && fabs(values.theta - theta) < 1e-14);
        /* Rounding of 30 steps. */
        assert_true(fabs(hits.low - e) < 1e-12 && fabs(hits.high - e) < 1e-12);
    }
}

/* The eigenvalues against stepped hits: their scatter over phases is a few percent, their mean
 * agrees with rho^(pi/theta) far better. */
static void test_closed_form(void **state)
{
    (void)state;
    for (int i = 0; i < INTEGRATOR_COUNT; i++) {
        for (double e = 0.2; e < 1.01; e += 0.2) {
            OzContactValues values = make_values(e, OZ_ATTRACTION_ALLOW);
            OzContactConstants c = oz_contact_constants(&values);
            double step = 6e-4 / 50.5;
            OzPredictedHits hits = oz_predict_hits((OzIntegrator)i, step, &c, OZ_ATTRACTION_ALLOW);
            OzEigenvalues z = oz_predict_eigenvalues((OzIntegrator)i, c.stiffness * step * step,
                                                     c.damping * step);
            /* what is left of the scatter in the mean over 64 phases: 3e-3 */
            assert_true(fabs(pow(z.rho, pi / z.theta) / hits.mean - 1) < 0.005);
        }
    }
}

/* Below the limit every eigenvalue is inside the unit circle, above it one is outside. */
static void test_limit_is_where_eigenvalues_leave(void **state)
{
    (void)state;
    for (int i = 0; i < INTEGRATOR_COUNT; i++) {
        for (double ratio = 0.05; ratio < 4; ratio *= 1.7) {
            double kappa = 3, gamma = 2 * ratio * sqrt(kappa);
            double limit = oz_predict_largest_step((OzIntegrator)i, kappa, gamma);
            double below = 0.999 * limit, above = 1.001 * limit;
            assert_true(
                oz_predict_eigenvalues((OzIntegrator)i, kappa * below * below, gamma * below)
                    .radius < 1);
            assert_true(
                oz_predict_eigenvalues((OzIntegrator)i, kappa * above * above, gamma * above)
                    .radius > 1);
        }
    }
    assert_true(oz_predict_largest_step(OZ_INTEGRATOR_EULER, 3, 0) == 0);
    /* a root and a quotient: one rounding */
    assert_true(fabs(oz_predict_largest_step(OZ_INTEGRATOR_SYMPLECTIC_EULER, 4, 0) - 1) < 1e-15);
    assert_true(isinf(oz_predict_largest_step(OZ_INTEGRATOR_VELOCITY_VERLET, 0, 0)));
}

static void test_scene_rows(void **state)
{
    (void)state;
    OzWall walls[2] = {{.contact = make_values(0.8, OZ_ATTRACTION_ALLOW)},
                       {.contact = make_values(1, OZ_ATTRACTION_CLAMP)}};
    OzScene scene = {.step = 2e-5,
                     .integrator = OZ_INTEGRATOR_EULER,
                     .contact = make_values(0.4, OZ_ATTRACTION_ALLOW),
                     .walls = walls,
                     .wall_count = 2};
    double mass[2] = {2, 6};
    OzGrains grains = {.count = 2, .mass = mass};
    OzPrediction *rows;
    int count;
    walls[0].contact.tangential_damping = 0;
    assert_int_equal(oz_prediction_rows(&rows, &count, &scene, &grains), OZ_OK);
    assert_int_equal(count, 3);
    assert_true(rows[0].wall == -1 && rows[2].wall == 1);
    assert_true(rows[0].mass_low == 1 && rows[0].mass_high == 3 && rows[1].mass_low == 2);
    /* a last digit of 30 is 4e-15 */
    assert_true(fabs(rows[0].steps - 30) < 1e-13);
    assert_true(rows[0].stable && rows[0].tangential_stable);
    /* c / k = t_c / 22.226 (its digits are the tolerance) for e = 0.8, at t_c / 30. */
    assert_true(rows[1].stable && fabs(rows[1].margin - 30 / 22.226) < 1e-4);
    assert_false(rows[1].tangential_stable);
    assert_true(!rows[2].stable && rows[2].margin == 0 && rows[2].radius > 1);
    /* Euler gives 1.178 where 1 is asked in 30 steps (test_known_restitutions) */
    assert_true(isnan(rows[2].closed_form) && rows[2].hits.mean > 1.17);
    free(rows);
}

/* A sphere that sticks yields along the contact by its turning too: 1/m + r^2/I = 7/2 over m, I =
 * 2/5 m r^2. An undamped spring kappa_t is then carried by symplectic Euler below 2 / sqrt(7/2
 * kappa_t). */
static void test_sticking_sphere(void **state)
{
    (void)state;
    double mass[1] = {2};
    OzGrains grains = {.count = 1, .mass = mass};
    OzScene scene = {.integrator = OZ_INTEGRATOR_SYMPLECTIC_EULER,
                     .contact = make_values(1, OZ_ATTRACTION_ALLOW)};
    scene.contact.tangential_stiffness = 1; /* kappa_t = kappa = pi^2 / t_c^2 */
    double limit = 2 / sqrt(3.5) * 6e-4 / pi;
    for (int side = -1; side <= 1; side += 2) {
        OzPrediction *rows;
        int count;
        scene.step = (1 + 0.001 * side) * limit;
        assert_int_equal(oz_prediction_rows(&rows, &count, &scene, &grains), OZ_OK);
        assert_true(rows[0].stable);
        assert_int_equal(rows[0].tangential_stable, side < 0);
        free(rows);
    }
}

/* Steps longer than the contact. A hit is one look at the overlap s, the share of the step after
 * touch, which pushes with K s + G: it throws back at K s + G - 1, of s the mean is 1/2. Explicit
 * Euler goes in for one more step, to 1 + s, before it obeys, and pushes again: at the end with
 * K (1 + s) - (G - 1) (K s + G - 1), which for steps far too long does not even send it away. */
static void test_absurd_steps_throw_back(void **state)
{
    (void)state;
    double e = 0.4;
    for (double steps = 0.01; steps < 0.9; steps *= 3) {
        double G = 2 * log(1 / e) / steps, K = (pi * pi + log(e) * log(e)) / (steps * steps);
        bool leaves = 2 * K > (G - 1) * (K + G - 1); /* at s = 1, the hardest */
        double euler = leaves ? 1.5 * K - (G - 1) * (K / 2 + G - 1) : NAN;
        double expected[] = {euler, K / 2 + G - 1, K / 2 + G - 1};
        assert_int_equal(leaves, steps > 0.5);
        for (int i = 0; i < INTEGRATOR_COUNT; i++) {
            OzPredictedHits hits = hits_of((OzIntegrator)i, e, OZ_ATTRACTION_ALLOW, steps);
            bool ends = i != OZ_INTEGRATOR_EULER || leaves;
            assert_int_equal(!isnan(hits.mean), ends);
            assert_true(!ends || fabs(hits.mean / expected[i] - 1) < 1e-12); /* rounding */
            assert_true(!ends || (hits.low < hits.mean && hits.mean < hits.high));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_constants_give_what_was_asked),
        cmocka_unit_test(test_constants_of_the_paper),
        cmocka_unit_test(test_clamped_restitution),
        cmocka_unit_test(test_known_restitutions),
        cmocka_unit_test(test_restitution_as_the_step_shrinks),
        cmocka_unit_test(test_whole_steps_are_exact),
        cmocka_unit_test(test_closed_form),
        cmocka_unit_test(test_limit_is_where_eigenvalues_leave),
        cmocka_unit_test(test_scene_rows),
        cmocka_unit_test(test_sticking_sphere),
        cmocka_unit_test(test_absurd_steps_throw_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
