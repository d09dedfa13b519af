/* Writes fields.csv and fields_mean.csv. */
#include "observe/coarse_rows.h"

#include "base/file.h"
#include "base/memory.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct OzCoarseRows {
    FILE *file;
    char *path;
    int64_t whole; /* bytes of whole moments */
    OzCoarseGrid grid;
    bool is_placed;    /* it is known where the grid lies     */
    OzCoarseSums sums; /* of the moment that was written last */
    double *total;     /* sums over `moments` of those from fields.mean_from on; owned */
    int64_t total_count;
    int64_t moments;
};

static const char PLACES[] = "x,y,z";

static void print_names(FILE *file)
{
    for (const OzCoarseColumn *c = oz_coarse_columns_all(); c->name; c++) {
        for (int k = 0; k < c->width; k++) {
            fprintf(file, ",%s%s", c->name, oz_coarse_columns_part(c, k));
        }
    }
    fputc('\n', file);
}

/* mode: of fopen. */
static OzStatus open_rows(OzCoarseRows **rows, const char *path, const OzScene *scene,
                          const char *mode)
{
    OzStatus status = OZ_OK;
    OZ_TRY(OZ_NEW(rows, 1));
    (*rows)->grid = oz_coarse_grid_make(scene);
    OZ_TRY(oz_memory_text(&(*rows)->path, path));
    (*rows)->file = fopen(path, mode);
    if (!(*rows)->file) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
    }
done:
    if (status != OZ_OK) {
        oz_coarse_rows_free(*rows);
        *rows = NULL;
    }
    return status;
}

OzStatus oz_coarse_rows_create(OzCoarseRows **rows, const char *path, const OzScene *scene)
{
    OZ_PASS(open_rows(rows, path, scene, "w"));
    fprintf((*rows)->file, "step,time,%s", PLACES);
    print_names((*rows)->file);
    return oz_file_commit((*rows)->file, &(*rows)->whole, path);
}

OzStatus oz_coarse_rows_go_on(OzCoarseRows **rows, const char *path, const OzScene *scene)
{
    return open_rows(rows, path, scene, "r+");
}

static void print_number(FILE *file, double number)
{
    if (isfinite(number)) {
        fprintf(file, ",%.9g", number + 0.0); /* -0 becomes 0 */
    } else {
        fputc(',', file);
    }
}

/* Cell i: its middle and its numbers. */
static void print_cell(FILE *file, const OzCoarseGrid *grid, int64_t i, const double *sums,
                       double factor)
{
    double numbers[OZ_COARSE_NUMBERS];
    int64_t rest = i;
    for (int axis = 0; axis < 3; axis++) {
        double middle = oz_coarse_grid_middle(grid, axis, rest % grid->cells[axis]);
        fprintf(file, axis ? ",%.9g" : "%.9g", middle + 0.0);
        rest /= grid->cells[axis];
    }
    oz_coarse_columns_find(&sums[i * OZ_COARSE_COUNT], factor, numbers);
    for (int k = 0; k < OZ_COARSE_NUMBERS; k++) {
        print_number(file, numbers[k]);
    }
    fputc('\n', file);
}

static OzStatus place(OzCoarseRows *rows, const OzSnapshot *snapshot)
{
    if (!rows->is_placed) {
        oz_coarse_grid_place(&rows->grid, snapshot);
        rows->is_placed = true;
    }
    return rows->sums.cell ? OZ_OK
                           : oz_coarse_sums_create(&rows->sums, &rows->grid, snapshot->count);
}

static OzStatus add_to_mean(OzCoarseRows *rows, const OzSnapshot *snapshot)
{
    int64_t count = OZ_COARSE_COUNT * rows->sums.cells;
    const double slack = 1e-9; /* of a moment's time, which is a whole number of steps */
    if (snapshot->time < snapshot->scene->fields.mean_from * (1 - slack)) {
        return OZ_OK;
    }
    if (rows->total_count == 0) {
        free(rows->total); /* a loaded one may be of no length */
        OZ_PASS(OZ_NEW(&rows->total, count));
        rows->total_count = count;
    }
    for (int64_t k = 0; k < count; k++) {
        rows->total[k] += rows->sums.cell[k];
    }
    rows->moments++;
    return OZ_OK;
}

OzStatus oz_coarse_rows_write(OzCoarseRows *rows, const OzSnapshot *snapshot)
{
    OZ_PASS(place(rows, snapshot));
    OZ_PASS(oz_coarse_sums_fill(&rows->sums, &rows->grid, snapshot));
    for (int64_t i = 0; i < rows->sums.cells; i++) {
        fprintf(rows->file, "%lld,%.9g,", (long long)snapshot->step, snapshot->time);
        print_cell(rows->file, &rows->grid, i, rows->sums.cell, 1);
    }
    OZ_PASS(oz_file_commit(rows->file, &rows->whole, rows->path));
    return add_to_mean(rows, snapshot);
}

/* What was loaded must be cells somewhere, and a mean of all of them, if there is one. */
static OzStatus check_loaded(const OzCoarseRows *rows)
{
    const OzCoarseGrid *grid = &rows->grid;
    int64_t count = rows->moments > 0 ? OZ_COARSE_COUNT * oz_coarse_grid_count(grid) : 0;
    bool good = rows->total_count == count;
    for (int axis = 0; axis < 3 && rows->is_placed; axis++) {
        double length = grid->high[axis] - grid->low[axis];
        good = good && length > 0 && isfinite(length);
    }
    return good ? OZ_OK : oz_status_fail(OZ_ERR_INPUT, "the state's fields are not this scene's");
}

OzStatus oz_coarse_rows_state(OzCoarseRows *rows, OzStateVisit *visit)
{
    OZ_PASS(oz_state_enter(visit, "fields", 1));
    OZ_PASS(oz_state_index(visit, "file_bytes", &rows->whole, 0, INT64_MAX));
    OZ_PASS(oz_state_bool(visit, "is_placed", &rows->is_placed));
    OZ_PASS(oz_state_double(visit, "low", "m", rows->grid.low, 3));
    OZ_PASS(oz_state_double(visit, "high", "m", rows->grid.high, 3));
    OZ_PASS(oz_state_index(visit, "moments", &rows->moments, 0, INT64_MAX));
    OZ_PASS(oz_state_array(visit, "total", "of each sum", OZ_STATE_DOUBLE, &rows->total,
                           &rows->total_count));
    oz_state_leave(visit);
    if (!visit->is_loading) {
        return OZ_OK;
    }
    OZ_PASS(check_loaded(rows));
    return oz_file_go_on(rows->file, rows->whole, rows->path);
}

bool oz_coarse_rows_has_mean(const OzCoarseRows *rows)
{
    return rows->moments > 0;
}

OzStatus oz_coarse_rows_write_mean(const OzCoarseRows *rows, const char *path)
{
    FILE *file = fopen(path, "w");
    bool good = file != NULL;
    if (file) {
        fputs(PLACES, file);
        print_names(file);
        for (int64_t i = 0; i < oz_coarse_grid_count(&rows->grid); i++) {
            print_cell(file, &rows->grid, i, rows->total, 1 / (double)rows->moments);
        }
        good = !ferror(file);
        good = fclose(file) == 0 && good;
    }
    return good ? OZ_OK : oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
}

const double *oz_coarse_rows_last(const OzCoarseRows *rows, bool mean, double *factor)
{
    *factor = mean ? 1 / (double)rows->moments : 1;
    return mean ? rows->total : rows->sums.cell;
}

const OzCoarseGrid *oz_coarse_rows_grid(const OzCoarseRows *rows)
{
    return rows->is_placed ? &rows->grid : NULL;
}

OzStatus oz_coarse_rows_free(OzCoarseRows *rows)
{
    OzStatus status = OZ_OK;
    if (!rows) {
        return OZ_OK;
    }
    if (rows->file && fclose(rows->file) != 0) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", rows->path, strerror(errno));
    }
    oz_coarse_sums_free(&rows->sums);
    free(rows->total);
    free(rows->path);
    free(rows);
    return status;
}
