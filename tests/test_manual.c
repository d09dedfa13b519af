/* The manual page names every command, option, key and column, and is one that man can show. */
#include "program.h"

#include "cli.h"
#include "observe/series.h"
#include "scene/keys.h"

/* Whether the page holds text, written as the page writes hyphens. */
static bool page_holds(const char *page, const char *text)
{
    char written[512];
    size_t used = 0;
    for (; *text && used < sizeof written - 3; text++) {
        if (*text == '-' || *text == '\\') {
            written[used++] = '\\';
        }
        written[used++] = *text;
    }
    written[used] = '\0';
    return strstr(page, written) != NULL;
}

static void must_hold(const char *page, const char *text)
{
    if (!page_holds(page, text)) {
        fail_msg("the page does not hold %s", text);
    }
}

static void the_page_names_all_there_is(void **state)
{
    (void)state;
    const OzCliCommand *commands;
    const OzCliOption *options;
    int command_count = oz_cli_commands(&commands), option_count = oz_cli_options(&options);
    expect(0, ".TH ORZO 1", "--man");
    char *page = read_file("said", NULL);
    for (int c = 0; c < command_count; c++) {
        must_hold(page, commands[c].help);
        must_hold(page, commands[c].example);
    }
    for (int o = 0; o < option_count; o++) {
        must_hold(page, options[o].name);
        must_hold(page, options[o].help);
    }
    for (const OzKey *key = oz_keys_all(); key->path; key++) {
        must_hold(page, key->path);
    }
    for (const OzColumn *column = oz_series_columns(); column->name; column++) {
        must_hold(page, column->meaning);
    }
    assert_false(page_holds(page, "--mankind"));
    free(page);
}

/* Nothing of what is said must be taken for a request of the page's language. */
static void every_request_is_known(void **state)
{
    (void)state;
    static const char *const known[] = {".TH ", ".SH ",  ".TP\n", ".BI ",  ".B ",
                                        ".I ",  ".br\n", ".nf\n", ".fi\n", ".PP\n"};
    expect(0, ".TH ORZO 1", "--man");
    char *page = read_file("said", NULL);
    for (char *line = page; *line; line += strcspn(line, "\n"), line += *line == '\n') {
        bool found = line[0] != '.' && line[0] != '\'';
        for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
            found |= strncmp(line, known[k], strlen(known[k])) == 0;
        }
        if (!found) {
            fail_msg("%.40s", line);
        }
    }
    free(page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_page_names_all_there_is),
        cmocka_unit_test(every_request_is_known),
    };
    return cmocka_run_group_tests(tests, enter_work, leave_work);
}
