/* `orzo figures`: a study is run where it is missing, gone on with where it was stopped, and drawn
 * from its own table; what is wrong with it is said at once. ORZO_NEEDS_DEVICE. */
#include "program.h"

#include <math.h>

static const char scene[] = "model: rods\n"
                            "time: {step: 1e-4, duration: 0.1}\n"
                            "contact: {contact_time: 5e-3, restitution: 0.5}\n"
                            "grains: [{kind: random, count: 2, diameter: 1e-3}]\n"
                            "walls: [{kind: plane}]\n"
                            "observe: {interval: 0.02}\n";

static const char study[] =
    "name: tiny\n"
    "quick: {seeds: 2, set: [time.duration=0.04]}\n"
    "runs:\n"
    "  - {name: a, scene: scene.yaml, seeds: [3, 5]}\n"
    "  - {name: b, scene: scene.yaml, seeds: [3, 3], set: [contact.restitution=0.6], label: "
    "lively}\n"
    "figures:\n"
    "  - {name: energies, kind: curves, runs: [a, b], columns: [kinetic, kinetic+rotational],\n"
    "     against: time, panels: runs, labels: [kinetic, both], title: Energies}\n"
    "  - {name: second, kind: curves, runs: [b], columns: [speed_max], against: time}\n";

static int begin(void **state)
{
    int status = enter_work(state);
    write_file("scene.yaml", "%s", scene);
    write_file("study.yaml", "%s", study);
    return status;
}

/* A cell of a table, by the name of its column; row 0 is the first below the names. */
static double cell(const char *file, int row, const char *column)
{
    char *text = read_file(file, NULL), names[4200], cells[4200];
    snprintf(names, sizeof names, ",%.4100s,", line_of(text, 0));
    snprintf(cells, sizeof cells, "%s", line_of(text, row + 1));
    char wanted[128], *at = cells;
    snprintf(wanted, sizeof wanted, ",%s,", column);
    char *found = strstr(names, wanted);
    assert_non_null(found);
    for (char *c = names + 1; c <= found; c++) {
        if (*c == ',') {
            at = strchr(at, ',') + 1;
        }
    }
    double value = strtod(at, NULL);
    free(text);
    return value;
}

/* The table holds what the members' own tables give: their mean and their standard deviation, to
 * the nine digits that tables have. */
static void a_study_is_run_and_drawn(void **state)
{
    (void)state;
    const int row = 4; /* of a run's series */
    double of[3], mean = 0, square = 0;
    expect(0, "energies: a: seeds 3 to 5, 1000 steps; b: seed 3, 1000 steps", "figures study.yaml");
    for (int i = 0; i < 3; i++) {
        char file[64];
        snprintf(file, sizeof file, "runs/tiny/a/seed_0000%d/series.csv", i + 3);
        of[i] = cell(file, row, "kinetic");
        mean += of[i] / 3;
    }
    for (int i = 0; i < 3; i++) {
        square += (of[i] - mean) * (of[i] - mean) / 2;
    }
    assert_true(mean > 0 && square > 0);
    const char *table = "runs/tiny/energies.csv";
    assert_true(fabs(cell(table, row, "kinetic") - mean) < 2e-8 * mean);
    assert_true(fabs(cell(table, row, "kinetic_spread") - sqrt(square)) < 2e-8 * mean);
    assert_true(fabs(cell(table, row, "time") - 0.08) < 1e-9);
    double both = cell("runs/tiny/b/seed_00003/series.csv", row, "kinetic") +
                  cell("runs/tiny/b/seed_00003/series.csv", row, "rotational");
    assert_true(fabs(cell(table, 6 + row, "kinetic+rotational") - both) < 2e-8 * both);
    assert_true(contains("runs/tiny/energies.svg", "lively") &&
                contains("runs/tiny/energies.svg", "seeds 3 to 5"));
    char *png = read_file("runs/tiny/energies.png", NULL);
    assert_memory_equal(png, "\x89PNG", 4);
    free(png);
    assert_true(is_there("runs/tiny/energies.pdf") && is_there("runs/tiny/second.png"));
}

static void what_has_ended_is_not_run_again(void **state)
{
    (void)state;
    expect(0, "second.png", "figures study.yaml --only second");
    assert_false(contains("said", "device:"));
    assert_false(contains("said", "energies"));
    expect(2, "expected one of energies, second", "figures study.yaml --only third");
}

/* A run that ended before the study's end goes on, and comes to the same table. */
static void what_was_stopped_goes_on(void **state)
{
    (void)state;
    expect(0, "", "run scene.yaml -o part/a --seeds 3..5 --no-video --until 0.04");
    expect(0, "from its last state", "figures study.yaml -o part");
    assert_true(same_files("part/energies.csv", "runs/tiny/energies.csv"));
}

static void quick_is_shorter_and_of_fewer_seeds(void **state)
{
    (void)state;
    expect(0, "energies: a: seeds 3 to 4, 400 steps", "figures study.yaml --quick");
    assert_int_equal(count_lines("runs/tiny_quick/energies.csv"), 1 + 2 * 3);
}

/* No wall moves, so that there are no taps; without a cylinder there is no density. */
static void what_has_no_points_is_said(void **state)
{
    (void)state;
    write_file("empty.yaml", "%s",
               "name: tiny\n"
               "runs:\n"
               "  - {name: b, scene: scene.yaml, seeds: [3, 3], set: [contact.restitution=0.6]}\n"
               "figures:\n"
               "  - {name: taps, kind: curves, runs: [b], columns: [kinetic], against: tap}\n"
               "  - {name: none, kind: curves, runs: [b], columns: [density], against: time}\n");
    expect(2, "runs/tiny/b has no tap", "figures empty.yaml --only taps");
    expect(2, "column density is empty", "figures empty.yaml --only none");
    assert_false(is_there("runs/tiny/none.png"));
}

static void another_run_is_refused(void **state)
{
    (void)state;
    expect(0, "", "run scene.yaml -o other/a --seeds 3..5 --no-video --set contact.friction=0.25");
    expect(2, "other/a holds another run (`  friction: 0.25`)", "figures study.yaml -o other");
    assert_true(is_there("other/second.png")); /* which needs none of it */
    expect(0, "", "run scene.yaml -o fewer/a --seeds 3..4 --no-video");
    expect(2, "fewer/a holds seeds 3 to 4; expected 3 to 5", "figures study.yaml -o fewer");
    assert_int_equal(mkdir("mine", 0777), 0);
    write_file("mine/second.svg", "a user's own\n");
    expect(2, "second.svg", "figures study.yaml -o mine --only second");
    assert_true(contains("mine/second.svg", "a user's own"));
}

static void a_signal_says_how_to_go_on(void **state)
{
    (void)state;
    write_file(
        "long.yaml", "%s",
        "name: long\n"
        "runs: [{name: a, scene: scene.yaml, set: [time.duration=1e5]}]\n"
        "figures: [{name: one, kind: curves, runs: [a], columns: [kinetic], against: time}]\n");
    pid_t child = start_orzo("figures long.yaml -o long");
    for (double end = now_seconds() + 60; now_seconds() < end;) {
        if (is_there("long/a/seed_00001/series.csv") &&
            count_lines("long/a/seed_00001/series.csv") > 2) {
            break;
        }
        sleep_a_little();
    }
    kill(child, SIGINT);
    assert_int_equal(wait_for(child, 60), 130);
    assert_true(contains("said", "to go on: orzo figures long.yaml -o long"));
    assert_false(is_there("long/one.png"));
}

/* Pixels across and down of a PNG, from its first block. */
static void size_of(const char *name, int size[2])
{
    unsigned char *bytes = (unsigned char *)read_file(name, NULL);
    for (int i = 0; i < 2; i++) {
        const unsigned char *at = bytes + 16 + 4 * i;
        size[i] = at[0] << 24 | at[1] << 16 | at[2] << 8 | at[3];
    }
    free(bytes);
}

/* A row for each run and view, a column for each moment that the run came to. */
static void pictures_stand_in_a_sheet(void **state)
{
    (void)state;
    int one[2], two[2];
    write_file(
        "pictures.yaml", "%s",
        "name: seen\n"
        "runs: [{name: a, scene: scene.yaml, set: ['snapshots={times: [0, 0.06, 0.1]}']}]\n"
        "figures:\n"
        "  - {name: sheet, kind: pictures, runs: [a], at: [0, 0.06, 7], size: [200, 160],\n"
        "     views: [lateral, cut]}\n"
        "  - {name: fast, kind: pictures, runs: [a], at_greatest: time, size: [200, 160]}\n");
    expect(0, "runs/seen/sheet.png", "figures pictures.yaml");
    assert_true(
        contains("runs/seen/sheet.csv",
                 "a,seed_00001,cut,0.06 s,pictures/sheet_a_cut/snapshots/time_0.060000.png\n"));
    assert_int_equal(count_lines("runs/seen/sheet.csv"), 1 + 2 * 2);
    assert_true(
        contains("runs/seen/fast.csv", "a,seed_00001,,0.1 s,")); /* time is greatest at its end */
    size_of("runs/seen/fast.png", one);
    size_of("runs/seen/sheet.png", two);
    assert_int_equal(two[0] - one[0], 200);
    assert_true(two[1] - one[1] >= 160);
    size_of("runs/seen/pictures/sheet_a_lateral/snapshots/time_0.000000.png", one);
    assert_true(one[0] == 200 && one[1] == 160);
}

/* A sphere that falls freely for t has the energy m (g t)^2 / 2, whatever the integrator makes of
 * its place: no force depends on that. Over g, that is a square with nothing added. */
static void a_sweep_is_fitted(void **state)
{
    (void)state;
    const double mass = 2500 * M_PI / 6 * 1e-9, factor = mass * 0.1 * 0.1 / 2;
    write_file("fall.yaml", "%s",
               "model: rods\n"
               "time: {step: 1e-4, duration: 0.1}\n"
               "contact: {contact_time: 5e-3, restitution: 0.5}\n"
               "grains: [{kind: single, position: [0, 0, 0], diameter: 1e-3, density: 2500}]\n"
               "walls: [{kind: plane, point: [0, 0, -1]}]\n"
               "sweep: {gravity.2: [-1, -2, -4, -8]}\n"
               "observe: {interval: 0.02}\n");
    write_file("sweep.yaml", "%s",
               "name: fall\n"
               "runs: [{name: g, scene: fall.yaml, seeds: [1, 2]}]\n"
               "figures: [{name: square, kind: sweep, runs: [g], columns: [kinetic], power: 2}]\n");
    expect(0, "runs/fall/square.pdf", "figures sweep.yaml");
    const char *points = "runs/fall/square.csv", *fit = "runs/fall/square_fit.csv";
    assert_int_equal(count_lines(points), 1 + 4);
    assert_true(cell(points, 2, "members") == 2);
    /* Velocities are floats: 1000 roundings of 6e-8. */
    assert_true(fabs(cell(points, 2, "kinetic") - factor * 16) < 1e-4 * factor * 16);
    assert_true(fabs(cell(fit, 0, "factor") - factor) < 1e-4 * factor);
    assert_true(fabs(cell(fit, 0, "constant")) < 1e-4 * factor);
    write_file("sweep.yaml", "%s",
               "name: tiny\n"
               "runs: [{name: a, scene: scene.yaml, seeds: [3, 5]}]\n"
               "figures: [{name: square, kind: sweep, runs: [a], columns: [kinetic]}]\n");
    expect(2, "a/members.csv is of no sweep", "figures sweep.yaml");
    write_file(
        "sweep.yaml", "%s",
        "name: fall\n"
        "runs: [{name: g, scene: fall.yaml, seeds: [1, 2]}]\n"
        "figures: [{name: c, kind: curves, runs: [g], columns: [kinetic], against: time}]\n");
    expect(2, "g/ensemble.csv is of a sweep", "figures sweep.yaml");
}

/* Parts of a step that were timed already are added up, beside the paper's numbers. */
static void shares_stand_beside_the_papers(void **state)
{
    (void)state;
    write_file(
        "shares.yaml", "%s",
        "name: timed\n"
        "runs: [{name: a, scene: scene.yaml}]\n"
        "figures: [{name: table, kind: shares, runs: [a], rows: [one, two, mean, none],\n"
        "           paper: [10, 20, 30, 40], parts: [walk+run, walk, mean speed_max, swim]}]\n");
    assert_int_equal(mkdir("runs/timed", 0777), 0);
    assert_int_equal(mkdir("runs/timed/times", 0777), 0);
    write_file("runs/timed/times/shares_scene.csv", "%s",
               "part,us_per_call,calls_per_step,us_per_step,percent_of_step\n"
               "walk,1,1,1,12.5\n  run,1,1,1,30.25\nidle,1,,,\n");
    expect(0, "runs/timed/table.csv", "figures shares.yaml");
    assert_true(contains("runs/timed/table.csv", "one,10,42.75\ntwo,20,12.50\n"));
    double sum = 0;
    for (int row = 0; row < 6; row++) {
        sum += cell("runs/timed/a/seed_00001/series.csv", row, "speed_max");
    }
    char line[64];
    snprintf(line, sizeof line, "mean,30,%.2f\nnone,40,\n", 100 * sum / 6);
    assert_true(sum > 0 && contains("runs/timed/table.csv", line));
}

static void every_error_of_a_study_is_said(void **state)
{
    (void)state;
    write_file("bad.yaml", "%s",
               "name: bad/name\n"
               "colour: red\n"
               "runs:\n"
               "  - {name: a, scene: nowhere.yaml, seeds: [5, 3]}\n"
               "  - {name: a, scene: scene.yaml, steps: 3}\n"
               "  - {name: b}\n"
               "figures:\n"
               "  - {name: one, kind: circles, runs: [a]}\n"
               "  - {name: two, kind: curves, runs: [z], columns: [kinetic], against: time,\n"
               "     x_log: true, x_range: [0, 1]}\n"
               "  - {name: three, kind: curves, runs: [a], columns: [kinetic], y_range: 3}\n"
               "  - {name: f, kind: curves, runs: [a], columns: [time+kinetik], against: time,\n"
               "     smooth: 0}\n"
               "  - {name: g, kind: shares, runs: [a], rows: [a], paper: [1, 2], parts: [a]}\n");
    static const char *const errors[] = {
        "bad.yaml:1: name is bad/name; expected letters",
        "bad.yaml:2: colour is no key of a study; expected one of",
        "bad.yaml:4: there is no nowhere.yaml; expected a scene",
        "bad.yaml:4: seeds are no span; expected [first, last]",
        "bad.yaml:5: a is there already; expected a new name",
        "bad.yaml:5: steps is no key of a run; expected one of name, scene",
        "bad.yaml:6: a run has no scene; expected it",
        "bad.yaml:8: kind is circles; expected one of curves, pictures, sweep, shares",
        "bad.yaml:9: z is none of the study's runs",
        "bad.yaml:10: x_range is empty; expected [low, high], above 0 on a logarithmic axis",
        "bad.yaml:11: a figure has no against; expected it",
        "bad.yaml:11: y_range is 3; expected a list of 2 numbers",
        "bad.yaml:12: columns holds time+kinetik; expected a column that `orzo keys --columns`",
        "bad.yaml:13: smooth is 0; expected a whole number",
        "bad.yaml:14: there are 1 rows, 2 numbers of the paper and 1 parts",
    };
    for (size_t i = 0; i < sizeof errors / sizeof *errors; i++) {
        expect(2, errors[i], "figures bad.yaml -o never");
    }
    assert_false(is_there("never"));
    write_file("bad.yaml", "%s",
               "name: bad\n"
               "runs:\n"
               "  - {name: a, scene: scene.yaml, set: [contact.frction=1]}\n"
               "  - {name: b, scene: scene.yaml, set: [friction]}\n"
               "figures: [{name: f, kind: pictures, runs: [a]}]\n");
    expect(2, "bad.yaml:3: run a: --set contact.frction=1", "figures bad.yaml -o never");
    expect(2, "bad.yaml:4: run b: ", "figures bad.yaml -o never");
    assert_false(is_there("never"));
    write_file("bad.yaml", "- a list\n");
    expect(2, "bad.yaml:1: this is no study", "figures bad.yaml -o never");
    expect(1, "nowhere.yaml", "figures nowhere.yaml -o never");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_study_is_run_and_drawn),
        cmocka_unit_test(what_has_ended_is_not_run_again),
        cmocka_unit_test(what_was_stopped_goes_on),
        cmocka_unit_test(quick_is_shorter_and_of_fewer_seeds),
        cmocka_unit_test(what_has_no_points_is_said),
        cmocka_unit_test(another_run_is_refused),
        cmocka_unit_test(a_signal_says_how_to_go_on),
        cmocka_unit_test(pictures_stand_in_a_sheet),
        cmocka_unit_test(a_sweep_is_fitted),
        cmocka_unit_test(shares_stand_beside_the_papers),
        cmocka_unit_test(every_error_of_a_study_is_said),
    };
    return cmocka_run_group_tests(tests, begin, leave_work);
}
