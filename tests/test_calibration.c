/* `restitution_calibration: discrete`, `damping: smooth` and `restitution_at: contact`: the
 * restitution that simulated hits really give, against what was asked. */
#include "rig.h"

#include "model/calibrate.h"
#include "model/predict.h"

static const double contact_time = 6e-4, speed = 0.1;

static OzScene make_scene(int integrator, double restitution, double steps)
{
    return (OzScene){.step = contact_time / steps,
                     .integrator = (OzIntegrator)integrator,
                     .contact = {.contact_time = contact_time,
                                 .restitution = restitution,
                                 .friction = 0.3,
                                 .tangential_stiffness = 2.0 / 7,
                                 .tangential_damping = 2.0 / 7,
                                 .restitution_calibration = OZ_CALIBRATION_DISCRETE}};
}

static OzPredictedHits hits_of(const OzScene *scene)
{
    OzContactConstants constants = oz_calibrate_contact(scene, &scene->contact);
    return oz_predict_hits(scene->integrator, scene->step, &constants, scene->contact.attraction);
}

/* Closed forms: every phase; rounding of a hundred steps. */
static void test_eulers_are_exact_at_every_phase(void **state)
{
    (void)state;
    double asked[] = {0.01, 0.1, 0.4, 0.8, 1};
    for (int k = 0; k < 30; k++) {
        OzScene scene = make_scene(k % 2, asked[k / 2 % 5],
                                   k / 10 == 0   ? 8
                                   : k / 10 == 1 ? 30
                                                 : 100);
        OzPredictedHits hits = hits_of(&scene);
        /* a hundred steps of 1e-16 each: 3e-14 */
        assert_true(fabs(hits.low - scene.contact.restitution) < 2e-13);
        assert_true(fabs(hits.high - scene.contact.restitution) < 2e-13);
    }
}

/* Where no closed form exists the mean over phases is right, whatever the damping and the
 * attraction. */
static void test_means_are_exact(void **state)
{
    (void)state;
    double asked[] = {0.1, 0.4, 0.8};
    for (int k = 0; k < 36; k++) {
        OzScene scene = make_scene(k / 12, asked[k % 3], 30);
        scene.contact.attraction = (OzAttraction)(k / 3 % 2);
        scene.contact.damping = (OzDamping)(k / 6 % 2);
        /* the search for the damping ends at 1e-13 */
        assert_true(fabs(hits_of(&scene).mean - asked[k % 3]) < 1e-12);
    }
    OzScene verlet = make_scene(OZ_INTEGRATOR_VELOCITY_VERLET, 0.4, 30);
    OzPredictedHits hits = hits_of(&verlet);
    /* The third eigenvalue's trace, 1.5e-4; 0.024 without calibration. */
    assert_true(hits.high - hits.low < 2e-4);
}

/* What calibration says of itself is what hits then do. */
static void test_calibration_knows_its_outcome(void **state)
{
    (void)state;
    for (int k = 0; k < 12; k++) {
        OzScene scene = make_scene(k % 3, 0.05, k / 6 ? 5 : 30);
        scene.contact.attraction = (OzAttraction)(k / 3 % 2);
        OzPredictedHits hits = hits_of(&scene);
        bool mean = fabs(hits.mean - 0.05) < 1e-9, all = hits.high - hits.low < 1e-9;
        OzCalibrated outcome = oz_calibrate_outcome(&scene, &scene.contact);
        assert_int_equal(outcome, mean && all ? OZ_CALIBRATED_EXACTLY
                                  : mean      ? OZ_CALIBRATED_IN_THE_MEAN
                                              : OZ_CALIBRATED_IN_VAIN);
    }
    OzScene verlet = make_scene(OZ_INTEGRATOR_VELOCITY_VERLET, 0.05, 5);
    assert_int_equal(OZ_CALIBRATED_IN_VAIN, oz_calibrate_outcome(&verlet, &verlet.contact));
    verlet.contact.restitution_calibration = OZ_CALIBRATION_NONE;
    assert_int_equal(OZ_CALIBRATED_NOT, oz_calibrate_outcome(&verlet, &verlet.contact));
}

static void open_pair(Rig *rig, int integrator, double restitution, double step, const char *more)
{
    rig_open(
        rig,
        "model: rods\ntime: {step: %.17g, duration: 1}\nintegrator: %s\ngravity: [0, 0, 0]\n"
        "contact: {contact_time: %g, restitution: %g, %s}\ngrains:\n"
        "  - {kind: single, diameter: 1e-3, position: [0, 0, 1.1e-3], aspect: 0}\n"
        "  - {kind: single, diameter: 0.8e-3, aspect: 4, axis: [0, 1, 0], position: [0, 0, 0]}\n",
        step, integrator_names[integrator], contact_time, restitution, more);
}

/* Relative speed along z after a head-on hit over that before; share: of the step before touch. */
static double hit(Rig *rig, double share, double approach)
{
    rig->grains.position[2] = 0.9e-3 + (1 - share) * approach * rig->scene.step;
    rig->grains.velocity[2] = -approach;
    rig_start(rig);
    rig_advance(rig, (int64_t)(4 * contact_time / rig->scene.step));
    return (rig->now.velocity[2] - rig->now.velocity[5]) / approach;
}

static void test_simulated_hits_return_what_was_asked(void **state)
{
    (void)state;
    for (int k = 0; k < 6; k++) {
        Rig rig;
        double asked = k % 3 == 0 ? 0.1 : k % 3 == 1 ? 0.4 : 0.8;
        open_pair(&rig, k / 3, asked, 2.1e-5, "restitution_calibration: discrete");
        /* the step is fitted: whole but for a last digit of 29 */
        assert_true(rig.scene.written_step == 2.1e-5);
        assert_true(fabs(contact_time / rig.scene.step - 29) < 1e-13);
        for (int phase = 0; phase < 16; phase++) {
            double got = hit(&rig, (phase + 0.5) / 16, speed);
            /* rounding of coordinates of 1e-3 m in overlaps of 1e-6 m, 30 steps: 1e-11 */
            assert_true(fabs(got - asked) < 1e-9);
        }
        rig_close(&rig);
    }
}

/* A wall's contact time of its own is rounded to whole steps. */
static void test_walls_are_calibrated_too(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig,
             "model: rods\ntime: {step: 2e-5, duration: 1}\ngravity: [0, 0, 0]\n"
             "contact: {contact_time: 6e-4, restitution: 0.4, restitution_calibration: discrete}\n"
             "grains: [{kind: single, diameter: 1e-3, position: [0, 0, 0.5003e-3],"
             " velocity: [0, 0, -0.1]}]\n"
             "walls: [{kind: plane, contact: {contact_time: 4.13e-4, restitution: 0.7}}]\n");
    rig_start(&rig);
    rig_advance(&rig, 60);
    /* rounding of coordinates of 5e-4 m, 30 steps: 1e-14 */
    assert_true(fabs(rig.now.velocity[2] / 0.1 - 0.7) < 1e-12);
    rig_close(&rig);
}

/* Runge and Kutta's fourth order in 1e-5 of the contact time. */
static void integrate_smooth(const OzContactConstants *c, bool clamp, double *restitution,
                             double *duration)
{
    double h = 1e-5 * contact_time, x = 0, v = 1, k[4], w[4], step[4] = {0, h / 2, h / 2, h};
    for (int64_t n = 0;; n++) {
        for (int i = 0; i < 4; i++) {
            double y = x + (i ? step[i] * w[i - 1] : 0);
            w[i] = v + (i ? step[i] * k[i - 1] : 0);
            double swing2 = c->stiffness * y * y;
            k[i] = -c->stiffness * y - c->damping * w[i] * sqrt(swing2 / (swing2 + w[i] * w[i]));
        }
        if (v < 0 && (clamp ? k[0] >= 0 : x <= 0)) {
            *restitution = -v;
            *duration = (double)n * h;
            return;
        }
        x += h * (w[0] + 2 * w[1] + 2 * w[2] + w[3]) / 6;
        v += h * (k[0] + 2 * k[1] + 2 * k[2] + k[3]) / 6;
    }
}

static void test_smooth_constants_give_what_was_asked(void **state)
{
    (void)state;
    double asked[] = {0.01, 0.1, 0.5, 0.9, 1};
    for (int k = 0; k < 10; k++) {
        OzScene scene = make_scene(0, asked[k % 5], 30);
        scene.contact.damping = OZ_DAMPING_SMOOTH;
        scene.contact.attraction = (OzAttraction)(k / 5);
        OzContactConstants constants = oz_contact_constants(&scene.contact);
        double restitution, duration;
        integrate_smooth(&constants, k / 5, &restitution, &duration);
        /* the end is found to a step */
        assert_true(fabs(restitution - asked[k % 5]) < 2e-5);
        assert_true(fabs(duration / contact_time - 1) < 5e-5);
    }
}

/* Greatest error over phases of first touch. */
static double worst_error(const char *damping, double steps)
{
    Rig rig;
    double worst = 0;
    open_pair(&rig, OZ_INTEGRATOR_VELOCITY_VERLET, 0.4, contact_time / steps, damping);
    for (int phase = 0; phase < 8; phase++) {
        worst = fmax(worst, fabs(hit(&rig, (phase + 0.5) / 8, speed) - 0.4));
    }
    rig_close(&rig);
    return worst;
}

/* The order that velocity-verlet keeps through a contact: ten times the steps, a hundredth of the
 * error; first order, a tenth, where the dashpot makes the force jump. 60 and 20 leave room for
 * chance. */
static void test_order_through_a_contact(void **state)
{
    (void)state;
    double smooth = worst_error("damping: smooth", 30.4) / worst_error("damping: smooth", 303.7);
    double constant =
        worst_error("damping: constant", 30.4) / worst_error("damping: constant", 303.7);
    if (!(smooth > 60 && constant < 20)) {
        fail_msg("ratio of errors %g with smooth damping, %g with constant", smooth, constant);
    }
}

static void test_smooth_restitution_is_the_same_at_every_speed(void **state)
{
    (void)state;
    Rig rig;
    open_pair(&rig, OZ_INTEGRATOR_VELOCITY_VERLET, 0.4, contact_time / 100, "damping: smooth");
    double slow = hit(&rig, 0.3, 0.01), fast = hit(&rig, 0.3, 1);
    /* the law scales with the speed, so that the two differ by rounding alone, of overlaps of 1e-6
     * m; 1.5e-4 is velocity-verlet's error at 100 steps */
    assert_true(fabs(slow - fast) < 1e-8 && fabs(slow - 0.4) < 2e-4);
    rig_close(&rig);
}

/* A rod at 30 degrees to the vertical falls with its lower end on a smooth plane: speed of that end
 * after over before. */
static double end_restitution(const char *more, double restitution, double time)
{
    Rig rig;
    rig_open(&rig,
             "model: rods\ntime: {step: %.17g, duration: 1}\nintegrator: velocity-verlet\n"
             "gravity: [0, 0, 0]\ncontact: {contact_time: %g, restitution: %g, friction: 0, %s}\n"
             "grains: [{kind: single, diameter: 1e-3, aspect: 4, axis: [0.5, 0, 0.866025403784],"
             " velocity: [0, 0, -0.01], position: [0, 0, %.17g]}]\n"
             "walls: [{kind: plane, point: [0, 0, 0], normal: [0, 0, 1]}]\n",
             time / 2000, time, restitution, more, 0.5e-3 + 2e-3 * 0.866025403784 + 1e-9);
    rig_start(&rig);
    rig_advance(&rig, 4000);
    const double *u = rig.now.axis, *w = rig.now.angular_velocity;
    double end = rig.now.velocity[2] - 2e-3 * (w[0] * u[1] - w[1] * u[0]); /* -(w x a).z */
    rig_close(&rig);
    return end / 0.01;
}

static void test_off_centre_hits_return_what_was_asked(void **state)
{
    (void)state;
    const char *options[] = {"restitution_at: contact",
                             "restitution_at: contact, attraction: clamp",
                             "restitution_at: contact, damping: smooth"};
    for (int k = 0; k < 9; k++) {
        double asked = k / 3 == 0 ? 0.2 : k / 3 == 1 ? 0.4 : 0.8;
        double got = end_restitution(options[k % 3], asked, 1e-5);
        /* 1400 steps in the hit: first order, 1e-3; turning by v t_c / d = 1e-4 meanwhile */
        if (!(fabs(got - asked) < 2e-3)) {
            fail_msg("%s: %g asked, %g got", options[k % 3], asked, got);
        }
    }
    /* 0.31: the end feels a smaller mass than the centres that the damping is for */
    assert_true(end_restitution("restitution_at: centre", 0.4, 1e-5) < 0.35);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_eulers_are_exact_at_every_phase),
        cmocka_unit_test(test_means_are_exact),
        cmocka_unit_test(test_calibration_knows_its_outcome),
        cmocka_unit_test(test_simulated_hits_return_what_was_asked),
        cmocka_unit_test(test_walls_are_calibrated_too),
        cmocka_unit_test(test_smooth_constants_give_what_was_asked),
        cmocka_unit_test(test_order_through_a_contact),
        cmocka_unit_test(test_smooth_restitution_is_the_same_at_every_speed),
        cmocka_unit_test(test_off_centre_hits_return_what_was_asked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
