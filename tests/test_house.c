/* The house's own rules, read off its sources and its library: which room may include which, which
 * room alone knows an outside library, and that a linking name tells the file it is in. */
#include <glob.h>
#include <libgen.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { NAME_SIZE = 256, LINE_SIZE = 4096 };

/* Rooms in floors: a room includes itself and lower floors only. Files directly under host/ are
 * rooms of their own. draw and compute share a floor, so neither sees the other; both see a
 * snapshot. */
static const struct {
    const char *name;
    int floor;
} rooms[] = {
    {"base", 0},    {"scene", 1},   {"model", 2},    {"observe", 3},
    {"draw", 4},    {"compute", 4}, {"cli", 5},      {"inputs", 5},
    {"outputs", 6}, {"plan", 6},    {"ensemble", 6}, {"room", 6},
    {"course", 7},  {"run", 8},     {"study", 9},    {"main", 10},
};

/* An outside header's beginning, and the only place whose files may include it. */
static const struct {
    const char *header, *place;
} keepers[] = {
    {"CL/", "host/compute/"},  {"GL/", "host/draw/"},        {"EGL/", "host/draw/"},
    {"KHR/", "host/draw/"},    {"libav", "host/draw/movie"}, {"libsw", "host/draw/movie"},
    {"yaml.h", "host/scene/"}, {"ft2build.h", "host/draw/"}, {"png.h", "host/draw/"},
};

static bool begins(const char *text, const char *start)
{
    return strncmp(text, start, strlen(start)) == 0;
}

/* -1 for what is no room of ours. */
static int floor_of(const char *room)
{
    for (size_t i = 0; i < sizeof rooms / sizeof *rooms; i++) {
        if (strcmp(room, rooms[i].name) == 0) {
            return rooms[i].floor;
        }
    }
    return -1;
}

/* "draw/movie.c" is in draw, "run.c" in run. */
static void room_of(char room[NAME_SIZE], const char *path)
{
    size_t length = strcspn(path, "/.");
    snprintf(room, NAME_SIZE, "%.*s", length < NAME_SIZE ? (int)length : NAME_SIZE - 1, path);
}

/* path is below host/, header as written between its quotes. */
static bool arrow_is_allowed(const char *path, const char *header)
{
    char from[NAME_SIZE], to[NAME_SIZE];
    room_of(from, path);
    room_of(to, header);
    if (begins(header, "kernels/")) {
        return floor_of(from) >= floor_of("scene");
    }
    return floor_of(to) >= 0 && (strcmp(from, to) == 0 || floor_of(to) < floor_of(from));
}

/* path is below the source folder, header as written between angle brackets. */
static bool outsider_is_allowed(const char *path, const char *header)
{
    for (size_t i = 0; i < sizeof keepers / sizeof *keepers; i++) {
        if (begins(header, keepers[i].header)) {
            return begins(path, keepers[i].place);
        }
    }
    return true;
}

/* *header receives what an #include line names (cut out of line), *mark its opening mark. */
static bool parse_include(char *line, char **header, char *mark)
{
    char *start = line + strspn(line, " \t");
    if (*start != '#') {
        return false;
    }
    start += 1 + strspn(start + 1, " \t");
    if (!begins(start, "include")) {
        return false;
    }
    start += strcspn(start, "\"<");
    *mark = *start;
    *header = start + (*start != 0);
    (*header)[strcspn(*header, "\">")] = 0;
    return *mark != 0;
}

/* Returns the number of forbidden includes in a file, printing each. */
static int count_forbidden(const char *full_path)
{
    char line[LINE_SIZE], mark, *header;
    const char *path = full_path + strlen(ORZO_SOURCE) + 1;
    int forbidden = 0, number = 0;
    FILE *file = fopen(full_path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        number++;
        if (!parse_include(line, &header, &mark)) {
            continue;
        }
        bool allowed = mark == '"' ? arrow_is_allowed(path + strlen("host/"), header)
                                   : outsider_is_allowed(path, header);
        if (!allowed) {
            print_error("%s:%d: may not include %s\n", path, number, header);
            forbidden++;
        }
    }
    fclose(file);
    return forbidden;
}

static void test_includes_run_downwards(void **state)
{
    (void)state;
    const char *patterns[] = {"host/*.[ch]", "host/*/*.[ch]"};
    int forbidden = 0;
    size_t files = 0;
    for (int i = 0; i < 2; i++) {
        char pattern[NAME_SIZE * 4];
        glob_t found;
        snprintf(pattern, sizeof pattern, "%s/%s", ORZO_SOURCE, patterns[i]);
        if (glob(pattern, 0, NULL, &found) != 0) {
            continue;
        }
        for (size_t f = 0; f < found.gl_pathc; f++) {
            forbidden += count_forbidden(found.gl_pathv[f]);
        }
        files += found.gl_pathc;
        globfree(&found);
    }
    assert_true(files > 20); /* the sources were found at all */
    assert_int_equal(forbidden, 0);
}

static void test_rules_can_fail(void **state)
{
    (void)state;
    assert_true(arrow_is_allowed("draw/movie.c", "observe/snapshot.h"));
    assert_true(arrow_is_allowed("main.c", "run.h"));
    assert_true(arrow_is_allowed("study/report.c", "run.h"));
    assert_true(arrow_is_allowed("model/place.c", "kernels/closest.h"));
    assert_false(arrow_is_allowed("draw/movie.c", "compute/sim.h"));
    assert_false(arrow_is_allowed("observe/series.c", "compute/sim.h"));
    assert_false(arrow_is_allowed("observe/series.c", "draw/image.h"));
    assert_false(arrow_is_allowed("compute/sim.c", "draw/image.h"));
    assert_false(arrow_is_allowed("model/place.c", "observe/final.h"));
    assert_false(arrow_is_allowed("base/log.c", "scene/scene.h"));
    assert_false(arrow_is_allowed("run.c", "study/report.h"));
    assert_false(arrow_is_allowed("base/log.c", "kernels/real.h"));
    assert_false(outsider_is_allowed("host/model/place.c", "CL/cl.h"));
    assert_false(outsider_is_allowed("host/draw/image.c", "libavcodec/avcodec.h"));
    assert_true(outsider_is_allowed("host/draw/movie.c", "libavcodec/avcodec.h"));
    assert_false(outsider_is_allowed("host/run.c", "EGL/egl.h"));
    assert_true(outsider_is_allowed("host/run.c", "math.h"));
}

/* oz_grains_axis may be in grains.c alone. The table that the build makes is the one exception;
 * names that begin with __ are the sanitizers' own. */
static bool symbol_is_allowed(const char *file, const char *symbol)
{
    char prefix[NAME_SIZE];
    snprintf(prefix, sizeof prefix, "oz_%s_", file);
    return begins(symbol, prefix) || begins(symbol, "__") || strcmp(symbol, "oz_embed_files") == 0;
}

/* nm prints "grains.c.o:" and then "address type name" for each symbol. */
static int count_foreign_symbols(FILE *names, int *total)
{
    char line[LINE_SIZE], file[NAME_SIZE] = "", symbol[NAME_SIZE];
    int foreign = 0;
    while (fgets(line, sizeof line, names)) {
        if (strstr(line, ".o:")) {
            room_of(file, line);
        } else if (sscanf(line, "%*x %*c %255s", symbol) == 1) {
            bool allowed = symbol_is_allowed(file, symbol);
            if (!allowed) {
                print_error("%s.c: linking name %s does not begin with oz_%s_\n", file, symbol,
                            file);
            }
            foreign += !allowed;
            ++*total;
        }
    }
    return foreign;
}

static void test_linking_names(void **state)
{
    (void)state;
    char program[] = ORZO_PROGRAM, command[NAME_SIZE * 4];
    int total = 0;
    snprintf(command, sizeof command, "nm --extern-only --defined-only '%s/liborzo.a'",
             dirname(program));
    FILE *names = popen(command, "r");
    assert_non_null(names);
    int foreign = count_foreign_symbols(names, &total);
    assert_int_equal(pclose(names), 0);
    assert_true(total > 20);
    assert_int_equal(foreign, 0);
    assert_false(symbol_is_allowed("grains", "oz_place_grains"));
    assert_false(symbol_is_allowed("grains", "helper"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rules_can_fail),
        cmocka_unit_test(test_includes_run_downwards),
        cmocka_unit_test(test_linking_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
