/* Measured motions: the way through the rows, its measures, and who keeps it. */
#include "scene/trace.h"

#include "base/file.h"
#include "base/log.h"
#include "base/memory.h"
#include "scene/trace_csv.h"

#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The last row at or before a time, of all but the last. */
static int64_t row_before(const OzTrace *trace, double time)
{
    int64_t low = 0, high = trace->count - 1;
    while (high - low > 1) {
        int64_t middle = (low + high) / 2;
        if (trace->time[middle] <= time) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

/* The cubic between two rows (Hermite): offset, velocity, acceleration at a share of the way. */
static void cubic_at(const OzTrace *trace, int64_t row, double share, double at[3])
{
    double h = trace->time[row + 1] - trace->time[row], u = share;
    double a = trace->offset[row], rise = trace->offset[row + 1] - a;
    double v = h * trace->velocity[row], w = h * trace->velocity[row + 1];
    double second = 3 * rise - 2 * v - w, third = v + w - 2 * rise;
    at[0] = a + u * (v + u * (second + u * third));
    at[1] = (v + u * (2 * second + 3 * u * third)) / h;
    at[2] = (2 * second + 6 * u * third) / (h * h);
}

void oz_trace_at(const OzTrace *trace, double time, double *offset, double *velocity)
{
    double end = trace->time[trace->count - 1], at[3] = {0};
    *velocity = 0;
    if (time >= end) {
        *offset = trace->offset[trace->count - 1];
        return;
    }
    if (time >= 0) {
        int64_t row = row_before(trace, time);
        double h = trace->time[row + 1] - trace->time[row];
        cubic_at(trace, row, (time - trace->time[row]) / h, at);
    }
    *offset = at[0];
    *velocity = at[1];
}

/* One row of a spline's equations for second derivatives: before, own, behind, right side. */
typedef struct Equation {
    double before, own, behind, right;
} Equation;

/* The second derivatives of inner rows are smooth, and the third is continuous at the second row
 * and the last but one (not-a-knot), which says those at the ends. Fewer than four rows: a parabola
 * or a straight line. */
static void set_equations(const OzTrace *trace, Equation *equations)
{
    const double *t = trace->time, *x = trace->offset;
    int64_t last = trace->count - 1;
    for (int64_t i = 1; i < last; i++) {
        double h = t[i] - t[i - 1], k = t[i + 1] - t[i];
        equations[i] =
            (Equation){h, 2 * (h + k), k, 6 * ((x[i + 1] - x[i]) / k - (x[i] - x[i - 1]) / h)};
    }
    if (last == 2) {
        equations[1].own += equations[1].before + equations[1].behind;
    } else if (last > 2) {
        double h = t[1] - t[0], k = t[2] - t[1];
        equations[1].own += h * (1 + h / k);
        equations[1].behind -= h * h / k;
        h = t[last] - t[last - 1];
        k = t[last - 1] - t[last - 2];
        equations[last - 1].own += h * (1 + h / k);
        equations[last - 1].before -= h * h / k;
    }
}

/* Second derivatives (Thomas's elimination), then velocities of the splines. */
static OzStatus join_offsets(OzTrace *trace)
{
    OzStatus status = OZ_OK;
    int64_t last = trace->count - 1;
    const double *t = trace->time, *x = trace->offset;
    Equation *e = NULL;
    double *bend = NULL;
    OZ_TRY(OZ_NEW(&e, trace->count));
    OZ_TRY(OZ_NEW(&bend, trace->count));
    set_equations(trace, e);
    for (int64_t i = 2; i < last; i++) {
        double share = e[i].before / e[i - 1].own;
        e[i].own -= share * e[i - 1].behind;
        e[i].right -= share * e[i - 1].right;
    }
    for (int64_t i = last - 1; i > 0; i--) {
        double behind = i + 1 < last ? e[i].behind * bend[i + 1] : 0;
        bend[i] = (e[i].right - behind) / e[i].own;
    }
    if (last == 2) {
        bend[0] = bend[2] = bend[1];
    } else if (last > 2) {
        double ends = (t[1] - t[0]) / (t[2] - t[1]);
        bend[0] = bend[1] - ends * (bend[2] - bend[1]);
        ends = (t[last] - t[last - 1]) / (t[last - 1] - t[last - 2]);
        bend[last] = bend[last - 1] + ends * (bend[last - 1] - bend[last - 2]);
    }
    for (int64_t i = 0; i < last; i++) {
        double h = t[i + 1] - t[i], rise = (x[i + 1] - x[i]) / h;
        trace->velocity[i] = rise - h * (2 * bend[i] + bend[i + 1]) / 6;
        trace->velocity[i + 1] = rise + h * (bend[i] + 2 * bend[i + 1]) / 6;
    }
done:
    free(e);
    free(bend);
    return status;
}

/* Straight lines of acceleration, added up twice; offset has the accelerations before. */
static void join_accelerations(OzTrace *trace, bool closed)
{
    int64_t last = trace->count - 1;
    double x = 0, v = 0;
    for (int64_t i = 0; i < last; i++) {
        double h = trace->time[i + 1] - trace->time[i];
        double a = trace->offset[i], b = trace->offset[i + 1];
        trace->offset[i] = x;
        trace->velocity[i] = v;
        x += h * (v + h * (2 * a + b) / 6);
        v += h * (a + b) / 2;
    }
    trace->offset[last] = x;
    trace->velocity[last] = v;
    double start = closed ? -x / trace->time[last] : 0; /* to end where it began, or from rest */
    for (int64_t i = 0; i <= last; i++) {
        trace->offset[i] += start * trace->time[i];
        trace->velocity[i] += start;
    }
}

/* FNV-1a over the bytes of all rows. */
static int64_t digest_of(const OzTrace *trace)
{
    uint64_t digest = 14695981039346656037ull;
    const double *const columns[] = {trace->time, trace->offset, trace->velocity};
    for (int c = 0; c < 3; c++) {
        const unsigned char *bytes = (const unsigned char *)columns[c];
        for (size_t k = 0; k < (size_t)trace->count * sizeof(double); k++) {
            digest = (digest ^ bytes[k]) * 1099511628211ull;
        }
    }
    return (int64_t)(digest & INT64_MAX);
}

/* Means and squares over the time, by Gauss's four points an interval, exact for squares of cubics;
 * and the greatest values, at these, at rows and where velocities turn. */
static void measure(OzTrace *trace)
{
    static const double points[] = {
        0.06943184420297371, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263, 0, 1};
    static const double weights[] = {
        0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693, 0, 0};
    double mean[3] = {0}, square[3] = {0}, at[3], total = trace->time[trace->count - 1];
    for (int64_t i = 0; i + 1 < trace->count; i++) {
        double h = trace->time[i + 1] - trace->time[i], from[3];
        for (int p = 0; p < 6; p++) {
            cubic_at(trace, i, points[p], at);
            for (int k = 0; k < 3; k++) {
                mean[k] += weights[p] * h / total * at[k];
                square[k] += weights[p] * h / total * at[k] * at[k];
            }
            trace->reach = fmax(trace->reach, fabs(at[0]));
            trace->speed = fmax(trace->speed, fabs(at[1]));
            trace->acceleration_most = fmax(trace->acceleration_most, fabs(at[2]));
        }
        cubic_at(trace, i, 0, from);
        if (from[2] * at[2] < 0) { /* at[] is of the interval's end, the last point */
            cubic_at(trace, i, from[2] / (from[2] - at[2]), at);
            trace->speed = fmax(trace->speed, fabs(at[1]));
        }
    }
    trace->offset_rms = sqrt(fmax(square[0] - mean[0] * mean[0], 0));
    trace->velocity_rms = sqrt(fmax(square[1] - mean[1] * mean[1], 0));
    trace->acceleration_rms = sqrt(fmax(square[2] - mean[2] * mean[2], 0));
    trace->acceleration_mean = mean[2];
}

static void release(OzTrace *trace)
{
    if (trace && atomic_fetch_sub(&trace->keepers, 1) == 1) {
        free(trace->time);
        free(trace->offset);
        free(trace->velocity);
        free(trace);
    }
}

/* From rows that are in order; takes their arrays over. */
static OzStatus create(OzTrace **trace, OzTraceCsv *csv, const OzMotion *motion)
{
    OzStatus status = OZ_OK;
    OzTrace *made = NULL;
    OZ_TRY(OZ_NEW(&made, 1));
    made->keepers = 1;
    made->count = csv->count;
    made->time = csv->time;
    made->offset = csv->value;
    *csv = (OzTraceCsv){0};
    OZ_TRY(OZ_NEW(&made->velocity, made->count));
    bool is_offset = motion->measured == OZ_MEASURED_OFFSET;
    double start = made->time[0], first = is_offset ? made->offset[0] : 0;
    for (int64_t i = 0; i < made->count; i++) {
        made->time[i] -= start;
        made->offset[i] = motion->scale * (made->offset[i] - first);
    }
    if (is_offset) {
        OZ_TRY(join_offsets(made));
    } else {
        join_accelerations(made, motion->closed);
    }
    measure(made);
    made->digest = digest_of(made);
    *trace = made;
    made = NULL;
done:
    release(made);
    return status;
}

OzStatus oz_trace_load_walls(OzScene *scene, OzFaults *faults)
{
    for (int w = 0; w < scene->wall_count; w++) {
        OzStatus status = OZ_OK;
        OzMotion *motion = &scene->walls[w].motion;
        OzTraceCsv csv = {0};
        if (!motion->file || !oz_file_exists(motion->file)) { /* which is a fault already */
            continue;
        }
        OZ_PASS(oz_trace_csv_read(&csv, motion->file, motion->column, faults));
        status = csv.count > 0 ? create(&motion->trace, &csv, motion) : OZ_OK;
        oz_trace_csv_free(&csv);
        OZ_PASS(status);
    }
    return OZ_OK;
}

void oz_trace_keep_walls(OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        if (scene->walls[w].motion.trace) {
            atomic_fetch_add(&scene->walls[w].motion.trace->keepers, 1);
        }
    }
}

void oz_trace_free_walls(OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        release(scene->walls[w].motion.trace);
        scene->walls[w].motion.trace = NULL;
    }
}

void oz_trace_say(const OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        char text[512];
        if (scene->walls[w].motion.trace) {
            oz_trace_describe(&scene->walls[w].motion, text, sizeof text);
            oz_log_line("walls.%d follows the %s", w, text);
        }
    }
}

void oz_trace_describe(const OzMotion *motion, char *text, size_t size)
{
    const OzTrace *trace = motion->trace;
    const char *slash = strrchr(motion->file, '/');
    snprintf(text, size,
             "%s of %s: %lld rows in %.6g s; rms of offset %.4g m, velocity %.4g m/s, "
             "acceleration %.4g m/s^2 (mean %.2g); greatest %.4g m, %.4g m/s, %.4g m/s^2; ends at "
             "%.4g m with %.4g m/s",
             motion->measured == OZ_MEASURED_OFFSET ? "offset" : "acceleration",
             slash ? slash + 1 : motion->file, (long long)trace->count,
             trace->time[trace->count - 1], trace->offset_rms, trace->velocity_rms,
             trace->acceleration_rms, trace->acceleration_mean, trace->reach, trace->speed,
             trace->acceleration_most, trace->offset[trace->count - 1],
             trace->velocity[trace->count - 1]);
}
