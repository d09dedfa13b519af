/* series.csv and the tap means. Walks the list of observables and knows none of them by name.
 */
#include "observe/series.h"

#include "base/file.h"
#include "base/memory.h"
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
    FILE *file;
    char *path;
    int64_t whole; /* bytes of whole rows */
    const OzScene *scene;
    double interval; /* s, between rows of the even series of a drum */
    OzMeasure measure;
    Ring mean[OZ_TAP_MEANS];
    double (*wall_force)[3]; /* of the row in hand; NULL: nobody asked */
    double *row;             /* the last one; NAN: an empty cell */
    int cell_count;
    bool has_start;
    double energy_start; /* J, of the first row */
    OzSurplus surplus;
    OzFlow flow;
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
    fputc('\n', series->file);
    return oz_file_commit(series->file, &series->whole, series->path);
}

static OzStatus write_header(OzSeries *series)
{
    const char *comma = "";
    char name[OZ_COLUMN_NAME];
    for (const OzColumn *column = oz_series_columns(); column->name; column++) {
        int cells = oz_observables_cells(column, series->scene);
        for (int cell = 0; cell < cells; cell++, comma = ",") {
            oz_observables_name(column, series->scene, cell, name);
            fprintf(series->file, "%s%s", comma, name);
        }
    }
    return end_row(series);
}

static OzStatus make_row(OzSeries *series)
{
    for (const OzColumn *column = oz_series_columns(); column->name; column++) {
        series->cell_count += oz_observables_cells(column, series->scene);
    }
    return OZ_NEW(&series->row, series->cell_count);
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
    if (scene->observe.walls) {
        OZ_TRY(OZ_NEW(&(*series)->wall_force, scene->wall_count));
    }
    OZ_TRY(make_row(*series));
    for (int k = 0; k < OZ_TAP_MEANS; k++) {
        OZ_TRY(ring_create(&(*series)->mean[k], 2 * samples));
    }
    (*series)->file = fopen(path, mode);
    if (!(*series)->file) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
        goto done;
    }
    if (mode[0] == 'w') {
        OZ_TRY(write_header(*series));
    }
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
    OZ_PASS(oz_state_enter(visit, "series", 1));
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
    oz_state_leave(visit);
    if (visit->is_loading) {
        return oz_file_go_on(series->file, series->whole, series->path);
    }
    return OZ_OK;
}

void oz_series_take(OzSeries *series)
{
    if (series->interval != series->scene->observe.interval) {
        series->flow.sample_count = 0;
        series->interval = series->scene->observe.interval;
    }
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
    OzObservation observation = {
        .measure = &series->measure, .snapshot = snapshot, .flow = &series->flow};
    observation.contacts = oz_contact_list_sum(&snapshot->contacts);
    observation.wall_force = series->wall_force;
    if (series->wall_force) {
        oz_contact_list_push_walls(&snapshot->contacts, series->wall_force,
                                   series->scene->wall_count);
    }
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
    if (isnan(value)) { /* printf would let a sign slip in */
        fputs("nan", file);
    } else {
        fprintf(file, column->whole ? "%.0f" : "%.9g", value);
    }
    return value;
}

OzStatus oz_series_write(OzSeries *series, const OzSnapshot *snapshot)
{
    OzStatus status = oz_flow_see(&series->flow, snapshot);
    if (status != OZ_OK) {
        return status;
    }
    OzObservation observation = observe(series, snapshot);
    const char *comma = "";
    double *value = series->row;
    for (const OzColumn *column = oz_series_columns(); column->name; column++) {
        int cells = oz_observables_cells(column, series->scene);
        for (int cell = 0; cell < cells; cell++, comma = ",") {
            fputs(comma, series->file);
            observation.index = column->index + cell;
            *value++ = write_cell(series->file, column, &observation);
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
    const OzColumn *column = oz_series_columns();
    int cells;
    while ((cells = oz_observables_cells(column, series->scene)) <= cell) {
        cell -= cells;
        column++;
    }
    oz_observables_name(column, series->scene, cell, name);
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
    free(series->wall_force);
    free(series->row);
    oz_flow_free(&series->flow);
    for (int k = 0; k < OZ_TAP_MEANS; k++) {
        free(series->mean[k].value);
    }
    free(series->path);
    free(series);
    return status;
}
