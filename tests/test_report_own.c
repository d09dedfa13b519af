/* `orzo report` of scenes that no answer is known for: its numbers where a closed form exists, its
 * choice, its last sentence. ORZO_NEEDS_DEVICE. */
#include "program.h"

#include "report/report_own.h"

#include <math.h>

/* Spheres in a shaken cylinder: their number, start, time and settling. All share their kernels. */
#define SPHERES                                                                                    \
    "model: rods\nprecision: double\nintegrator: euler\ntime: {step: 2e-5, %s}\n"                  \
    "contact: {contact_time: 6e-4, restitution: 0.4, friction: 0.1}\n"                             \
    "grains:\n  - {diameter: 0.5e-3, %s}\n"                                                        \
    "walls:\n  - {kind: plane, motion: {frequency: 30, acceleration_ratio: 2}}\n"                  \
    "  - {kind: cylinder, diameter: 3e-3}\n%s"

/* One row of paths.csv. */
typedef struct Row {
    double steps, step, largest, horizon, error;
} Row;

static Row row_of(const char *file, const char *integrator, double steps)
{
    char *text = read_file(file, NULL), start[64];
    Row row = {0};
    snprintf(start, sizeof start, "%s,1,%g,", integrator, steps);
    const char *at = strstr(text, start);
    if (!at) {
        fail_msg("%s has no row %s", file, start);
    }
    assert_int_equal(sscanf(at + strlen(integrator) + 3, "%lf,%lf,%lf,%lf,%lf", &row.steps,
                            &row.step, &row.largest, &row.horizon, &row.error),
                     5);
    free(text);
    return row;
}

/* In free fall both Eulers are off by g T dt / 2, velocity-verlet is exact. The step is shortened
 * so that it divides the time. The small-step paths' rounding is 1e-12 diameters. */
static void test_free_fall(void **state)
{
    (void)state;
    const double time = 0.02, diameter = 0.5e-3, gravity = 9.81;
    write_file("fall.yaml", SPHERES, "duration: 0.02", "kind: single, position: [0, 0, 0.1]", "");
    expect(0, "1 grain, paths from grains as placed",
           "report fall.yaml --quick -o out --tolerance 1e-3");
    assert_true(contains("said", "nothing in this scene depends on the seed"));
    assert_true(contains("said", "nothing touched at any look"));
    const char *const eulers[] = {"euler", "symplectic-euler"};
    for (int k = 0; k < 2; k++) {
        Row row = row_of("out/fall/paths.csv", eulers[k], 50);
        double dt = time / ceil(time / row.step - 1e-9);
        /* nine digits are written; the Euler's error is g t dt / 2 but for rounding in the scene's
         * precision: 3e-7 */
        assert_true(fabs(row.horizon / time - 1) < 1e-9);
        assert_true(fabs(row.step / (6e-4 / 50) - 1) < 1e-6); /* a hit takes the contact time */
        double expected = gravity * time * dt / 2 / diameter;
        assert_true(fabs(row.error / expected - 1) < 1e-5);
    }
    assert_true(row_of("out/fall/paths.csv", "velocity-verlet", 20).error < 1e-9);
    /* the Eulers are off by 1.2e-3 diameters at their finest, 100 steps */
    assert_true(contains("said",
                         "advice: take integrator: velocity-verlet, time.step: 3e-05 (20 "
                         "steps per contact), the cheapest that is within 0.001 diameters"));
}

/* A bed: it settles, its stability is measured, means over seeds are compared. */
static void test_bed(void **state)
{
    (void)state;
    write_file("bed.yaml", SPHERES, "taps: 2", "kind: random, count: 12",
               "settle: {drag: 70, rest_time: 0.02}\n");
    expect(0, "12 grains, paths from the bed settled for", "report bed.yaml --quick -o out");
    static const char *const said[] = {"stability: as written, the largest stable step is ",
                                       "contacts together",
                                       "paths: those of 200 and 400 steps per contact agree for ",
                                       "means over 2 seeds, later half of 0.0667 s",
                                       "density_tap_mean  ",
                                       "contact_number  ",
                                       "left out, not defined here: angle_tap_mean, speed_mean, "
                                       "spin_mean, inclination\n",
                                       "means over seeds"};
    for (size_t k = 0; k < sizeof said / sizeof said[0]; k++) {
        if (!contains("said", said[k])) {
            fail_msg("'%s' is not said", said[k]);
        }
    }
    Row coarse = row_of("out/bed/paths.csv", "velocity-verlet", 20);
    Row fine = row_of("out/bed/paths.csv", "velocity-verlet", 100);
    assert_true(fine.error < coarse.error && fine.error > 0);
    assert_true(row_of("out/bed/paths.csv", "euler", 50).error > fine.error);
    char *text = read_file("said", NULL), *advice = strstr(text, "advice: ");
    assert_non_null(advice);
    char *end = strchr(advice, '\n');
    assert_non_null(end);
    assert_true(end[-1] == '.'); /* one sentence */
    free(text);
}

/* Two dice that hit: few grains are followed from their placing on, to the end. */
static void test_dice(void **state)
{
    (void)state;
    write_file("dice.yaml",
               "model: trigrains\ngravity: [0, 0]\ntime: {step: 2e-6, duration: 4e-3}\n"
               "beams: {stiffness: 100, second_moment: 1e-10, damping: 9e-3}\n"
               "triangles: {stiffness: 2e6}\ngrains:\n"
               "  - {kind: single, shape: square, edge: 2e-3, position: [0, 0], "
               "angle: 30, velocity: [1, 0]}\n"
               "  - {kind: single, shape: square, edge: 2e-3, "
               "position: [2.9e-3, 3e-4], angle: 30}\n");
    expect(0, "agree for 0.004 s, all that was followed", "report dice.yaml --quick -o out");
    assert_true(contains("said", "of any grain with a whole edge in contact"));
    assert_true(contains("said", "advice: take integrator: "));
    double coarse = row_of("out/dice/paths.csv", "gear4", 20).error;
    double fine = row_of("out/dice/paths.csv", "gear4", 40).error;
    /* in diameters, at 20 steps: 3e-4 */
    assert_true(fine > 0 && fine < coarse && coarse < 1e-3);
}

static void test_refusals(void **state)
{
    (void)state;
    write_file("sweep.yaml", SPHERES, "duration: 0.02", "kind: single, position: [0, 0, 0.1]",
               "sweep: {contact.friction: [0.1, 0.2]}\n");
    expect(2, "expected a scene without one", "report sweep.yaml --quick -o out");
    write_file("alone.yaml", "model: rods\ntime: {step: 1e-5, duration: 1}\n"
                             "contact: {contact_time: 6e-4, restitution: 0.4}\n"
                             "grains:\n  - {kind: single, diameter: 1e-3, position: [0, 0, 0]}\n");
    expect(2, "nothing can touch here", "report alone.yaml --quick -o out");
}

static OzReportPath path_of(double step, double largest, double error, double cost)
{
    return (OzReportPath){
        .step = step, .largest = largest, .error = error, .cost = cost, .good = true};
}

static void test_choice(void **state)
{
    (void)state;
    OzReportPaths paths = {.count = 4};
    paths.path[0] = path_of(1, 10, 1e-3, 8);
    paths.path[1] = path_of(2, 10, 9e-3, 4);
    paths.path[2] = path_of(3, 3.1, 8e-3, 2); /* too near its limit */
    paths.path[3] = path_of(4, 10, 2e-2, 1);
    assert_ptr_equal(oz_report_own_choose(&paths, 0.01), &paths.path[1]);
    assert_ptr_equal(oz_report_own_choose(&paths, 0.05), &paths.path[3]);
    assert_ptr_equal(oz_report_own_choose(&paths, 1e-4), &paths.path[0]); /* none: the nearest */
    paths.path[1].good = false;
    assert_ptr_equal(oz_report_own_choose(&paths, 0.01), &paths.path[0]);
    paths.count = 0;
    assert_null(oz_report_own_choose(&paths, 0.01));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_choice), cmocka_unit_test(test_free_fall), cmocka_unit_test(test_bed),
        cmocka_unit_test(test_dice),   cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, enter_work, leave_work);
}
