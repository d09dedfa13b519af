/* Rows in columns. */
#include "bench/bench_table.h"

#include <math.h>

static const struct {
    const char *name, *heading;
    int width, decimals;
    const char *meaning;
} columns[] = {
#define COLUMN(id, name, heading, width, decimals, meaning)                                        \
    {name, heading, width, decimals, meaning},
    OZ_BENCH_COLUMNS(COLUMN)
#undef COLUMN
};

void oz_bench_table_begin(FILE *text, FILE *csv)
{
    fprintf(text, "%-12s", "bed");
    fprintf(csv, "bed");
    for (int c = 0; c < OZ_BENCH_COLUMN_COUNT; c++) {
        fprintf(csv, ",%s", columns[c].name);
        if (columns[c].heading) {
            fprintf(text, "%*s", columns[c].width, columns[c].heading);
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
        fprintf(text, "%*.*f", columns[c].width, columns[c].decimals, value);
    } else {
        fprintf(text, "%*s", columns[c].width, "-");
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
