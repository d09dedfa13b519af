/* `orzo run --from`: a run begins where another one was. ORZO_NEEDS_DEVICE. */
#include "program.h"
#include "run_bed.h"

static const char dice[] =
    "model: trigrains\n"
    "time: {step: 2e-6, duration: 0.01}\n"
    "grains:\n"
    "  - {kind: random, count: 6, shape: square, edge: 6e-3}\n"
    "walls:\n"
    "  - {kind: floor, width: 0.1, motion: {frequency: 50, amplitude: 1e-3}}\n"
    "settle: {drag: 70, time_max: 0.02, rest_time: 0.01}\n"
    "observe: {interval: 5e-4, ledger: true}\n";

/* A bed at rest, and one that was left in the middle of its second tap. */
static int make_beds(void **state)
{
    if (enter_work(state) != 0) {
        return -1;
    }
    write_file("bed.yaml", "%s", bed);
    write_file("dice.yaml", "%s", dice);
    int failed = orzo("run bed.yaml -o rest --until 0");
    return failed ? failed
                  : orzo("run bed.yaml -o left --set time.taps=1.3 "
                         "--set checkpoint.taps=[1]");
}

/* Without any change it is the run that settles itself, to the byte: nothing is lost on the way. */
static void test_a_settled_bed(void **state)
{
    (void)state;
    expect(0, "30 grains", "run bed.yaml -o whole");
    expect(0, "grains are those of rest/state.h5, step 0",
           "run bed.yaml -o branch --from rest --set settle=false");
    assert_true(same_files("whole/series.csv", "branch/series.csv"));
    assert_true(same_files("whole/final.csv", "branch/final.csv"));
}

static void test_settled_dice(void **state)
{
    (void)state;
    expect(0, "", "run dice.yaml -o dice");
    expect(0, "", "run dice.yaml -o dice_rest --until 0");
    expect(0, "", "run dice.yaml -o dice_branch --from dice_rest --set settle=false");
    assert_true(same_files("dice/series.csv", "dice_branch/series.csv"));
    assert_true(same_files("dice/final.csv", "dice_branch/final.csv"));
}

/* Every member begins with the bed: the first is the run alone, and none is like another. */
static void test_a_sweep(void **state)
{
    (void)state;
    expect(0, "",
           "run bed.yaml -o many --from rest --set settle=false --set "
           "'sweep={walls.0.motion.acceleration_ratio: [2, 3]}'");
    expect(0, "",
           "run bed.yaml -o three --from rest --set settle=false --set "
           "walls.0.motion.acceleration_ratio=3");
    assert_true(same_files("three/final.csv", "many/acceleration_ratio_3/final.csv"));
    assert_false(
        same_files("many/acceleration_ratio_2/final.csv", "many/acceleration_ratio_3/final.csv"));
    char *three = read_file("three/series.csv", NULL), *rest = read_file("rest/series.csv", NULL);
    assert_true(strncmp(line_of(rest, 1), "0,0,0,", 6) == 0);
    char row[4096];
    snprintf(row, sizeof row, "%s", line_of(rest, 1));
    assert_string_equal(line_of(three, 1), row);
    free(three);
    free(rest);
}

/* It is a run like any other: it can be left, and goes on. */
static void test_a_branch_goes_on(void **state)
{
    (void)state;
    expect(0, "", "run bed.yaml -o long --from left@tap=1 --set settle=false");
    expect(0, "", "run bed.yaml -o short --from left@tap=1 --set settle=false --until 0.013");
    expect(0, "goes on", "resume short");
    assert_true(same_files("long/series.csv", "short/series.csv"));
    assert_true(same_files("long/final.csv", "short/final.csv"));
}

static void test_what_is_refused(void **state)
{
    (void)state;
    static const struct {
        const char *arguments, *text;
    } bad[] = {
        {"--from left", "walls.0 stands elsewhere in left/state.h5"},
        {"--from left@tap=3", "there is no state tap_00003; expected one of those kept in "
                              "left/checkpoints (tap_00001)"},
        {"--from left@tip=3", "expected DIR, DIR@tap=300 or DIR@time=2.5"},
        {"--from nothing", "nothing/scene.yaml"},
        {"--from rest --seeds 1..2", "all these runs would be the same"},
        {"--from rest --set seed=2", "expected --set seed=1"},
        {"--from rest --set grains.0.count=28", "has 29 grains, and rest/state.h5 has 30"},
        {"--from rest --set grains.1.aspect=1.5", "grain 29 is 0.001 m thick"},
        {"--from rest --set time.step=1e-5", "time.step is 1e-05 s, and in rest/state.h5 2e-05 s"},
        {"--from rest --set precision=double", "precision is not that of rest/state.h5"},
        {"--from rest --set walls.1=false", "has 1 walls, and rest/state.h5 has 2"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        char arguments[256];
        snprintf(arguments, sizeof arguments, "run bed.yaml -o bad %s", bad[k].arguments);
        expect(2, bad[k].text, arguments);
        assert_false(is_there("bad"));
    }
    expect(2, "rest/state.h5 is read here, and the run would write or remove it",
           "run bed.yaml -o rest --overwrite --from rest");
    assert_true(is_there("rest/state.h5"));
    expect(0, "", "run bed.yaml -o begun --from rest --until 0.001 --set settle=false --no-video");
    assert_true(contains("begun/from.txt", "rest"));
    expect(2, "began with the state of another one", "run begun --replay -o again");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_settled_bed),   cmocka_unit_test(test_settled_dice),
        cmocka_unit_test(test_a_sweep),         cmocka_unit_test(test_a_branch_goes_on),
        cmocka_unit_test(test_what_is_refused),
    };
    return cmocka_run_group_tests(tests, make_beds, leave_work);
}
