/* `orzo check` as a user meets it: the verdict first, what it rests on after that, exit statuses as
 * those of `run`. Kernels are those of test_run's bed. ORZO_NEEDS_DEVICE. */
#include "hand_contacts.h"
#include "program.h"
#include "run_bed.h"

#include "cli.h"
#include "command/inspect_columns.h"
#include "model/insert.h"
#include "observe/series.h"

#include <math.h>

static int make_bed(void **state)
{
    if (enter_work(state) != 0) {
        return -1;
    }
    write_file("bed.yaml", "%s", bed);
    write_file("shown.yaml", "%s%s", bed, pictures);
    return 0;
}

/* `check` ends as `run` would, and prints everything before. */
static void test_check_ends_as_a_run_would(void **state)
{
    (void)state;
    static const char refusal[] = "bed.yaml: time.step 0.0007 s is unstable for a contact of two "
                                  "grains; expected below";
    expect(2, refusal, "run bed.yaml -o refused --set time.step=7e-4");
    expect(2, refusal, "check bed.yaml --set time.step=7e-4");
    assert_true(contains("said", "stable           NO: "));
    expect(1, "stopped at step ",
           "run bed.yaml -o forced --set time.step=7e-4 --set settle=false --force");
    expect(1, "warning: at time.step 0.0007 s a contact of two grains is unstable",
           "check bed.yaml --set time.step=7e-4 --set settle=false --force");
    assert_true(contains("said", "not timed: a guard stops them") &&
                contains("said", "stopped at step "));
    expect(2, "step_7e-4: bed.yaml: time.step 0.0007 s is unstable",
           "check bed.yaml --set 'sweep={time.step: [2e-5, 7e-4]}'");
    assert_true(contains("said", "1 of 2 members cannot be run"));
    expect(0, "exit status: 0 done", "--help");
}

/* Wrong values of a sweep are told where they stand, all in one go. */
static void test_wrong_values_of_a_sweep(void **state)
{
    (void)state;
    write_file("swept.yaml",
               "%ssweep:\n  contact.friction: [0.1, -1]\n  contact.restitution: [0.5, 3]\n", bed);
    expect(2, "swept.yaml:13: in the sweep, contact.friction=-1: contact.friction is -1; expected",
           "run swept.yaml");
    assert_true(contains("said", "swept.yaml:14: in the sweep, contact.restitution=3: "));
    assert_int_equal(count_lines("said"), 2);
}

static void test_check_refuses_deep_starts(void **state)
{
    (void)state;
    static const char lattice[] =
        "--set 'grains=[{kind: lattice, cells: [2, 1, 1], spacing: [2e-4, 1, 1], diameter: 5e-4, "
        "position: [0, 0, 1e-3]}]' --set settle=false";
    char command[512];
    snprintf(command, sizeof command, "run bed.yaml -o deep %s", lattice);
    expect(2, "bed.yaml: grain 0 overlaps grain 1 at the start by 0.0003 m", command);
    snprintf(command, sizeof command, "check bed.yaml %s", lattice);
    expect(2, "bed.yaml: grain 0 overlaps grain 1 at the start by 0.0003 m", command);
}

static void test_check_is_short(void **state)
{
    (void)state;
    expect(
        0, "  warning          snapshots.taps 50 beyond the run's end at tap 2 are not drawn",
        "check shown.yaml --set 'grains=[{kind: random, count: 30, diameter: 1e-3, aspect: 2}]'");
    assert_true(contains("said", "contact            at walls 0 to 1\n"));
    assert_false(contains("said", "contact            at wall "));
    char *said = read_file("said", NULL), *line = strstr(said, "  k_n  ");
    assert_non_null(line);
    assert_null(strstr(line_of(line, 0), "...")); /* one mass, one stiffness */
    free(said);
    expect(0, " ... ", "check bed.yaml --set walls.1.contact.friction=0.1");
    assert_true(contains("said", "contact            at walls 0 to 1\n"));
    expect(0, "contact            at wall 1\n",
           "check bed.yaml --set walls.1.contact.restitution=0.9");
}

/* The line of `said` that begins with these words; it stays until the next call. */
static const char *said_line(const char *begin)
{
    static char line[1024];
    char *said = read_file("said", NULL), *found = strstr(said, begin);
    if (!found) {
        fail_msg("\"%s\" is not in: %s", begin, said);
    }
    snprintf(line, sizeof line, "%.*s", (int)strcspn(found, "\n"), found);
    free(said);
    return line;
}

static void test_what_is_open_is_said(void **state)
{
    (void)state;
    write_file("open.yaml", "model: rods\ntime: {step: 1e-5, duration: 1e-3}\n"
                            "contact: {contact_time: 6e-4, restitution: 0.5}\n"
                            "grains: [{kind: random, count: 3, diameter: 1e-3}]\n"
                            "walls: [{kind: plane}, {kind: cylinder, diameter: 9e-3}]\n");
    expect(0, "verdict", "check open.yaml");
    assert_false(contains("said", "container"));
    expect(0, "level planes alone: nothing holds grains sideways",
           "check open.yaml --set walls.1=false");
}

/* The wall that asks for a smaller step than grains do is named. */
static void test_walls_say_their_steps(void **state)
{
    (void)state;
    write_file("steps.yaml", "model: rods\ntime: {step: 1e-5, duration: 1e-3}\n"
                             "contact: {contact_time: 6e-4, restitution: 0.5}\n"
                             "grains: [{kind: random, count: 3, diameter: 1e-3, aspect: 2}]\n"
                             "walls:\n  - {kind: plane}\n  - {kind: cylinder, diameter: 9e-3}\n"
                             "  - {kind: plane, point: [0, 0, 5e-2], normal: [0, 0, -1]}\n");
    expect(0, "; at walls 0 to 2 ", "check steps.yaml");
    assert_true(contains("said", "\n  largest steps    two grains "));
    expect(0, "; at wall 2 ", "check steps.yaml --set walls.2.contact.contact_time=4e-5");
    assert_true(contains("said", "; at walls 0 to 1 ") && contains("said", ", less than the step"));
}

/* What a person came for stands above everything else; switches and memory only when asked for. */
static void test_verdict_comes_first(void **state)
{
    (void)state;
    static const char *const order[] = {"\nverdict\n  restitution      0.5 asked, ",
                                        "\n  stable           yes: ",
                                        "\n  largest steps    two grains ",
                                        "\n  resolution       float tells overlaps of ",
                                        "\n  grains           30, 0.001 to 0.001 m wide, ",
                                        "\n  cost             2000 steps at ",
                                        "\n  movie            5 pictures of 320 x 240 at ",
                                        "\n  in all           about ",
                                        "\n  memory           ",
                                        "\n  empty columns    none\n",
                                        "\n  warning          snapshots",
                                        "\nintegrator         ",
                                        "\ngrains             30\n",
                                        "\ncontact            of two grains",
                                        "\nbed                settled"};
    expect(0, "verdict", "check shown.yaml");
    char *said = read_file("said", NULL);
    const char *at = said;
    for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
        const char *found = strstr(at, order[i]);
        if (!found) {
            fail_msg("\"%s\" does not come after the line before it in: %s", order[i], said);
        }
        at = found + 1;
    }
    free(said);
    assert_false(contains("said", "kernel switches") || contains("said", "device memory"));
    expect(0, "kernel switches", "check bed.yaml --verbose");
    assert_true(contains("said", "left out") && contains("said", "device memory") &&
                contains("said", "not opened"));
    assert_false(contains("said", "  movie "));
}

/* The same steps on the same machine a moment later; what else runs on it may slow down either, so
 * that it is tried again; a wrong unit would be a factor of a thousand each time. */
static void test_cost_is_what_a_run_takes(void **state)
{
    (void)state;
    double estimate = 1, taken = 0, spent = 0;
    int steps = 0;
    for (int tries = 0; tries < 5 && !(estimate < 10 * taken && taken < 10 * estimate); tries++) {
        expect(0, "verdict", "check bed.yaml");
        assert_int_equal(
            sscanf(said_line("  cost "), "  cost %d steps at %lf us:", &steps, &estimate), 2);
        expect(0, "30 grains", /* a state costs once */
               "run bed.yaml -o timed --overwrite --no-video --set checkpoint.every=0");
        assert_int_equal(
            sscanf(said_line("2000 steps in "), "2000 steps in %lf s; %lf us", &spent, &taken), 2);
        print_message("%.3g us a step estimated, %.3g taken\n", estimate, taken);
    }
    assert_int_equal(steps, 2000);
    assert_true(estimate < 10 * taken && taken < 10 * estimate);
}

/* Numbers that follow from the scene by hand: a grain at rest on a wall of k = m (pi^2 + ln^2 e) /
 * t^2 sinks in by m g / k. */
static void test_resolution(void **state)
{
    (void)state;
    const double pi = 3.14159265358979, time = 6e-4, loss = log(0.5);
    double unit = 0, overlap = 0, ratio = 0;
    expect(0, "verdict", "check bed.yaml");
    assert_int_equal(
        sscanf(said_line("  resolution "),
               "  resolution float tells overlaps of %lf m apart; %*[^:]: %lf m, %lf of", &unit,
               &overlap, &ratio),
        3);
    /* Three digits are printed; of the two walls' contacts and a pair's the stiffest counts, which
     * are alike. */
    double expected = 9.81 * time * time / (pi * pi + loss * loss);
    assert_true(fabs(overlap / expected - 1) < 0.005);
    assert_true(fabs(ratio * unit / overlap - 1) < 0.01);
    expect(0, "verdict", "check bed.yaml --precision double --set sweep=false");
    assert_false(contains("said", "  resolution "));
}

enum { NAMES_SIZE = 2048 };

/* The columns that no row fills, of a series whose snapshots have all that they can have. */
static void find_empty(const OzScene *scene, const OzGrains *grains, char names[NAMES_SIZE])
{
    OzSnapshot now = {0};
    OzSeries *series = NULL;
    assert_int_equal(oz_snapshot_create(&now, scene, grains), OZ_OK);
    memcpy(now.position, grains->position, 3 * (size_t)now.count * sizeof(double));
    memcpy(now.quaternion, grains->quaternion, 4 * (size_t)now.count * sizeof(double));
    oz_snapshot_turn_axes(&now);
    now.has_ledger = true;
    for (int kind = 0; kind < OZ_CONTACT_KINDS; kind++) {
        hand_contact(&now, (OzContactEntry){.b = 1, .kind = (OzContactKind)kind});
    }
    assert_int_equal(oz_series_create(&series, "probe.csv", scene, grains), OZ_OK);
    for (int row = 0; row < 3; row++) {
        now.time = 0.01 * row;
        for (int sample = 0; scene->period > 0 && sample < 2; sample++) {
            oz_series_sample(series, &now);
        }
        assert_int_equal(oz_series_write(series, &now), OZ_OK);
    }
    assert_int_equal(oz_series_free(series), OZ_OK);
    oz_snapshot_free(&now);
    char *text = read_file("probe.csv", NULL);
    char *head = strdup(line_of(text, 0)), *last = strdup(line_of(text, 3));
    free(text);
    names[0] = '\0';
    for (char *h = head, *l = last, *name; (name = strsep(&h, ",")) != NULL;) {
        size_t used = strlen(names);
        if (!*strsep(&l, ",")) {
            snprintf(names + used, NAMES_SIZE - used, " %s ", name);
        }
    }
    free(head);
    free(last);
}

/* One column's name after the other, then NULL. */
static const char *next_name(const OzScene *scene)
{
    static char name[OZ_COLUMN_NAME];
    static const OzColumn *column;
    static int cell;
    column = column ? column : oz_series_columns();
    while (column->name && cell >= oz_observables_cells(column, scene)) {
        column++;
        cell = 0;
    }
    if (!column->name) {
        column = NULL;
        return NULL;
    }
    oz_observables_name(column, scene, cell++, name);
    return name;
}

/* Every column that `check` names must be empty, and every empty one be named, but for those that
 * wait for something to happen. */
static void assert_columns(const char *text)
{
    static const char *const waiting[] = {"angle_layer", "avalanche_size", "outflow_rate"};
    OzScene scene;
    OzGrains grains;
    char empty[NAMES_SIZE], said[NAMES_SIZE] = "", name[80];
    if (oz_scene_parse(&scene, "scene.yaml", text, NULL, 0) != OZ_OK ||
        oz_insert_grains(&grains, &scene) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    find_empty(&scene, &grains, empty);
    FILE *file = fmemopen(said, sizeof said - 1, "w");
    oz_inspect_columns_print(file, &scene, &grains);
    fclose(file);
    for (const char *key; (key = next_name(&scene)) != NULL;) {
        snprintf(name, sizeof name, " %s ", key);
        bool is_empty = strstr(empty, name) != NULL, is_waiting = false;
        for (size_t i = 0; i < sizeof waiting / sizeof *waiting; i++) {
            is_waiting |= strncmp(key, waiting[i], strlen(waiting[i])) == 0;
        }
        bool is_named = false;
        for (const char *at = said; (at = strstr(at, key)) != NULL; at++) {
            char before = at > said ? at[-1] : ' ', after = at[strlen(key)];
            is_named |= before == ' ' && (after == ',' || after == ':');
        }
        if (is_named ? !is_empty : is_empty && !is_waiting) {
            fail_msg("%s is %s; said was: %s", key, is_empty ? "empty" : "filled", said);
        }
    }
    oz_grains_free(&grains);
    oz_scene_free(&scene);
}

#define RODS                                                                                       \
    "model: rods\ntime: {step: 1e-5, duration: 1}\n"                                               \
    "contact: {contact_time: 1e-3, restitution: 0.5}\n"
#define FLAT "model: trigrains\ntime: {step: 1e-6, duration: 1}\n"

static void test_empty_columns(void **state)
{
    (void)state;
    assert_columns(bed);
    assert_columns(RODS "grains:\n  - {kind: random, count: 5, diameter: 1e-3}\n"
                        "walls: [{kind: plane}]\n");
    assert_columns(RODS "grains:\n  - {kind: random, count: 5, diameter: 1e-3, aspect: 1}\n"
                        "walls: [{kind: cylinder, diameter: 1e-2}]\n");
    assert_columns(RODS "grains:\n  - {kind: random, count: 5, diameter: 1e-3}\n"
                        "walls:\n  - {kind: cylinder, diameter: 1e-2}\n"
                        "  - {kind: plane, motion: {frequency: 30, amplitude: 1e-4}}\n"
                        "observe: {ledger: true}\n");
    assert_columns(FLAT "grains:\n  - {kind: random, count: 60, shape: square, edge: 2e-3}\n"
                        "walls: [{kind: drum, diameter: 4e-2}]\nobserve: {ledger: true}\n");
    assert_columns(
        FLAT "gravity: [0, 0]\ngrains:\n  - {kind: random, count: 60, shape: square, edge: 2e-3}\n"
             "walls: [{kind: drum, diameter: 4e-2}]\nobserve: {ledger: true}\n");
    assert_columns(FLAT "grains:\n  - {kind: random, count: 1, shape: square, edge: 2e-3}\n"
                        "walls: [{kind: vessel, width: 2e-2, height: 2e-2}]\n"
                        "observe: {outlet: 0.01}\n");
    assert_columns(FLAT "contact: {contact_time: 1e-3, restitution: 0.5}\n"
                        "grains:\n  - {kind: random, count: 3, shape: disc, radius: 2e-3}\n"
                        "walls: [{kind: vessel, width: 2e-2, height: 2e-2}]\n");
}

/* The last line of a command's help is a command line that the program takes. */
static void test_help_ends_with_an_example(void **state)
{
    (void)state;
    static const char *const commands[] = {"run",   "check",  "draw",    "keys",
                                           "bench", "report", "devices", "figures"};
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        char arguments[32], begin[32], *argv[32];
        int argc = 0;
        OzOptions options;
        snprintf(arguments, sizeof arguments, "%s --help", commands[i]);
        snprintf(begin, sizeof begin, "example: orzo %s", commands[i]);
        expect(0, begin, arguments);
        char *said = read_file("said", NULL);
        char *line = strdup(line_of(said, count_lines("said") - 1));
        free(said);
        assert_true(strncmp(line, begin, strlen(begin)) == 0);
        char *rest = line + strlen("example: ");
        while (rest && argc < 32) {
            argv[argc++] = strsep(&rest, " ");
        }
        assert_int_equal(oz_cli_parse(&options, argc, argv), OZ_OK);
        free(line);
    }
}

/* --realtime may stand alone: then the movie says how fast, and without one it is 1. */
static void test_realtime(void **state)
{
    (void)state;
    char *alone[] = {"orzo", "run", "--realtime", "scene.yaml"};
    char *given[] = {"orzo", "run", "scene.yaml", "--realtime", "2.5e-1"};
    OzOptions options;
    assert_int_equal(oz_cli_parse(&options, 4, alone), OZ_OK);
    assert_true(options.has_pace && options.pace == 0);
    assert_string_equal(options.paths[0], "scene.yaml");
    assert_int_equal(oz_cli_parse(&options, 5, given), OZ_OK);
    assert_true(options.has_pace && options.pace == 0.25);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_check_ends_as_a_run_would),
        cmocka_unit_test(test_wrong_values_of_a_sweep),
        cmocka_unit_test(test_check_refuses_deep_starts),
        cmocka_unit_test(test_check_is_short),
        cmocka_unit_test(test_walls_say_their_steps),
        cmocka_unit_test(test_verdict_comes_first),
        cmocka_unit_test(test_what_is_open_is_said),
        cmocka_unit_test(test_cost_is_what_a_run_takes),
        cmocka_unit_test(test_resolution),
        cmocka_unit_test(test_empty_columns),
        cmocka_unit_test(test_help_ends_with_an_example),
        cmocka_unit_test(test_realtime),
    };
    return cmocka_run_group_tests(tests, make_bed, leave_work);
}
