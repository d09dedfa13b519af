/* `orzo bench --quick` with a tiny ladder runs, and leaves a table of finite positive numbers and a
 * picture. No speed is asserted. ORZO_NEEDS_DEVICE. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

enum { TEXT_MAX = 1 << 16, COLUMNS_MAX = 64 };

static void run(const char *format, const char *folder, int expected)
{
    char command[2048];
    snprintf(command, sizeof command, format, ORZO_PROGRAM, folder, folder);
    int status = system(command);
    if (status != expected) {
        snprintf(command, sizeof command, "cat '%s/said'", folder);
        assert_int_equal(system(command), 0);
    }
    assert_int_equal(status, expected);
}

static void run_arguments(const char *arguments)
{
    char command[4096];
    snprintf(command, sizeof command, "'%s' %s", ORZO_PROGRAM, arguments);
    assert_int_equal(system(command), 0);
}

static long long file_size(const char *folder, const char *name)
{
    char path[1024];
    struct stat info;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return stat(path, &info) == 0 ? (long long)info.st_size : -1;
}

/* Cuts a row at its commas; returns the number of cells. */
static int cut_row(char *line, char *cells[COLUMNS_MAX])
{
    int count = 0;
    line[strcspn(line, "\n")] = '\0';
    for (char *at = line; at && count < COLUMNS_MAX;) {
        cells[count++] = at;
        at = strchr(at, ',');
        if (at) {
            *at++ = '\0';
        }
    }
    return count;
}

/* Whether a column may be empty or zero: what a scene does not have. */
static bool may_be_absent(const char *column)
{
    return strcmp(column, "observe_us_per_step") == 0 || strcmp(column, "steps_per_rebuild") == 0 ||
           strcmp(column, "touching_per_grain") == 0;
}

/* Returns the number of rows of bench.csv, every cell checked. */
static int check_table(const char *folder)
{
    char path[1024], head[4096], line[4096], *names[COLUMNS_MAX], *cells[COLUMNS_MAX];
    int rows = 0;
    snprintf(path, sizeof path, "%s/bench.csv", folder);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(head, sizeof head, file));
    int columns = cut_row(head, names);
    assert_true(columns > 15);
    for (; fgets(line, sizeof line, file); rows++) {
        assert_int_equal(cut_row(line, cells), columns);
        if (strcmp(cells[0], "yardstick") == 0) {
            continue; /* another program: most of its cells are empty */
        }
        for (int c = 1; c < columns; c++) {
            char *end = NULL;
            double value = strtod(cells[c], &end);
            bool sound = end != cells[c] && *end == '\0' && isfinite(value) && value > 0;
            if (!sound && !may_be_absent(names[c])) {
                fail_msg("row %d: %s is '%s'", rows, names[c], cells[c]);
            }
        }
    }
    fclose(file);
    return rows;
}

/* Each size by each view, with a positive number of pictures a second. */
static void check_pictures(const char *folder)
{
    char path[1024], line[256], view[16];
    int rows = 0, width = 0, height = 0;
    double milliseconds = 0, per_second = 0;
    snprintf(path, sizeof path, "%s/pictures.csv", folder);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    for (; fgets(line, sizeof line, file); rows++) {
        assert_int_equal(sscanf(line, "%d,%d,%15[a-z],%lf,%lf", &width, &height, view,
                                &milliseconds, &per_second),
                         5);
        assert_true(width > 0 && height > 0 && milliseconds > 0 && per_second > 0);
    }
    fclose(file);
    assert_int_equal(rows, 12);
}

static void expect_said(const char *folder, const char *text)
{
    char command[2048];
    snprintf(command, sizeof command, "grep -q -- \"%s\" '%s/said'", text, folder);
    assert_int_equal(system(command), 0);
}

/* bench.json beside itself: every row is found again, as it is; another file is refused at once. */
static void check_record(const char *folder)
{
    char command[2048];
    assert_true(file_size(folder, "bench.json") > 1000);
    expect_said(folder, "first step after [0-9.]* s where kernels are built");
    snprintf(command, sizeof command,
             "bench --quick --device cpu --threads 1 --budget 1 --set grains.0.count=100 --set "
             "settle.rest_time=0.01 --set settle.threshold=0.1 --sizes 100 --compare "
             "'%s/bench.json' -o '%s/again' >'%s/said' 2>&1",
             folder, folder, folder);
    run_arguments(command);
    expect_said(folder, "^box, float, 1 thread, 100 grains *[0-9.]* *[0-9.]* *[0-9.]*");
    expect_said(folder, "^first step, kernels kept, s *[0-9.]* *[0-9.]* *[0-9.]*");
    run("'%s' bench --quick --compare '%s/shares.csv' -o '%s/no' >/dev/null 2>&1", folder, 2 << 8);
}

/* A ladder of a bed that settles by itself and of one that is paved. */
static void test_tiny_ladder(void **state)
{
    (void)state;
    char folder[] = "/tmp/orzo_test_bench_XXXXXX", tidy[64];
    assert_non_null(mkdtemp(folder));
    run("'%s' bench --quick --device cpu --threads 1 --budget 1 --set grains.0.count=100 --set "
        "settle.rest_time=0.01 --set settle.threshold=0.1 --sizes "
        "100,300 -o '%s' "
        ">'%s/said' 2>&1",
        folder, 0);
    assert_true(check_table(folder) >= 6); /* an6 and two sizes, in float and double */
    assert_true(file_size(folder, "shares.csv") > 0);
    check_record(folder);
    check_pictures(folder);
    if (system("command -v gnuplot >/dev/null") == 0) {
        assert_true(file_size(folder, "bench.png") > 1000);
    }
    snprintf(tidy, sizeof tidy, "rm -r '%s'", folder);
    assert_int_equal(system(tidy), 0);
}

static void test_nonsense_is_refused(void **state)
{
    (void)state;
    char folder[] = "/tmp/orzo_test_bench_XXXXXX", tidy[64];
    assert_non_null(mkdtemp(folder));
    run("'%s' bench --quick --sizes 250,many -o '%s' >'%s/said' 2>&1", folder, 2 << 8);
    run("'%s' bench --quick --budget 0 -o '%s' >'%s/said' 2>&1", folder, 2 << 8);
    snprintf(tidy, sizeof tidy, "rm -r '%s'", folder);
    assert_int_equal(system(tidy), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nonsense_is_refused),
        cmocka_unit_test(test_tiny_ladder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
