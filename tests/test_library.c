/* liborzo as it is installed: programs in C and C++ that find it with pkg-config, and say the bytes
 * that the program does. ORZO_NEEDS_DEVICE. */
#include "program.h"
#include "run_bed.h"

#include <libgen.h>

/* A command in the test's folder, which must succeed; what it says goes to the file `said`. */
static void expect_command(const char *format, ...)
{
    char command[2048];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(command, sizeof command, format, arguments);
    va_end(arguments);
    if (system(command) != 0) {
        fail_msg("%s\n%s", command, is_there("said") ? read_file("said", NULL) : "");
    }
}

static char *find_build(void)
{
    static char program[] = ORZO_PROGRAM;
    return dirname(program);
}

static void compile(const char *compiler, const char *source, const char *out)
{
    expect_command("export PKG_CONFIG_PATH=$(dirname $(find $PWD/tree -name orzo.pc)) && %s "
                   "-Wall -Wextra -Wpedantic -Werror -o %s '%s/library/%s' "
                   "$(pkg-config --cflags --libs orzo) -pthread -lm >said 2>&1",
                   compiler, out, ORZO_TESTS, source);
}

#define WITH_LIBRARY "LD_LIBRARY_PATH=$(dirname $(find $PWD/tree -name liborzo.so)) "

static int install_and_compile(void **state)
{
    if (enter_work(state) != 0) {
        return -1;
    }
    write_file("bed.yaml", "%s", bed);
    expect_command("cmake --install '%s' --prefix $PWD/tree >said 2>&1", find_build());
    compile("cc -std=gnu17", "first.c", "first_c");
    compile("c++ -std=c++17", "first.cpp", "first_cpp");
    compile("cc -std=gnu17", "calls.c", "calls");
    return 0;
}

/* Places at the end are final.csv's, to the byte. */
static void test_bytes_of_the_program(void **state)
{
    (void)state;
    expect(0, "30 grains", "run bed.yaml -o run --no-video");
    expect_command("tail -n +2 run/final.csv | cut -d, -f2-4 >places");
    expect_command(WITH_LIBRARY "./first_c bed.yaml >places_c 2>said");
    expect_command(WITH_LIBRARY "./first_cpp bed.yaml >places_cpp 2>said");
    assert_int_equal(count_lines("places"), 30);
    assert_true(same_files("places", "places_c"));
    assert_true(same_files("places", "places_cpp"));
}

static void test_calls(void **state)
{
    (void)state;
    expect_command(WITH_LIBRARY "./calls bed.yaml >said 2>&1");
    assert_int_equal(count_lines("said"), 0); /* it prints nothing */
}

/* Nothing but the calls of the header, and all of these. */
static void test_names(void **state)
{
    (void)state;
    expect_command("nm -D --defined-only $(find $PWD/tree -name liborzo.so) | awk '{print $3}' | "
                   "sort >names");
    expect_command("sed -nE 's/^ORZO_API .*[ *](orzo_[a-z_]+)\\(.*/\\1/p' tree/include/orzo.h | "
                   "sort >calls_of_header");
    assert_true(count_lines("names") > 25);
    assert_true(same_files("names", "calls_of_header"));
    expect_command("test \"$(PKG_CONFIG_PATH=$(dirname $(find $PWD/tree -name orzo.pc)) "
                   "pkg-config --modversion orzo)\" = " ORZO_VERSION);
    expect_command("test \"$(awk '/define ORZO_VERSION_/ {printf \"%%s%%s\", d, $3; d = \".\"}' "
                   "tree/include/orzo.h)\" = " ORZO_VERSION);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bytes_of_the_program),
        cmocka_unit_test(test_calls),
        cmocka_unit_test(test_names),
    };
    return cmocka_run_group_tests(tests, install_and_compile, leave_work);
}
