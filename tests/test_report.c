/* The work-precision study: exact answers, the sentence for a tolerance, the Pareto front, orders.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "model/contact.h"
#include "model/insert.h"
#include "report/report_cases.h"
#include "report/report_ensemble_table.h"
#include "report/report_map.h"
#include "report/report_point.h"
#include "report/report_table.h"
#include "sim/stiffness.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static OzDevice device;
static const OzOptions no_options;

static int open_device(void **state)
{
    (void)state;
    return oz_device_open(&device, NULL, 0) == OZ_OK ? 0 : -1;
}

static int close_device(void **state)
{
    (void)state;
    oz_device_close(&device);
    return 0;
}

static OzReportJob job_of(const char *scene, char path[static 512])
{
    snprintf(path, 512, "%s/report/%s.yaml", ORZO_SCENES, scene);
    const OzReportCase *row = oz_report_cases_find(scene);
    assert_non_null(row);
    return (OzReportJob){.options = &no_options,
                         .device = &device,
                         .path = path,
                         .row = row,
                         .phases = 4,
                         .repeats = 1};
}

static double truth_of(const char *scene)
{
    char path[512];
    OzReportJob job = job_of(scene, path);
    assert_int_equal(OZ_OK, oz_report_point_truth(&job));
    return job.truth[0];
}

static OzReportPoint measured(const char *scene, OzIntegrator integrator, int steps)
{
    char path[512];
    OzReportJob job = job_of(scene, path);
    OzReportPoint point = {.device = &device,
                           .label = "",
                           .cycle = "contact",
                           .integrator = integrator,
                           .precision = OZ_PRECISION_DOUBLE,
                           .steps = steps};
    assert_int_equal(OZ_OK, oz_report_point_truth(&job));
    assert_int_equal(OZ_OK, oz_report_point_measure(&point, &job));
    return point;
}

static void test_every_case_has_its_scene(void **state)
{
    (void)state;
    for (const OzReportCase *row = oz_report_cases_all(OZ_MODEL_RODS); row->scene; row++) {
        char path[512];
        OzScene scene = {0};
        snprintf(path, sizeof path, "%s/report/%s.yaml", ORZO_SCENES, row->scene);
        assert_int_equal(OZ_OK, oz_scene_load(&scene, path, NULL, 0));
        /* a whole number of contact times: every rung of the ladder then ends at the same time */
        double contacts = scene.duration / scene.contact.contact_time;
        assert_true(fabs(contacts - round(contacts)) < 1e-12);
        oz_scene_free(&scene);
    }
}

/* A rigid sphere has gone 12/49 v^2/(mu g) when it rolls, at 2 v/(7 mu g), and then goes on with
 * 5/7 v. The spring along the plane yields by mu m g / k_t at most, 1e-6 m of 2.3e-3 m. */
static void test_reference_meets_the_rigid_sphere(void **state)
{
    (void)state;
    double v = 0.1, deceleration = 0.3 * 9.81, rolls = 2 * v / (7 * deceleration);
    double way = 12.0 / 49 * v * v / deceleration + 5.0 / 7 * v * (0.03 - rolls);
    /* 1e-6 m of 2.3e-3 m for the spring, less for what it gives back: 2e-4 */
    assert_true(fabs(truth_of("rolling_sphere") / way - 1) < 4e-4);
}

/* Gravity acts during the hits too, and a hit lasts 1/20 of a flight. */
static void test_reference_meets_the_bouncing_sphere(void **state)
{
    (void)state;
    /* a twentieth for what a hit lasts of a flight, and gravity meanwhile: 0.055 */
    assert_true(fabs(truth_of("bounce") / (1e-3 * pow(0.8, 6)) - 1) < 0.1);
}

/* One end of a rod 45 degrees steep: 1/m + arm^2/I in place of 1/m makes the hit shorter and
 * deader. The rod turns by 0.4 degrees while it touches, which moves the answer by a few
 * thousandths. */
static void test_reference_meets_the_slanted_rod(void **state)
{
    (void)state;
    double d = 5e-3, l = 4 * d, pi = acos(-1), k = log(0.4);
    double mass = d * d * l / 4 + d * d * d / 6; /* over pi and density, as is the inertia */
    double inertia =
        d * d * l * l * l / 48 + 3 * pow(d, 4) * l / 64 + pow(d, 5) / 60 + d * d * d * l * l / 24;
    double arm = 0.5 * l * sqrt(0.5), share = 1 + mass * arm * arm / inertia;
    double half_damping = -k * share, squared = (pi * pi + k * k) * share;
    double e = exp(-pi * half_damping / sqrt(squared - half_damping * half_damping));
    double angular_velocity = mass / share * (1 + e) * 0.1 * arm / inertia;
    /* the turning of 0.4 degrees: 1.5e-3 */
    assert_true(fabs(truth_of("oblique_smooth") / angular_velocity - 1) < 3e-3);
}

/* symplectic-euler's restitution depends on where in a step the hit begins: without phases, the
 * greatest error would be the mean one. */
static void test_phases_scatter(void **state)
{
    (void)state;
    OzReportPoint point = measured("normal_hit", OZ_INTEGRATOR_SYMPLECTIC_EULER, 20);
    /* an error spread evenly over the phases has sqrt(3) between them, less with an offset: 1.3 */
    assert_true(point.error_max > 1.1 * point.error_rms);
}

/* velocity-verlet is of second order: between 20 and 80 steps its error falls 16 times, but for the
 * edges of the phases. */
static void test_error_falls_with_the_step(void **state)
{
    (void)state;
    OzReportPoint coarse = measured("normal_hit", OZ_INTEGRATOR_VELOCITY_VERLET, 20);
    OzReportPoint fine = measured("normal_hit", OZ_INTEGRATOR_VELOCITY_VERLET, 80);
    assert_true(coarse.good && fine.good);
    assert_true(coarse.error_rms > 8 * fine.error_rms);
    /* of the restitution: some of (pi / 80)^2, 1.5e-3 */
    assert_true(fine.error_rms > 1e-4 && fine.error_rms < 3e-3);
    assert_true(fine.wall > 0 && fine.wall_low <= fine.wall && fine.wall <= fine.wall_high);
}

static void test_unstable_settings_say_why(void **state)
{
    (void)state;
    OzReportPoint point = measured("bounce", OZ_INTEGRATOR_EULER, 10);
    assert_false(point.good);
    assert_non_null(strstr(point.reason, "largest stable step"));
}

static OzReportPoint made_up(int steps, double wall, double error)
{
    return (OzReportPoint){.scene = "made_up",
                           .label = "",
                           .cycle = "contact",
                           .row = oz_report_cases_find("normal_hit"),
                           .steps = steps,
                           .step = 1e-3 / steps,
                           .error_rms = error,
                           .error_max = error,
                           .wall = wall,
                           .good = true};
}

static void test_front_cheapest_and_order(void **state)
{
    (void)state;
    OzReportPoint points[] = {made_up(10, 1, 0.1), made_up(20, 2, 0.025), made_up(40, 4, 0.00625),
                              made_up(30, 3, 0.05), made_up(80, 0.1, 1e-9)};
    points[3].integrator = OZ_INTEGRATOR_VELOCITY_VERLET;
    points[4].integrator = OZ_INTEGRATOR_VELOCITY_VERLET;
    points[4].good = false; /* would beat them all */
    oz_report_table_front(points, 5);
    assert_true(points[0].front && points[1].front && points[2].front);
    assert_false(points[3].front || points[4].front);
    assert_int_equal(20, oz_report_table_cheapest(points, 5, 0.03)->steps);
    assert_null(oz_report_table_cheapest(points, 5, 1e-3));
    /* a line through logarithms that lie on it: rounding */
    assert_true(fabs(oz_report_table_order(points, 5, &points[0]) - 2) < 1e-12);
    points[2].device = &device; /* another device is another curve: two points have no order */
    assert_true(isnan(oz_report_table_order(points, 5, &points[0])));
}

static void test_sentence_and_setting(void **state)
{
    (void)state;
    char *text = NULL;
    size_t size = 0;
    OzReportPoint point = made_up(20, 2, 0.025);
    point.label = "gpu";
    FILE *file = open_memstream(&text, &size);
    assert_non_null(file);
    oz_report_table_say(file, &point, 1, 0.03, true);
    fclose(file);
    assert_non_null(strstr(text, "for an error of 3 % in restitution use euler, float"));
    assert_non_null(strstr(text, "2 seconds per simulated second on gpu\n"));
    assert_non_null(strstr(text, "time:\n  step: 5e-05\nintegrator: euler\nprecision: float\n"));
    free(text);
}

/* A slanted rod that touches a plane with one end, 45 degrees steep: 1/m + arm^2/I in place of 1/m.
 */
static void test_an_end_is_stiffer_than_a_centre(void **state)
{
    (void)state;
    const char *text = "model: rods\ntime: {step: 1e-5, duration: 1}\n"
                       "contact: {contact_time: 1e-3, restitution: 0.5, friction: 0}\n"
                       "grains:\n  - {kind: single, diameter: 5e-3, aspect: 4, axis: [1, 0, 1],"
                       " position: [0, 0, 9.56e-3]}\nwalls:\n  - {kind: plane}\n";
    OzScene scene = {0};
    OzGrains grains = {0};
    OzSnapshot now = {0};
    OzStiffness bed;
    assert_int_equal(OZ_OK, oz_scene_parse(&scene, "bed", text, NULL, 0));
    assert_int_equal(OZ_OK, oz_insert_grains(&grains, &scene));
    assert_int_equal(OZ_OK, oz_snapshot_create(&now, &scene, &grains));
    memcpy(now.position, grains.position, 3 * sizeof(double));
    memcpy(now.quaternion, grains.quaternion, 4 * sizeof(double));
    oz_snapshot_turn_axes(&now);
    assert_int_equal(OZ_OK, oz_stiffness_measure(&bed, &now));
    double arm = 0.5 * grains.length[0] * sqrt(0.5);
    double share = 1 + grains.mass[0] * arm * arm / grains.inertia[0];
    OzContactConstants pair = oz_contact_constants(&scene.contact);
    assert_int_equal(1, bed.contacts);
    /* rounding alone: a single contact's swing is found in one iteration */
    assert_true(fabs(bed.stiffness / (share * pair.stiffness) - 1) < 1e-14);
    assert_true(fabs(bed.damping / (share * pair.damping) - 1) < 1e-14);
    oz_snapshot_free(&now);
    oz_grains_free(&grains);
    oz_scene_free(&scene);
}

/* A rod lying on its ends tilts 1 + m a^2 / I times as stiffly as it bounces: steps of 2.5e-4 s
 * carry one contact (up to 4.1e-4 s) and not the rod (up to 1.7e-4 s). Ledger, cylinder and a floor
 * that could move are those of the tiny bed below, whose kernels serve here. */
static void test_check_and_run_warn_of_the_bed(void **state)
{
    (void)state;
    char folder[] = "/tmp/orzo_test_report_XXXXXX", command[1024];
    assert_non_null(mkdtemp(folder));
    snprintf(command, sizeof command, "%s/rod.yaml", folder);
    FILE *file = fopen(command, "w");
    assert_non_null(file);
    fprintf(file, "model: rods\ntime: {step: 2.5e-4, duration: 1e-3}\n"
                  "integrator: velocity-verlet\n"
                  "contact: {contact_time: 1e-3, restitution: 0.5}\nobserve: {ledger: true}\n"
                  "walls:\n  - {kind: plane, motion: {frequency: 30, acceleration_ratio: 0}}\n"
                  "  - {kind: cylinder, diameter: 0.1}\n"
                  "grains:\n  - {kind: single, diameter: 5e-3, aspect: 4, axis: [1, 0, 0],"
                  " position: [0, 0, 2.4999e-3]}\n");
    fclose(file);
    snprintf(command, sizeof command,
             "'%s' check %s/rod.yaml | grep -q 'NO, it cannot come to rest'", ORZO_PROGRAM, folder);
    assert_int_equal(0, system(command));
    snprintf(command, sizeof command,
             "'%s' run %s/rod.yaml -o %s/out 2>&1 | grep -q 'warning: at this step'", ORZO_PROGRAM,
             folder, folder);
    assert_int_equal(0, system(command));
    snprintf(command, sizeof command,
             "'%s' run %s/rod.yaml -o %s/out --overwrite --set time.step=1e-4 2>&1 | "
             "grep 'contacts together' | grep -vq warning",
             ORZO_PROGRAM, folder, folder);
    assert_int_equal(0, system(command));
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    assert_int_equal(0, system(command));
}

static int count_lines(const char *path, const char *with)
{
    char line[1024];
    int count = 0;
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        count += strstr(line, with) != NULL;
    }
    fclose(file);
    return count;
}

/* The study itself, with a bed of a dozen grains: a row for each step, with numbers in it. */
static void test_ensemble_of_a_tiny_bed(void **state)
{
    (void)state;
    char folder[] = "/tmp/orzo_test_report_XXXXXX", command[1024], path[128];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/bed.yaml", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "model: rods\ntime: {step: 2e-5, taps: 2}\n"
                  "contact: {contact_time: 6e-4, restitution: 0.4, friction: 0.1}\n"
                  "grains:\n  - {kind: random, count: 12, diameter: 0.5e-3, aspect: 2}\n"
                  "walls:\n  - {kind: plane, motion: {frequency: 30, acceleration_ratio: 2}}\n"
                  "  - {kind: cylinder, diameter: 3e-3}\nsettle: {drag: 70, rest_time: 0.02}\n");
    fclose(file);
    snprintf(command, sizeof command,
             "'%s' report --ensemble %s --quick --seeds 1..2 --set integrator=velocity-verlet "
             "-o %s/out >%s/said 2>&1",
             ORZO_PROGRAM, path, folder, folder);
    assert_int_equal(0, system(command));
    snprintf(path, sizeof path, "%s/out/ensemble.csv", folder);
    assert_int_equal(3, count_lines(path, ",")); /* header, 20 and 40 steps */
    assert_int_equal(1, count_lines(path, "velocity-verlet,20,2,"));
    assert_int_equal(1, count_lines(path, "velocity-verlet,40,2,"));
    assert_int_equal(0, count_lines(path, ",,"));
    snprintf(path, sizeof path, "%s/out/ensemble.png", folder);
    assert_int_equal(system("command -v gnuplot >/dev/null") == 0, access(path, R_OK) == 0);
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    assert_int_equal(0, system(command));
}

/* Four planes instead of a cylinder: there is no density, and everything else is told all the same.
 */
static void test_ensemble_without_a_density(void **state)
{
    (void)state;
    char folder[] = "/tmp/orzo_test_report_XXXXXX", command[1024], path[128];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/box.yaml", folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "model: rods\ntime: {step: 2e-5, taps: 2}\n"
                  "contact: {contact_time: 6e-4, restitution: 0.4, friction: 0.1}\n"
                  "grains:\n  - {kind: random, count: 12, diameter: 0.5e-3, aspect: 2}\n"
                  "walls:\n  - {kind: plane, motion: {frequency: 30, acceleration_ratio: 2}}\n"
                  "  - {kind: plane, point: [-1.5e-3, 0, 0], normal: [1, 0, 0]}\n"
                  "  - {kind: plane, point: [1.5e-3, 0, 0], normal: [-1, 0, 0]}\n"
                  "  - {kind: plane, point: [0, -1.5e-3, 0], normal: [0, 1, 0]}\n"
                  "  - {kind: plane, point: [0, 1.5e-3, 0], normal: [0, -1, 0]}\n"
                  "settle: {drag: 70, rest_time: 0.02}\n");
    fclose(file);
    snprintf(command, sizeof command,
             "'%s' report --ensemble %s --quick --seeds 1..2 --set integrator=velocity-verlet "
             "-o %s/out >%s/said 2>&1",
             ORZO_PROGRAM, path, folder, folder);
    assert_int_equal(0, system(command));
    snprintf(path, sizeof path, "%s/said", folder);
    assert_int_equal(1,
                     count_lines(path, "density is left out: this scene has no density_tap_mean"));
    assert_int_equal(0, count_lines(path, "angle is left out"));
    snprintf(path, sizeof path, "%s/out/ensemble.csv", folder);
    assert_int_equal(3, count_lines(path, ","));
    assert_int_equal(0, count_lines(path, "density"));
    assert_int_equal(1,
                     count_lines(path, ",angle_mean,angle_spread,angle_ci95,contacts_per_grain"));
    assert_int_equal(0, count_lines(path, ",,"));
    assert_int_equal(0, count_lines(path, "nan"));
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    assert_int_equal(0, system(command));
}

/* Means over the later half: rows of tap 2 and later. */
static void test_a_member_counts_its_later_half(void **state)
{
    (void)state;
    char path[] = "/tmp/orzo_test_report_XXXXXX";
    double values[OZ_MEMBER_QUANTITIES], lift;
    OzScene scene = {0};
    OzGrains grains = {0};
    const char *text = "model: rods\ntime: {step: 1e-5, duration: 1}\n"
                       "contact: {contact_time: 1e-3, restitution: 0.5}\ngrains:\n"
                       "  - {kind: lattice, diameter: 5e-3, cells: [2, 1, 1], spacing: [1, 1, 1],"
                       " position: [0, 0, 0]}\n";
    FILE *file = fdopen(mkstemp(path), "w");
    assert_non_null(file);
    fprintf(file, "step,tap,density_tap_mean,angle_tap_mean,contact_count,work_walls\n"
                  "0,0,0.9,80,9,7\n1,2,0.5,20,3,10\n2,4,0.6,30,5,16\n");
    fclose(file);
    assert_int_equal(OZ_OK, oz_scene_parse(&scene, "two", text, NULL, 0));
    assert_int_equal(OZ_OK, oz_insert_grains(&grains, &scene));
    assert_int_equal(OZ_OK, oz_report_member_read(values, path, &scene, &grains));
    lift = 2 * grains.mass[0] * 9.81 * 5e-3;
    const double expected[] = {0.55, 25, 4, 3 / lift};
    for (int q = 0; q < OZ_MEMBER_QUANTITIES; q++) {
        assert_true(fabs(values[q] / expected[q] - 1) < 1e-12); /* rounding of a few sums */
    }
    OzEnsemblePoint point = {.members = 2, .value = {{1, 3}}};
    OzMoments moments = oz_report_ensemble_table_moments(&point, 0);
    /* rounding of two numbers */
    assert_true(fabs(moments.mean - 2) < 1e-12 && fabs(moments.spread - sqrt(2)) < 1e-12);
    assert_true(fabs(moments.interval - 12.706) < 1e-3); /* t of one degree, times 1 */
    unlink(path);
    oz_grains_free(&grains);
    oz_scene_free(&scene);
}

static OzMapVerdict verdict_at(OzIntegrator integrator, double steps, double restitution)
{
    OzMapVerdict verdict = OZ_MAP_EXPLODED;
    double amplitude = NAN;
    assert_int_equal(OZ_OK,
                     oz_report_map_try(&verdict, &amplitude, integrator, steps, restitution));
    return verdict;
}

/* Theory: explicit Euler needs 22 steps at 0.8 and 5.8 at 0.4; symplectic Euler 4.7 at 0.02. */
static void test_the_map_meets_theory(void **state)
{
    (void)state;
    assert_int_equal(OZ_MAP_STABLE, verdict_at(OZ_INTEGRATOR_EULER, 26, 0.8));
    assert_int_not_equal(OZ_MAP_STABLE, verdict_at(OZ_INTEGRATOR_EULER, 18, 0.8));
    assert_int_equal(OZ_MAP_EXPLODED, verdict_at(OZ_INTEGRATOR_EULER, 6, 0.8));
    assert_int_equal(OZ_MAP_STABLE, verdict_at(OZ_INTEGRATOR_EULER, 7, 0.4));
    assert_int_equal(OZ_MAP_STABLE, verdict_at(OZ_INTEGRATOR_SYMPLECTIC_EULER, 6, 0.02));
    assert_int_not_equal(OZ_MAP_STABLE, verdict_at(OZ_INTEGRATOR_SYMPLECTIC_EULER, 3, 0.02));
    assert_int_not_equal(OZ_MAP_STABLE, verdict_at(OZ_INTEGRATOR_VELOCITY_VERLET, 5, 0.02));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_case_has_its_scene),
        cmocka_unit_test(test_reference_meets_the_rigid_sphere),
        cmocka_unit_test(test_reference_meets_the_bouncing_sphere),
        cmocka_unit_test(test_reference_meets_the_slanted_rod),
        cmocka_unit_test(test_phases_scatter),
        cmocka_unit_test(test_error_falls_with_the_step),
        cmocka_unit_test(test_unstable_settings_say_why),
        cmocka_unit_test(test_front_cheapest_and_order),
        cmocka_unit_test(test_sentence_and_setting),
        cmocka_unit_test(test_an_end_is_stiffer_than_a_centre),
        cmocka_unit_test(test_check_and_run_warn_of_the_bed),
        cmocka_unit_test(test_ensemble_of_a_tiny_bed),
        cmocka_unit_test(test_ensemble_without_a_density),
        cmocka_unit_test(test_a_member_counts_its_later_half),
        cmocka_unit_test(test_the_map_meets_theory),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
