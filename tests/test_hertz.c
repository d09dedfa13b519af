/* The Hertzian laws: Chung & Ooi's (2011) benchmark tests 1 to 4 against their closed forms, the
 * law of Poeschel & Buchholtz (1995), and the prediction against simulated hits. */
#include "model/prediction.h"
#include "rig.h"

#include "model/predict.h"

#include <stdlib.h>

/* Arguments for a scene's settings. */
#define SETTINGS(...)                                                                              \
    (char *[]){__VA_ARGS__}, (int)(sizeof((char *[]){__VA_ARGS__}) / sizeof(char *))

static void rig_load(Rig *rig, const char *name, char *const *settings, int count)
{
    char path[512];
    memset(rig, 0, sizeof *rig);
    snprintf(path, sizeof path, "%s/report/%s.yaml", ORZO_SCENES, name);
    must(oz_scene_load(&rig->scene, path, settings, count));
    must(oz_insert_grains(&rig->grains, &rig->scene));
    rig_start(rig);
}

/* Greatest overlap and the time with contact of a whole run. */
static void follow(Rig *rig, double *overlap, double *duration)
{
    int64_t last = (int64_t)round(rig->scene.duration / rig->scene.step), touched = 0;
    *overlap = 0;
    for (int64_t step = 1; step <= last; step++) {
        rig_advance(rig, step);
        *overlap = fmax(*overlap, oz_contact_list_sum(&rig->now.contacts).overlap_max);
        touched += oz_contact_list_sum(&rig->now.contacts).pairs +
                       oz_contact_list_sum(&rig->now.contacts).walls >
                   0;
    }
    *duration = (double)touched * rig->scene.step;
}

/* Hertz's elastic hit. Thousands of steps a hit: second order leaves 1e-6; the ends of the contact
 * and the deepest moment are seen to a step. */
static void check_elastic(const char *name, char *const *settings, int count, double mass,
                          double radius, double modulus, double speed)
{
    Rig rig;
    double overlap, duration;
    rig_load(&rig, name, settings, count);
    follow(&rig, &overlap, &duration);
    double expected = pow(15 * mass * speed * speed / (16 * modulus * sqrt(radius)), 0.4);
    /* second order, and the deepest moment to a step: 5e-8; each end of the hit to one step */
    assert_true(fabs(overlap / expected - 1) < 1e-6);
    assert_true(fabs(duration - 2.943275 * expected / speed) < 2 * rig.scene.step);
    double after =
        rig.now.count > 1 ? rig.now.velocity[3] - rig.now.velocity[0] : rig.now.velocity[2];
    /* of second order in thousands of steps; 4e-10 here */
    assert_true(fabs(after / speed - 1) < 1e-7);
    rig_close(&rig);
}

static double ball(double radius, double density)
{
    return 4 * 3.14159265358979 / 3 * radius * radius * radius * density;
}

static void test_chung_ooi_1(void **state)
{
    (void)state;
    check_elastic("chung_ooi_1", NULL, 0, ball(0.01, 2800) / 2, 0.005, 4.8e10 / (2 * (1 - 0.04)),
                  20);
    check_elastic("chung_ooi_1",
                  SETTINGS("contact.youngs_modulus=2e10", "contact.poisson_ratio=0.25",
                           "grains.0.density=2500", "grains.1.density=2500", "time.duration=1e-4"),
                  ball(0.01, 2500) / 2, 0.005, 2e10 / (2 * (1 - 0.0625)), 20);
}

static void test_chung_ooi_2(void **state)
{
    (void)state;
    check_elastic("chung_ooi_2", NULL, 0, ball(0.1, 2699), 0.1, 7e10 / (1 - 0.09), 0.2);
    check_elastic("chung_ooi_2",
                  SETTINGS("contact.youngs_modulus=4e10", "contact.poisson_ratio=0.35",
                           "grains.0.density=1800"),
                  ball(0.1, 1800), 0.1, 4e10 / (1 - 0.1225), 0.2);
}

static void test_chung_ooi_3(void **state)
{
    (void)state;
    for (int k = 0; k < 18; k++) {
        Rig rig;
        char restitution[64];
        double asked = 0.2 + 0.1 * (k / 2);
        snprintf(restitution, sizeof restitution, "contact.restitution=%.17g", asked);
        char *iron[] = {restitution, "contact.youngs_modulus=1e11", "contact.poisson_ratio=0.25",
                        "grains.0.density=7000"};
        rig_load(&rig, "chung_ooi_3", iron, k % 2 ? 4 : 1);
        rig_advance(&rig, 12000);
        /* 2000 steps a hit; damping begins as xi^(1/4): nearly first order there */
        if (!(fabs(rig.now.velocity[2] / 3.9 - asked) < 2e-4)) {
            fail_msg("asked %g, got %.9g", asked, rig.now.velocity[2] / 3.9);
        }
        rig_close(&rig);
    }
}

/* Angles to the normal at which the sphere slides from first to last; nearer the normal it sticks,
 * and the tangential spring decides. */
static void test_chung_ooi_4(void **state)
{
    (void)state;
    double degrees[] = {5, 20, 45, 60, 75};
    for (int k = 0; k < 5; k++) {
        Rig rig;
        char velocity[128];
        double angle = degrees[k] * 3.14159265358979 / 180, normal = 3.9 * cos(angle);
        snprintf(velocity, sizeof velocity, "grains.0.velocity=[%.17g, 0, %.17g]", 3.9 * sin(angle),
                 -normal);
        rig_load(&rig, "chung_ooi_4", SETTINGS(velocity));
        rig_advance(&rig, 12000);
        double lost = 0.092 * 1.98 * normal, angular_velocity = 2.5 * lost / 2.5e-3;
        double gain = (3.9 * sin(angle) - rig.now.velocity[0]) / lost,
               turn = rig.now.angular_velocity[1] / angular_velocity;
        if (k >= 2) {
            /* the restitution is right to 1e-4 */
            assert_true(fabs(gain - 1) < 2e-4);
        } else {
            assert_true(gain > 0 && gain < 1); /* friction's impulse is not used up */
        }
        /* both are that impulse's, the lever being r less half of an overlap of 0.02 r */
        assert_true(fabs(turn / gain - 1) < 1.2e-2);
        /* thousands of steps a hit: 2e-6 at the worst */
        assert_true(fabs(rig.now.velocity[2] / normal - 0.98) < 1e-5);
        rig_close(&rig);
    }
}

/* At every speed alike, clamped contacts too. */
static void test_restitution_does_not_depend_on_speed(void **state)
{
    (void)state;
    for (int k = 0; k < 6; k++) {
        Rig rig;
        double speed = k / 2 == 0 ? 0.039 : k / 2 == 1 ? 0.39 : 3.9;
        char velocity[64], step[64];
        snprintf(velocity, sizeof velocity, "grains.0.velocity=[0, 0, %g]", -speed);
        /* a hit's duration goes with speed^(-1/5) */
        snprintf(step, sizeof step, "time.step=%.9g", 5e-9 * pow(speed / 3.9, -0.2));
        rig_load(&rig, "chung_ooi_3",
                 SETTINGS(velocity, step,
                          k % 2 ? "contact.attraction=clamp" : "contact.attraction=allow"));
        rig_advance(&rig, 12000);
        /* thousands of steps a hit: 4e-5 at the worst */
        assert_true(fabs(rig.now.velocity[2] / speed - 0.6) < 2e-4);
        rig_close(&rig);
    }
}

/* The tangential force is min(m gamma_t v, mu F_n), opposite to sliding, without memory: a sphere
 * that slides along a plane under its own weight, slowly enough for the first, or fast. */
static double sliding_force(double speed)
{
    Rig rig;
    rig_open(&rig,
             "model: rods\ntime: {step: 1e-6, duration: 1}\nintegrator: velocity-verlet\n"
             "contact: {law: hertz, hertz_stiffness: 1e6, normal_damping_rate: 1e4, friction: 0.4,"
             " tangential_damping_rate: 100}\n"
             "grains: [{kind: single, diameter: 2e-3, position: [0, 0, 0.999e-3],"
             " velocity: [%g, 0, 0]}]\nwalls: [{kind: plane}]\n",
             speed);
    /* where weight and Y xi^(3/2) balance */
    rig.grains.position[2] = 1e-3 - pow(rig.grains.mass[0] * 9.81 / 1e6, 2.0 / 3);
    rig_start(&rig);
    rig_advance(&rig, 1);
    double force = (speed - rig.now.velocity[0]) / rig.scene.step; /* per mass */
    rig_close(&rig);
    return force;
}

static void test_haff_werner_friction(void **state)
{
    (void)state;
    /* one step of 1e-6 s slows sliding by 1e-4 of itself, 3.5e-4 with the spin it gives */
    assert_true(fabs(sliding_force(0.01) / (100 * 0.01) - 1) < 5e-4);
    assert_true(fabs(sliding_force(1) / (0.4 * 9.81) - 1) < 5e-4);
}

/* Prediction against simulated hits, over the same 64 phases. */
static void check_prediction(const char *law, int integrator)
{
    Rig rig;
    OzPrediction *rows = NULL;
    int count;
    double mean = 0;
    rig_open(
        &rig,
        "model: rods\ntime: {step: 2e-6, duration: 1}\nintegrator: %s\ngravity: [0, 0, 0]\n"
        "contact: {%s, friction: 0}\n"
        "grains:\n  - {kind: single, diameter: 2e-3, position: [0, 0, 0], velocity: [0, 0, 0.1]}\n"
        "  - {kind: single, diameter: 2e-3, position: [0, 0, 2e-3], velocity: [0, 0, -0.1]}\n",
        integrator_names[integrator], law);
    must(oz_prediction_rows(&rows, &count, &rig.scene, &rig.grains));
    assert_true(rows[0].speed == 0.2 && rows[0].stable && rows[0].steps > 20);
    for (int phase = 0; phase < OZ_PREDICT_PHASES; phase++) {
        double share = (phase + 0.5) / OZ_PREDICT_PHASES;
        rig.grains.position[5] = 2e-3 + (1 - share) * 0.2 * rig.scene.step;
        rig_start(&rig);
        rig_advance(&rig, (int64_t)(4 * rows[0].steps));
        mean += (rig.now.velocity[5] - rig.now.velocity[2]) / 0.2 / OZ_PREDICT_PHASES;
    }
    if (!(fabs(mean - rows[0].hits.mean) < 1e-8)) {
        fail_msg("%s, %s: %.12g, predicted %.12g", law, integrator_names[integrator], mean,
                 rows[0].hits.mean);
    }
    free(rows);
    rig_close(&rig);
}

static void test_prediction(void **state)
{
    (void)state;
    for (int integrator = 0; integrator < INTEGRATORS; integrator++) {
        check_prediction(
            "law: hertz-mindlin, youngs_modulus: 1e8, poisson_ratio: 0.3, restitution: 0.5",
            integrator);
        check_prediction("law: hertz, hertz_stiffness: 1e6, normal_damping_rate: 2e3,"
                         " tangential_damping_rate: 0",
                         integrator);
    }
}

/* What is foreseen of a hit without loss against the hit itself: its duration, and the tangents at
 * its deepest point. There the motion's energy m v^2 / 2 is the spring's 2/5 F x, so that dF/dx =
 * 3/2 F / x is 15/8 m (v / x)^2; along the contact it is Mindlin's 2 (1 - nu) / (2 - nu) of that.
 */
static void check_tangents(const char *law, bool mindlin)
{
    Rig rig;
    OzPrediction *rows = NULL;
    int count;
    double deepest, duration;
    rig_open(
        &rig,
        "model: rods\ntime: {step: 5e-8, duration: 3e-4}\nintegrator: velocity-verlet\n"
        "gravity: [0, 0, 0]\ncontact: {%s, friction: 0.1}\n"
        "grains:\n  - {kind: single, diameter: 2e-3, position: [0, 0, 0], velocity: [0, 0, 0.1]}\n"
        "  - {kind: single, diameter: 2e-3, position: [0, 0, 2e-3], velocity: [0, 0, -0.1]}\n",
        law);
    must(oz_prediction_rows(&rows, &count, &rig.scene, &rig.grains));
    rig_start(&rig);
    follow(&rig, &deepest, &duration);
    const OzContactConstants *c = &rows[0].constants;
    double tangent = 15.0 / 8 * 0.04 / (deepest * deepest);
    assert_true(duration < 0.5 * rig.scene.duration); /* it has ended */
    /* thousands of steps: both ends of the hit and its deepest point are seen to one of them */
    assert_true(fabs(c->duration / duration - 1) < 2e-3);
    assert_true(fabs(rows[0].steps * rig.scene.step / c->duration - 1) < 1e-14);
    /* the depth is flat about its deepest: the square of a step over the hit, 2e-7; the ratio is a
     * product */
    assert_true(fabs(c->stiffness / tangent - 1) < 1e-5);
    assert_true(!mindlin ||
                fabs(c->tangential_stiffness / (2 * 0.7 / 1.7 * c->stiffness) - 1) < 1e-14);
    free(rows);
    rig_close(&rig);
}

static void test_tangents_of_a_hit(void **state)
{
    (void)state;
    check_tangents("law: hertz-mindlin, youngs_modulus: 1e8, poisson_ratio: 0.3, restitution: 1",
                   true);
    check_tangents("law: hertz, hertz_stiffness: 1e6, normal_damping_rate: 0,"
                   " tangential_damping_rate: 0",
                   false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_chung_ooi_1),
        cmocka_unit_test(test_chung_ooi_2),
        cmocka_unit_test(test_chung_ooi_3),
        cmocka_unit_test(test_chung_ooi_4),
        cmocka_unit_test(test_restitution_does_not_depend_on_speed),
        cmocka_unit_test(test_haff_werner_friction),
        cmocka_unit_test(test_prediction),
        cmocka_unit_test(test_tangents_of_a_hit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
