/* Moving cells into other columns. */
#include "observe/rows_file.h"

#include "base/memory.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A line in hand. */
typedef struct Line {
    char *text;
    size_t room;
    char **cells; /* in the text */
    int count;
} Line;

static void free_line(Line *line)
{
    free(line->text);
    free(line->cells);
}

/* Reads a line and cuts it into cells; false at the end, and of a line without its end. */
static bool read_line(Line *line, FILE *file, OzStatus *status)
{
    ssize_t length = getline(&line->text, &line->room, file);
    if (length <= 0 || line->text[length - 1] != '\n') {
        return false;
    }
    line->text[length - 1] = '\0';
    line->count = 0;
    for (char *rest = line->text, *cell = strsep(&rest, ","); cell; cell = strsep(&rest, ",")) {
        *status = oz_memory_grow((void **)&line->cells, (size_t)line->count,
                                 (size_t)line->count + 1, sizeof *line->cells, "cells");
        if (*status != OZ_OK) {
            return false;
        }
        line->cells[line->count++] = cell;
    }
    return true;
}

/* Where each of the names is in the header, or -1. *same: each in its place, and no others. */
static void find(const Line *header, const char *const *names, int count, int *from, bool *same)
{
    *same = header->count == count;
    for (int i = 0; i < count; i++) {
        from[i] = header->count - 1;
        while (from[i] >= 0 && strcmp(header->cells[from[i]], names[i]) != 0) {
            from[i]--;
        }
        *same &= from[i] == i;
    }
}

static void write_cells(FILE *file, const Line *line, const int *from, int count)
{
    for (int i = 0; i < count; i++) {
        const char *cell = from[i] >= 0 && from[i] < line->count ? line->cells[from[i]] : "";
        fprintf(file, "%s%s", i ? "," : "", cell);
    }
    fputc('\n', file);
}

static void write_header(FILE *file, const char *const *names, int count)
{
    for (int i = 0; i < count; i++) {
        fprintf(file, "%s%s", i ? "," : "", names[i]);
    }
    fputc('\n', file);
}

/* Closes what was written, and puts it into the table's place. */
static OzStatus replace(FILE **file, const char *part, const char *path)
{
    bool whole = fflush(*file) == 0 && !ferror(*file) && fsync(fileno(*file)) == 0;
    whole = fclose(*file) == 0 && whole;
    *file = NULL;
    return whole && rename(part, path) == 0
               ? OZ_OK
               : oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
}

OzStatus oz_rows_file_reshape(const char *path, const char *const *names, int count)
{
    OzStatus status = OZ_OK;
    char part[4200];
    Line line = {0};
    int *from = NULL;
    bool same = false;
    FILE *table = fopen(path, "r"), *made = NULL;
    snprintf(part, sizeof part, "%s.part", path);
    if (!table) {
        return oz_status_fail(OZ_ERR_FILE, "cannot read %s: %s", path, strerror(errno));
    }
    OZ_TRY(OZ_NEW(&from, count));
    if (!read_line(&line, table, &status)) {
        goto done;
    }
    find(&line, names, count, from, &same);
    if (same) {
        goto done;
    }
    made = fopen(part, "w");
    if (!made) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", part, strerror(errno));
        goto done;
    }
    write_header(made, names, count);
    while (read_line(&line, table, &status)) {
        write_cells(made, &line, from, count);
    }
    OZ_TRY(status);
    OZ_TRY(replace(&made, part, path));
done:
    if (made) {
        fclose(made);
        remove(part);
    }
    fclose(table);
    free(from);
    free_line(&line);
    return status;
}
