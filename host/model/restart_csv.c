/* Reads final.csv. The file is a person's input: every row is checked before it becomes a grain.
 * Knows nothing of scenes and runs. */
#include "model/restart_csv.h"

#include "base/file.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A quaternion that went through float is off by 1e-7; one written by hand with six digits by 1e-6.
 */
static const double UNIT_TOLERANCE = 1e-5;

/* Where the reader stands. */
typedef struct Reader {
    const char *path;
    char *text, *next; /* whole file; start of the next line */
    int line;
    bool *seen;                /* by id */
    int place[OZ_BED_COLUMNS]; /* which value of a row the file's cell i is */
} Reader;

enum { CELL_SIZE = 64 };

static OzStatus complain(const Reader *reader, const char *wrong, const char *expected)
{
    return oz_status_fail(OZ_ERR_INPUT, "%s:%d: %s; expected %s", reader->path, reader->line, wrong,
                          expected);
}

/* Cuts the next line off the text, or gives NULL at the end. A carriage return before its end goes.
 */
static char *next_line(Reader *reader)
{
    char *line = reader->next;
    if (!*line) {
        return NULL;
    }
    size_t length = strcspn(line, "\n");
    reader->next = line + length + (line[length] == '\n');
    line[length] = '\0';
    if (length > 0 && line[length - 1] == '\r') {
        line[length - 1] = '\0';
    }
    reader->line++;
    return line;
}

/* Lines that are not blank, but for the header. As many ids, each once, leave none out. */
static int64_t count_rows(const char *text)
{
    int64_t lines = 0;
    for (const char *at = text; *at; at += *at == '\n') {
        lines += *at != '\n' && *at != '\r';
        at += strcspn(at, "\n");
    }
    return lines > 0 ? lines - 1 : 0;
}

/* Copies the next cell, without the quotes and spaces about it, and steps over its comma; false at
 * the line's end. *at starts as the line and is NULL after its last cell. What is longer than a
 * cell can be is cut, and then no number and no name. */
static bool next_cell(const char **at, char cell[CELL_SIZE])
{
    static const char around[] = " \t\"";
    if (!*at) {
        return false;
    }
    size_t length = strcspn(*at, ",");
    const char *from = *at, *comma = from + length;
    size_t skipped = strspn(from, around);
    from += skipped < length ? skipped : length;
    length = (size_t)(comma - from);
    while (length > 0 && strchr(around, from[length - 1])) {
        length--;
    }
    snprintf(cell, CELL_SIZE, "%.*s", (int)(length < CELL_SIZE ? length : CELL_SIZE), from);
    *at = *comma ? comma + 1 : NULL;
    return true;
}

static OzStatus parse_number(const Reader *reader, const char *cell, double *value)
{
    char *end = NULL;
    *value = strtod(cell, &end);
    if (end == cell || *end) {
        return complain(reader, "not a number", "20 numbers with commas between them");
    }
    return isfinite(*value) ? OZ_OK
                            : complain(reader, "nan, infinite or too large", "finite numbers");
}

static OzStatus parse_row(const Reader *reader, const char *line, double row[OZ_BED_COLUMNS])
{
    const char *at = line;
    char cell[CELL_SIZE];
    int count = 0;
    for (; count < OZ_BED_COLUMNS && next_cell(&at, cell); count++) {
        OZ_PASS(parse_number(reader, cell, &row[reader->place[count]]));
    }
    if (at || count < OZ_BED_COLUMNS) {
        return complain(reader, at ? "too many numbers" : "too few numbers",
                        "20: " OZ_RESTART_CSV_HEADER);
    }
    return OZ_OK;
}

static OzStatus check_id(const Reader *reader, double id, int64_t count)
{
    if (!(id >= 0 && id < (double)count) || id != floor(id)) {
        return complain(reader, "no such id", "whole numbers from 0, one for each row");
    }
    if (reader->seen[(int64_t)id]) {
        return complain(reader, "this id came before", "each id once");
    }
    reader->seen[(int64_t)id] = true;
    return OZ_OK;
}

static OzStatus check_shape(const Reader *reader, const double row[OZ_BED_COLUMNS])
{
    double axis[3], square = 0, apart = 0;
    const double *q = &row[OZ_BED_QUATERNION];
    for (int k = 0; k < 4; k++) {
        square += q[k] * q[k];
    }
    if (fabs(square - 1) > UNIT_TOLERANCE) {
        return complain(reader, "the quaternion's length is not 1", "qw,qx,qy,qz of length 1");
    }
    oz_grains_axis(q, axis);
    for (int k = 0; k < 3; k++) {
        apart = fmax(apart, fabs(axis[k] - row[OZ_BED_AXIS + k]));
    }
    if (apart > UNIT_TOLERANCE) {
        return complain(reader, "ux,uy,uz is not the axis of the quaternion",
                        "both to say the same direction");
    }
    if (!(row[OZ_BED_DIAMETER] > 0 && row[OZ_BED_LENGTH] >= 0 && row[OZ_BED_MASS] > 0)) {
        return complain(reader, "impossible size or mass",
                        "diameter and mass above 0, length at least 0");
    }
    return OZ_OK;
}

/* Inertia for the written mass; sizes whose moments a double cannot hold are refused. */
static OzStatus store(const Reader *reader, OzGrains *grains, const double row[OZ_BED_COLUMNS])
{
    int64_t i = (int64_t)row[OZ_BED_ID];
    grains->diameter[i] = row[OZ_BED_DIAMETER];
    grains->length[i] = row[OZ_BED_LENGTH];
    oz_grains_set_mass(
        grains, i, row[OZ_BED_MASS] / oz_grains_volume(row[OZ_BED_DIAMETER], row[OZ_BED_LENGTH]));
    grains->mass[i] = row[OZ_BED_MASS];
    memcpy(&grains->position[3 * i], &row[OZ_BED_POSITION], 3 * sizeof(double));
    memcpy(&grains->quaternion[4 * i], &row[OZ_BED_QUATERNION], 4 * sizeof(double));
    memcpy(&grains->velocity[3 * i], &row[OZ_BED_VELOCITY], 3 * sizeof(double));
    memcpy(&grains->angular_velocity[3 * i], &row[OZ_BED_SPIN], 3 * sizeof(double));
    if (!(isnormal(grains->inertia[i]) && isnormal(grains->inertia_axis[i]))) {
        return complain(reader, "this size and mass have no finite moment of inertia",
                        "SI units: metres and kilograms");
    }
    return OZ_OK;
}

/* The place of a column's name in a row of ours, or -1. */
static int find_column(const char *name)
{
    const char *at = OZ_RESTART_CSV_HEADER;
    char column[CELL_SIZE];
    for (int i = 0; next_cell(&at, column); i++) {
        if (strcmp(column, name) == 0) {
            return i;
        }
    }
    return -1;
}

static OzStatus complain_of_column(const Reader *reader, const char *what, const char *name)
{
    char wrong[CELL_SIZE + 64];
    snprintf(wrong, sizeof wrong, "%s %s", what, name);
    return complain(reader, wrong, "the columns " OZ_RESTART_CSV_HEADER ", in any order");
}

/* Takes one name of the header; *count is how many came before. */
static OzStatus take_column(Reader *reader, const char *name, bool found[OZ_BED_COLUMNS],
                            int *count)
{
    int column = find_column(name);
    if (column < 0 && *count == 0) {
        return complain(reader, "this is no final.csv", "the first line " OZ_RESTART_CSV_HEADER);
    }
    if (column < 0 || found[column]) {
        return complain_of_column(reader, column < 0 ? "no such column:" : "twice the column",
                                  name);
    }
    found[column] = true;
    reader->place[(*count)++] = column;
    return OZ_OK;
}

static OzStatus read_header(Reader *reader)
{
    static const char byte_order_mark[] = "\xef\xbb\xbf";
    char name[CELL_SIZE];
    bool found[OZ_BED_COLUMNS] = {false};
    int count = 0;
    if (strncmp(reader->next, byte_order_mark, 3) == 0) {
        reader->next += 3;
    }
    const char *line = next_line(reader), *at = line ? line : "";
    reader->line = 1;
    while (next_cell(&at, name)) {
        OZ_PASS(take_column(reader, name, found, &count));
    }
    at = OZ_RESTART_CSV_HEADER;
    for (int i = 0; i < OZ_BED_COLUMNS; i++) {
        next_cell(&at, name);
        OZ_PASS(found[i] ? OZ_OK : complain_of_column(reader, "without the column", name));
    }
    return OZ_OK;
}

static OzStatus read_rows(Reader *reader, OzGrains *grains)
{
    double row[OZ_BED_COLUMNS];
    for (char *line = next_line(reader); line; line = next_line(reader)) {
        if (!*line) {
            continue;
        }
        OZ_PASS(parse_row(reader, line, row));
        OZ_PASS(check_id(reader, row[OZ_BED_ID], grains->count));
        OZ_PASS(check_shape(reader, row));
        OZ_PASS(store(reader, grains, row));
    }
    return OZ_OK;
}

OzStatus oz_restart_csv_read(OzGrains *grains, const char *path)
{
    OzStatus status = OZ_OK;
    Reader reader = {.path = path};
    size_t length = 0;
    memset(grains, 0, sizeof *grains);
    OZ_TRY(oz_file_read(&reader.text, &length, path));
    if (strlen(reader.text) != length) {
        status = oz_status_fail(OZ_ERR_INPUT, "%s: holds a zero byte; expected plain text", path);
        goto done;
    }
    reader.next = reader.text;
    int64_t count = count_rows(reader.text);
    OZ_TRY(read_header(&reader));
    OZ_TRY(count > 0 ? OZ_OK : complain(&reader, "no grain", "a row for each below the header"));
    OZ_TRY(OZ_NEW(&reader.seen, count));
    OZ_TRY(oz_grains_create(grains, count));
    OZ_TRY(read_rows(&reader, grains));
done:
    if (status != OZ_OK) {
        oz_grains_free(grains);
    }
    free(reader.seen);
    free(reader.text);
    return status;
}
