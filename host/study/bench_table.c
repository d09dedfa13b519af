/* Rows in columns. */
#include "study/bench_table.h"

#include <math.h>
#include <string.h>

static const struct {
    const char *name, *heading;
    int decimals;
    const char *meaning;
} columns[] = {
#define COLUMN(id, name, heading, decimals, meaning) {name, heading, decimals, meaning},
    OZ_BENCH_COLUMNS(COLUMN)
#undef COLUMN
};

/* Room for the heading and for numbers such as 1000000 and 123456.78. */
static int width_of(int c)
{
    int least = c == OZ_BENCH_GRAINS ? 8 : columns[c].decimals == 2 ? 8 : 6;
    int heading = (int)strlen(columns[c].heading) + 1;
    return heading > least ? heading : least;
}

void oz_bench_table_begin(FILE *text, FILE *csv)
{
    fprintf(text, "%-12s", "bed");
    fprintf(csv, "bed");
    for (int c = 0; c < OZ_BENCH_COLUMN_COUNT; c++) {
        fprintf(csv, ",%s", columns[c].name);
        if (columns[c].heading) {
            fprintf(text, "%*s", width_of(c), columns[c].heading);
        }
    }
    fprintf(text, "\n");
    fprintf(csv, "\n");
}

static void add_cell(int c, double value, FILE *text, FILE *csv)
{
    if (isfinite(value)) {
        fprintf(csv, ",%.9g", value);
    } else {
        fprintf(csv, ",");
    }
    if (!columns[c].heading) {
        return;
    }
    if (isfinite(value)) {
        fprintf(text, "%*.*f", width_of(c), columns[c].decimals, value);
    } else {
        fprintf(text, "%*s", width_of(c), "-");
    }
}

void oz_bench_table_add(const OzBenchRow *row, FILE *text, FILE *csv)
{
    fprintf(text, "%-12s", row->bed);
    fprintf(csv, "%s", row->bed);
    for (int c = 0; c < OZ_BENCH_COLUMN_COUNT; c++) {
        add_cell(c, row->value[c], text, csv);
    }
    fprintf(text, "\n");
    fprintf(csv, "\n");
    fflush(text);
    fflush(csv);
}

void oz_bench_table_explain(FILE *text)
{
    for (int c = 0; c < OZ_BENCH_COLUMN_COUNT; c++) {
        if (columns[c].heading) {
            fprintf(text, "  %-9s %s\n", columns[c].heading, columns[c].meaning);
        }
    }
}
