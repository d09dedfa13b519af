/* Reading tables for plots. */
#include "plot/plot_table.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static OzStatus note_first(OzPlotTable *table, const char *cell)
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
static OzStatus look_at_column(OzPlotTable *table, int column)
{
    const OzCells *cells = &table->cells;
    bool notes = column == 0 && strcmp(cells->cells[0], "step") != 0;
    for (int64_t row = 0; row < cells->row_count; row++) {
        double number = oz_cells_number(cells, row, column);
        table->has_value[column] |= !isnan(number);
        table->low[column] = fmin(row ? table->low[column] : NAN, number);
        table->high[column] = fmax(row ? table->high[column] : NAN, number);
        if (notes) {
            OZ_PASS(note_first(table, oz_cells_text(cells, row, column)));
        }
    }
    return OZ_OK;
}

OzStatus oz_plot_table_read(OzPlotTable *table, const char *path)
{
    *table = (OzPlotTable){0};
    OZ_PASS(oz_cells_read(&table->cells, path));
    OZ_PASS(OZ_NEW(&table->has_value, table->cells.column_count));
    OZ_PASS(OZ_NEW(&table->low, table->cells.column_count));
    OZ_PASS(OZ_NEW(&table->high, table->cells.column_count));
    for (int column = 0; column < table->cells.column_count; column++) {
        OZ_PASS(look_at_column(table, column));
    }
    return OZ_OK;
}

void oz_plot_table_free(OzPlotTable *table)
{
    oz_cells_free(&table->cells);
    free(table->has_value);
    free(table->low);
    free(table->high);
    free(table->first);
    *table = (OzPlotTable){0};
}
