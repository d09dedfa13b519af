/* Cutting a table into cells. */
#include "base/cells.h"

#include "base/file.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int count_of(const char *text, const char *end, char mark)
{
    int count = 0;
    for (; text < end; text++) {
        count += *text == mark;
    }
    return count;
}

/* One line's cells, from place `at` on. */
static void cut_line(OzCells *table, char *line, int64_t at)
{
    static char empty[] = "";
    for (int column = 0; column < table->column_count; column++) {
        char *comma = line ? strchr(line, ',') : NULL;
        table->cells[at + column] = line ? line : empty;
        if (comma) {
            *comma = '\0';
        }
        line = comma ? comma + 1 : NULL;
    }
}

OzStatus oz_cells_read(OzCells *table, const char *path)
{
    size_t length = 0;
    *table = (OzCells){0};
    OZ_PASS(oz_file_read(&table->text, &length, path));
    char *end = table->text + length, *line = table->text;
    if (length == 0 || line[0] == '\n') {
        return oz_status_fail(OZ_ERR_INPUT, "%s is empty; expected a table", path);
    }
    table->column_count = 1 + count_of(line, line + strcspn(line, "\n"), ',');
    int64_t lines = count_of(line, end, '\n') + (end[-1] != '\n');
    OZ_PASS(OZ_NEW(&table->cells, lines * table->column_count));
    for (int64_t i = 0; i < lines; i++) {
        char *next = line + strcspn(line, "\n");
        *next = '\0';
        cut_line(table, line, i * table->column_count);
        line = next + 1;
    }
    table->row_count = lines - 1;
    return OZ_OK;
}

void oz_cells_free(OzCells *table)
{
    free(table->text);
    free(table->cells);
    *table = (OzCells){0};
}

int oz_cells_find(const OzCells *table, const char *name)
{
    for (int column = 0; column < table->column_count; column++) {
        if (strcmp(table->cells[column], name) == 0) {
            return column;
        }
    }
    return -1;
}

const char *oz_cells_text(const OzCells *table, int64_t row, int column)
{
    return table->cells[(row + 1) * table->column_count + column];
}

double oz_cells_number(const OzCells *table, int64_t row, int column)
{
    const char *text = oz_cells_text(table, row, column);
    char *end = NULL;
    double value = strtod(text, &end);
    return end != text && *end == '\0' ? value : NAN;
}
