/* `orzo run DIR --replay`: a run that was edited while it went is made again, to the byte.
 * ORZO_NEEDS_DEVICE. */
#include "edited_run.h"

/* Trigrains of test_state, in a drum-like vessel that is shaken. */
static const char flat[] =
    "model: trigrains\n"
    "time: {step: 4e-6, duration: 100}\n"
    "gravity: [20, -200]\n"
    "integrator: gear4\n"
    "grains: [{kind: random, count: 12, shape: polygon, corners: [3, 5], radius: [1e-3, 2e-3]}]\n"
    "walls:\n"
    "  - {kind: vessel, width: 15e-3, height: 3e-2, motion: {frequency: 500, "
    "acceleration_ratio: 1}}\n"
    "observe: {ledger: true, interval: 1e-3}\n";

/* In double, and of trigrains, whose state is counted in steps. */
static void test_replay_of_others(void **state)
{
    (void)state;
    write_bed("bed.yaml", "0.1", "2e-5");
    pid_t child = start("run bed.yaml --watch -o double --set time.taps=1000000 --no-video "
                        "--precision double");
    await("said", "first step");
    write_bed("bed.yaml", "0.4", "1e-5");
    await("said", "time.step 2e-05 -> 1e-05");
    kill(child, SIGTERM);
    assert_int_equal(end_of(child), 130);
    run_again("double");
    write_file("flat.yaml", "%s", flat);
    child = start("run flat.yaml --watch -o flat --no-video");
    await("said", "first step");
    char *text = read_file("flat.yaml", NULL);
    memcpy(strstr(text, "-200"), "-150", 4);
    memcpy(strstr(text, "4e-6"), "3e-6", 4);
    write_file("flat.yaml", "%s", text);
    await("said", "gravity [20, -200] -> [20, -150]");
    free(text);
    rest(200);
    kill(child, SIGTERM);
    assert_int_equal(end_of(child), 130);
    run_again("flat");
}

/* Those that are side by side take a change at steps of their own. */
static void test_replay_of_members(void **state)
{
    (void)state;
    write_bed("bed.yaml", "0.1", "2e-5");
    pid_t child = start("run bed.yaml --watch -o several --set time.taps=1000000 --no-video "
                        "--seeds 1..2 --set sweep={\"contact.restitution\":[0.4,0.6]}");
    await("said", "first step");
    write_bed("bed.yaml", "0.4", "2e-5");
    await("said", "contact.friction 0.1 -> 0.4");
    write_bed("bed.yaml", "0", "1e-5");
    await("said", "time.step 2e-05 -> 1e-05");
    rest(200);
    kill(child, SIGTERM);
    assert_int_equal(end_of(child), 130);
    assert_int_equal(end_of(start("run several --replay -o again_several --no-video")), 0);
    static const char *const members[] = {
        "restitution_0.4_seed_00001", "restitution_0.4_seed_00002", "restitution_0.6_seed_00001",
        "restitution_0.6_seed_00002"};
    for (int m = 0; m < 4; m++) {
        assert_repeated("several", "again_several", members[m]);
        char reloads[100];
        snprintf(reloads, sizeof reloads, "again_several/%s/reloads.csv", members[m]);
        assert_reloads(reloads, "key,old,new\n"
                                "contact.friction,0.1,0.4\n"
                                "time.step,2e-05,1e-05\n"
                                "contact.friction,0.4,0\n"
                                "end,,done\n");
    }
    assert_int_equal(system("rm several/state_*"), 0);
    assert_int_equal(
        end_of(start("run several/restitution_0.6_seed_00002 --replay -o one --no-video")), 0);
    assert_true(same_files("one/final.csv", "several/restitution_0.6_seed_00002/final.csv"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_replay_of_others),
        cmocka_unit_test(test_replay_of_members),
    };
    return cmocka_run_group_tests(tests, enter_work, leave_work);
}
