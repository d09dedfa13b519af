/* Outflow, avalanches and the spectrum of a drum's inclination. */
#include "observe/flow.h"

#include "base/memory.h"
#include "observe/inclination.h"
#include "observe/spectrum.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double DEGREES = 180 / 3.14159265358979323846;

static void see_outflow(OzFlow *flow, const OzSnapshot *snapshot)
{
    const OzScene *scene = snapshot->scene;
    double before = flow->out_mass, since = snapshot->time - flow->last_time;
    flow->has_outlet = scene->observe.has_outlet;
    flow->out_count = 0;
    flow->out_mass = 0;
    for (int64_t g = 0; flow->has_outlet && g < snapshot->count; g++) {
        if (snapshot->position[3 * g + 1] < scene->observe.outlet) {
            flow->out_count++;
            flow->out_mass += snapshot->grains->mass[g];
        }
    }
    flow->has_rate = flow->has_outlet && flow->seen && since > 0;
    flow->out_rate = flow->has_rate ? (flow->out_mass - before) / since : 0;
}

/* Follows centre down from its highest until it has clearly turned up again. */
static void see_fall(OzFlow *flow)
{
    double now = flow->centre;
    if (flow->sample_count == 0) {
        flow->highest = now;
    }
    if (!flow->is_falling) {
        flow->highest = fmax(flow->highest, now);
        flow->is_falling = now <= flow->highest - OZ_FLOW_AVALANCHE;
        flow->lowest = now;
        return;
    }
    flow->lowest = fmin(flow->lowest, now);
    if (now >= flow->lowest + 0.5 * OZ_FLOW_AVALANCHE) {
        flow->avalanche_count++;
        flow->avalanche_size = flow->highest - flow->lowest;
        flow->is_falling = false;
        flow->highest = now;
    }
}

static OzStatus keep_sample(OzFlow *flow)
{
    OZ_PASS(OZ_ROOM(&flow->samples, &flow->sample_capacity, flow->sample_count + 1,
                    "inclinations"));
    flow->samples[flow->sample_count++] = (OzFlowSample){flow->surface, flow->centre};
    return OZ_OK;
}

static void average(OzFlow *flow)
{
    int64_t first = flow->sample_count / 2, count = flow->sample_count - first;
    double sum = 0, square = 0;
    for (int64_t i = first; i < flow->sample_count; i++) {
        sum += flow->samples[i].surface;
    }
    flow->mean = sum / (double)count;
    for (int64_t i = first; i < flow->sample_count; i++) {
        double off = flow->samples[i].surface - flow->mean;
        square += off * off;
    }
    flow->deviation = count > 1 ? sqrt(square / (double)(count - 1)) : 0;
}

/* The last row of a run may follow the one before too soon for an even series. A surface that
 * cannot be told is as it was. */
static OzStatus see_drum(OzFlow *flow, const OzSnapshot *snapshot)
{
    double surface = 0, centre = 0, interval = snapshot->scene->observe.interval;
    bool even = flow->sample_count == 0 || snapshot->time - flow->sample_time > 0.99 * interval;
    flow->has_surface = oz_inclination_surface(snapshot, &surface);
    flow->has_centre = oz_inclination_centre(snapshot, &centre);
    flow->surface = flow->has_surface ? DEGREES * surface : flow->surface;
    flow->centre = flow->has_centre ? DEGREES * centre : flow->centre;
    if (flow->has_centre && (flow->has_surface || flow->sample_count > 0) && even) {
        see_fall(flow);
        OZ_PASS(keep_sample(flow));
        average(flow);
        flow->sample_time = snapshot->time;
    }
    return OZ_OK;
}

OzStatus oz_flow_see(OzFlow *flow, const OzSnapshot *snapshot)
{
    see_outflow(flow, snapshot);
    if (oz_inclination_applies(snapshot->scene)) {
        OZ_PASS(see_drum(flow, snapshot));
    }
    flow->seen = true;
    flow->last_time = snapshot->time;
    return OZ_OK;
}

/* The later half of one of a sample's values; the caller frees. */
static OzStatus copy_half(const OzFlow *flow, bool centre, double **values, int64_t *count)
{
    int64_t first = flow->sample_count / 2;
    *count = flow->sample_count - first;
    OzStatus status = OZ_NEW(values, *count);
    for (int64_t i = 0; status == OZ_OK && i < *count; i++) {
        const OzFlowSample *sample = &flow->samples[first + i];
        (*values)[i] = centre ? sample->centre : sample->surface;
    }
    return status;
}

static OzStatus write_rows(const char *path, const double *surface, const double *centre,
                           int64_t count, double interval)
{
    FILE *file = fopen(path, "w");
    bool good = file != NULL;
    if (file) {
        fputs("frequency,inclination,inclination_centre\n", file);
        for (int64_t k = 1; 2 * k <= count && k <= OZ_FLOW_FREQUENCIES; k++) {
            fprintf(file, "%.9g,%.9g,%.9g\n", (double)k / ((double)count * interval),
                    oz_spectrum_amplitude(surface, count, k),
                    oz_spectrum_amplitude(centre, count, k));
        }
        good = !ferror(file);
        good = fclose(file) == 0 && good;
    }
    return good ? OZ_OK : oz_status_fail(OZ_ERR_FILE, "cannot write %s: %s", path, strerror(errno));
}

OzStatus oz_flow_write_spectrum(const OzFlow *flow, double interval, const char *path)
{
    OzStatus status = OZ_OK;
    double *surface = NULL, *centre = NULL;
    int64_t count = 0;
    if (flow->sample_count == 0) {
        return OZ_OK;
    }
    OZ_TRY(copy_half(flow, false, &surface, &count));
    OZ_TRY(copy_half(flow, true, &centre, &count));
    OZ_TRY(write_rows(path, surface, centre, count, interval));
done:
    free(surface);
    free(centre);
    return status;
}

void oz_flow_free(OzFlow *flow)
{
    free(flow->samples);
    memset(flow, 0, sizeof *flow);
}

static OzStatus samples_state(OzFlow *flow, OzStateVisit *visit)
{
    int64_t numbers = 2 * flow->sample_count;
    _Static_assert(sizeof *flow->samples == 2 * sizeof(double), "a sample is two numbers");
    OZ_PASS(oz_state_array(visit, "samples", "degrees, of surface and centre in turn",
                           OZ_STATE_DOUBLE, &flow->samples, &numbers));
    if (numbers % 2 != 0) {
        return oz_status_fail(OZ_ERR_INPUT, "state: half a sample of a drum's inclination");
    }
    flow->sample_count = numbers / 2;
    flow->sample_capacity = visit->is_loading ? numbers / 2 : flow->sample_capacity;
    return OZ_OK;
}

static OzStatus outflow_state(OzFlow *flow, OzStateVisit *visit)
{
    OZ_PASS(oz_state_bool(visit, "seen", &flow->seen));
    OZ_PASS(oz_state_double(visit, "last_time", "s", &flow->last_time, 1));
    return oz_state_double(visit, "out_mass", "kg", &flow->out_mass, 1);
}

OzStatus oz_flow_state(OzFlow *flow, OzStateVisit *visit)
{
    OZ_PASS(oz_state_enter(visit, "flow", 1));
    OZ_PASS(outflow_state(flow, visit));
    OZ_PASS(samples_state(flow, visit));
    OZ_PASS(oz_state_double(visit, "sample_time", "s", &flow->sample_time, 1));
    OZ_PASS(oz_state_double(visit, "surface", "degrees", &flow->surface, 1));
    OZ_PASS(oz_state_double(visit, "centre", "degrees", &flow->centre, 1));
    OZ_PASS(oz_state_double(visit, "mean", "degrees", &flow->mean, 1));
    OZ_PASS(oz_state_double(visit, "deviation", "degrees", &flow->deviation, 1));
    OZ_PASS(oz_state_int64(visit, "avalanche_count", "none", &flow->avalanche_count));
    OZ_PASS(oz_state_double(visit, "avalanche_size", "degrees", &flow->avalanche_size, 1));
    OZ_PASS(oz_state_bool(visit, "is_falling", &flow->is_falling));
    OZ_PASS(oz_state_double(visit, "highest", "degrees", &flow->highest, 1));
    OZ_PASS(oz_state_double(visit, "lowest", "degrees", &flow->lowest, 1));
    oz_state_leave(visit);
    return OZ_OK;
}
