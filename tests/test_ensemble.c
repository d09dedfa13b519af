/* Many scenes at once: a member's bits do not depend on its companions, a stopped one leaves the
 * others alone, and the tables say what the members' series say. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "base/file.h"
#include "base/student.h"
#include "sim/rods_private.h"
#include "sim/settle.h"

#include <sys/stat.h>

#define TINY                                                                                       \
    "model: rods\n"                                                                                \
    "time: {step: 1e-5, duration: 0.01}\n"                                                         \
    "contact: {contact_time: 6e-4, restitution: 0.4, friction: 0.1}\n"                             \
    "grains:\n"                                                                                    \
    "  - {kind: single, diameter: 5e-4, position: [0, 0, 0.05], velocity: [0, 0, 0]}\n"            \
    "  - {kind: random, count: 30, diameter: 5e-4, aspect: 4}\n"                                   \
    "walls:\n"                                                                                     \
    "  - {kind: plane, motion: {frequency: 300, acceleration_ratio: 2}}\n"                         \
    "  - {kind: cylinder, diameter: 8e-3}\n"                                                       \
    "settle: {drag: 70, threshold: 2e-1, rest_time: 0.003, time_max: 0.2}\n"

static char folder[] = "/tmp/orzo_test_ensemble_XXXXXX";

static int make_folder(void **state)
{
    char path[256];
    if (open_rig_device(state) != 0 || !mkdtemp(folder)) {
        return -1;
    }
    snprintf(path, sizeof path, "%s/tiny.yaml", folder);
    FILE *file = fopen(path, "w");
    return !file || fputs(TINY, file) < 0 || fclose(file) != 0;
}

static int remove_folder(void **state)
{
    char command[256];
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return system(command) + close_rig_device(state);
}

/* `orzo run tiny.yaml ARGUMENTS -o OUT` must end with this exit status. */
static void run(const char *arguments, const char *out, int expected)
{
    char command[1024];
    snprintf(command, sizeof command, "cd '%s' && '%s' run tiny.yaml %s -o %s >said 2>&1", folder,
             ORZO_PROGRAM, arguments, out);
    int status = system(command);
    if (status != expected << 8) {
        snprintf(command, sizeof command, "cat '%s/said'", folder);
        assert_int_equal(system(command), 0);
    }
    assert_int_equal(status, expected << 8);
}

static char *read_text(const char *name)
{
    char path[512], *text = NULL;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    must(oz_file_read(&text, NULL, path));
    return text;
}

static void assert_same_file(const char *one, const char *other, const char *name)
{
    char paths[2][256];
    snprintf(paths[0], sizeof paths[0], "%s/%s", one, name);
    snprintf(paths[1], sizeof paths[1], "%s/%s", other, name);
    char *a = read_text(paths[0]), *b = read_text(paths[1]);
    assert_true(strlen(a) > 100);
    assert_string_equal(a, b);
    free(a);
    free(b);
}

static void assert_said(const char *words)
{
    char *said = read_text("said");
    if (!strstr(said, words)) {
        fail_msg("'%s' is not in: %s", words, said);
    }
    free(said);
}

/* The number in a table's line (0: the header) under a column's name. */
static double number_at(const char *table, int line, const char *column)
{
    char *text = read_text(table), *rest = text, *row = NULL, *header = strsep(&rest, "\n");
    int place = -1;
    for (int i = 0; header; i++) {
        place = strcmp(strsep(&header, ","), column) == 0 ? i : place;
    }
    for (int i = 0; i < line; i++) {
        row = strsep(&rest, "\n");
    }
    assert_true(place >= 0 && row);
    for (int i = 0; i < place; i++) {
        strsep(&row, ",");
    }
    double number = strtod(row, NULL);
    free(text);
    return number;
}

/* Seed 3 alone and seed 3 in company: the same bytes. */
static void test_company_changes_nothing(void **state)
{
    (void)state;
    run("--set seed=3", "alone", 0);
    run("--seeds 1..4", "seeds", 0);
    assert_same_file("alone", "seeds/seed_00003", "final.csv");
    assert_same_file("alone", "seeds/seed_00003", "series.csv");
    assert_same_file("alone", "seeds/seed_00003", "scene.yaml");
}

static void test_tables_add_up(void **state)
{
    (void)state;
    double value[4], mean = 0, squares = 0;
    for (int m = 0; m < 4; m++) {
        assert_int_equal((int)number_at("seeds/members.csv", m + 1, "seed"), m + 1);
        value[m] = number_at("seeds/members.csv", m + 1, "angle");
        mean += value[m] / 4;
    }
    for (int m = 0; m < 4; m++) {
        squares += (value[m] - mean) * (value[m] - mean);
    }
    double spread = sqrt(squares / 3);
    assert_true(spread > 0);
    /* Rows at 0, 1/300, 2/300 and 3/300 s, which is the end. Cells have nine digits. */
    assert_int_equal((int)number_at("seeds/ensemble.csv", 4, "step"), 1000);
    assert_int_equal((int)number_at("seeds/ensemble.csv", 4, "members"), 4);
    assert_true(fabs(number_at("seeds/ensemble.csv", 4, "angle_mean") - mean) < 1e-7 * mean);
    assert_true(fabs(number_at("seeds/ensemble.csv", 4, "angle_spread") - spread) < 1e-6 * mean);
    /* t of 3 degrees of freedom, 95 %, from tables: 3.182. */
    assert_true(fabs(number_at("seeds/ensemble.csv", 4, "angle_ci95") - 3.182446 * spread / 2) <
                1e-6 * mean);
}

static void test_students_t(void **state)
{
    (void)state;
    const struct {
        int degrees;
        double limit; /* from tables, to the digits given */
    } rows[] = {{1, 12.7062}, {2, 4.3027}, {5, 2.5706}, {10, 2.2281}, {30, 2.0423}, {100, 1.9840}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        assert_true(fabs(oz_student_limit(rows[i].degrees) - rows[i].limit) < 6e-5);
    }
}

#define SHOWN                                                                                      \
    "--seeds 1..3 --set 'movie={size: [320, 240], length: 0.2}' --set 'snapshots={taps: [1]}'"

/* One launch at a time with three members, or three with one each, which share what draws. */
static void test_workers_change_nothing(void **state)
{
    (void)state;
    run(SHOWN " --threads 1", "together", 0);
    assert_said("3 side by side, 1 launches at a time");
    run(SHOWN " --threads 3", "apart", 0);
    assert_said("3 side by side, 3 launches at a time");
    const char *names[] = {"ensemble.csv", "members.csv", "seed_00003/series.csv",
                           "seed_00002/final.csv"};
    for (int i = 0; i < 4; i++) {
        assert_same_file("together", "apart", names[i]);
    }
    char command[256];
    snprintf(command, sizeof command,
             "cd '%s' && for f in movie.mp4 snapshots/tap_00001.png; do for s in 1 2 3; do "
             "cmp together/seed_0000$s/$f apart/seed_0000$s/$f || exit 1; done; done",
             folder);
    assert_int_equal(system(command), 0);
}

/* A picture of the second that cannot be written ends all, in order. A member that had no picture
 * yet has no movie. */
static void test_failure_ends_all(void **state)
{
    (void)state;
    char command[256];
    snprintf(command, sizeof command,
             "mkdir -p '%s/full/seed_00002' && touch '%s/full/seed_00002/snapshots'", folder,
             folder);
    assert_int_equal(system(command), 0);
    run(SHOWN " --threads 3", "full", 1);
    assert_said("cannot write full/seed_00002/snapshots/tap_00001.png.part: ");
    for (int seed = 1; seed <= 3; seed++) {
        snprintf(command, sizeof command,
                 "cd '%s/full/seed_0000%d' && ! test -e movie.mp4.part && "
                 "{ test %d -ne 2 && ! test -e movie.mp4 || test -s movie.mp4; } && "
                 "test \"$(tail -c 1 series.csv)\" = ''",
                 folder, seed, seed);
        assert_int_equal(system(command), 0);
    }
    char *members = read_text("full/members.csv");
    assert_non_null(strstr(members, "failed"));
    free(members);
}

/* Frictionless grains have kernels of their own: two groups, one after the other. */
static void test_sweep(void **state)
{
    (void)state;
    run("--set 'sweep={contact.friction: [0, 0.1]}' --seeds 1..2", "sweep", 0);
    run("--set contact.friction=0 --set seed=2", "smooth", 0);
    assert_same_file("smooth", "sweep/friction_0_seed_00002", "final.csv");
    assert_same_file("smooth", "sweep/friction_0_seed_00002", "series.csv");
    assert_same_file("seeds/seed_00001", "sweep/friction_0.1_seed_00001", "final.csv");
    assert_true(number_at("sweep/ensemble.csv", 4, "contact.friction") == 0);
    assert_true(number_at("sweep/ensemble.csv", 5, "contact.friction") == 0.1);
    assert_int_equal((int)number_at("sweep/ensemble.csv", 8, "members"), 2);
}

/* Two keys: each combination is the run that has both values, and has its row under both. */
static void test_grid(void **state)
{
    (void)state;
    run("--set 'sweep={contact.friction: [0.1, 0.2], contact.restitution: [0.4, 0.6]}' --seeds "
        "1..2",
        "grid", 0);
    run("--set contact.friction=0.2 --set contact.restitution=0.6 --set seed=2", "corner", 0);
    assert_same_file("corner", "grid/friction_0.2_restitution_0.6_seed_00002", "final.csv");
    assert_same_file("corner", "grid/friction_0.2_restitution_0.6_seed_00002", "series.csv");
    assert_same_file("seeds/seed_00001", "grid/friction_0.1_restitution_0.4_seed_00001",
                     "final.csv");
    /* Four rows for each combination. */
    assert_true(number_at("grid/ensemble.csv", 9, "contact.friction") == 0.2);
    assert_true(number_at("grid/ensemble.csv", 9, "contact.restitution") == 0.4);
    assert_true(number_at("grid/ensemble.csv", 13, "contact.restitution") == 0.6);
    assert_true(number_at("grid/ensemble.csv", 13, "step") == 0);
    assert_int_equal((int)number_at("grid/ensemble.csv", 16, "members"), 2);
    assert_true(number_at("grid/members.csv", 8, "contact.friction") == 0.2);
    assert_true(number_at("grid/members.csv", 8, "contact.restitution") == 0.6);
    assert_int_equal((int)number_at("grid/members.csv", 8, "seed"), 2);
    assert_int_equal((int)number_at("grid/members.csv", 8, "step"), 1000);
}

/* In step; keys that end alike go by their whole names. */
static void test_zip(void **state)
{
    (void)state;
    run("--set 'sweep={contact.friction: [0.2, 0.2], walls.0.contact.friction: [0.1, 0.3], zip: "
        "true}'",
        "zip", 0);
    run("--set contact.friction=0.2 --set walls.0.contact.friction=0.3", "pair", 0);
    assert_same_file("pair", "zip/contact.friction_0.2_walls.0.contact.friction_0.3", "final.csv");
    char *members = read_text("zip/members.csv");
    assert_non_null(
        strstr(members, "folder,seed,contact.friction,walls.0.contact.friction,status"));
    assert_non_null(strstr(members, "_0.1,1,0.2,0.1,done,"));
    assert_non_null(strstr(members, "_0.3,1,0.2,0.3,done,"));
    free(members);
    run("--set 'sweep={contact.friction: [0.2, 0.2], contact.restitution: [0.5, 0.5], zip: true}'",
        "bad", 2);
    assert_said("two members of the sweep of contact.friction,contact.restitution would both be "
                "written into friction_0.2_restitution_0.5");
}

/* A grain thrown at 100 m/s moves more than its radius in a step. */
static void test_stopped_member(void **state)
{
    (void)state;
    run("--set 'sweep={grains.0.velocity.0: [100, 0]}' --set seed=3 --set settle=false", "stopped",
        1);
    assert_said("velocity.0_100: tiny.yaml: stopped at step 1,");
    run("--set seed=3 --set settle=false", "calm", 0);
    assert_same_file("calm", "stopped/velocity.0_0", "final.csv");
    assert_same_file("calm", "stopped/velocity.0_0", "series.csv");
    char *members = read_text("stopped/members.csv");
    assert_non_null(strstr(members, ",3,100,stopped,0,0,0,"));
    assert_non_null(strstr(members, ",3,0,done,1000,"));
    free(members);
    run("--set grains.0.velocity.0=100 --set settle=false", "plain", 1);
}

static void test_nonsense_is_refused(void **state)
{
    (void)state;
    run("--seeds 4..3", "bad", 2);
    run("--seeds 1..x", "bad", 2);
    run("--seeds 1", "bad", 2);
    run("--seeds 0..100000", "bad", 2);
    run("--set 'sweep={contact.fricton: [0.1]}'", "bad", 2);
    assert_said("did you mean contact.friction?");
    run("--set 'sweep={contact.friction: [0.1, 0.1]}'", "bad", 2);
    run("--set 'sweep={contact.friction: [0.1, -1]}'", "bad", 2);
    run("--set 'sweep={contact.friction: 0.1}'", "bad", 2);
    run("--set 'sweep={seed: [1, 2]}' --seeds 1..2", "bad", 2);
    run("--seeds 1..4", "seeds", 2); /* holds a run that has ended */
}

/* Lists that hold next to nothing, for all members: they grow at moments that are not every
 * member's own. */
static void shrink_lists(OzSim *sim)
{
    OzSizes tiny = *oz_rods_sizes(sim);
    tiny.outer_capacity = oz_rods_switches(sim)->lanes;
    tiny.inner_capacity = oz_rods_switches(sim)->lanes;
    tiny.back_capacity = 1;
    must(oz_arrays_resize(&sim->arrays, &tiny));
    for (int m = 0; m < sim->batch.member_count; m++) {
        oz_rods_control(sim, m)->truth = OZ_SPRINGS_AT_NONE;
    }
}

/* Member 0's list grows while member 1 is through its launch, and the other way round. */
static void test_growth_in_company(void **state)
{
    (void)state;
    enum { MEMBERS = 3 };
    Rig rigs[MEMBERS];
    OzMember members[MEMBERS];
    OzSim *sim = NULL, *alone = NULL;
    double seconds = 0;
    for (int m = 0; m < MEMBERS; m++) {
        rig_open(&rigs[m], TINY);
        throw_grains(&rigs[m].grains, 0.2 * m, 50);
        members[m] = (OzMember){&rigs[m].scene, &rigs[m].grains};
    }
    must(oz_sim_create(&sim, &rig_device, members, MEMBERS, NULL));
    shrink_lists(sim);
    must(oz_settle_run(sim, &seconds, NULL, NULL));
    for (int m = 0; m < MEMBERS; m++) {
        must(oz_sim_create(&alone, &rig_device, &members[m], 1, NULL));
        must(oz_settle_run(alone, &seconds, NULL, NULL));
        OzSnapshot lonely = state_at(&rigs[m], alone, 500), now;
        must(oz_snapshot_create(&now, &rigs[m].scene, &rigs[m].grains));
        must(oz_sim_advance(sim, 500));
        must(oz_read_snapshot_snapshot(sim, m, &now, true));
        assert_same_bits(&now, &lonely);
        oz_snapshot_free(&now);
        oz_snapshot_free(&lonely);
        oz_sim_free(alone);
    }
    oz_sim_free(sim);
    for (int m = 0; m < MEMBERS; m++) {
        rig_close(&rigs[m]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_students_t),
        cmocka_unit_test(test_growth_in_company),
        cmocka_unit_test(test_company_changes_nothing),
        cmocka_unit_test(test_tables_add_up),
        cmocka_unit_test(test_workers_change_nothing),
        cmocka_unit_test(test_failure_ends_all),
        cmocka_unit_test(test_sweep),
        cmocka_unit_test(test_grid),
        cmocka_unit_test(test_zip),
        cmocka_unit_test(test_stopped_member),
        cmocka_unit_test(test_nonsense_is_refused),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
