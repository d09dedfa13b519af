/* series.csv and the tap means. Walks the list of observables and knows none of them by name.
 */
#include "observe/series.h"

#include "base/file.h"
#include "base/memory.h"
#include "observe/rows_file.h"
#include "observe/surplus.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The last values of one observable. */
typedef struct Ring {
    double *value;
    int64_t capacity, count, next;
} Ring;

struct OzSeries {
    FILE *file;    /* NULL: rows are read by oz_series_row alone */
    char *path;    /* NULL with it                               */
    int64_t whole; /* bytes of whole rows */
    const OzScene *scene;
    double interval;  /* s, between rows of the even series of a drum */
    bool has_ledger;  /* the scene that runs keeps one             */
    uint8_t *is_kept; /* of each column of the list: 0, or the file has it */
    int column_count;
    OzMeasure measure;
    Ring mean[OZ_TAP_MEANS];
    OzWallPush push; /* of the row in hand, where the scene asks for it */
    double *row;     /* the last one; NAN: an empty cell */
    int cell_count;
    bool has_start;
    double energy_start; /* J, of the first row */
    OzSurplus surplus;
    OzFlow flow;
    OzBedOrder order; /* of the row in hand, where the scene asks for it */
};

const OzColumn *oz_series_columns(void)
{
    return oz_observables_list();
}

static OzStatus ring_create(Ring *ring, int64_t capacity)
{
    ring->capacity = capacity;
    return OZ_NEW(&ring->value, capacity);
}

static void ring_add(Ring *ring, double value)
{
    ring->value[ring->next] = value;
    ring->next = (ring->next + 1) % ring->capacity;
    ring->count += ring->count < ring->capacity;
}

static bool ring_mean(const Ring *ring, double *mean)
{
    double sum = 0;
    for (int64_t i = 0; i < ring->count; i++) {
        sum += ring->value[i];
    }
    *mean = ring->count > 0 ? sum / (double)ring->count : 0;
    return ring->count > 0;
}

/* Ends the row; whatever failed since the last one shows here. */
static OzStatus end_row(OzSeries *series)
{
    if (!series->file) {
        return OZ_OK;
    }
    fputc('\n', series->file);
    return oz_file_commit(series->file, &series->whole, series->path);
}

/* Cells that the file has of a column. */
static int width_of(const OzSeries *series, int column)
{
    return series->is_kept[column]
               ? oz_observables_width(&oz_series_columns()[column], series->scene)
               : 0;
}

static OzStatus write_header(OzSeries *series)
{
    char name[OZ_COLUMN_NAME];
    for (int cell = 0; cell < series->cell_count; cell++) {
        oz_series_name(series, cell, name);
        fprintf(series->file, "%s%s", cell ? "," : "", name);
    }
    return end_row(series);
}

/* Room for the columns that are kept. */
static OzStatus make_row(OzSeries *series)
{
    series->cell_count = 0;
    for (int k = 0; k < series->column_count; k++) {
        series->cell_count += width_of(series, k);
    }
    free(series->row);
    return OZ_NEW(&series->row, series->cell_count);
}

/* Keeps the columns that the scene has, beside those that are kept already. *more: there were some.
 */
static void keep_columns(OzSeries *series, bool *more)
{
    *more = false;
    for (int k = 0; k < series->column_count; k++) {
        bool has = oz_observables_cells(&oz_series_columns()[k], series->scene) > 0;
        *more |= has && !series->is_kept[k];
        series->is_kept[k] = has || series->is_kept[k];
    }
}

/* The list as flags, which are set where the scene has the column. */
static OzStatus make_columns(OzSeries *series)
{
    bool more = false;
    while (oz_series_columns()[series->column_count].name) {
        series->column_count++;
    }
    OZ_PASS(OZ_NEW(&series->is_kept, series->column_count));
    keep_columns(series, &more);
    return make_row(series);
}

/* The file with the columns that are kept by now, open at its end. */
static OzStatus reshape(OzSeries *series)
{
    OzStatus status = OZ_OK;
    char(*text)[OZ_COLUMN_NAME] = NULL;
    const char **names = NULL;
    OZ_TRY(make_row(series));
    if (!series->path) {
        return OZ_OK;
    }
    OZ_TRY(OZ_NEW(&text, series->cell_count));
    OZ_TRY(OZ_NEW(&names, series->cell_count));
    for (int cell = 0; cell < series->cell_count; cell++) {
        oz_series_name(series, cell, text[cell]);
        names[cell] = text[cell];
    }
    if (fclose(series->file) != 0) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", series->path, strerror(errno));
    }
    OZ_AFTER(status, oz_rows_file_reshape(series->path, names, series->cell_count));
    series->file = fopen(series->path, "r+");
    if (status == OZ_OK && !series->file) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", series->path, strerror(errno));
    }
done:
    free(names);
    free(text);
    return status;
}

static OzStatus open_file(OzSeries *series, const char *mode)
{
    series->file = fopen(series->path, mode);
    if (!series->file) {
        return oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", series->path, strerror(errno));
    }
    return mode[0] == 'w' ? write_header(series) : OZ_OK;
}

/* mode: of fopen; a header is written into an empty file. */
static OzStatus open_series(OzSeries **series, const char *path, const OzScene *scene,
                            const OzGrains *grains, const char *mode)
{
    OzStatus status = OZ_OK;
    bool all_phases = scene->observe.at == OZ_OBSERVE_MEAN && scene->observe.samples_per_tap > 0;
    int64_t samples = all_phases ? scene->observe.samples_per_tap : 1;
    OZ_TRY(OZ_NEW(series, 1));
    (*series)->scene = scene;
    (*series)->interval = scene->observe.interval;
    OZ_TRY(oz_memory_text(&(*series)->path, path));
    OZ_TRY(oz_measure_create(&(*series)->measure, scene, grains));
    (*series)->has_ledger = scene->observe.ledger;
    OZ_TRY(oz_wall_push_take(&(*series)->push, scene));
    OZ_TRY(make_columns(*series));
    for (int k = 0; k < OZ_TAP_MEANS; k++) {
        OZ_TRY(ring_create(&(*series)->mean[k], 2 * samples));
    }
    OZ_TRY(path ? open_file(*series, mode) : OZ_OK);
done:
    if (status != OZ_OK) {
        oz_series_free(*series);
        *series = NULL;
    }
    return status;
}

OzStatus oz_series_create(OzSeries **series, const char *path, const OzScene *scene,
                          const OzGrains *grains)
{
    return open_series(series, path, scene, grains, "w");
}

OzStatus oz_series_go_on(OzSeries **series, const char *path, const OzScene *scene,
                         const OzGrains *grains)
{
    return open_series(series, path, scene, grains, "r+");
}

static OzStatus ring_state(Ring *ring, OzStateVisit *visit)
{
    OZ_PASS(oz_state_index(visit, "count", &ring->count, 0, ring->capacity));
    OZ_PASS(oz_state_index(visit, "next", &ring->next, 0, ring->capacity - 1));
    return oz_state_double(visit, "value", "as the column", ring->value, ring->capacity);
}

OzStatus oz_series_state(OzSeries *series, OzStateVisit *visit)
{
    OZ_PASS(oz_state_enter(visit, "series", 3));
    OZ_PASS(oz_state_items(visit, "columns", "none", OZ_STATE_BYTES, series->is_kept,
                           series->column_count));
    OZ_PASS(oz_state_index(visit, "file_bytes", &series->whole, 0, INT64_MAX));
    OZ_PASS(oz_state_bool(visit, "has_start", &series->has_start));
    OZ_PASS(oz_state_double(visit, "energy_start", "J", &series->energy_start, 1));
    for (int k = 0; k < OZ_TAP_MEANS; k++) {
        oz_state_enter_one(visit, "mean", k);
        OZ_PASS(ring_state(&series->mean[k], visit));
        oz_state_leave(visit);
    }
    OZ_PASS(oz_surplus_state(&series->surplus, visit));
    OZ_PASS(oz_flow_state(&series->flow, visit));
    OZ_PASS(oz_wall_push_state(&series->push, visit));
    oz_state_leave(visit);
    if (visit->is_loading) { /* the run may have got columns after this state was made */
        OZ_PASS(reshape(series));
        return series->file ? oz_file_go_on(series->file, series->whole, series->path) : OZ_OK;
    }
    return OZ_OK;
}

/* Columns that came with a change. */
static OzStatus grow_columns(OzSeries *series)
{
    bool more = false;
    keep_columns(series, &more);
    if (!more) {
        return OZ_OK;
    }
    OZ_PASS(reshape(series));
    if (!series->file) {
        return OZ_OK;
    }
    if (fseeko(series->file, 0, SEEK_END) != 0) {
        return oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", series->path, strerror(errno));
    }
    series->whole = ftello(series->file);
    return OZ_OK;
}

OzStatus oz_series_take(OzSeries *series)
{
    if (series->interval != series->scene->observe.interval) {
        series->flow.sample_count = 0;
        series->interval = series->scene->observe.interval;
    }
    if (series->has_ledger != series->scene->observe.ledger) { /* whose sums begin anew */
        series->has_ledger = series->scene->observe.ledger;
        series->has_start = false;
        series->surplus = (OzSurplus){0};
    }
    OZ_PASS(oz_wall_push_take(&series->push, series->scene));
    return grow_columns(series);
}

void oz_series_sample(OzSeries *series, const OzSnapshot *snapshot)
{
    OzTapSample sample = oz_observables_sample(&series->measure, snapshot);
    for (int k = 0; k < OZ_TAP_MEANS; k++) {
        if (sample.present[k]) {
            ring_add(&series->mean[k], sample.value[k]);
        }
    }
}

static OzObservation observe(OzSeries *series, const OzSnapshot *snapshot)
{
    OzObservation observation = {.measure = &series->measure,
                                 .snapshot = snapshot,
                                 .flow = &series->flow,
                                 .order = &series->order};
    observation.contacts = oz_contact_list_sum(&snapshot->contacts);
    observation.push = &series->push;
    oz_wall_push_see(&series->push, snapshot);
    oz_measure_layers(&series->measure, snapshot, observation.layers);
    for (int k = 0; k < OZ_TAP_MEANS; k++) {
        observation.has_mean[k] = ring_mean(&series->mean[k], &observation.mean[k]);
    }
    observation.has_start = series->has_start;
    observation.energy_start = series->energy_start;
    return observation;
}

/* Returns the value, NAN for an empty cell. */
static double write_cell(FILE *file, const OzColumn *column, const OzObservation *observation)
{
    double value = 0;
    if (!column->value(observation, &value)) {
        return NAN;
    }
    if (!file) {
        return value;
    }
    if (isnan(value)) { /* printf would let a sign slip in */
        fputs("nan", file);
    } else {
        fprintf(file, column->whole ? "%.0f" : "%.9g", value);
    }
    return value;
}

OzStatus oz_series_write(OzSeries *series, const OzSnapshot *snapshot)
{
    OzStatus status = OZ_OK;
    OZ_PASS(oz_flow_see(&series->flow, snapshot));
    if (series->scene->observe.order) {
        OZ_PASS(oz_bed_order_find(&series->order, snapshot));
    }
    OzObservation observation = observe(series, snapshot);
    const char *comma = "";
    double *value = series->row;
    for (int k = 0; k < series->column_count; k++) {
        const OzColumn *column = &oz_series_columns()[k];
        bool has = oz_observables_cells(column, series->scene) > 0;
        for (int cell = 0; cell < width_of(series, k); cell++, comma = ",") {
            if (series->file) {
                fputs(comma, series->file);
            }
            observation.index = column->index + cell;
            *value++ = has ? write_cell(series->file, column, &observation) : NAN;
        }
    }
    if (!series->has_start) {
        series->has_start = true;
        series->energy_start = oz_observables_energy(snapshot);
    }
    status = end_row(series);
    return status == OZ_OK ? oz_surplus_check(&series->surplus, snapshot) : status;
}

int oz_series_row(const OzSeries *series, const double **cells)
{
    *cells = series->row;
    return series->cell_count;
}

void oz_series_name(const OzSeries *series, int cell, char name[OZ_COLUMN_NAME])
{
    int column = 0;
    while (width_of(series, column) <= cell) {
        cell -= width_of(series, column++);
    }
    oz_observables_name(&oz_series_columns()[column], series->scene, cell, name);
}

bool oz_series_has_spectrum(const OzSeries *series)
{
    return series->flow.sample_count > 0;
}

OzStatus oz_series_write_spectrum(const OzSeries *series, const char *path)
{
    return oz_flow_write_spectrum(&series->flow, series->scene->observe.interval, path);
}

OzStatus oz_series_free(OzSeries *series)
{
    OzStatus status = OZ_OK;
    if (!series) {
        return OZ_OK;
    }
    if (series->file && fclose(series->file) != 0) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", series->path, strerror(errno));
    }
    oz_measure_free(&series->measure);
    oz_wall_push_free(&series->push);
    free(series->row);
    free(series->is_kept);
    oz_flow_free(&series->flow);
    oz_bed_order_free(&series->order);
    for (int k = 0; k < OZ_TAP_MEANS; k++) {
        free(series->mean[k].value);
    }
    free(series->path);
    free(series);
    return status;
}
