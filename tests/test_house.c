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
#include <unistd.h>

#include <cmocka.h>

enum { NAME_SIZE = 256, LINE_SIZE = 4096, HEADERS = 1024, ARROWS = 8192 };

/* Rooms in floors: a room includes itself and lower floors only. Files directly under host/ are
 * rooms of their own. draw and sim share a floor, so neither sees the other; both see a
 * snapshot. */
static const struct {
    const char *name;
    int floor;
} rooms[] = {
    {"base", 0},  {"scene", 1},  {"model", 2},   {"compute", 2}, {"observe", 3},
    {"draw", 4},  {"sim", 4},    {"export", 4}, {"plot", 4},  {"cli", 5},     {"run", 6},
    {"bench", 7}, {"report", 7}, {"command", 8}, {"figures", 9}, {"main", 10},    {"library", 7},
};

/* An outside header's beginning, and the only place whose files may include it. */
static const struct {
    const char *header, *place;
} keepers[] = {
    {"CL/", "host/compute/"},
    {"GL/", "host/draw/"},
    {"EGL/", "host/draw/"},
    {"KHR/", "host/draw/"},
    {"libav", "host/draw/movie"},
    {"libsw", "host/draw/movie"},
    {"yaml.h", "host/scene/"},
    {"ft2build.h", "host/draw/"},
    {"png.h", "host/draw/"},
    {"hdf5.h", "host/base/hdf5_library"},
    {"microhttpd.h", "host/run/page_server"},
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

/* "draw/movie.c" is in draw, "cli.c" in cli. */
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
    assert_true(arrow_is_allowed("draw/movie.c", "model/snapshot.h"));
    assert_true(arrow_is_allowed("main.c", "run.h"));
    assert_true(arrow_is_allowed("report/report.c", "run.h"));
    assert_true(arrow_is_allowed("model/insert.c", "kernels/closest.h"));
    assert_false(arrow_is_allowed("draw/movie.c", "sim/sim.h"));
    assert_false(arrow_is_allowed("observe/series.c", "sim/sim.h"));
    assert_false(arrow_is_allowed("observe/series.c", "draw/image.h"));
    assert_false(arrow_is_allowed("sim/sim.c", "draw/image.h"));
    assert_false(arrow_is_allowed("model/insert.c", "observe/final.h"));
    assert_false(arrow_is_allowed("base/log.c", "scene/scene.h"));
    assert_false(arrow_is_allowed("run/run.c", "report/report.h"));
    assert_false(arrow_is_allowed("base/log.c", "kernels/real.h"));
    assert_false(outsider_is_allowed("host/model/insert.c", "CL/cl.h"));
    assert_false(outsider_is_allowed("host/draw/image.c", "libavcodec/avcodec.h"));
    assert_true(outsider_is_allowed("host/draw/movie.c", "libavcodec/avcodec.h"));
    assert_false(outsider_is_allowed("host/run/run.c", "EGL/egl.h"));
    assert_true(outsider_is_allowed("host/run/run.c", "math.h"));
}

/* Headers by their path below the source folder, and which includes which. */
typedef struct Arrows {
    char name[HEADERS][NAME_SIZE];
    int from[ARROWS], to[ARROWS];
    int header_count, arrow_count;
} Arrows;

static int header_index(Arrows *arrows, const char *name)
{
    int i = 0;
    while (i < arrows->header_count && strcmp(arrows->name[i], name) != 0) {
        i++;
    }
    if (i == arrows->header_count) {
        assert_true(arrows->header_count++ < HEADERS);
        snprintf(arrows->name[i], NAME_SIZE, "%s", name);
    }
    return i;
}

static void add_arrow(Arrows *arrows, const char *from, const char *to)
{
    assert_true(arrows->arrow_count < ARROWS);
    arrows->from[arrows->arrow_count] = header_index(arrows, from);
    arrows->to[arrows->arrow_count++] = header_index(arrows, to);
}

/* Takes away what includes nothing that is left, until nothing more goes. Returns the number of
 * arrows that are left, printing each: they make circles or lead into one. */
static int count_circular(const Arrows *arrows)
{
    bool gone[HEADERS] = {false}, again = true;
    while (again) {
        bool leads[HEADERS] = {false};
        again = false;
        for (int i = 0; i < arrows->arrow_count; i++) {
            leads[arrows->from[i]] |= !gone[arrows->to[i]];
        }
        for (int i = 0; i < arrows->header_count; i++) {
            again |= !gone[i] && !leads[i];
            gone[i] = !leads[i];
        }
    }
    int left = 0;
    for (int i = 0; i < arrows->arrow_count; i++) {
        if (!gone[arrows->to[i]]) {
            print_error("%s includes %s in a circle or on the way to one\n",
                        arrows->name[arrows->from[i]], arrows->name[arrows->to[i]]);
            left++;
        }
    }
    return left;
}

/* name receives the path below the source folder of what path includes as header: a neighbour, one
 * below host/ or one below the source folder itself. False for what is none of ours. */
static bool find_header(char name[NAME_SIZE], const char *path, const char *header)
{
    int folder = (int)(strrchr(path, '/') - path);
    const char *const places[] = {path, "host", ""};
    for (int i = 0; i < 3; i++) {
        char full[NAME_SIZE * 4];
        snprintf(name, NAME_SIZE, "%.*s%s%s", i ? NAME_SIZE : folder, places[i], i < 2 ? "/" : "",
                 header);
        snprintf(full, sizeof full, "%s/%s", ORZO_SOURCE, name);
        if (access(full, R_OK) == 0) {
            return true;
        }
    }
    return false;
}

static void add_includes(Arrows *arrows, const char *full_path)
{
    char line[LINE_SIZE], name[NAME_SIZE], mark, *header;
    const char *path = full_path + strlen(ORZO_SOURCE) + 1;
    FILE *file = fopen(full_path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        if (parse_include(line, &header, &mark) && mark == '"' && find_header(name, path, header)) {
            add_arrow(arrows, path, name);
        }
    }
    fclose(file);
}

static Arrows house, made_up;

static void test_no_headers_in_a_circle(void **state)
{
    (void)state;
    const char *patterns[] = {"host/*.h",    "host/*/*.h",    "host/*/*/*.h",
                              "kernels/*.h", "kernels/*/*.h", "tests/*.h"};
    for (size_t i = 0; i < sizeof patterns / sizeof *patterns; i++) {
        char pattern[NAME_SIZE * 4];
        glob_t found;
        snprintf(pattern, sizeof pattern, "%s/%s", ORZO_SOURCE, patterns[i]);
        if (glob(pattern, 0, NULL, &found) != 0) {
            continue;
        }
        for (size_t f = 0; f < found.gl_pathc; f++) {
            add_includes(&house, found.gl_pathv[f]);
        }
        globfree(&found);
    }
    assert_true(house.arrow_count > 300); /* about as many as there are headers: they were found */
    assert_int_equal(count_circular(&house), 0);
}

static void test_circles_are_seen(void **state)
{
    (void)state;
    add_arrow(&made_up, "a.h", "b.h");
    add_arrow(&made_up, "b.h", "c.h");
    add_arrow(&made_up, "a.h", "c.h");
    assert_int_equal(count_circular(&made_up), 0);
    add_arrow(&made_up, "d.h", "a.h");
    add_arrow(&made_up, "c.h", "e.h");
    assert_int_equal(count_circular(&made_up), 0);
    add_arrow(&made_up, "c.h", "a.h");
    /* a, b, c among each other and d, which leads to them; e is out of it */
    assert_int_equal(count_circular(&made_up), 5);
    char name[NAME_SIZE];
    assert_true(find_header(name, "kernels/rods.h", "real.h"));
    assert_string_equal(name, "kernels/real.h");
    assert_true(find_header(name, "tests/rig.h", "model/insert.h"));
    assert_string_equal(name, "host/model/insert.h");
    assert_true(find_header(name, "host/model/insert.h", "kernels/real.h"));
    assert_string_equal(name, "kernels/real.h");
    assert_false(find_header(name, "host/model/insert.h", "math.h"));
}

/* A source and its header are one: "host/sim/sim.c" and "host/sim/sim.h" are host/sim/sim. */
static void unit_of(char unit[NAME_SIZE], const char *path)
{
    snprintf(unit, NAME_SIZE, "%.*s", (int)(strrchr(path, '.') - path), path);
}

/* So are these two, and what only a file's own parts may know of it: sim.h and sim_private.h. */
static bool is_same_unit(const char *one, const char *other)
{
    size_t length = strlen(one);
    return begins(other, one) && (!other[length] || strcmp(other + length, "_private") == 0);
}

static void add_needs(Arrows *arrows, const char *full_path)
{
    char line[LINE_SIZE], name[NAME_SIZE], from[NAME_SIZE], to[NAME_SIZE], mark, *header;
    const char *path = full_path + strlen(ORZO_SOURCE) + 1;
    FILE *file = fopen(full_path, "r");
    assert_non_null(file);
    unit_of(from, path);
    while (fgets(line, sizeof line, file)) {
        if (parse_include(line, &header, &mark) && mark == '"' && find_header(name, path, header)) {
            unit_of(to, name);
            if (!is_same_unit(from, to) && !is_same_unit(to, from)) {
                add_arrow(arrows, from, to);
            }
        }
    }
    fclose(file);
}

/* Returns the number of arrows that have one the other way, printing each. */
static int count_mutual(const Arrows *arrows)
{
    int mutual = 0;
    for (int i = 0; i < arrows->arrow_count; i++) {
        bool back = false;
        for (int j = 0; j < arrows->arrow_count && !back; j++) {
            back = arrows->from[j] == arrows->to[i] && arrows->to[j] == arrows->from[i];
        }
        if (back) {
            print_error("%s and %s include each other\n", arrows->name[arrows->from[i]],
                        arrows->name[arrows->to[i]]);
        }
        mutual += back;
    }
    return mutual;
}

static Arrows files, two_files;

/* A source and its header count as one: what both of two files need is in a third one. */
static void test_no_files_include_each_other(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        char pattern[NAME_SIZE * 4];
        glob_t found;
        snprintf(pattern, sizeof pattern, "%s/host/%s", ORZO_SOURCE, i ? "*/*.[ch]" : "*.[ch]");
        assert_int_equal(glob(pattern, 0, NULL, &found), 0);
        for (size_t f = 0; f < found.gl_pathc; f++) {
            add_needs(&files, found.gl_pathv[f]);
        }
        globfree(&found);
    }
    assert_true(files.arrow_count > 1000); /* some for each file */
    assert_int_equal(count_mutual(&files), 0);
    add_arrow(&two_files, "a", "b");
    add_arrow(&two_files, "b", "c");
    assert_int_equal(count_mutual(&two_files), 0);
    add_arrow(&two_files, "b", "a");
    assert_int_equal(count_mutual(&two_files), 2);
    assert_true(is_same_unit("sim/sim", "sim/sim_private"));
    assert_false(is_same_unit("sim/sim", "sim/sim_state"));
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
        cmocka_unit_test(test_circles_are_seen),
        cmocka_unit_test(test_no_headers_in_a_circle),
        cmocka_unit_test(test_no_files_include_each_other),
        cmocka_unit_test(test_linking_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
