/* Timing one row. */
#include "study/bench_row.h"

#include "base/clock.h"
#include "base/memory.h"
#include "compute/capture.h"
#include "compute/limits.h"
#include "compute/probe.h"
#include "compute/sim.h"
#include "observe/series.h"
#include "study/apart.h"
#include "study/bench_cost.h"

#include <math.h>
#include <stdlib.h>

enum {
    PIECES_LEAST = 5,
    PIECES_MOST = 1000,
    STEPS_LEAST = 8,    /* of a piece: below, the clock and the launch would be seen */
    STEPS_WARM = 16,    /* lists made, kernels compiled, arrays touched              */
    STEPS_STILL = 1000, /* of a piece in a scene without a period                    */
    PROBES = 8          /* over one piece: contacts come and go with the floor       */
};

/* A row being measured. Zeroed is valid. */
typedef struct Bench {
    const OzBenchJob *job;
    OzDevice device;
    OzMember *members;
    OzSim *sim;
    OzSnapshot now;
    OzSeries *series;
    double observing;           /* s, in the pieces */
    double pieces[PIECES_MOST]; /* s */
    int piece_count, piece_steps;
    double wall, cpu;   /* s, of all pieces */
    OzSimCounts before; /* the first piece  */
    OzBenchRow *row;    /* borrowed         */
} Bench;

OzBenchRow oz_bench_row_empty(const char *name)
{
    OzBenchRow row;
    snprintf(row.bed, sizeof row.bed, "%s", name);
    for (int c = 0; c < OZ_BENCH_COLUMN_COUNT; c++) {
        row.value[c] = NAN;
    }
    return row;
}

void oz_bench_row_describe(const OzBenchRow *row, char *text, size_t size)
{
    const double *value = row->value;
    char threads[32] = "";
    if (isfinite(value[OZ_BENCH_THREADS])) {
        snprintf(threads, sizeof threads, ", %.0f thread%s", value[OZ_BENCH_THREADS],
                 value[OZ_BENCH_THREADS] > 1 ? "s" : "");
    }
    snprintf(text, size, "%s%s%s", row->bed,
             isnan(value[OZ_BENCH_BITS])  ? ""
             : value[OZ_BENCH_BITS] == 64 ? ", double"
                                          : ", float",
             threads);
}

static int steps_of_tap(const OzScene *scene)
{
    return scene->period > 0 ? (int)lround(scene->period / scene->step) : STEPS_STILL;
}

static OzStatus open_bench(Bench *bench)
{
    OzStatus status = OZ_OK;
    const OzBenchJob *job = bench->job;
    OzBenchBed *bed = job->bed;
    bed->scene.precision = job->is_double ? OZ_PRECISION_DOUBLE : OZ_PRECISION_FLOAT;
    double start = oz_clock_now();
    OZ_TRY(oz_device_open(&bench->device, job->options->device, job->threads));
    OZ_TRY(OZ_NEW(&bench->members, job->members));
    for (int m = 0; m < job->members; m++) {
        bench->members[m] = (OzMember){&bed->scene, &bed->grains};
    }
    OZ_TRY(oz_sim_create(&bench->sim, &bench->device, bench->members, job->members,
                         job->options->source_dir));
    OZ_TRY(oz_sim_launch(bench->sim, steps_of_tap(&bed->scene)));
    bench->row->value[OZ_BENCH_START] = oz_clock_now() - start;
    if (job->observed) {
        OZ_TRY(oz_snapshot_create(&bench->now, &bed->scene, &bed->grains));
        OZ_TRY(oz_series_create(&bench->series, "/dev/null", &bed->scene, &bed->grains));
    }
done:
    return status;
}

static void close_bench(Bench *bench)
{
    oz_series_free(bench->series);
    oz_snapshot_free(&bench->now);
    oz_sim_free(bench->sim);
    free(bench->members);
    oz_device_close(&bench->device);
}

/* A sample for the tap means; at the piece's end a row. */
static OzStatus observe(Bench *bench, bool last)
{
    OzStatus status = OZ_OK;
    double start = oz_clock_now();
    for (int m = 0; m < bench->job->members; m++) {
        OZ_TRY(oz_capture_snapshot(bench->sim, m, &bench->now, last));
        oz_series_sample(bench->series, &bench->now);
        if (last) {
            OZ_TRY(oz_series_write(bench->series, &bench->now));
        }
    }
    bench->observing += oz_clock_now() - start;
done:
    return status;
}

/* So many steps, observed as a run would when the job says so. */
static OzStatus make_piece(Bench *bench, int steps)
{
    OzStatus status = OZ_OK;
    const OzBenchJob *job = bench->job;
    int64_t first = oz_sim_step(bench->sim);
    int samples = job->observed ? (int)job->bed->scene.observe.samples_per_tap : 1;
    for (int k = 1; k <= samples; k++) {
        OZ_TRY(oz_sim_advance(bench->sim, first + (int64_t)steps * k / samples));
        if (job->observed) {
            OZ_TRY(observe(bench, k == samples));
        }
    }
done:
    return status;
}

/* Seconds of a step, while caches, lists and launch sizes find their state. */
static OzStatus warm_up(Bench *bench, double *step_seconds)
{
    OzStatus status = OZ_OK;
    int most = steps_of_tap(&bench->job->bed->scene), steps = STEPS_WARM;
    double start = oz_clock_now(), end = start + 0.1 * bench->job->seconds, now = start;
    *step_seconds = 0;
    for (int made = 0; made < most && (made == 0 || now < end); made += steps) {
        double before = oz_clock_now();
        OZ_TRY(oz_sim_advance(bench->sim, oz_sim_step(bench->sim) + steps));
        now = oz_clock_now();
        *step_seconds = (now - before) / steps;
    }
done:
    return status;
}

static OzStatus time_pieces(Bench *bench)
{
    OzStatus status = OZ_OK;
    int tap = steps_of_tap(&bench->job->bed->scene);
    double step_seconds = 0;
    OZ_TRY(warm_up(bench, &step_seconds));
    double wanted = bench->job->seconds / PIECES_LEAST / step_seconds;
    bench->piece_steps = wanted >= tap ? tap : (int)fmax(STEPS_LEAST, wanted);
    bench->before = oz_sim_counts(bench->sim);
    bench->observing = 0;
    double end = oz_clock_now() + bench->job->seconds;
    for (int k = 0; k < PIECES_MOST && (k < PIECES_LEAST || oz_clock_now() < end); k++) {
        double wall = oz_clock_now(), cpu = oz_clock_processor();
        OZ_TRY(make_piece(bench, bench->piece_steps));
        bench->pieces[k] = oz_clock_now() - wall;
        bench->wall += bench->pieces[k];
        bench->cpu += oz_clock_processor() - cpu;
        bench->piece_count = k + 1;
    }
done:
    return status;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double per(double count, double events)
{
    return events > 0 ? count / events : NAN;
}

/* What the clocks and the simulation's counters say. */
static void note_times(Bench *bench)
{
    OzSimCounts before = bench->before, after = oz_sim_counts(bench->sim);
    double *value = bench->row->value, count = bench->piece_count, made = bench->piece_steps;
    const OzScene *scene = &bench->job->bed->scene;
    bool whole = bench->piece_steps == steps_of_tap(scene);
    qsort(bench->pieces, (size_t)bench->piece_count, sizeof bench->pieces[0], compare);
    double middle = whole ? bench->pieces[bench->piece_count / 2] : bench->wall / count;
    double steps = (double)(after.steps - before.steps);
    value[OZ_BENCH_US_STEP] = 1e6 * middle / made;
    value[OZ_BENCH_US_LEAST] = 1e6 * bench->pieces[0] / made;
    value[OZ_BENCH_US_CPU] = 1e6 * bench->cpu / (count * made);
    value[OZ_BENCH_OBSERVE] = bench->job->observed ? 1e6 * bench->observing / (count * made) : NAN;
    value[OZ_BENCH_TAPS] = scene->period > 0 ? count * made * scene->step / scene->period : NAN;
    value[OZ_BENCH_PIECES] = count;
    value[OZ_BENCH_REFRESH] = per(steps, (double)(after.refreshes - before.refreshes));
    value[OZ_BENCH_REBUILD] = per(steps, (double)(after.rebuilds - before.rebuilds));
    value[OZ_BENCH_STEPS_LAUNCH] = per(steps, (double)(after.launches - before.launches));
}

/* The mean of several moments of one more piece. */
static OzStatus probe_piece(Bench *bench, OzProbe *mean)
{
    OzStatus status = OZ_OK;
    int64_t pairs = 0, touching = 0, first = oz_sim_step(bench->sim);
    for (int k = 1; k <= PROBES; k++) {
        OZ_TRY(oz_sim_advance(bench->sim, first + bench->piece_steps * k / PROBES));
        OZ_TRY(oz_probe_read(mean, bench->sim));
        pairs += mean->pairs;
        touching += mean->touching;
    }
    mean->pairs = pairs / PROBES;
    mean->touching = touching / PROBES;
done:
    return status;
}

/* What the simulation holds, and how far a step is from what the device could do. */
static OzStatus note_work(Bench *bench)
{
    OzStatus status = OZ_OK;
    double *value = bench->row->value, copy = 0, multiply_add = 0;
    const OzBenchJob *job = bench->job;
    OzProbe probe;
    OZ_TRY(probe_piece(bench, &probe));
    OzBenchCost cost = oz_bench_cost_step(&probe);
    OZ_TRY(oz_limits_copy(&copy, &bench->device, job->options->source_dir, (size_t)cost.bytes,
                          job->is_double));
    OZ_TRY(oz_limits_multiply_add(&multiply_add, &bench->device, job->options->source_dir,
                                  job->is_double));
    double seconds = 1e-6 * value[OZ_BENCH_US_STEP], grains = (double)probe.grains;
    value[OZ_BENCH_NS_GRAIN] = 1e9 * seconds / grains;
    value[OZ_BENCH_PAIRS] = (double)probe.pairs / grains;
    value[OZ_BENCH_TOUCHING] = (double)probe.touching / grains;
    value[OZ_BENCH_BYTES] = (double)probe.bytes / grains;
    value[OZ_BENCH_GBYTES] = 1e-9 * cost.bytes / seconds;
    value[OZ_BENCH_GFLOPS] = 1e-9 * cost.operations / seconds;
    value[OZ_BENCH_COPY] = 1e-9 * copy;
    value[OZ_BENCH_MULTIPLY_ADD] = 1e-9 * multiply_add;
    value[OZ_BENCH_SHARE] = 100 * fmax(cost.bytes / copy, cost.operations / multiply_add) / seconds;
done:
    return status;
}

static void note_setting(Bench *bench)
{
    double *value = bench->row->value;
    const OzBenchJob *job = bench->job;
    value[OZ_BENCH_GRAINS] = (double)job->bed->grains.count;
    value[OZ_BENCH_MEMBERS] = job->members;
    value[OZ_BENCH_BITS] = job->is_double ? 64 : 32;
    value[OZ_BENCH_LANES] = job->is_double ? bench->device.double_lanes : bench->device.float_lanes;
    value[OZ_BENCH_THREADS] = bench->device.is_cpu ? (double)bench->device.units : NAN;
}

static OzStatus measure(void *context)
{
    OzStatus status = OZ_OK;
    Bench *bench = context;
    OZ_TRY(open_bench(bench));
    note_setting(bench);
    OZ_TRY(time_pieces(bench));
    note_times(bench);
    OZ_TRY(note_work(bench));
done:
    close_bench(bench);
    return status;
}

OzStatus oz_bench_row_measure(OzBenchRow *row, const OzBenchJob *job)
{
    Bench bench = {.job = job, .row = row};
    *row = oz_bench_row_empty(job->name);
    if (job->members > 1) {
        snprintf(row->bed, sizeof row->bed, "%.32s x %d", job->name, job->members);
    }
    return oz_apart_run(measure, &bench, row, sizeof *row);
}
