/* Sections of the page, one function each. */
#include "command/manual.h"

#include "cli.h"
#include "observe/series.h"
#include "scene/describe.h"

#include <stdlib.h>
#include <string.h>

/* Text between requests: a backslash and a hyphen mean themselves, and no line is a request. */
static void put(FILE *file, const char *text)
{
    for (bool begins = true; *text; text++) {
        if (begins && (*text == '.' || *text == '\'')) {
            fputs("\\&", file);
        }
        if (*text == '\\') {
            fputs("\\e", file);
        } else if (*text == '-') {
            fputs("\\-", file);
        } else {
            fputc(*text, file);
        }
        begins = *text == '\n';
    }
}

/* As it stands, without filling lines. */
static void put_table(FILE *file, const char *text)
{
    fputs(".nf\n", file);
    put(file, text);
    fputs(".fi\n", file);
}

static void put_commands(FILE *file)
{
    const OzCliCommand *commands;
    const OzCliOption *options;
    int command_count = oz_cli_commands(&commands), option_count = oz_cli_options(&options);
    fputs(".SH COMMANDS\n", file);
    for (int c = 0; c < command_count; c++) {
        fprintf(file, ".TP\n.BI \"orzo %s \" \"", commands[c].name);
        put(file, commands[c].arguments);
        fputs("\"\n", file);
        put(file, commands[c].help);
        fputs(".\n", file);
        const char *comma = "Takes ";
        for (int o = 0; o < option_count; o++) {
            if (strchr(commands[c].takes, options[o].letter)) {
                fputs(comma, file);
                put(file, options[o].name);
                comma = ", ";
            }
        }
        fputs(comma[0] == ',' ? ".\n.br\n" : ".br\n", file);
        put(file, commands[c].example);
        fputc('\n', file);
    }
}

static void put_options(FILE *file)
{
    const OzCliOption *options;
    int count = oz_cli_options(&options);
    fputs(".SH OPTIONS\n", file);
    for (int o = 0; o < count; o++) {
        fputs(".TP\n.BI ", file);
        put(file, options[o].name);
        if (options[o].value) {
            fputs(" \" ", file);
            put(file, options[o].value);
            fputs("\"", file);
        }
        fputc('\n', file);
        put(file, options[o].help);
        fputc('\n', file);
    }
}

/* What `orzo keys` says. */
static OzStatus put_keys(FILE *file)
{
    char *text = NULL;
    size_t length = 0;
    FILE *memory = open_memstream(&text, &length);
    if (!memory) {
        return oz_status_fail(OZ_ERR_MEMORY, "no memory for the list of keys");
    }
    oz_describe_keys(NULL, memory);
    bool whole = fclose(memory) == 0 && text;
    fputs(".SH SCENE KEYS\n", file);
    put(file, "A scene is a YAML file in SI units. Any key can be set from the command line: --set "
              "contact.friction=0.2.\n");
    fputs(".PP\n", file);
    if (whole) {
        put_table(file, text);
    }
    free(text);
    return whole ? OZ_OK : oz_status_fail(OZ_ERR_MEMORY, "no memory for the list of keys");
}

static void put_columns(FILE *file)
{
    fputs(".SH COLUMNS OF SERIES.CSV\n", file);
    for (const OzColumn *column = oz_series_columns(); column->name; column++) {
        fputs(".TP\n.B ", file);
        put(file, column->name);
        fputs(" (", file);
        put(file, column->unit);
        fputs(")\n", file);
        put(file, column->meaning);
        fputc('\n', file);
    }
}

OzStatus oz_manual_print(FILE *file)
{
    fputs(".TH ORZO 1 \"\" \"orzo " ORZO_VERSION "\" \"User Commands\"\n.SH NAME\norzo \\- ", file);
    put(file, oz_cli_summary());
    fputs("\n.SH SYNOPSIS\n.B orzo\n.I command\n[options] [arguments]\n.br\n.B orzo "
          "\\-\\-help\n| \\-\\-version | \\-\\-man\n",
          file);
    put_commands(file);
    put_options(file);
    fputs(".SH EXIT STATUS\n", file);
    put(file, oz_cli_statuses());
    fputc('\n', file);
    OzStatus status = put_keys(file);
    put_columns(file);
    return status;
}
