/* `phases:` as its users see it: what changes at a phase's first step, what is told of it, and that
 * a stop between or in phases leaves no trace. ORZO_NEEDS_DEVICE. */
#include "program.h"

#include <math.h>

/* Thrown up, weightless from 0.03 s on, and under half its weight upwards from 0.06 s on. */
static const char ball[] = "model: rods\n"
                           "precision: double\n"
                           "time: {step: 1e-5, duration: 0.09}\n"
                           "contact: {contact_time: 1e-3, restitution: 0.5}\n"
                           "grains: [{kind: single, diameter: 1e-3, position: [0, 0, 0.1]}]\n"
                           "walls: [{kind: plane}]\n"
                           "observe: {interval: 0.03}\n"
                           "checkpoint: {every: 0}\n";

static const char phases[] =
    "phases:\n"
    "  - {name: fall, time: 0.03}\n"
    "  - {name: float, time: 0.03, set: gravity.2=0; contact.friction=0.1}\n"
    "  - {set: \"gravity=[0, 0, 4.905]\"}\n";

static int begin(void **state)
{
    int status = enter_work(state);
    write_file("plain.yaml", "%s", ball);
    write_file("ball.yaml", "%s%s", ball, phases);
    return status;
}

/* The columns of series.csv's row: time, phase, and the height, which is that of the potential. */
static void read_row(const char *folder, int row, double *time, double *phase)
{
    char path[64], *line, *rest;
    snprintf(path, sizeof path, "%s/series.csv", folder);
    char *all = read_file(path, NULL);
    rest = all;
    for (line = strsep(&rest, "\n"); row > 0; row--) {
        line = strsep(&rest, "\n");
    }
    assert_int_equal(sscanf(line, "%*d,%lf,,%lf,", time, phase), 2);
    free(all);
}

static double height(const char *folder)
{
    char path[64];
    double z = NAN;
    snprintf(path, sizeof path, "%s/final.csv", folder);
    char *all = read_file(path, NULL), *row = strchr(all, '\n');
    assert_non_null(row);
    assert_int_equal(sscanf(row + 1, "%*[^,],%*[^,],%*[^,],%lf", &z), 1);
    free(all);
    return z;
}

static void falls_floats_and_rises(void **state)
{
    (void)state;
    double time, phase, g = 9.81, t = 0.03, v = g * t;
    expect(0, "phase 2, float, begins at step 3000", "run ball.yaml -o ball");
    assert_true(contains("said", "gravity [0, 0, -9.81] -> [0, 0, 0]"));
    for (int row = 1; row <= 4; row++) {
        read_row("ball", row, &time, &phase);
        assert_int_equal((int)phase, row < 4 ? row : 3); /* at its first step a phase has begun */
    }
    double z = 0.1 - g * t * t / 2 - v * t - v * t + g / 2 * t * t / 2;
    /* symplectic Euler is behind the parabola by g t dt/2 in each phase, 1.5e-6 in the first */
    assert_true(fabs(height("ball") - z) < 3e-6);
}

/* The same changes by hand: those of a run that is repeated, which has no phases. */
static void is_a_run_changed_by_hand(void **state)
{
    (void)state;
    expect(0, "", "run ball.yaml -o ball --overwrite");
    expect(0, "", "run plain.yaml -o plain");
    write_file("plain/reloads.csv", "step,time,key,old,new,rebuild_seconds\n"
                                    "3000,0.03,gravity,\"[0, 0, -9.81]\",\"[0, 0, 0]\",0\n"
                                    "3000,0.03,contact.friction,0.3,0.1,0\n"
                                    "6000,0.06,gravity,\"[0, 0, 0]\",\"[0, 0, 4.905]\",0\n"
                                    "9000,0.09,end,,done,0\n");
    expect(0, "", "run plain --replay -o hand");
    assert_true(same_files("ball/final.csv", "hand/final.csv"));
    assert_false(same_files("ball/final.csv", "plain/final.csv"));
    expect(0, "", "run ball --replay -o again");
    assert_true(same_files("ball/series.csv", "again/series.csv"));
}

static void a_stop_leaves_no_trace(void **state)
{
    (void)state;
    static const char *const ends[] = {"0.03", "0.04", "0.06", "0.07"};
    char command[128];
    expect(0, "", "run ball.yaml -o ball --overwrite");
    for (int i = 0; i < 4; i++) {
        snprintf(command, sizeof command,
                 "run ball.yaml -o left --overwrite --set checkpoint.every=60 --until %s", ends[i]);
        expect(0, "", command);
        expect(0, "", "resume left --until 0.09");
        assert_true(same_files("ball/series.csv", "left/series.csv"));
        assert_true(same_files("ball/final.csv", "left/final.csv"));
        assert_true(same_files("ball/reloads.csv", "left/reloads.csv"));
    }
    expect(2, "has phases, which change it at their times", "resume left --set gravity.2=0");
}

/* Cycles are the same list, written out; of later ones the log says nothing. */
static void cycles_repeat_the_phases(void **state)
{
    (void)state;
    double time, phase;
    const char *fall = "{time: 0.02, set: gravity.2=-9}", *rest = "{time: 0.01, set: gravity.2=0}";
    write_file("cycles.yaml", "%scycles: 3\nphases: [%s, %s]\n", ball, fall, rest);
    write_file("list.yaml", "%sphases: [%s, %s, %s, %s, %s, %s]\n", ball, fall, rest, fall, rest,
               fall, rest);
    expect(0, "phase 2, begins at step 2000",
           "run cycles.yaml -o cycles --set observe.interval=0.01");
    assert_false(contains("said", "begins at step 3000"));
    expect(0, "begins at step 3000", "run list.yaml -o list --set observe.interval=0.01");
    assert_true(same_files("cycles/final.csv", "list/final.csv"));
    for (int row = 1; row <= 10; row++) {
        read_row("cycles", row, &time, &phase);
        assert_int_equal((int)phase, row == 10 || row % 3 == 0 ? 2 : 1);
    }
    expect(0, "", "run cycles.yaml -o left --overwrite --set checkpoint.every=60 --until 0.05");
    expect(0, "", "resume left --until 0.09");
    assert_true(same_files("cycles/final.csv", "left/final.csv"));
    assert_true(same_files("cycles/reloads.csv", "left/reloads.csv"));
    expect(0, "cycles             3 of 0.03 s", "check cycles.yaml");
    expect(0, "phase 2, float, begins at step 3000",
           "run ball.yaml -o endless --set time.duration=endless --until 0.09");
    assert_true(same_files("endless/final.csv", "ball/final.csv"));
    read_row("endless", 4, &time, &phase);
    assert_int_equal((int)phase, 3);
    expect(2, "cycles without phases", "check plain.yaml --set cycles=2");
    expect(2, "phases.1 has no length", "check cycles.yaml --set 'phases.1={set: gravity.2=0}'");
}

/* The floor is shaken for one period, which ends between two steps, and stands for two: a ball that
 * lies on it moves with it, and has come to rest 2.5 ms after. */
static void a_tap_is_one_period(void **state)
{
    (void)state;
    write_file("tap.yaml",
               "model: rods\nprecision: double\ntime: {step: 7.5e-6, duration: 0.18}\n"
               "contact: {contact_time: 1e-3, restitution: 0.3}\n"
               "grains: [{kind: single, diameter: 1e-3, position: [0, 0, 0.5e-3]}]\n"
               "walls: [{kind: plane, motion: {frequency: 50, acceleration_ratio: 0.2}}]\n"
               "observe: {interval: 2.5e-3}\ncheckpoint: {every: 0}\ncycles: 3\n"
               "phases: [{taps: 1, set: walls.0.motion.acceleration_ratio=0.2},\n"
               "         {taps: 2, set: walls.0.motion.acceleration_ratio=0}]\n");
    expect(0, "", "run tap.yaml -o tap");
    char name[] = "speed_max", *all = read_file("tap/series.csv", NULL), *rest = all;
    char *head = strsep(&rest, "\n"), *column = strstr(head, name);
    int before = 0;
    assert_non_null(column);
    for (char *at = head; at < column; at++) {
        before += *at == ',';
    }
    double fastest = 0.2 * 9.81 / (2 * 3.14159265358979 * 50);
    for (int row = 0; row <= 72; row++) {
        char *line = strsep(&rest, "\n"), *cell = NULL;
        for (int k = 0; k <= before; k++) {
            cell = strsep(&line, ",");
        }
        double speed = strtod(cell, NULL);
        int in_cycle = row % 24; /* 8 rows a period */
        bool is_fast = in_cycle == 1 || in_cycle == 3 || in_cycle == 4 || in_cycle == 5;
        assert_true(!is_fast || speed > 0.5 * fastest);
        assert_true(in_cycle < 9 || speed < 0.02 * fastest);
    }
    free(all);
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    expect(2,
           "ball.yaml:11: phases.1.set: --set contact.frction=3: unknown key contact.frction; "
           "did you mean contact.friction?",
           "check ball.yaml --set phases.1.set=contact.frction=3");
    expect(2, "phases.2.set: --set seed=2: seed runs with 1, which cannot change",
           "run ball.yaml -o no --set phases.2.set=seed=2");
    assert_false(is_there("no"));
    expect(2, "phases.1.set: ball.yaml: time.step 1e-05 s is unstable",
           "run ball.yaml -o no --set phases.1.set=contact.contact_time=1e-5");
    expect(2, "expected time instead of taps",
           "check ball.yaml --set 'walls.0.motion={frequency: 500, amplitude: 1e-5}' "
           "--set 'phases=[{taps: 5}, {taps: 5, set: walls.0.motion.frequency=200}]'");
    expect(2, "phases.0.taps without a wall that is shaken; expected time",
           "check ball.yaml --set 'phases=[{taps: 2}]'");
    expect(2, "phases.0 has no length, and another phase follows",
           "check ball.yaml --set 'phases=[{name: a}, {time: 0.01}]'");
    expect(2, "the phases last 0.13 s together, the run 0.09 s",
           "check ball.yaml --set phases.0.time=0.1");
    expect(2, "--watch of a scene with phases", "run ball.yaml -o no --watch");
    expect(0, "phase 2            float, 0.03 ... 0.06 s: gravity.2=0; contact.friction=0.1",
           "check ball.yaml");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(falls_floats_and_rises), cmocka_unit_test(is_a_run_changed_by_hand),
        cmocka_unit_test(a_stop_leaves_no_trace), cmocka_unit_test(cycles_repeat_the_phases),
        cmocka_unit_test(a_tap_is_one_period),    cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, begin, leave_work);
}
