/* Reading tables for plots. */
#include "plot/plot_table.h"

#include "base/file.h"
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* The next line of the text, cut off; NULL at the end. */
static char *next_line(char **at)
{
    char *line = *at;
    if (!*line) {
        return NULL;
    }
    char *end = line + strcspn(line, "\n");
    *at = end + (*end != '\0');
    *end = '\0';
    return line;
}

/* The next cell of a line, cut off; NULL at the end. */
static char *next_cell(char **at)
{
    char *cell = *at;
    if (!cell) {
        return NULL;
    }
    char *comma = strchr(cell, ',');
    *at = comma ? comma + 1 : NULL;
    if (comma) {
        *comma = '\0';
    }
    return cell;
}

static OzStatus read_names(OzPlotTable *table, char *line)
{
    int most = 1;
    for (const char *c = line; *c; c++) {
        most += *c == ',';
    }
    OZ_PASS(OZ_NEW(&table->names, most));
    OZ_PASS(OZ_NEW(&table->has_value, most));
    for (char *cell = next_cell(&line); cell; cell = next_cell(&line)) {
        table->names[table->column_count++] = cell;
    }
    return OZ_OK;
}

static OzStatus note_first(OzPlotTable *table, char *cell)
{
    for (int i = 0; i < table->first_count; i++) {
        if (strcmp(table->first[i], cell) == 0) {
            return OZ_OK;
        }
    }
    size_t count = (size_t)table->first_count;
    OZ_PASS(oz_memory_grow((void **)&table->first, count, count + 1, sizeof *table->first,
                           "a table's first column"));
    table->first[table->first_count++] = cell;
    return OZ_OK;
}

/* Series have a step in their first column, as many texts as rows: those are not noted. */
static OzStatus read_row(OzPlotTable *table, char *line)
{
    int column = 0;
    bool is_series = strcmp(table->names[0], "step") == 0;
    for (char *cell = next_cell(&line); cell && column < table->column_count;
         cell = next_cell(&line), column++) {
        char *end = NULL;
        strtod(cell, &end);
        table->has_value[column] |= end != cell && *end == '\0';
        if (column == 0 && !is_series) {
            OZ_PASS(note_first(table, cell));
        }
    }
    table->row_count++;
    return OZ_OK;
}

OzStatus oz_plot_table_read(OzPlotTable *table, const char *path)
{
    memset(table, 0, sizeof *table);
    OZ_PASS(oz_file_read(&table->text, NULL, path));
    char *at = table->text, *line = next_line(&at);
    if (!line) {
        return oz_status_fail(OZ_ERR_INPUT, "%s is empty; expected a table", path);
    }
    OZ_PASS(read_names(table, line));
    while ((line = next_line(&at)) != NULL) {
        OZ_PASS(read_row(table, line));
    }
    return OZ_OK;
}

int oz_plot_table_find(const OzPlotTable *table, const char *name)
{
    for (int i = 0; i < table->column_count; i++) {
        if (strcmp(table->names[i], name) == 0) {
            return i;
        }
    }
    return -1;
}

void oz_plot_table_free(OzPlotTable *table)
{
    free(table->text);
    free(table->names);
    free(table->has_value);
    free(table->first);
    memset(table, 0, sizeof *table);
}
