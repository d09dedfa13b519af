/* The README's first command, with one tap: it runs an6 on whatever device there is and leaves a
 * movie, pictures and numbers. ORZO_NEEDS_DEVICE. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

static long long file_size(const char *folder, const char *name)
{
    char path[1024];
    struct stat info;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return stat(path, &info) == 0 ? (long long)info.st_size : -1;
}

static int count_lines(const char *folder, const char *name)
{
    char path[1024];
    int lines = 0;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    for (int c = fgetc(file); c != EOF; c = fgetc(file)) {
        lines += c == '\n';
    }
    fclose(file);
    return lines;
}

/* Runs the script with this argument, its output kept in a file; returns its exit status as
 * system(). */
static int run_demo(const char *folder, const char *taps)
{
    char command[4096];
    snprintf(command, sizeof command,
             "ORZO_PROGRAM='%s' ORZO_OUT='%s/out' '%s/demo.sh' '%s' >'%s/said' 2>&1", ORZO_PROGRAM,
             folder, ORZO_SCENES, taps, folder);
    return system(command);
}

static void test_one_tap(void **state)
{
    (void)state;
    char folder[] = "/tmp/orzo_test_demo_XXXXXX", out[64], tidy[64];
    assert_non_null(mkdtemp(folder));
    snprintf(out, sizeof out, "%s/out", folder);
    snprintf(tidy, sizeof tidy, "rm -r '%s'", folder);
    if (run_demo(folder, "1") != 0) {
        snprintf(tidy, sizeof tidy, "cat '%s/said'", folder);
        assert_int_equal(system(tidy), 0);
        fail_msg("the demo failed");
    }
    assert_true(file_size(out, "movie.mp4") > 10000);
    assert_true(file_size(out, "snapshots") > 0);
    assert_true(file_size(out, "scene.yaml") > 0);
    assert_int_equal(count_lines(out, "series.csv"), 3);   /* names, tap 0, tap 1 */
    assert_int_equal(count_lines(out, "final.csv"), 1001); /* names, 1000 grains  */
    assert_int_equal(system(tidy), 0);
}

static void test_nonsense_is_refused(void **state)
{
    (void)state;
    char folder[] = "/tmp/orzo_test_demo_XXXXXX", tidy[64];
    assert_non_null(mkdtemp(folder));
    assert_int_not_equal(run_demo(folder, "many"), 0);
    assert_int_not_equal(run_demo(folder, "0"), 0);
    snprintf(tidy, sizeof tidy, "rm -r '%s'", folder);
    assert_int_equal(system(tidy), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nonsense_is_refused),
        cmocka_unit_test(test_one_tap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
