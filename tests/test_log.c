/* Lines for people: what a pipe or a file gets of progress and of long stages, and what log.txt
 * gets. */
#include "base/log.h"

#include "base/clock.h"
#include "base/stage.h"

#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

static char folder[] = "/tmp/orzo_log_XXXXXX", said[64], kept[64];

/* A log of this thread on the file `said`, whose progress has this pace, s. */
static OzLog *begin(double pace)
{
    OzLog *log = NULL;
    FILE *stream = fopen(said, "w");
    assert_non_null(stream);
    setvbuf(stream, NULL, _IONBF, 0);
    assert_int_equal(oz_log_create(&log, stream, false), OZ_OK);
    assert_null(oz_log_use(log));
    oz_log_pace(pace);
    return log;
}

static void end(OzLog *log)
{
    FILE *stream = oz_log_stream();
    assert_ptr_equal(oz_log_use(NULL), log);
    oz_log_free(log);
    fclose(stream);
}

static int count_lines(const char *path, const char *holding)
{
    char line[256];
    int count = 0;
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        count += strstr(line, holding) != NULL;
    }
    fclose(file);
    return count;
}

static void nap(double seconds)
{
    struct timespec time = {.tv_nsec = (long)(1e9 * seconds)};
    nanosleep(&time, NULL);
}

/* Calls without end for three paces and a half: a line at the end of each whole pace, the first
 * pace beginning with the first call. A machine too busy to call in time gets fewer, never more. */
static void test_progress_in_a_file_is_a_line_a_pace(void **state)
{
    (void)state;
    const double pace = 0.2;
    double start = oz_clock_now(), spent = 0;
    OzLog *log = begin(pace);
    while (spent < 3.5 * pace) {
        oz_log_progress("%.0f %% done", 12.0);
        nap(1e-3);
        spent = oz_clock_now() - start;
    }
    oz_log_progress("%.0f %% done", 12.0);
    spent = oz_clock_now() - start;
    end(log);
    int count = count_lines(said, "12 % done\n");
    assert_in_range(count, 1, (int)(spent / pace));
    assert_int_equal(count_lines(said, ""), count);
}

static void test_blank_progress_is_no_line(void **state)
{
    (void)state;
    OzLog *log = begin(0);
    oz_log_progress(" ");
    oz_log_progress("%s", "");
    oz_log_progress("here");
    end(log);
    assert_int_equal(count_lines(said, ""), 1);
    assert_int_equal(count_lines(said, "here"), 1);
}

static void test_progress_never_reaches_the_log(void **state)
{
    (void)state;
    OzLog *log = begin(0);
    assert_int_equal(oz_log_open(log, kept), OZ_OK);
    oz_log_line("begun");
    oz_log_progress("half");
    end(log);
    assert_int_equal(count_lines(said, "half"), 1);
    assert_int_equal(count_lines(kept, "half"), 0);
    assert_int_equal(count_lines(kept, "begun"), 1);
}

/* Lines from before the file are its first, in their order, and each is there once. */
static void test_lines_wait_for_their_file(void **state)
{
    (void)state;
    OzLog *log = NULL;
    char text[256];
    assert_int_equal(oz_log_create(&log, NULL, true), OZ_OK);
    oz_log_use(log);
    oz_log_line("first");
    oz_log_detail("second");
    for (int i = 0; i < 3; i++) {
        oz_log_once("%d: said once", i);
    }
    assert_int_equal(oz_log_open(log, kept), OZ_OK);
    oz_log_line("third");
    oz_log_once("said %s", "after");
    oz_log_use(NULL);
    oz_log_free(log);
    FILE *file = fopen(kept, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    assert_string_equal(text, "first\nsecond\n0: said once\nthird\nsaid after\n");
}

/* /dev/full takes nothing: said once, and lines go on on stderr. */
static void test_log_that_cannot_be_written_is_said_once(void **state)
{
    (void)state;
    OzLog *log = begin(0);
    assert_int_equal(oz_log_open(log, "/dev/full"), OZ_OK);
    oz_log_line("one");
    oz_log_line("two");
    end(log);
    assert_int_equal(count_lines(said, "log.txt cannot be written"), 1);
    assert_int_equal(count_lines(said, "No space left"), 1);
    assert_int_equal(count_lines(said, "two"), 1);
}

static void wait_for_line(const char *holding)
{
    double end = oz_clock_now() + 30;
    while (count_lines(said, holding) == 0) {
        assert_true(oz_clock_now() < end);
        nap(1e-2);
    }
}

/* A stage is named after a second, once, in the log too; how far it is comes after that. */
static void test_stage_that_lasts_is_named(void **state)
{
    (void)state;
    OzStage stage;
    double start = oz_clock_now();
    OzLog *log = begin(0);
    assert_int_equal(oz_log_open(log, kept), OZ_OK);
    oz_stage_begin(&stage, "baking %d loaves", 7);
    wait_for_line("baking");
    double named = oz_clock_now() - start;
    wait_for_line("baking 7 loaves: ");
    oz_stage_say(&stage, "baking: half done");
    wait_for_line("baking: half done\n");
    oz_stage_end(&stage);
    int lines = count_lines(said, "");
    nap(0.4);
    end(log);
    assert_true(named >= 1);
    assert_int_equal(count_lines(said, "baking 7 loaves ...\n"), 1);
    assert_int_equal(count_lines(said, ""), lines);
    assert_int_equal(count_lines(kept, "baking"), 1);
}

static void test_durations_in_words(void **state)
{
    (void)state;
    const struct {
        double seconds;
        const char *words;
    } rows[] = {{0, "0 s"},
                {0.0451, "0.045 s"},
                {0.96, "1.0 s"},
                {9.94, "9.9 s"},
                {9.96, "10 s"},
                {119.4, "119 s"},
                {119.6, "2 min 0 s"},
                {250, "4 min 10 s"},
                {7199.7, "2 h 0 min"},
                {8000, "2 h 13 min"},
                {86400, "24 h 0 min"},
                {172800, "2 days 0 h"},
                {442800, "5 days 3 h"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char words[48];
        oz_clock_words(rows[i].seconds, words, sizeof words);
        assert_string_equal(words, rows[i].words);
    }
}

static void test_short_stage_says_nothing(void **state)
{
    (void)state;
    OzStage stage;
    OzLog *log = begin(0);
    oz_stage_begin(&stage, "crumbs");
    oz_stage_say(&stage, "crumbs: 3");
    oz_stage_end(&stage);
    end(log);
    assert_int_equal(count_lines(said, ""), 0);
}

static int make_folder(void **state)
{
    (void)state;
    bool made = mkdtemp(folder) != NULL;
    snprintf(said, sizeof said, "%s/said", folder);
    snprintf(kept, sizeof kept, "%s/kept", folder);
    return made ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink(said);
    unlink(kept);
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_progress_in_a_file_is_a_line_a_pace),
        cmocka_unit_test(test_blank_progress_is_no_line),
        cmocka_unit_test(test_progress_never_reaches_the_log),
        cmocka_unit_test(test_lines_wait_for_their_file),
        cmocka_unit_test(test_log_that_cannot_be_written_is_said_once),
        cmocka_unit_test(test_stage_that_lasts_is_named),
        cmocka_unit_test(test_short_stage_says_nothing),
        cmocka_unit_test(test_durations_in_words),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
