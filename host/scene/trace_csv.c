/* Reads two columns. The file is a person's input: every row is checked. */
#include "scene/trace_csv.h"

#include "base/file.h"
#include "base/memory.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CELL_SIZE = 64, RANK = 1 << 20 }; /* after the scene's own faults */

/* Where the reader stands, and which cells of a row it takes. */
typedef struct Reader {
    OzSource source;
    OzFaults *faults;
    char *next; /* the next line */
    int line;
    int time_cell, value_cell;
} Reader;

/* Adds a fault at the line in hand; false. */
static bool fault(Reader *reader, const char *format, ...) __attribute__((format(printf, 2, 3)));

static bool fault(Reader *reader, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    oz_faults_add(reader->faults, &reader->source, reader->line, "%s", text);
    return false;
}

/* Cuts the next line off that is not blank; NULL at the end. */
static char *next_line(Reader *reader)
{
    while (*reader->next) {
        char *line = reader->next;
        size_t length = strcspn(line, "\n");
        reader->next = line + length + (line[length] == '\n');
        reader->line++;
        line[length] = '\0';
        if (line[strspn(line, " \t\r")] != '\0') {
            return line;
        }
    }
    return NULL;
}

/* Cell i of a line, without the quotes and spaces about it; false where there is none. What is
 * longer than a cell can be is cut. */
static bool cell_of(const char *line, int i, char cell[CELL_SIZE])
{
    for (; i > 0 && line; i--) {
        line = strchr(line, ',');
        line = line ? line + 1 : NULL;
    }
    if (!line) {
        return false;
    }
    size_t length = strcspn(line, ","), skipped = strspn(line, " \t\"\r");
    skipped = skipped < length ? skipped : length;
    line += skipped;
    length -= skipped;
    while (length > 0 && strchr(" \t\"\r", line[length - 1])) {
        length--;
    }
    snprintf(cell, CELL_SIZE, "%.*s", (int)(length < CELL_SIZE ? length : CELL_SIZE), line);
    return true;
}

/* Which cells are meant. */
static bool read_header(Reader *reader, const char *line, const char *column)
{
    char cell[CELL_SIZE], names[256] = "";
    int count = 0, found = -1;
    for (; cell_of(line, count, cell); count++) {
        reader->time_cell = strcmp(cell, "time") == 0 ? count : reader->time_cell;
        found = column && strcmp(cell, column) == 0 ? count : found;
        size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%.40s", count ? ", " : "", cell);
    }
    if (!column && count == 2) {
        found = 1 - reader->time_cell;
    }
    reader->value_cell = found;
    if (!column && count != 2) {
        return fault(reader, "%d columns (%s); expected motion.column to name one of them", count,
                     names);
    }
    if (found < 0 || found == reader->time_cell) {
        return fault(reader,
                     "no column %.60s (%s); expected motion.column to name one beside the time",
                     column, names);
    }
    return true;
}

static bool read_number(Reader *reader, const char *line, int i, const char *what, double *number)
{
    char cell[CELL_SIZE] = "", *end = NULL;
    bool any = cell_of(line, i, cell);
    *number = strtod(cell, &end);
    if (!any || end == cell || *end || !isfinite(*number)) {
        return fault(reader, "%s is %s; expected a number", what, cell[0] ? cell : "missing");
    }
    return true;
}

/* Rows until the end, or a fault. */
static OzStatus read_rows(Reader *reader, OzTraceCsv *csv, bool *good)
{
    size_t capacity = 0;
    *good = true;
    for (char *line; *good && (line = next_line(reader));) {
        size_t count = (size_t)csv->count;
        if (count == capacity) {
            size_t more = 2 * capacity + 64;
            OZ_PASS(
                oz_memory_grow((void **)&csv->time, capacity, more, sizeof *csv->time, "trace"));
            OZ_PASS(
                oz_memory_grow((void **)&csv->value, capacity, more, sizeof *csv->value, "trace"));
            capacity = more;
        }
        *good = read_number(reader, line, reader->time_cell, "the time", &csv->time[count]) &&
                read_number(reader, line, reader->value_cell, "the value", &csv->value[count]);
        if (*good && count > 0 && !(csv->time[count] > csv->time[count - 1])) {
            *good = fault(reader, "the time is %.9g s after %.9g s; expected times that increase",
                          csv->time[count], csv->time[count - 1]);
        }
        csv->count += *good;
    }
    if (*good && csv->count < 2) {
        *good = fault(reader, "a trace of %lld rows; expected two or more", (long long)csv->count);
    }
    return OZ_OK;
}

OzStatus oz_trace_csv_read(OzTraceCsv *csv, const char *path, const char *column, OzFaults *faults)
{
    OzStatus status = OZ_OK;
    char *text = NULL;
    bool good = false;
    Reader own = {.source = {.name = path, .rank = RANK}, .faults = faults}, *reader = &own;
    *csv = (OzTraceCsv){0};
    status = oz_file_read(&text, NULL, path);
    if (status == OZ_ERR_FILE) {
        fault(reader, "%s; expected a table of times and values", oz_status_text());
        return OZ_OK;
    }
    OZ_TRY(status);
    reader->next = text;
    char *header = next_line(reader);
    if (!header) {
        fault(reader, "an empty file; expected a line of names, then rows of numbers");
    } else if (read_header(reader, header, column)) {
        OZ_TRY(read_rows(reader, csv, &good));
    }
done:
    free(text);
    if (!good) {
        oz_trace_csv_free(csv);
    }
    return status;
}

void oz_trace_csv_free(OzTraceCsv *csv)
{
    free(csv->time);
    free(csv->value);
    *csv = (OzTraceCsv){0};
}
