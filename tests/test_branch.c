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
    failed = failed ? failed : orzo("run bed.yaml -o beds --seeds 1..3 --until 0");
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
    expect(0, "", "run dice.yaml -o dice_gone --until 0.0005 --set walls.0.until=2e-4");
    expect(2, "walls.0 is gone in dice_gone/state.h5, and is there at the start",
           "run dice.yaml -o bad --from dice_gone --set settle=false");
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
        {"--from nothing", "there is no state.h5"},
        {"--from nothing@tap=1", "nothing/scene.yaml"},
        {"--from beds", "expected one of those there, as by --from DIR/MEMBER or --seeds: "
                        "seed_00001, seed_00002, seed_00003"},
        {"--from beds/seed_4", "there is no member seed_4; expected"},
        {"--from rest --set 'grains.1.aspect=[1, 1.1]' --set seed=2",
         "(here of seed 2, there of seed 1)"},
        {"--from rest --set grains.0.count=28", "has 29 grains, and rest/state.h5 has 30"},
        {"--from rest --set grains.1.aspect=1.5", "grain 29 is 0.001 m thick"},
        {"--from rest --set time.step=1e-5", "time.step is 1e-05 s, and in rest/state.h5 2e-05 s"},
        {"--from rest --set precision=double", "precision is not that of rest/state.h5"},
        {"--from rest --set walls.1=false", "has 1 walls, and rest/state.h5 has 2"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        char arguments[256];
        bool seeded = strcmp(bad[k].arguments, "--from beds") == 0;
        snprintf(arguments, sizeof arguments, "run bed.yaml -o bad %s%s", bad[k].arguments,
                 seeded ? " --set seed=7" : "");
        expect(2, bad[k].text, arguments);
        assert_false(is_there("bad"));
    }
    expect(2, "rest/state.h5 is read here, and the run would write or remove it",
           "run bed.yaml -o rest --overwrite --from rest");
    assert_true(is_there("rest/state.h5"));
}

/* A state's springs at a mesh are of these triangles and no others. */
static void test_other_triangles(void **state)
{
    (void)state;
    static const char mesh[] = "v -%d -9 0\nv 9 -9 0\nv 0 9 0\nf 1 2 3\n";
    write_file("mesh.yaml", "%s",
               "model: rods\ntime: {step: 1e-5, duration: 1e-4}\n"
               "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4}\n"
               "grains: [{kind: single, diameter: 1e-3, position: [0, 0, 0.5e-3]}]\n"
               "walls: [{kind: mesh, path: mesh.obj, scale: 1e-3}]\n");
    write_file("mesh.obj", mesh, 9);
    expect(0, "", "run mesh.yaml -o mesh");
    expect(0, "grains are those of mesh", "run mesh.yaml -o mesh_same --from mesh");
    write_file("mesh.obj", mesh, 8);
    expect(2, "mesh.obj, has other triangles than in mesh/state.h5; expected the same file",
           "run mesh.yaml -o bad --from mesh");
}

/* A member of an ensemble, alone; and each with its own, where another sweep has no names alike. */
static void test_an_ensemble(void **state)
{
    (void)state;
    expect(0, "", "run bed.yaml -o whole_beds --seeds 1..3");
    expect(0, "seed_00003 begins with beds/state_0000",
           "run bed.yaml -o from_beds --from beds --seeds 1..3 --set settle=false");
    assert_true(same_files("whole_beds/ensemble.csv", "from_beds/ensemble.csv"));
    assert_true(same_files("whole_beds/seed_00002/final.csv", "from_beds/seed_00002/final.csv"));
    expect(0, "", "run bed.yaml -o two --from beds/seed_00002 --set settle=false --set seed=2");
    assert_true(same_files("two/final.csv", "from_beds/seed_00002/final.csv"));
    expect(0, "",
           "run bed.yaml -o swept --from beds/ --seeds 2..3 --set settle=false --set "
           "'sweep={walls.0.motion.acceleration_ratio: [2, 3]}'");
    assert_true(same_files("two/final.csv", "swept/acceleration_ratio_2_seed_00002/final.csv"));
    assert_false(same_files("swept/acceleration_ratio_3_seed_00002/final.csv",
                            "swept/acceleration_ratio_3_seed_00003/final.csv"));
    expect(0, "members of all seeds are the same run",
           "run bed.yaml -o alike --from beds/seed_00002 --seeds 8..9 --set settle=false");
    assert_true(same_files("two/final.csv", "alike/seed_00009/final.csv"));
}

/* A folder that began with a state keeps it: without the first run it can be repeated, and members
 * that had not begun can. */
static void test_it_is_kept(void **state)
{
    (void)state;
    expect(0, "", "run bed.yaml -o gone --seeds 1..2 --until 0");
    expect(0, "what it begins from is kept in begun/from: 0.",
           "run bed.yaml -o begun --from gone --seeds 1..2 --set settle=false");
    assert_int_equal(system("mv gone elsewhere && cp -r begun cut && rm cut/state_00001.h5*"), 0);
    expect(0, "begun/from/state_0000", "run begun --replay -o again");
    assert_true(same_files("begun/seed_00001/series.csv", "again/seed_00001/series.csv"));
    assert_true(same_files("begun/seed_00002/final.csv", "again/seed_00002/final.csv"));
    expect(0, "", "run begun/seed_00002 --replay -o second");
    assert_true(same_files("begun/seed_00002/final.csv", "second/final.csv"));
    expect(0, "seed_00002 begins with cut/from/state_0000", "resume cut");
    assert_true(same_files("begun/seed_00002/series.csv", "cut/seed_00002/series.csv"));
    assert_true(same_files("begun/ensemble.csv", "cut/ensemble.csv"));
    expect(0, "", "run bed.yaml -o begun --overwrite --until 0");
    assert_false(is_there("begun/from"));
}

/* Where walls stand is told by what was running, not by the scene that the run began with. */
static void test_a_changed_run(void **state)
{
    (void)state;
    assert_int_equal(mkdir("plan", 0777), 0);
    write_file("plan/scene.yaml", "%s", bed);
    write_file("plan/reloads.csv", "%s",
               "step,time,key,old,new,rebuild_seconds\n"
               "200,0.004,walls.0.motion.frequency,50,100,\n");
    expect(0, "", "run plan --replay -o changed --set time.duration=0.025");
    expect(0, "grains are those of changed/state.h5",
           "run bed.yaml -o after --from changed --until 0.001 --set settle=false");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_settled_bed),   cmocka_unit_test(test_settled_dice),
        cmocka_unit_test(test_a_sweep),         cmocka_unit_test(test_a_branch_goes_on),
        cmocka_unit_test(test_what_is_refused), cmocka_unit_test(test_other_triangles),
        cmocka_unit_test(test_an_ensemble),     cmocka_unit_test(test_it_is_kept),
        cmocka_unit_test(test_a_changed_run),
    };
    return cmocka_run_group_tests(tests, make_beds, leave_work);
}
