/* A table of numbers that never grows beyond what a plot shows. */
#include "run/page_rows.h"

#include "base/memory.h"
#include "run/page_json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROWS = 1024, /* more than a plot has pixels across */
    PLOTS = 8    /* columns in one answer              */
};

/* The column of this name, whose end is not marked; -1. */
static int find_column(const OzPageRows *rows, const char *name, size_t length)
{
    int i = 0;
    while (i < rows->column_count &&
           (strncmp(rows->names[i], name, length) != 0 || rows->names[i][length])) {
        i++;
    }
    return i < rows->column_count ? i : -1;
}

void oz_page_rows_free(OzPageRows *rows)
{
    for (int i = 0; i < rows->column_count; i++) {
        free(rows->names[i]);
    }
    free(rows->names);
    free(rows->values);
    *rows = (OzPageRows){0};
}

static OzStatus make(OzPageRows *rows, const char *const *names, int count)
{
    OZ_PASS(OZ_NEW(&rows->names, count));
    for (; rows->column_count < count; rows->column_count++) {
        OZ_PASS(oz_memory_text(&rows->names[rows->column_count], names[rows->column_count]));
    }
    return OZ_NEW(&rows->values, (size_t)count * ROWS);
}

/* The rows so far under the new columns. */
static void copy_rows(OzPageRows *to, const OzPageRows *from)
{
    to->count = from->count;
    to->kept = from->kept;
    to->every = from->every;
    for (int i = 0; i < to->column_count; i++) {
        int column = find_column(from, to->names[i], strlen(to->names[i]));
        for (int64_t r = 0; r < from->kept; r++) {
            to->values[r * to->column_count + i] =
                column < 0 ? NAN : from->values[r * from->column_count + column];
        }
    }
}

OzStatus oz_page_rows_open(OzPageRows *rows, const char *const *names, int count)
{
    OzPageRows made = {.every = 1};
    OzStatus status = make(&made, names, count);
    if (status == OZ_OK && rows->values) {
        copy_rows(&made, rows);
    }
    oz_page_rows_free(rows);
    *rows = made;
    return status;
}

/* Every second row that is kept goes. */
static void thin(OzPageRows *rows)
{
    size_t width = (size_t)rows->column_count;
    for (size_t r = 0; r < ROWS / 2; r++) {
        memmove(rows->values + r * width, rows->values + 2 * r * width,
                width * sizeof *rows->values);
    }
    rows->kept = ROWS / 2;
    rows->every *= 2;
}

void oz_page_rows_add(OzPageRows *rows, const double *values)
{
    if (!rows->values || rows->count++ % rows->every != 0) {
        return;
    }
    if (rows->kept == ROWS) {
        thin(rows);
    }
    size_t width = (size_t)rows->column_count;
    memcpy(rows->values + (size_t)rows->kept++ * width, values, width * sizeof *values);
}

/* The columns that the list names and the table has. */
static int choose_columns(const OzPageRows *rows, const char *list, int chosen[PLOTS])
{
    int count = 0;
    while (list && *list && count < PLOTS) {
        size_t length = strcspn(list, ",");
        int column = find_column(rows, list, length);
        if (column >= 0) {
            chosen[count++] = column;
        }
        list += length + (list[length] == ',');
    }
    return count;
}

static void print_names(char *const *names, const int *chosen, int count, FILE *file)
{
    fputc('[', file);
    for (int i = 0; i < count; i++) {
        fputs(i ? ", " : "", file);
        oz_page_json_text(file, names[chosen ? chosen[i] : i]);
    }
    fputc(']', file);
}

void oz_page_rows_print_names(const OzPageRows *rows, FILE *file)
{
    print_names(rows->names, NULL, rows->column_count, file);
}

void oz_page_rows_print(const OzPageRows *rows, const char *list, FILE *file)
{
    int chosen[PLOTS], count = choose_columns(rows, list, chosen);
    fputs("{\"columns\": ", file);
    print_names(rows->names, chosen, count, file);
    fputs(", \"rows\": [", file);
    for (int64_t r = 0; r < rows->kept; r++) {
        fputs(r ? ", [" : "[", file);
        for (int i = 0; i < count; i++) {
            fputs(i ? ", " : "", file);
            oz_page_json_number(file, rows->values[r * rows->column_count + chosen[i]]);
        }
        fputc(']', file);
    }
    fputs("]}\n", file);
}
