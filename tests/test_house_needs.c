/* No two files of the library need each other's functions: read off its object files. */
#include <libgen.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { FILES = 512, NAMES = 16384, NAME_SIZE = 256, LINE_SIZE = 4096, PATH_SIZE = 4096 };

/* Which file defines or needs a name. */
typedef struct Name {
    char text[96];
    int file;
    bool defined;
} Name;

/* What nm says of a library, and which file needs which. */
typedef struct Needs {
    char file[FILES][NAME_SIZE];
    int file_count, name_count;
    Name name[NAMES];
    bool needs[FILES][FILES];
} Needs;

static Needs library, hand_made;

static void read_needs(Needs *n, FILE *names)
{
    char line[LINE_SIZE], type;
    while (fgets(line, sizeof line, names)) {
        Name *name = &n->name[n->name_count];
        if (strstr(line, ".o:")) {
            assert_true(n->file_count < FILES);
            sscanf(line, "%255[^.]", n->file[n->file_count++]);
        } else if (sscanf(line, "%*[ 0-9a-f] %c %95s", &type, name->text) == 2) {
            name->file = n->file_count - 1;
            name->defined = type != 'U';
            assert_true(++n->name_count < NAMES);
        }
    }
}

static int by_text(const void *a, const void *b)
{
    const Name *one = a, *other = b;
    int order = strcmp(one->text, other->text);
    return order ? order : other->defined - one->defined; /* who defines it comes first */
}

/* Returns the number of pairs of files that need each other, printing each. */
static int count_mutual(Needs *n)
{
    int mutual = 0, owner = -1;
    qsort(n->name, (size_t)n->name_count, sizeof *n->name, by_text);
    for (int k = 0; k < n->name_count; k++) {
        if (k == 0 || strcmp(n->name[k - 1].text, n->name[k].text) != 0) {
            owner = n->name[k].defined ? n->name[k].file : -1;
        } else if (owner >= 0) {
            n->needs[n->name[k].file][owner] = true;
        }
    }
    for (int a = 0; a < n->file_count; a++) {
        for (int b = 0; b < a; b++) {
            if (n->needs[a][b] && n->needs[b][a]) {
                print_error("%s.c and %s.c need each other\n", n->file[a], n->file[b]);
                mutual++;
            }
        }
    }
    return mutual;
}

static void test_files_need_one_way(void **state)
{
    (void)state;
    char text[] = "a.c.o:\n0000000000000010 T oz_a_go\n                 U oz_b_go\n"
                  "b.c.o:\n                 U oz_c_go\n0000000000000000 T oz_b_go\n"
                  "c.c.o:\n0000000000000000 D oz_c_go\n                 U oz_b_go\n";
    FILE *names = fmemopen(text, strlen(text), "r");
    assert_non_null(names);
    read_needs(&hand_made, names);
    fclose(names);
    assert_int_equal(count_mutual(&hand_made), 1); /* b and c */
    char program[] = ORZO_PROGRAM, command[PATH_SIZE];
    snprintf(command, sizeof command, "nm --extern-only '%s/liborzo.a'", dirname(program));
    names = popen(command, "r");
    assert_non_null(names);
    read_needs(&library, names);
    assert_int_equal(pclose(names), 0);
    assert_true(library.file_count > 100);
    assert_int_equal(count_mutual(&library), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_files_need_one_way)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
