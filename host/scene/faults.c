/* The list of a scene's errors. Knows neither YAML nor keys. */
#include "scene/faults.h"

#include "base/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* More than anyone reads; a file of noise must not fill the memory with messages. */
enum { MOST_FAULTS = 100 };

/* Keeps a hostile text from reaching the terminal as commands. */
static void blank_controls(char *text)
{
    for (; *text; text++) {
        if ((unsigned char)*text < 0x20 || *text == 0x7f) {
            *text = '?';
        }
    }
}

static char *with_place(const OzSource *source, int line, char *what)
{
    char *text = NULL;
    int length = source->setting ? asprintf(&text, "%s: %s", source->name, what)
                                 : asprintf(&text, "%s:%d: %s", source->name, line, what);
    return length < 0 ? NULL : text;
}

static void keep(OzFaults *faults, OzFault fault)
{
    size_t count = (size_t)faults->count;
    if (oz_memory_grow((void **)&faults->rows, count, count + 1, sizeof *faults->rows,
                       "the scene's errors") != OZ_OK) {
        faults->no_memory = true;
        free(fault.text);
        return;
    }
    faults->rows[faults->count++] = fault;
}

void oz_faults_add(OzFaults *faults, const OzSource *source, int line, const char *format, ...)
{
    if (faults->count == MOST_FAULTS) {
        faults->left_out++;
        return;
    }
    char *what = NULL;
    va_list arguments;
    va_start(arguments, format);
    int length = vasprintf(&what, format, arguments);
    va_end(arguments);
    if (length < 0) {
        faults->no_memory = true;
        return;
    }
    OzFault fault = {source->rank, line, with_place(source, line, what)};
    free(what);
    if (!fault.text) {
        faults->no_memory = true;
        return;
    }
    blank_controls(fault.text);
    keep(faults, fault);
}

bool oz_faults_name(const OzFaults *faults, const char *path)
{
    bool found = false;
    for (int i = 0; i < faults->count && !found; i++) {
        const char *named = strstr(faults->rows[i].text, path);
        found = named && strchr(". ", named[strlen(path)]);
    }
    return found;
}

static bool comes_after(const OzFault *a, const OzFault *b)
{
    return a->rank != b->rank ? a->rank > b->rank : a->line > b->line;
}

/* Insertion: stable, so that faults of one line stay in the order in which they were found. */
static void sort(OzFaults *faults)
{
    for (int i = 1; i < faults->count; i++) {
        OzFault fault = faults->rows[i];
        int j = i;
        for (; j > 0 && comes_after(&faults->rows[j - 1], &fault); j--) {
            faults->rows[j] = faults->rows[j - 1];
        }
        faults->rows[j] = fault;
    }
}

static void print_all(const OzFaults *faults, FILE *file)
{
    for (int i = 0; i < faults->count; i++) {
        fprintf(file, "%s%s", i ? "\n" : "", faults->rows[i].text);
    }
    if (faults->left_out) {
        fprintf(file, "\n... and %d more", faults->left_out);
    }
}

OzStatus oz_faults_report(OzFaults *faults)
{
    if (faults->no_memory) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory while reading the scene");
    }
    if (!faults->count) {
        return OZ_OK;
    }
    sort(faults);
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    if (!file) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for the scene's errors");
    }
    print_all(faults, file);
    fclose(file);
    OzStatus status = oz_status_fail(OZ_ERR_INPUT, "%s", text ? text : faults->rows[0].text);
    free(text);
    return status;
}

void oz_faults_free(OzFaults *faults)
{
    for (int i = 0; i < faults->count; i++) {
        free(faults->rows[i].text);
    }
    free(faults->rows);
    *faults = (OzFaults){0};
}
