/* A running scene is changed as people do it: files are edited in every way that editors have, and
 * what the run says, notes and computes of it is looked at. ORZO_NEEDS_DEVICE. */
#include "edited_run.h"

static int count_said(const char *text)
{
    char *all = read_file("said", NULL);
    int count = 0;
    for (char *at = strstr(all, text); at; at = strstr(at + 1, text)) {
        count++;
    }
    free(all);
    return count;
}

/* A bed of which half is there for a while, shorter than the run's patience of 0.2 s: no mistake.
 * On a busy machine the while may come out longer, and is tried again. */
static void write_slowly(const char *name, const char *friction)
{
    double held = 1;
    for (int tries = 0; tries < 20 && held > 0.15; tries++) {
        int before = count_said("goes on as it was");
        double start = now();
        write_file(name, "model: ro");
        rest(80);
        write_bed(name, friction, "2e-5");
        held = now() - start;
        rest(500);
        assert_true(held > 0.15 || count_said("goes on as it was") == before);
    }
    assert_true(held <= 0.15);
}

/* In place, by rename, cut off first, wrong in three ways, gone and back; ten in a second. */
static void test_edits(void **state)
{
    (void)state;
    write_bed("bed.yaml", "0.1", "2e-5");
    pid_t child = start("run bed.yaml --watch -o edited --set time.taps=1000000 --no-video");
    await("said", "first step");
    write_bed("bed.yaml", "0.2", "2e-5");
    await("said", "contact.friction 0.1 -> 0.2");
    write_bed("next.yaml", "0.3", "2e-5");
    rename("next.yaml", "bed.yaml");
    await("said", "contact.friction 0.2 -> 0.3");
    write_slowly("bed.yaml", "0.4");
    await("said", "contact.friction 0.3 -> 0.4");
    write_file("bed.yaml", "model: rods\nfriction 0.5\n");
    await("said", "the run goes on as it was");
    write_bed("bed.yaml", "0.4", "5e-4");
    await("said", "time.step 0.0005 s is unstable for a contact of two grains");
    write_file("bed.yaml", "precision: double\n%s", bed);
    await("said",
          "bed.yaml:1: precision runs with float, which cannot change: the grains' state is "
          "kept in it");
    remove("bed.yaml");
    await("said", "bed.yaml");
    rest(600);
    write_bed("bed.yaml", "0.5", "2e-5");
    await("said", "contact.friction 0.4 -> 0.5");
    for (int i = 0; i < 10; i++) {
        char friction[8];
        snprintf(friction, sizeof friction, "0.6%d", i);
        write_bed("bed.yaml", friction, "2e-5");
        rest(100);
    }
    await("said", "-> 0.69");
    write_bed("bed.yaml", "0",
              "2e-5"); /* other kernels, and another change before they are built */
    rest(100);
    write_bed("bed.yaml", "0.7", "2e-5");
    await("said", "contact.friction 0 -> 0.7");
    rest(300);
    kill(child, SIGTERM);
    assert_int_equal(end_of(child), 130);
    assert_true(contains("edited/scene.yaml", "friction: 0.1"));
    assert_true(contains("edited/scene_final.yaml", "friction: 0.7"));
    assert_true(contains("edited/reloads.csv", "interrupted"));
    run_again("edited");
}

/* Of a scene that extends another, that one's file counts too; walls' motion goes on in phase. */
static void test_base_and_motion(void **state)
{
    (void)state;
    write_bed("base.yaml", "0.1", "2e-5");
    write_file("upper.yaml", "extends: base.yaml\ntime: {taps: 1000000}\n");
    pid_t child = start("run upper.yaml --watch -o based --no-video");
    await("said", "first step");
    char *text = read_file("base.yaml", NULL), *ratio = strstr(text, "acceleration_ratio: 2");
    ratio[strlen("acceleration_ratio: ")] = '4';
    write_file("base.yaml", "%s", text);
    await("said", "walls.0.motion.acceleration_ratio 2 -> 4"); /* at a crossing, or from the next */
    memcpy(strstr(text, "frequency: 50"), "frequency: 40", 13);
    write_file("base.yaml", "%s", text);
    await("said", "walls.0.motion.frequency 50 -> 40");
    free(text);
    rest(300);
    kill(child, SIGTERM);
    assert_int_equal(end_of(child), 130);
    assert_reloads("based/reloads.csv", "key,old,new\n"
                                        "walls.0.motion.acceleration_ratio,2,4\n"
                                        "walls.0.motion.frequency,50,40\n"
                                        "end,,interrupted\n");
    run_again("based");
}

/* A run that ends when it is stopped, or when a change gives it an end; it can go on, and be
 * repeated up to where it was stopped. */
static void test_endless(void **state)
{
    (void)state;
    char text[sizeof bed + 100];
    snprintf(text, sizeof text, "%s", bed);
    char *taps = strstr(text, "taps: 2}"), tail[sizeof bed];
    snprintf(tail, sizeof tail, "%s", taps + strlen("taps: 2}"));
    *taps = '\0';
    write_file("bed.yaml", "%sduration: endless}%s", text, tail);
    pid_t child = start("run bed.yaml -o stopped --no-video");
    await("said", "first step");
    await("said", "until it is stopped");
    kill(child, SIGTERM);
    assert_int_equal(end_of(child), 130);
    assert_true(contains("stopped/scene.yaml", "duration: endless"));
    assert_reloads("stopped/reloads.csv", "key,old,new\nend,,interrupted\n");
    child = start("resume stopped");
    await("said", "until it is stopped");
    kill(child, SIGTERM);
    assert_int_equal(end_of(child), 130);
    run_again("stopped");
    child = start("run bed.yaml -o given --watch --no-video");
    await("said", "first step");
    write_file("bed.yaml", "%staps: 3}%s", text, tail);
    assert_int_equal(end_of(child), 0);
    assert_reloads("given/reloads.csv",
                   "key,old,new\ntime.duration,endless,\ntime.taps,,3\nend,,done\n");
    run_again("given");
    write_file("bed.yaml", "%sduration: endless}%s", text, tail);
    assert_int_equal(end_of(start("run bed.yaml -o seeds --seeds 1..2")), 2);
    assert_true(contains("said", "an endless run of an ensemble"));
    assert_int_equal(end_of(start("run bed.yaml -o seeds --seeds 1..2 --until 1e-3 --no-video")),
                     0);
}

/* The ledger is asked for in mid-run, and given up: its columns come, and are empty before and
 * after. */
static void test_ledger(void **state)
{
    (void)state;
    write_bed("bed.yaml", "0.1", "2e-5");
    pid_t child = start("run bed.yaml --watch -o summed --set time.taps=1000000 --no-video");
    await("said", "first step");
    await("summed/series.csv", "\n500,");
    char *text = read_file("bed.yaml", NULL), *at = strstr(text, "observe: {");
    *at = '\0';
    write_file("bed.yaml", "%sobserve: {interval_taps: 0.5, ledger: true, walls: true}\n", text);
    await("said", "observe.ledger false -> true");
    await("summed/series.csv", "wall0_fz");
    rest(300);
    write_file("bed.yaml", "%sobserve: {interval_taps: 0.5}\n", text);
    await("said", "observe.ledger true -> false");
    free(text);
    rest(300);
    kill(child, SIGTERM);
    assert_int_equal(end_of(child), 130);
    run_again("summed");
}

/* More grains than a small scene has: sorted anew as they move, of which a replay must make the
 * same. */
static void test_large(void **state)
{
    (void)state;
    static const char lattice[] =
        "model: rods\n"
        "time: {step: 2e-5, duration: 0.03}\n"
        "contact: {contact_time: 6e-4, restitution: 0.5, friction: %s}\n"
        "grains: [{kind: random, count: 9000, diameter: 1e-3, aspect: 2}]\n"
        "walls:\n"
        "  - {kind: plane, motion: {frequency: 50, acceleration_ratio: 4}}\n"
        "  - {kind: cylinder, diameter: 2e-2}\n"
        "observe: {interval: 1e-3}\n";
    write_file("large.yaml", lattice, "0.1");
    pid_t child = start("run large.yaml --watch -o large --no-video");
    await("large/series.csv", "\n100,");
    write_file("large.yaml", lattice, "0.3");
    await("said", "contact.friction 0.1 -> 0.3");
    assert_int_equal(end_of(child), 0);
    assert_reloads("large/reloads.csv", "key,old,new\ncontact.friction,0.1,0.3\nend,,done\n");
    run_again("large");
}

/* SIGHUP reads the file again without --watch, which nobody else does. */
static void test_signal(void **state)
{
    (void)state;
    write_bed("bed.yaml", "0.1", "2e-5");
    pid_t child = start("run bed.yaml -o told --set time.taps=1000000 --no-video");
    await("said", "first step");
    write_bed("bed.yaml", "0.2", "2e-5");
    rest(800);
    assert_false(contains("said", "-> 0.2"));
    kill(child, SIGHUP);
    await("said", "contact.friction 0.1 -> 0.2");
    kill(child, SIGTERM);
    assert_int_equal(end_of(child), 130);
    run_again("told");
}

/* Interrupted after a change of taps and of kernels, and gone on with from its last state: the run
 * that makes the same changes without a stop has the same bytes. */
static void test_resumed(void **state)
{
    (void)state;
    write_bed("bed.yaml", "0.1", "2e-5");
    pid_t child = start("run bed.yaml --watch -o left --set time.taps=1000000 --no-video");
    await("said", "first step");
    char *text = read_file("bed.yaml", NULL);
    memcpy(strstr(text, "frequency: 50"), "frequency: 41", 13);
    memcpy(strstr(text, "friction: 0.1"), "friction: 0.0", 13);
    write_file("bed.yaml", "%s", text);
    free(text);
    await("said", "contact.friction 0.1 -> 0");
    rest(100);
    kill(child, SIGTERM);
    assert_int_equal(end_of(child), 130);
    text = read_file("left/final.csv", NULL);
    char *log = read_file("left/reloads.csv", NULL), command[100];
    char *row = strstr(log, "end,,interrupted");
    assert_non_null(row);
    while (row[-1] != '\n') {
        row--;
    }
    double end = atof(row); /* its step */
    snprintf(command, sizeof command, "resume left --until %.6f", end * 2e-5 + 0.5);
    free(text);
    free(log);
    assert_int_equal(end_of(start(command)), 0);
    assert_false(contains("left/reloads.csv", "interrupted"));
    snprintf(command, sizeof command, "run left --replay -o whole --no-video --until %.6f",
             end * 2e-5 + 0.5);
    assert_int_equal(end_of(start(command)), 0);
    assert_true(same_files("left/series.csv", "whole/series.csv"));
    assert_true(same_files("left/final.csv", "whole/final.csv"));
}

/* The bed with a sweep. */
static void write_swept(const char *friction, const char *step)
{
    write_bed("part.yaml", friction, step);
    char *text = read_file("part.yaml", NULL);
    write_file("swept.part", "%ssweep: {contact.friction: [0.2, 0.3]}\n", text);
    free(text);
    rename("swept.part", "swept.yaml");
}

/* Members take a change all alike; what they differ in is refused. */
static void test_members(void **state)
{
    (void)state;
    write_swept("0.1", "2e-5");
    pid_t child = start("run swept.yaml --watch -o many --no-video --set time.taps=1000000");
    await("said", "first step");
    write_swept("0.5", "2e-5");
    await("said", "contact.friction runs with 0.1, which cannot change: members differ in it");
    write_swept("0.1", "1e-5");
    await("many/friction_0.2/reloads.csv", "time.step");
    await("many/friction_0.3/reloads.csv", "time.step");
    kill(child, SIGTERM);
    assert_int_equal(end_of(child), 130);
    run_again("many/friction_0.3");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_edits),   cmocka_unit_test(test_base_and_motion),
        cmocka_unit_test(test_endless), cmocka_unit_test(test_ledger),
        cmocka_unit_test(test_large),   cmocka_unit_test(test_signal),
        cmocka_unit_test(test_members), cmocka_unit_test(test_resumed),
    };
    return cmocka_run_group_tests(tests, enter_work, leave_work);
}
