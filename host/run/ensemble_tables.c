/* Adding up series over members. Cells are matched by the name of their column and the number of
 * their row: members of one value write their rows at the same steps. */
#include "run/ensemble_tables.h"

#include "base/file.h"
#include "base/folder.h"
#include "base/memory.h"
#include "base/student.h"
#include "observe/inclination_fit.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS_MAX = 128, MOMENT_COLUMNS = 3 /* step, time and tap: the same for all members */ };

/* Of one cell over members, by Welford 1962: mean and the sum of squares about it. */
typedef struct Cell {
    int64_t count;
    double mean, squares;
} Cell;

typedef struct Row {
    char *moment; /* "step,time,tap" */
    int64_t members;
    Cell cells[]; /* one a column */
} Row;

struct OzEnsemble {
    const char *folder, *key;
    FILE *members, *table;
    char *header; /* of the first series.csv, cut at its commas */
    char *columns[COLUMNS_MAX];
    int column_count;
    char *value; /* of the rows in hand */
    Row **rows;
    int64_t row_count, row_capacity;
    OzInclinationFit inclination; /* of a sweep over a drum's speed */
};

static OzStatus in_folder(const OzEnsemble *e, const char *name, char **path)
{
    return oz_file_join(path, e->folder, name);
}

/* A table is written under another name and renamed last: its presence says that the ensemble has
 * ended. */
OzStatus oz_ensemble_tables_create(OzEnsemble **ensemble, const char *folder, const char *key)
{
    OzStatus status = OZ_OK;
    OzEnsemble *e = NULL;
    OZ_TRY(OZ_NEW(&e, 1));
    e->folder = folder;
    e->key = key;
    OZ_TRY(oz_folder_create_file(&e->members, folder, "members.csv.part"));
    OZ_TRY(oz_folder_create_file(&e->table, folder, "ensemble.csv.part"));
    *ensemble = e;
    e = NULL;
done:
    if (e) {
        oz_ensemble_tables_finish(e);
    }
    return status;
}

/* Cuts a line at its commas; returns the number of cells. */
static int cut(char *line, char *cells[COLUMNS_MAX])
{
    int count = 0;
    line[strcspn(line, "\r\n")] = '\0';
    for (char *rest = line; rest && count < COLUMNS_MAX;) {
        cells[count++] = strsep(&rest, ",");
    }
    return count;
}

static void write_headers(const OzEnsemble *e)
{
    const char *comma = e->key ? "," : "", *key = e->key ? e->key : "";
    fprintf(e->members, "folder,seed%s%s,status", comma, key);
    fprintf(e->table, "%s%sstep,time,tap,members", key, comma);
    for (int c = 0; c < e->column_count; c++) {
        const char *name = e->columns[c];
        fprintf(e->members, ",%s", name);
        if (c >= MOMENT_COLUMNS) {
            fprintf(e->table, ",%s_mean,%s_spread,%s_ci95", name, name, name);
        }
    }
    fputc('\n', e->members);
    fputc('\n', e->table);
}

/* The first header is everyone's; place[i] receives where a series' column i belongs in it, -1:
 * nowhere. */
static OzStatus take_header(OzEnsemble *e, char *line, int place[COLUMNS_MAX])
{
    char *names[COLUMNS_MAX];
    if (!e->header) {
        OZ_PASS(oz_memory_text(&e->header, line));
        e->column_count = cut(e->header, e->columns);
        write_headers(e);
    }
    int count = cut(line, names);
    for (int i = 0; i < COLUMNS_MAX; i++) {
        place[i] = -1;
        for (int c = 0; i < count && c < e->column_count; c++) {
            place[i] = strcmp(names[i], e->columns[c]) == 0 ? c : place[i];
        }
    }
    return OZ_OK;
}

static OzStatus find_row(OzEnsemble *e, int64_t i, Row **row)
{
    if (i >= e->row_capacity) {
        int64_t wanted = 2 * i + 64;
        OZ_PASS(oz_memory_grow((void **)&e->rows, (size_t)e->row_capacity, (size_t)wanted,
                               sizeof *e->rows, "rows"));
        e->row_capacity = wanted;
    }
    if (!e->rows[i]) {
        OZ_PASS(oz_memory_new((void **)&e->rows[i], 1,
                              sizeof(Row) + (size_t)e->column_count * sizeof(Cell), "row"));
        e->row_count = i + 1;
    }
    *row = e->rows[i];
    return OZ_OK;
}

static void add_value(Cell *cell, double value)
{
    double before = value - cell->mean;
    cell->count++;
    cell->mean += before / (double)cell->count;
    cell->squares += before * (value - cell->mean);
}

/* Adds a row's cells; one that is empty or no number is left out of its column. */
static OzStatus add_row(OzEnsemble *e, int64_t i, char *const cells[COLUMNS_MAX])
{
    Row *row = NULL;
    OZ_PASS(find_row(e, i, &row));
    row->members++;
    if (!row->moment && asprintf(&row->moment, "%s,%s,%s", cells[0] ? cells[0] : "",
                                 cells[1] ? cells[1] : "", cells[2] ? cells[2] : "") < 0) {
        row->moment = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a row");
    }
    for (int c = MOMENT_COLUMNS; c < e->column_count; c++) {
        char *end = NULL;
        double value = cells[c] ? strtod(cells[c], &end) : NAN;
        if (end && end != cells[c] && isfinite(value)) {
            add_value(&row->cells[c], value);
        }
    }
    return OZ_OK;
}

/* Cells of a line in the order of the ensemble's columns; NULL where the series has none. */
static void arrange(char *line, const int place[COLUMNS_MAX], char *cells[COLUMNS_MAX])
{
    char *found[COLUMNS_MAX];
    int count = cut(line, found);
    memset(cells, 0, COLUMNS_MAX * sizeof *cells);
    for (int i = 0; i < count; i++) {
        if (place[i] >= 0) {
            cells[place[i]] = found[i];
        }
    }
}

/* A member's last row, empty where it has none. */
static void write_last(const OzEnsemble *e, char *const cells[COLUMNS_MAX])
{
    for (int c = 0; c < e->column_count; c++) {
        fprintf(e->members, ",%s", cells[c] ? cells[c] : "");
    }
}

/* Adds every row of a series and its last one to members.csv. */
static OzStatus add_series(OzEnsemble *e, FILE *file)
{
    OzStatus status = OZ_OK;
    char *line = NULL, *last = NULL, *cells[COLUMNS_MAX] = {0};
    size_t line_size = 0;
    int place[COLUMNS_MAX];
    if (getline(&line, &line_size, file) < 0) {
        goto done;
    }
    OZ_TRY(take_header(e, line, place));
    for (int64_t i = 0; getline(&line, &line_size, file) > 0; i++) {
        free(last);
        OZ_TRY(oz_memory_text(&last, line));
        arrange(line, place, cells);
        OZ_TRY(add_row(e, i, cells));
    }
    memset(cells, 0, sizeof cells);
    if (last) {
        arrange(last, place, cells);
    }
    write_last(e, cells);
done:
    free(last);
    free(line);
    return status;
}

static void write_cell(const OzEnsemble *e, const Cell *cell, double limit)
{
    double n = (double)cell->count, spread = n > 1 ? sqrt(cell->squares / (n - 1)) : 0;
    if (cell->count == 0) {
        fputs(",,,", e->table);
    } else if (cell->count == 1) {
        fprintf(e->table, ",%.9g,,", cell->mean);
    } else {
        fprintf(e->table, ",%.9g,%.9g,%.9g", cell->mean, spread, limit * spread / sqrt(n));
    }
}

static void write_row(const OzEnsemble *e, const Row *row)
{
    int64_t counted = 0;
    double limit = 0;
    fprintf(e->table, "%s%s%s,%" PRId64, e->key ? e->value : "", e->key ? "," : "", row->moment,
            row->members);
    for (int c = MOMENT_COLUMNS; c < e->column_count; c++) {
        const Cell *cell = &row->cells[c];
        if (cell->count > 1 && cell->count != counted) {
            limit = oz_student_limit((int)cell->count - 1);
            counted = cell->count;
        }
        write_cell(e, cell, limit);
    }
    fputc('\n', e->table);
}

/* A drum's speed and the mean inclination of its members' last row. */
static OzStatus note_inclination(OzEnsemble *e)
{
    if (e->row_count == 0 || !oz_inclination_fit_applies(e->key)) {
        return OZ_OK;
    }
    for (int c = 0; c < e->column_count; c++) {
        const Cell *cell = &e->rows[e->row_count - 1]->cells[c];
        if (strcmp(e->columns[c], "inclination_mean") == 0 && cell->count > 0) {
            OZ_PASS(oz_inclination_fit_add(&e->inclination, strtod(e->value, NULL), cell->mean));
        }
    }
    return OZ_OK;
}

/* Writes the rows in hand: the members of a value are all in. */
static OzStatus end_value(OzEnsemble *e)
{
    OzStatus status = note_inclination(e);
    for (int64_t i = 0; i < e->row_count; i++) {
        write_row(e, e->rows[i]);
        free(e->rows[i]->moment);
        free(e->rows[i]);
        e->rows[i] = NULL;
    }
    e->row_count = 0;
    free(e->value);
    e->value = NULL;
    return status;
}

OzStatus oz_ensemble_tables_add(OzEnsemble *e, const OzEnsembleRow *row)
{
    OzStatus status = OZ_OK;
    char *folder = NULL, *path = NULL;
    FILE *series = NULL;
    if (row->value && (!e->value || strcmp(e->value, row->value) != 0)) {
        OZ_TRY(end_value(e));
        OZ_TRY(oz_memory_text(&e->value, row->value));
    }
    OZ_TRY(oz_file_join(&folder, row->place ? row->place : e->folder, row->name));
    OZ_TRY(oz_file_join(&path, folder, "series.csv"));
    series = row->has_series ? fopen(path, "r") : NULL;
    /* The header is known once the first series is: it comes before the first member's row. */
    if (series && !e->header) {
        char *line = NULL;
        size_t size = 0;
        int place[COLUMNS_MAX];
        status = getline(&line, &size, series) > 0 ? take_header(e, line, place) : OZ_OK;
        free(line);
        rewind(series);
        OZ_TRY(status);
    }
    fprintf(e->members, "%s,%" PRIu64 "%s%s,%s", row->name, row->seed, row->value ? "," : "",
            row->value ? row->value : "", row->status);
    if (series) {
        OZ_TRY(add_series(e, series));
    } else {
        write_last(e, (char *[COLUMNS_MAX]){0});
    }
    fputc('\n', e->members);
done:
    if (series) {
        fclose(series);
    }
    free(folder);
    free(path);
    return status;
}

static OzStatus close_table(const OzEnsemble *e, FILE *file, const char *part, const char *name)
{
    OzStatus status = OZ_OK;
    char *from = NULL, *to = NULL;
    bool bad = file && ferror(file) != 0;
    bad |= !file || fclose(file) != 0;
    OZ_TRY(in_folder(e, part, &from));
    OZ_TRY(in_folder(e, name, &to));
    OZ_TRY(oz_folder_note(e->folder, name));
    if (bad || rename(from, to) != 0) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", to, strerror(errno));
    }
done:
    free(from);
    free(to);
    return status;
}

OzStatus oz_ensemble_tables_finish(OzEnsemble *e)
{
    if (!e) {
        return OZ_OK;
    }
    OzStatus status = end_value(e);
    OZ_AFTER(status, oz_inclination_fit_write(&e->inclination, e->folder));
    OZ_AFTER(status, close_table(e, e->table, "ensemble.csv.part", "ensemble.csv"));
    OZ_AFTER(status, close_table(e, e->members, "members.csv.part", "members.csv"));
    oz_inclination_fit_free(&e->inclination);
    free(e->rows);
    free(e->header);
    free(e);
    return status;
}
