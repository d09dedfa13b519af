/* The work-precision study of trigrains: orders against closed forms, energy against the force
 * point, host against device, what a refusal and a sentence say. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "report/report_cases.h"
#include "report/report_midpoint.h"
#include "report/report_point.h"
#include "report/report_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static OzOptions plain;

static OzReportJob job_of(const char *scene, const OzOptions *options, char path[static 512])
{
    snprintf(path, 512, "%s/report/%s.yaml", ORZO_SCENES, scene);
    const OzReportCase *row = oz_report_cases_find(scene);
    assert_non_null(row);
    return (OzReportJob){.options = options,
                         .path = path,
                         .row = row,
                         .phases = 4,
                         .repeats = 1};
}

/* On the host, or on a device when there is one. */
static OzReportPoint measured(const char *scene, const OzOptions *options, OzIntegrator integrator,
                              int substeps, int steps, const OzDevice *device)
{
    char path[512];
    OzReportJob job = job_of(scene, options, path);
    OzReportPoint point = {.device = device,
                           .label = device ? "" : "host",
                           .cycle = "period",
                           .integrator = integrator,
                           .precision = OZ_PRECISION_DOUBLE,
                           .substeps = substeps,
                           .host = !device,
                           .steps = steps};
    job.device = device;
    assert_int_equal(OZ_OK, oz_report_point_truth(&job));
    assert_int_equal(OZ_OK, oz_report_point_measure(&point, &job));
    return point;
}

static double error_of(const char *scene, OzIntegrator integrator, int substeps, int steps)
{
    OzReportPoint point = measured(scene, &plain, integrator, substeps, steps, NULL);
    assert_true(point.good);
    return point.error_rms;
}

static void test_every_case_has_its_scene(void **state)
{
    (void)state;
    for (const OzReportCase *row = oz_report_cases_all(OZ_MODEL_TRIGRAINS); row->scene; row++) {
        char path[512];
        OzScene scene = {0};
        snprintf(path, sizeof path, "%s/report/%s.yaml", ORZO_SCENES, row->scene);
        assert_int_equal(OZ_OK, oz_scene_load(&scene, path, NULL, 0));
        assert_int_equal(OZ_MODEL_TRIGRAINS, scene.model);
        oz_scene_free(&scene);
    }
}

/* Of three modes of two triangles and a beam. Halving the step divides an error of order p by 2^p.
 */
static void test_orders(void **state)
{
    (void)state;
    static const struct {
        OzIntegrator integrator;
        double order;
    } rows[] = {
        {OZ_INTEGRATOR_VELOCITY_VERLET, 2}, {OZ_INTEGRATOR_GEAR4, 4}, {OZ_INTEGRATOR_RK4, 4}};
    for (int i = 0; i < 3; i++) {
        double coarse = error_of("beam_vibration", rows[i].integrator, 0, 16);
        double fine = error_of("beam_vibration", rows[i].integrator, 0, 32);
        print_message("order %g: error %.2e at 16 steps, %.2e at 32\n", rows[i].order, coarse,
                      fine);
        /* the next order's part at 16 steps a period: 0.13 */
        assert_true(fabs(log2(coarse / fine) - rows[i].order) < 0.25);
    }
}

/* Four steps of the beams in one make the error of their vibration 16 times smaller. */
static void test_substeps(void **state)
{
    (void)state;
    double one = error_of("beam_vibration", OZ_INTEGRATOR_VELOCITY_VERLET, 0, 20);
    double four = error_of("beam_vibration", OZ_INTEGRATOR_VELOCITY_VERLET, 4, 20);
    assert_true(one / four > 12 && one / four < 20);
}

/* The centroid's force has a potential, the midpoint's has none: small steps help the one alone. */
static void test_energy(void **state)
{
    (void)state;
    char setting[] = "triangles.force_point=midpoint";
    OzOptions paper = {.settings = {setting}, .setting_count = 1};
    OzReportPoint centroid = measured("undamped_dice", &plain, OZ_INTEGRATOR_GEAR4, 0, 40, NULL);
    OzReportPoint midpoint = measured("undamped_dice", &paper, OZ_INTEGRATOR_GEAR4, 0, 40, NULL);
    print_message("energy after a hit without damping: centroid %.1e, midpoint %.1e\n",
                  centroid.error_rms, midpoint.error_rms);
    /* gear4's error at 40 steps of the fastest vibration 1e-7; the midpoint's work 6e-4 */
    assert_true(centroid.error_rms < 5e-7);
    assert_true(midpoint.error_rms > 1e-4);
}

/* Dice whose faces meet: the force jumps where the kind changes, so the error need not be of fourth
 * order, but it is far below the coarse one. */
static void test_dice(void **state)
{
    (void)state;
    double coarse = error_of("two_dice", OZ_INTEGRATOR_GEAR4, 0, 20);
    double fine = error_of("two_dice", OZ_INTEGRATOR_GEAR4, 0, 160);
    print_message("dice: error %.1e at 20 steps, %.1e at 160\n", coarse, fine);
    assert_true(coarse > 5 * fine);
    /* 3e-5 at 160 steps; no order to derive it from, since the force jumps */
    assert_true(fine < 1e-4);
}

/* The device does what the host does, up to roundings. */
static void test_device(void **state)
{
    (void)state;
    OzDevice device = {0};
    assert_int_equal(OZ_OK, oz_device_open(&device, NULL, 0));
    if (device.has_double) {
        OzReportPoint host = measured("undamped_dice", &plain, OZ_INTEGRATOR_GEAR4, 0, 20, NULL);
        OzReportPoint there =
            measured("undamped_dice", &plain, OZ_INTEGRATOR_GEAR4, 0, 20, &device);
        assert_true(there.good && there.wall > 0);
        /* roundings of 1e-16 in an error of 1e-6: 4e-10 */
        assert_true(fabs(there.error_rms / host.error_rms - 1) < 1e-7);
    }
    oz_device_close(&device);
}

/* A closed loop of press, turn and release: Simpson's error alone with the centroid. */
static void test_loop(void **state)
{
    (void)state;
    double centroid, midpoint;
    assert_int_equal(OZ_OK, oz_report_midpoint_loop(&centroid, OZ_FORCE_CENTROID));
    assert_int_equal(OZ_OK, oz_report_midpoint_loop(&midpoint, OZ_FORCE_MIDPOINT));
    /* Simpson's error 5e-11; the midpoint's work 0.02 of what is stored */
    assert_true(fabs(centroid) < 1e-9);
    assert_true(fabs(midpoint) > 0.01);
}

/* Eight grains, falling and at rest. The vessel moves by less than any rounding: so the extreme
 * suite's kernels serve. */
static OzMidpointPile pile_of(const OzDevice *device, OzForcePoint point)
{
    char *settings[] = {"grains.0.count=8", "time.duration=0.6", "walls.0.motion.frequency=1",
                        "walls.0.motion.amplitude=1e-18"};
    OzScene scene = {0};
    OzMidpointPile pile;
    char path[512];
    snprintf(path, sizeof path, "%s/report/settled_pile.yaml", ORZO_SCENES);
    assert_int_equal(OZ_OK, oz_scene_load(&scene, path, settings, 4));
    scene.triangles.force_point = point;
    assert_int_equal(OZ_OK, oz_report_midpoint_pile(&pile, &scene, device, NULL, NULL));
    oz_scene_free(&scene);
    return pile;
}

static void test_pile(void **state)
{
    (void)state;
    OzDevice device = {0};
    assert_int_equal(OZ_OK, oz_device_open(&device, NULL, 0));
    if (device.has_double) {
        OzMidpointPile centroid = pile_of(&device, OZ_FORCE_CENTROID);
        OzMidpointPile midpoint = pile_of(&device, OZ_FORCE_MIDPOINT);
        print_message("injected: centroid %.1e W, midpoint %.1e W; kinetic energy over its peak "
                      "%.1e, then %.1e\n",
                      centroid.power, midpoint.power, centroid.before, centroid.after);
        /* beams and dampers take all motion, and the centroid's force gives none: 5e-5 of the
         * midpoint's */
        assert_true(fabs(centroid.power) < 1e-3 * fabs(midpoint.power));
        assert_true(centroid.after < centroid.before && centroid.before < 1e-3);
    }
    oz_device_close(&device);
}

static void test_unstable_steps_are_named(void **state)
{
    (void)state;
    OzReportPoint point = measured("two_dice", &plain, OZ_INTEGRATOR_GEAR4, 0, 5, NULL);
    assert_false(point.good);
    assert_non_null(strstr(point.reason, "largest stable step"));
}

static void test_sentence(void **state)
{
    (void)state;
    char *text = NULL;
    size_t size = 0;
    OzReportPoint point = {.scene = "made_up",
                           .label = "host",
                           .cycle = "period",
                           .row = oz_report_cases_find("two_dice"),
                           .integrator = OZ_INTEGRATOR_VELOCITY_VERLET,
                           .precision = OZ_PRECISION_DOUBLE,
                           .substeps = 4,
                           .host = true,
                           .steps = 20,
                           .step = 1e-6,
                           .wall = 2,
                           .good = true};
    FILE *file = open_memstream(&text, &size);
    assert_non_null(file);
    oz_report_table_say(file, &point, 1, 0.01, true);
    fclose(file);
    assert_non_null(strstr(text, "use velocity-verlet, 4 substeps, double, at dt = 1e-06 s (20 "
                                 "steps per period)"));
    assert_non_null(strstr(text, "beams: {substeps: 4}\n"));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_case_has_its_scene),
        cmocka_unit_test(test_orders),
        cmocka_unit_test(test_substeps),
        cmocka_unit_test(test_energy),
        cmocka_unit_test(test_dice),
        cmocka_unit_test(test_device),
        cmocka_unit_test(test_loop),
        cmocka_unit_test(test_pile),
        cmocka_unit_test(test_unstable_steps_are_named),
        cmocka_unit_test(test_sentence),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
