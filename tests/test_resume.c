/* `orzo resume`: a run that was left goes on to the same bytes. ORZO_NEEDS_DEVICE. */
#include "program.h"
#include "run_bed.h"

static const char dice[] =
    "model: trigrains\n"
    "time: {step: 2e-6, duration: 0.02}\n"
    "grains:\n"
    "  - {kind: random, count: 6, shape: square, edge: 6e-3}\n"
    "walls:\n"
    "  - {kind: floor, width: 0.1, motion: {frequency: 50, amplitude: 1e-3}}\n"
    "observe: {interval: 5e-4, ledger: true}\ncontacts: {}\n";

/* Row 0 to the end of each, with movie's frames so far apart whatever the end. */
static int make_scenes(void **state)
{
    if (enter_work(state) != 0) {
        return -1;
    }
    write_file("bed.yaml", "%smovie: {speed: 0.1, size: [64, 64]}\n", bed);
    write_file("dice.yaml", "%s", dice);
    return orzo("run bed.yaml -o bed --until 0.06");
}

/* A bed has frames, dice have contacts. */
static void assert_same_run(const char *a, const char *b, bool frames)
{
    static const char *const names[] = {"series.csv", "final.csv", "frames.bin", "contacts.csv"};
    char one[128], other[128];
    for (int i = 0; i < 4; i++) {
        snprintf(one, sizeof one, "%s/%s", a, names[i]);
        snprintf(other, sizeof other, "%s/%s", b, names[i]);
        if ((i < 2 || (i == 2) == frames) && !same_files(one, other)) {
            fail_msg("%s and %s differ", one, other);
        }
    }
}

static void test_a_run_that_was_left(void **state)
{
    (void)state;
    expect(0, "", "run bed.yaml -o left --until 0.0213");
    assert_false(same_files("left/series.csv", "bed/series.csv"));
    expect(0, "left goes on at step", "resume left --until 0.041");
    expect(0, "left goes on at step", "resume left --until 0.06");
    assert_same_run("left", "bed", true);
    assert_true(contains("left/log.txt", "building kernels") || count_lines("left/log.txt") > 5);
    expect(0, "left goes on at step", "resume left --until 0.06"); /* from its end: nothing new */
    assert_same_run("left", "bed", true);
}

static void test_double_and_another_integrator(void **state)
{
    (void)state;
    expect(0, "",
           "run bed.yaml -o wide --until 0.03 --no-video --set precision=double "
           "--set integrator=velocity-verlet");
    expect(0, "",
           "run bed.yaml -o wide_left --until 0.0117 --no-video --set precision=double "
           "--set integrator=velocity-verlet");
    expect(0, "goes on", "resume wide_left --until 0.03");
    assert_same_run("wide_left", "wide", true);
}

static void test_trigrains(void **state)
{
    (void)state;
    expect(0, "", "run dice.yaml -o dice");
    expect(0, "", "run dice.yaml -o dice_left --until 0.0071");
    expect(0, "goes on", "resume dice_left");
    assert_same_run("dice_left", "dice", false);
}

/* 0 without the file; another one each time that it is replaced. */
static ino_t inode_of(const char *name)
{
    struct stat found;
    return stat(name, &found) == 0 ? found.st_ino : 0;
}

/* Settling of half a second and more, whose frames are kept: a run that is left in it, by kill -9
 * and then by Ctrl-C, goes on in it. */
static void test_left_while_settling(void **state)
{
    (void)state;
    static const char more[] =
        "--seeds 1..2 --no-video --set time.taps=0.55 --set checkpoint.every=0.02 --set "
        "settle.threshold=0 --set settle.time_max=0.5 --set movie.settle=true";
    static const int signals[] = {SIGKILL, SIGINT};
    char arguments[300];
    snprintf(arguments, sizeof arguments, "run bed.yaml -o straight %s", more);
    expect(0, "", arguments);
    snprintf(arguments, sizeof arguments, "run bed.yaml -o settles %s", more);
    for (int i = 0; i < 2; i++) {
        ino_t before = inode_of("settles/state_00000.h5");
        pid_t child = start_orzo(i ? "resume settles" : arguments);
        for (int k = 0; k < 10000 && inode_of("settles/state_00000.h5") == before; k++) {
            nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
        }
        kill(child, signals[i]);
        assert_int_equal(wait_for(child, 20), i ? 130 : -1);
    }
    expect(0, "of settling", "resume settles");
    assert_same_run("straight/seed_00001", "settles/seed_00001", true);
    assert_same_run("straight/seed_00002", "settles/seed_00002", true);
}

/* A later end is the longer run's, whose last row the shorter one had not. */
static void test_a_later_end(void **state)
{
    (void)state;
    expect(0, "", "run dice.yaml -o longer --set time.duration=0.0303");
    expect(0, "", "run dice.yaml -o shorter --set time.duration=0.0101");
    expect(0, "goes on", "resume shorter --set time.duration=0.0303");
    assert_same_run("shorter", "longer", false);
    expect(0, "goes on at step 15150", "resume shorter"); /* which it then keeps */
    expect(2, "beyond the end asked for", "resume shorter --until 0.01");
}

/* Stopped in its first minute, it goes on from its settled bed with a guard that lets it. */
static void test_stopped_by_a_guard(void **state)
{
    (void)state;
    expect(1,
           "(step 0, 0 s), changed, for unchanged it comes to the same stop: orzo resume stopped",
           "run bed.yaml -o stopped --until 0.06 --no-video --set guards.overlap.stop=0.05");
    expect(1, "guards.overlap.stop", "resume stopped");
    expect(0, "guards.overlap.stop 0.05 -> 2", "resume stopped --set guards.overlap.stop=2");
    assert_same_run("stopped", "bed", true);
}

/* Other keys change where it goes on, as they would have in a run that was not left. */
static void test_changed_on_the_way(void **state)
{
    (void)state;
    expect(0, "", "run bed.yaml -o turned --until 0.0213 --no-video");
    expect(0, "walls.0.motion.acceleration_ratio 2 -> 3",
           "resume turned --until 0.04 --set walls.0.motion.acceleration_ratio=3");
    expect(0, "contact.friction 0.3 -> 0.2",
           "resume turned --until 0.06 --set contact.friction=0.2");
    assert_false(same_files("turned/series.csv", "bed/series.csv"));
    expect(0, "", "run turned --replay -o repeated --until 0.06 --no-video");
    assert_same_run("turned", "repeated", true);
    expect(0, "", "run dice.yaml -o pair --seeds 1..2 --until 0.0052");
    expect(0, "gravity", "resume pair --set 'gravity=[0, -5]'");
    assert_true(contains("pair/seed_00002/reloads.csv", "2600,0.0052,gravity"));
    expect(0, "", "run pair --replay -o pair_again");
    assert_same_run("pair/seed_00001", "pair_again/seed_00001", false);
    assert_same_run("pair/seed_00002", "pair_again/seed_00002", false);
    assert_int_equal(system("mkdir -p none && cp -r pair none && rm none/pair/state_*"), 0);
    expect(2, "expected --seeds", "run none/pair --replay -o none_again");
    assert_false(is_there("none_again"));
    expect(0, "", "run pair/seed_00002 --replay -o second");
    assert_same_run("pair/seed_00002", "second", false);
}

/* A run that repeats another one goes on repeating it, also when that one is gone. */
static void test_left_while_repeating(void **state)
{
    (void)state;
    expect(0, "", "run turned --replay -o half --until 0.03 --no-video");
    expect(2, "half repeats another run", "resume half --until 0.06 --set contact.friction=0.1");
    assert_int_equal(system("mv turned away"), 0);
    expect(0, "contact.friction 0.3 -> 0.2", "resume half --until 0.06");
    assert_same_run("away", "half", true);
    expect(0, "contact.friction 0.2 -> 0.1",
           "resume half --until 0.07 --set contact.friction=0.1"); /* nothing is left to repeat */
    expect(0, "", "run pair --replay -o pair_half --until 0.003");
    expect(0, "gravity", "resume pair_half");
    assert_same_run("pair/seed_00001", "pair_half/seed_00001", false);
    assert_same_run("pair/seed_00002", "pair_half/seed_00002", false);
}

static void test_an_ensemble(void **state)
{
    (void)state;
    expect(0, "", "run dice.yaml -o all --seeds 1..3");
    expect(0, "", "run dice.yaml -o part --seeds 1..3 --until 0.0052");
    expect(0, "goes on", "resume part");
    assert_same_run("all/seed_00001", "part/seed_00001", false);
    assert_same_run("all/seed_00003", "part/seed_00003", false);
    assert_true(same_files("all/ensemble.csv", "part/ensemble.csv"));
    write_file("dice.yaml", "%s# as before, but for this\nseed: 9\n", dice);
    expect(2, "is not what the run in part began with", "resume part");
    write_file("dice.yaml", "%s", dice);
}

static void test_what_is_refused(void **state)
{
    (void)state;
    expect(2, "nothing holds no state of a run", "resume nothing");
    expect(2, "grains.0.count runs with 29, which cannot change",
           "resume bed --set grains.0.count=28 --set contact.friction=0.2");
    expect(2, "contact.friction is -1", "resume bed --set contact.friction=-1");
    expect(0, "", "run dice.yaml -o none --until 0.001 --set checkpoint.every=0");
    assert_false(is_there("none/state.h5"));
    expect(2, "none holds no state of a run", "resume none");
}

/* Cuts a file down to its first bytes. */
static void cut(const char *name)
{
    assert_int_equal(truncate(name, 5000), 0);
}

static void test_damaged_states(void **state)
{
    (void)state;
    expect(0, "", "run bed.yaml -o hurt --until 0.02");
    expect(0, "goes on", "resume hurt --until 0.04");
    assert_true(is_there("hurt/state.h5.previous"));
    cut("hurt/state.h5");
    expect(0,
           "hurt/state.h5: cut short; expected a state of orzo, version 1; going on from the "
           "state before it, step",
           "resume hurt --until 0.06");
    assert_same_run("hurt", "bed", true);
    cut("hurt/state.h5");
    cut("hurt/state.h5.previous");
    expect(2, "and the one before it: hurt/state.h5.previous: cut short", "resume hurt");
}

static void test_kept_states(void **state)
{
    (void)state;
    expect(0, "", "run bed.yaml -o kept --no-video --until 0.07 --set checkpoint.taps=[1,2]");
    assert_true(is_there("kept/checkpoints/tap_00001.h5"));
    assert_true(is_there("kept/checkpoints/tap_00002.h5"));
    assert_true(contains("kept/.orzo", "checkpoints/tap_00002.h5"));
    expect(0, "", "run bed.yaml -o kept --overwrite --no-video --until 0.01");
    assert_false(is_there("kept/checkpoints/tap_00001.h5"));
}

static void test_one_owner(void **state)
{
    (void)state;
    pid_t first = start_orzo(
        "run bed.yaml -o owned --no-video --set time.taps=300 --set checkpoint.every=0.05");
    char used[64];
    snprintf(used, sizeof used, "owned is in use by process %d", (int)first);
    for (int i = 0; i < 1000 && !is_there("owned/state.h5"); i++) {
        sleep_a_little();
    }
    expect(2, used, "resume owned");
    expect(2, used, "run bed.yaml -o owned --overwrite");
    kill(first, SIGINT);
    assert_int_equal(wait_for(first, 10), 130);
    assert_true(contains("owned/log.txt", "orzo resume owned\n"));
    expect(0, "goes on", "resume owned");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_run_that_was_left),
        cmocka_unit_test(test_double_and_another_integrator),
        cmocka_unit_test(test_trigrains),
        cmocka_unit_test(test_left_while_settling),
        cmocka_unit_test(test_a_later_end),
        cmocka_unit_test(test_stopped_by_a_guard),
        cmocka_unit_test(test_changed_on_the_way),
        cmocka_unit_test(test_left_while_repeating),
        cmocka_unit_test(test_an_ensemble),
        cmocka_unit_test(test_what_is_refused),
        cmocka_unit_test(test_damaged_states),
        cmocka_unit_test(test_kept_states),
        cmocka_unit_test(test_one_owner),
    };
    return cmocka_run_group_tests(tests, make_scenes, leave_work);
}
