/* Walls that follow a measured trace: against the shaking it was sampled from, closed forms of its
 * joints, bad files, and a run that is left. ORZO_NEEDS_DEVICE. */
#include "program.h"
#include "run_bed.h"

#include "model/motion.h"
#include "scene/trace.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

/* A scene with a plane whose motion is written so, and a file of its own. */
static OzScene scene_of(const char *motion)
{
    OzScene scene;
    char text[1024];
    snprintf(text, sizeof text,
             "model: rods\ntime: {step: 1e-5, duration: 1}\n"
             "contact: {contact_time: 1e-3, restitution: 0.5}\ngrains: []\n"
             "walls: [{kind: plane, motion: {%s}}]\n",
             motion);
    if (oz_scene_parse(&scene, "small.yaml", text, NULL, 0) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    return scene;
}

enum { PERIODS = 5 };

/* amplitude x sin(2 pi 10 t), or what it accelerates with, at so many rows a period, from 3 s on.
 */
static void write_sine(const char *name, int rows, bool accelerations)
{
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fprintf(file, "time, level\n");
    for (int i = 0; i <= PERIODS * rows; i++) {
        double value = 2e-3 * sin(2 * PI * i / rows);
        value *= accelerations ? -pow(2 * PI * 10, 2) : 1;
        fprintf(file, "%.17g, %.17g\n", 3 + 0.1 * i / rows, value);
    }
    assert_int_equal(fclose(file), 0);
}

/* The greatest differences from the built-in shaking, as shares of amplitude and greatest speed. */
static void compare(int rows, bool accelerations, double far[2])
{
    write_sine("sine.csv", rows, accelerations);
    OzScene shaken = scene_of("frequency: 10, amplitude: 2e-3");
    OzScene traced = scene_of(accelerations ? "file: sine.csv, measured: acceleration, closed: true"
                                            : "file: sine.csv");
    far[0] = far[1] = 0;
    for (int i = 0; i < 20000; i++) {
        double a[2], b[2], time = 0.1 * PERIODS * i / 20000;
        oz_motion_offset(&shaken.walls[0].motion, time, &a[0], &a[1]);
        oz_motion_offset(&traced.walls[0].motion, time, &b[0], &b[1]);
        far[0] = fmax(far[0], fabs(a[0] - b[0]) / 2e-3);
        far[1] = fmax(far[1], fabs(a[1] - b[1]) / (2e-3 * 2 * PI * 10));
    }
    const OzTrace *trace = traced.walls[0].motion.trace;
    /* a sine's root mean square is 1/sqrt(2) of its greatest value, to the joints' error */
    assert_true(fabs(trace->offset_rms / 2e-3 * sqrt(2) - 1) < 2 * far[0] + 1e-12);
    assert_true(fabs(trace->speed / (2e-3 * 2 * PI * 10) - 1) < far[1] + 1e-12);
    assert_true(fabs(oz_motion_reach(&traced.walls[0].motion) / 2e-3 - 1) < 2 * far[0] + 2e-4);
    oz_scene_free(&shaken);
    oz_scene_free(&traced);
}

/* Splines through h apart are off by 5/384 h^4 of the fourth derivative at most inside (Hall &
 * Meyer 1976), some more at the ends; h is 2 pi / rows of the phase. Velocities are of third order.
 * Straight lines of acceleration are off by h^2/8 of themselves, which adds up to h^2/12 of the
 * way. */
static void test_a_sampled_sine_is_the_built_in_shaking(void **state)
{
    (void)state;
    double coarse[2], fine[2];
    compare(20, false, coarse);
    compare(40, false, fine);
    double h = 2 * PI / 40;
    assert_true(fine[0] < 4 * 5.0 / 384 * pow(h, 4) && fine[1] < pow(h, 3) / 3);
    /* sixteen and eight times; the ends are of that order as well */
    assert_true(coarse[0] / fine[0] > 11 && coarse[0] / fine[0] < 40);
    assert_true(coarse[1] / fine[1] > 6 && coarse[1] / fine[1] < 20);
    compare(20, true, coarse);
    compare(40, true, fine);
    assert_true(fine[0] < h * h / 11 && coarse[0] / fine[0] > 3.9 && coarse[0] / fine[0] < 4.1);
    assert_true(fine[1] < h * h / 11 && coarse[1] / fine[1] > 3.9 && coarse[1] / fine[1] < 4.1);
}

/* Rows of a cubic at any distances give the cubic back; of a parabola three rows do, of a straight
 * line two. Before and behind the wall rests; it is scaled where a factor says so, and stops. */
static void test_polynomials(void **state)
{
    (void)state;
    static const double times[] = {0, 0.1, 0.17, 0.4, 0.55, 0.6};
    for (int degree = 1; degree <= 3; degree++) {
        int rows = degree == 3 ? 6 : degree + 1;
        FILE *file = fopen("cubic.csv", "w");
        assert_non_null(file);
        fprintf(file, "\"level\",other,\"time\"\r\n");
        for (int i = 0; i < rows; i++) {
            double t = times[i];
            fprintf(file, "%.17g,x,%.17g\r\n\n", -1e3 * (7 + t + pow(t, degree)), t);
        }
        assert_int_equal(fclose(file), 0);
        OzScene scene =
            scene_of("file: cubic.csv, column: level, scale: -1e-3, from: 0.25, until: 0.8");
        const OzMotion *motion = &scene.walls[0].motion;
        double offset, velocity, end = fmin(times[rows - 1], 0.55);
        for (double t = 0; t < end; t += 0.013) {
            oz_motion_offset(motion, 0.25 + t, &offset, &velocity);
            /* rounding of 7e3, whose third differences over 0.05 s are looked at */
            assert_true(fabs(offset - (t + pow(t, degree))) < 1e-12);
            assert_true(fabs(velocity - (1 + degree * pow(t, degree - 1))) < 1e-10);
        }
        oz_motion_offset(motion, 0.2, &offset, &velocity);
        assert_true(offset == 0 && velocity == 0);
        oz_motion_offset(motion, 2, &offset, &velocity);
        assert_true(fabs(offset - (end + pow(end, degree))) < 1e-12 && velocity == 0);
        oz_scene_free(&scene);
    }
}

/* Steady accelerations add up to a parabola, which begins at rest or, closed, ends where it began.
 */
static void test_steady_accelerations(void **state)
{
    (void)state;
    write_file("steady.csv", "time,a\n1,0.5\n1.1,0.5\n1.4,0.5\n");
    OzScene scene = scene_of("file: steady.csv, measured: acceleration, closed: true");
    OzScene from_rest = scene_of("file: steady.csv, measured: acceleration");
    const OzTrace *trace = scene.walls[0].motion.trace;
    for (double t = 0; t < 0.4; t += 0.03) {
        double offset, velocity;
        oz_motion_offset(&scene.walls[0].motion, t, &offset, &velocity);
        assert_true(fabs(offset - 0.25 * t * (t - 0.4)) < 1e-15);
        assert_true(fabs(velocity - 0.5 * (t - 0.2)) < 1e-15);
        oz_motion_offset(&from_rest.walls[0].motion, t, &offset, &velocity);
        assert_true(fabs(offset - 0.25 * t * t) < 1e-15 && fabs(velocity - 0.5 * t) < 1e-15);
    }
    assert_true(fabs(trace->acceleration_mean - 0.5) < 1e-12 && trace->acceleration_rms < 1e-6);
    assert_true(fabs(trace->reach - 0.25 * 0.04) < 1e-4 && fabs(trace->speed - 0.1) < 1e-12);
    oz_scene_free(&from_rest);
    oz_scene_free(&scene);
}

static const struct {
    const char *text, *motion, *message;
} refused[] = {
    /* motion: beside the file, or after a ! without one */
    {"", "", "bad.csv:0: an empty file; expected a line of names, then rows of numbers"},
    {"time\n0\n1\n", "", "bad.csv:1: 1 columns (time); expected motion.column to name one of them"},
    {"time,a,b\n", "",
     "bad.csv:1: 3 columns (time, a, b); expected motion.column to name one of "
     "them"},
    {"time,a,b\n", "column: c",
     "bad.csv:1: no column c (time, a, b); expected motion.column to name one beside the time"},
    {"time,a\n0,1\n\n1,x\n", "", "bad.csv:4: the value is x; expected a number"},
    {"time,a\n0,1\n1\n", "", "bad.csv:3: the value is missing; expected a number"},
    {"time,a\n0,1\nnan,2\n", "", "bad.csv:3: the time is nan; expected a number"},
    {"time,a\n0,1\n0,2\n", "",
     "bad.csv:3: the time is 0 s after 0 s; expected times that increase"},
    {"time,a\n0,1\n", "", "bad.csv:2: a trace of 1 rows; expected two or more"},
    {"time,a\n0,1\n1,2\n", "!frequency: 3, amplitude: 1, scale: 2",
     "small.yaml:5: a wall without a trace has a motion.scale; expected motion.file with it"},
    {"time,a\n0,1\n1,2\n", "frequency: 3, amplitude: 1",
     "small.yaml:5: a wall that is shaken or has a velocity follows a trace, too; expected one of "
     "them"},
};

static void test_bad_files(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof refused / sizeof *refused; k++) {
        char text[512];
        OzScene scene;
        write_file("bad.csv", "%s", refused[k].text);
        snprintf(text, sizeof text,
                 "model: rods\ntime: {step: 1e-5, duration: 1}\n"
                 "contact: {contact_time: 1e-3, restitution: 0.5}\ngrains: []\n"
                 "walls: [{kind: plane, motion: {%s%s}}]\n",
                 refused[k].motion[0] == '!' ? "" : "file: bad.csv, ",
                 refused[k].motion + (refused[k].motion[0] == '!'));
        assert_int_equal(oz_scene_parse(&scene, "small.yaml", text, NULL, 0), OZ_ERR_INPUT);
        const char *said = oz_status_text(), *name = strstr(said, "bad.csv:");
        if (strcmp(name ? name : said, refused[k].message) != 0) {
            fail_msg("%s\nis not\n%s", said, refused[k].message);
        }
    }
}

/* A run on a traced floor is the same to the byte after a stop, `check` and the log say its rms,
 * and another trace under the same name is refused. */
static void test_a_run_that_is_left(void **state)
{
    (void)state;
    FILE *file = fopen("level.csv", "w");
    assert_non_null(file);
    fprintf(file, "time,level\n");
    for (int i = 0; i <= 100; i++) {
        fprintf(file, "%.9g,%.9g\n", 1e-3 * i, 0.1 * sin(0.3 * i) + 0.05 * sin(0.71 * i));
    }
    assert_int_equal(fclose(file), 0);
    write_file("bed.yaml", "%s", bed);
    write_file("traced.yaml",
               "extends: bed.yaml\ntime: {duration: 0.04}\nobserve: {interval: 2e-3}\nwalls:\n"
               "  - {kind: plane, motion: {file: level.csv, scale: 1e-3, from: 4e-3}}\n"
               "  - {kind: cylinder, diameter: 8e-3}\n");
    expect(0,
           "wall 0 follows   the offset of level.csv: 101 rows in 0.1 s; rms of offset 7.889e-05 m",
           "check traced.yaml");
    expect(0, "rms of offset 7.889e-05 m", "run traced.yaml -o straight --no-video");
    expect(0, "", "run traced.yaml -o left --no-video --until 0.0213");
    expect(0, "goes on", "resume left");
    assert_true(same_files("straight/series.csv", "left/series.csv"));
    assert_true(same_files("straight/final.csv", "left/final.csv"));
    expect(0, "", "run traced.yaml -o other --no-video --until 0.0213");
    write_file("level.csv", "time,level\n0,0\n0.01,0.1\n");
    expect(2, "holds another trace than the run was begun with", "resume other");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_sampled_sine_is_the_built_in_shaking),
        cmocka_unit_test(test_polynomials),
        cmocka_unit_test(test_steady_accelerations),
        cmocka_unit_test(test_bad_files),
        cmocka_unit_test(test_a_run_that_is_left),
    };
    return cmocka_run_group_tests(tests, enter_work, leave_work);
}
