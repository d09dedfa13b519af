/* The house's limits of size, read off its sources: lines of a file, lines of a function, and how
 * many parameters a function takes. Layout is clang-format's: a function's braces stand in column
 * 0. */
#include <ctype.h>
#include <glob.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { FILE_LINES = 450, FUNCTION_LINES = 60, PARAMETERS = 8, NAME_SIZE = 256 };

/* Whether text stands at the beginning of a line that holds no more than it. */
static bool is_alone(const char *text, const char *at, char mark)
{
    return *at == mark && (at == text || at[-1] == '\n') && (at[1] == '\n' || at[1] == 0);
}

/* Returns how many functions are too long, their braces' lines counted in, printing each. */
static int count_long_functions(const char *path, const char *text)
{
    int line = 1, begin = 0, too_long = 0;
    for (const char *at = text; *at; at++) {
        if (is_alone(text, at, '{')) {
            begin = line;
        } else if (begin && is_alone(text, at, '}')) {
            if (line - begin + 1 > FUNCTION_LINES) {
                print_error("%s:%d: a function of %d lines\n", path, begin, line - begin + 1);
                too_long++;
            }
            begin = 0;
        }
        line += *at == '\n';
    }
    return too_long;
}

static int count_lines(const char *path, const char *text)
{
    int lines = 0;
    for (const char *at = text; *at; at++) {
        lines += *at == '\n';
    }
    if (lines > FILE_LINES) {
        print_error("%s: %d lines\n", path, lines);
    }
    return lines;
}

/* The end of what begins at text: a comment, a string, a character, a directive with its
 * continued lines; text itself for anything else. */
static const char *skip_words(const char *start, const char *text)
{
    if (text[0] == '/' && text[1] == '*') {
        const char *end = strstr(text + 2, "*/");
        return end ? end + 2 : text + strlen(text);
    }
    if (text[0] == '/' && text[1] == '/') {
        return text + strcspn(text, "\n");
    }
    bool directive = *text == '#' && (text == start || text[-1] == '\n');
    if (!directive && *text != '"' && *text != '\'') {
        return text;
    }
    for (const char *at = text + 1; *at; at++) {
        if (*at == '\\') {
            at += at[1] != 0;
        } else if (*at == (directive ? '\n' : *text)) {
            return at + !directive;
        }
    }
    return text + strlen(text);
}

/* The word before an opening bracket. */
static void word_before(char name[NAME_SIZE], const char *start, const char *bracket)
{
    const char *end = bracket;
    while (end > start && isspace((unsigned char)end[-1])) {
        end--;
    }
    const char *begin = end;
    while (begin > start && (isalnum((unsigned char)begin[-1]) || begin[-1] == '_')) {
        begin--;
    }
    snprintf(name, NAME_SIZE, "%.*s", (int)(end - begin), begin);
}

/* Whether a list of parameters is too long, printing it. */
static bool is_wide(const char *path, const char *name, int count)
{
    if (count > PARAMETERS) {
        print_error("%s: %s takes %d parameters\n", path, name, count);
    }
    return count > PARAMETERS;
}

/* Returns how many functions, declared or defined outside of all braces, take too much. */
static int count_wide_functions(const char *path, const char *text)
{
    int braces = 0, brackets = 0, commas = 0, wide = 0;
    char name[NAME_SIZE] = "";
    for (const char *at = text; *at; at++) {
        const char *end = skip_words(text, at);
        if (end != at) {
            at = end - 1;
            continue;
        }
        braces += (*at == '{') - (*at == '}');
        if (braces > 0) {
            continue;
        }
        if (*at == '(' && brackets++ == 0) {
            commas = 0;
            word_before(name, text, at);
        } else if (*at == ',' && brackets == 1) {
            commas++;
        } else if (*at == ')' && --brackets == 0) {
            wide += is_wide(path, name, commas + 1);
        }
    }
    return wide;
}

/* The whole file as text, to be freed. */
static char *read_text(const char *path)
{
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    size_t size = (size_t)ftell(file);
    rewind(file);
    char *text = malloc(size + 1);
    assert_non_null(text);
    assert_int_equal(fread(text, 1, size, file), size);
    text[size] = 0;
    fclose(file);
    return text;
}

typedef struct Counts {
    int files, long_files, long_functions, wide_functions;
} Counts;

static void look_at(Counts *counts, const char *full_path)
{
    const char *path = full_path + strlen(ORZO_SOURCE) + 1;
    char *text = read_text(full_path);
    counts->files++;
    counts->long_files += count_lines(path, text) > FILE_LINES;
    counts->long_functions += count_long_functions(path, text);
    if (strncmp(path, "tests/", 6) != 0) {
        counts->wide_functions += count_wide_functions(path, text);
    }
    free(text);
}

static void the_house_keeps_its_sizes(void **state)
{
    (void)state;
    static const char *const patterns[] = {"host/*.[ch]",    "host/*/*.[ch]", "host/*/*/*.[ch]",
                                           "kernels/*.[ch]", "kernels/*.cl",  "kernels/*/*.[ch]",
                                           "tests/*.[ch]",   "tests/*.cl"};
    Counts counts = {0};
    for (size_t i = 0; i < sizeof patterns / sizeof *patterns; i++) {
        char pattern[NAME_SIZE * 4];
        glob_t found;
        snprintf(pattern, sizeof pattern, "%s/%s", ORZO_SOURCE, patterns[i]);
        if (glob(pattern, 0, NULL, &found) != 0) {
            continue;
        }
        for (size_t f = 0; f < found.gl_pathc; f++) {
            look_at(&counts, found.gl_pathv[f]);
        }
        globfree(&found);
    }
    assert_true(counts.files > 300); /* the sources were found at all */
    assert_int_equal(counts.long_files, 0);
    assert_int_equal(counts.long_functions, 0);
    assert_int_equal(counts.wide_functions, 0);
}

/* A function of so many lines, its braces counted in. */
static int long_functions(int lines)
{
    char text[4096] = "static void stretch(int a)\n{\n";
    for (int i = 0; i < lines - 2; i++) {
        strcat(text, i % 2 ? "    }\n" : "    {\n"); /* indented braces end nothing */
    }
    return count_long_functions("made up", strcat(text, "}\n"));
}

static void long_functions_are_seen(void **state)
{
    (void)state;
    assert_int_equal(long_functions(FUNCTION_LINES), 0);
    assert_int_equal(long_functions(FUNCTION_LINES + 1), 1);
    /* an initialiser is no function, however long */
    char text[4096] = "static const int table[] = {\n";
    for (int i = 0; i < 2 * FUNCTION_LINES; i++) {
        strcat(text, "    1,\n");
    }
    assert_int_equal(count_long_functions("made up", strcat(text, "};\n")), 0);
}

static void long_files_are_seen(void **state)
{
    (void)state;
    char text[FILE_LINES + 2];
    memset(text, '\n', sizeof text);
    text[FILE_LINES] = 0;
    assert_int_equal(count_lines("made up", text), FILE_LINES);
    text[FILE_LINES] = '\n';
    text[FILE_LINES + 1] = 0;
    assert_true(count_lines("made up", text) > FILE_LINES);
}

static int wide_functions(const char *text)
{
    return count_wide_functions("made up", text);
}

static void wide_functions_are_seen(void **state)
{
    (void)state;
    assert_int_equal(
        wide_functions("int f(int a, int b, int c, int d, int e, int g, int h, int i);"), 0);
    assert_int_equal(
        wide_functions("int f(int a, int b, int c, int d,\n int e, int g, int h, int i, int j);"),
        1);
    assert_int_equal(
        wide_functions("int f(int a, int b, int c, int d, int e, int g, int h, int i, int j)\n{}\n"
                       "int k(void)\n{\n}\n"),
        1);
    /* commas of an inner list, of comments, of strings, of macros and of calls are none of it */
    assert_int_equal(
        wide_functions("int f(int (*g)(int, int, int, int, int, int, int, int), int a);"), 0);
    assert_int_equal(wide_functions("int f(int a /* 1, 2, 3, 4, 5, 6, 7, 8, 9 */);"), 0);
    assert_int_equal(wide_functions("#define F(a, b, c, d, \\\n e, f, g, h, i) 0\n"), 0);
    assert_int_equal(wide_functions("int f(int a)\n{\n g(\"(\", 1, 2, 3, 4, 5, 6, 7, 8, 9);\n}\n"),
                     0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(long_functions_are_seen),
        cmocka_unit_test(long_files_are_seen),
        cmocka_unit_test(wide_functions_are_seen),
        cmocka_unit_test(the_house_keeps_its_sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
