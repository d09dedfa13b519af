/* Streams that the starter closed, that are full, and whose reader leaves: what is printed fails
 * or is lost, files and exit statuses do not. ORZO_NEEDS_DEVICE. */
#include "program.h"

/* Kernels of test_run's bed; few steps. */
static const char bed[] = "model: rods\n"
                          "time: {step: 2e-5, taps: 1}\n"
                          "contact: {contact_time: 6e-4, restitution: 0.5}\n"
                          "grains:\n"
                          "  - {kind: random, count: 29, diameter: 1e-3, aspect: 2}\n"
                          "  - {kind: random, count: 1, diameter: 1e-3, aspect: 1}\n"
                          "walls:\n"
                          "  - {kind: plane, motion: {frequency: 50, acceleration_ratio: 2}}\n"
                          "  - {kind: cylinder, diameter: 8e-3}\n"
                          "settle: {drag: 70, time_max: 0.02, rest_time: 0.01}\n"
                          "observe: {interval_taps: 0.5}\n";

static int make_bed(void **state)
{
    if (enter_work(state) != 0) {
        return -1;
    }
    write_file("bed.yaml", "%s", bed);
    return 0;
}

/* A line of the shell, with ORZO in place of the program; its exit status. */
static int shell(const char *line)
{
    char command[1024];
    snprintf(command, sizeof command, "ORZO='%s'; %s", ORZO_PROGRAM, line);
    int status = system(command);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

/* What a scheduler does: none of the three streams is there. The files that the program opens must
 * not take their numbers, or its log goes into its tables. */
static void test_closed_streams_spoil_no_file(void **state)
{
    (void)state;
    assert_int_equal(shell("$ORZO run bed.yaml -o open --no-video "
                           "--set 'sweep={contact.friction: [0.2, 0.5]}' 2>said"),
                     0);
    assert_int_equal(shell("$ORZO run bed.yaml -o closed --no-video "
                           "--set 'sweep={contact.friction: [0.2, 0.5]}' <&- >&- 2>&-"),
                     0);
    static const char *const tables[] = {"members.csv", "ensemble.csv", "friction_0.2/series.csv",
                                         "friction_0.5/series.csv", "friction_0.5/final.csv"};
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++) {
        char one[64], other[64];
        snprintf(one, sizeof one, "open/%s", tables[i]);
        snprintf(other, sizeof other, "closed/%s", tables[i]);
        assert_true(same_files(one, other));
    }
    assert_true(contains("closed/log.txt", "first step"));
}

/* Closed alone, stderr is the number that log.txt would get: each line would be in it twice. */
static void test_closed_stderr_spoils_no_log(void **state)
{
    (void)state;
    assert_int_equal(shell("$ORZO run bed.yaml -o mute --no-video --until 0 2>&-"), 0);
    assert_int_equal(shell("test $(grep -c 'first step' mute/log.txt) = 1"), 0);
}

/* Whoever asks for a text and does not get it must be told so. */
static void test_full_or_closed_stdout_is_a_failure(void **state)
{
    (void)state;
    static const char *const commands[] = {"keys",      "keys --columns", "devices",       "--help",
                                           "--version", "run --help",     "check bed.yaml"};
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        char line[256];
        snprintf(line, sizeof line, "$ORZO %s >/dev/full 2>said", commands[i]);
        assert_int_equal(shell(line), 1);
        assert_true(contains("said", "what was printed did not all arrive: "));
        snprintf(line, sizeof line, "$ORZO %s >&- 2>said", commands[i]);
        assert_int_equal(shell(line), 1);
        assert_true(contains("said", "what was printed did not all arrive"));
    }
    /* The command's own failure comes first. */
    assert_int_equal(shell("$ORZO check bed.yaml --set time.step=1 >/dev/full 2>said"), 2);
    /* It prints nothing there, so there is nothing to miss. */
    assert_int_equal(shell("$ORZO run bed.yaml -o full --no-video --until 0 >/dev/full 2>said"), 0);
}

/* `head` takes a line and leaves; the shell keeps the program's exit status, 141 had it died of
 * SIGPIPE. */
static void test_reader_that_leaves_ends_nothing(void **state)
{
    (void)state;
    shell("($ORZO keys 2>said; echo $? >keys) | head -1 >line");
    assert_int_equal(shell("test \"$(cat keys)\" = 0 && test ! -s said"), 0);
    shell("($ORZO check bed.yaml 2>said; echo $? >check) | head -1 >line");
    assert_int_equal(shell("test \"$(cat check)\" = 0"), 0);
    assert_false(contains("said", "printed"));
    shell("($ORZO run bed.yaml -o left --no-video 2>&1; echo $? >left_status) | head -1 >line");
    assert_int_equal(shell("test \"$(cat left_status)\" = 0"), 0);
    assert_int_equal(count_lines("left/final.csv"), 31);
    assert_true(contains("left/log.txt", "1000 steps in "));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closed_streams_spoil_no_file),
        cmocka_unit_test(test_closed_stderr_spoils_no_log),
        cmocka_unit_test(test_full_or_closed_stdout_is_a_failure),
        cmocka_unit_test(test_reader_that_leaves_ends_nothing),
    };
    return cmocka_run_group_tests(tests, make_bed, leave_work);
}
