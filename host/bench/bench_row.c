/* Timing one row. Scenes side by side are timed as a run makes them: on a CPU each with a queue and
 * a thread of its own, on a GPU all in one launch. */
#include "bench/bench_row.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/order.h"
#include "base/subprocess.h"
#include "base/thread.h"
#include "bench/bench_cost.h"
#include "compute/limits.h"
#include "observe/series.h"
#include "sim/counters.h"
#include "sim/read_snapshot.h"
#include "sim/sim.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum {
    PIECES_LEAST = 5,
    PIECES_MOST = 1000,
    STEPS_LEAST = 8,    /* of a piece: below, the clock and the launch would be seen */
    STEPS_WARM = 16,    /* lists made, kernels compiled, arrays touched              */
    STEPS_STILL = 1000, /* of a piece in a scene without a period                    */
    PROBES = 8          /* over one piece: contacts come and go with the floor       */
};

/* Scenes of a row that share a simulation. Zeroed is valid. */
typedef struct Worker {
    const OzBenchJob *job;
    OzDevice device; /* a branch */
    OzMember *members;
    int member_count;
    OzSim *sim;
    OzSnapshot now;
    OzSeries *series;
    double observing;           /* s, in the pieces */
    double pieces[PIECES_MOST]; /* s */
    int piece_count, piece_steps;
    double wall, cpu;   /* s, of all pieces */
    OzSimCounts before; /* the first piece  */
    pthread_t thread;
    OzStatus status; /* how its timing ended, and why */
    char text[4096];
} Worker;

/* A row being measured. Zeroed is valid. */
typedef struct Bench {
    const OzBenchJob *job;
    OzDevice device;
    Worker *workers;
    int count;
    OzBenchRow *row; /* borrowed */
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

static OzStatus open_worker(Worker *worker, const Bench *bench)
{
    const OzBenchJob *job = bench->job;
    const OzBenchBed *bed = job->bed;
    worker->job = job;
    worker->member_count = job->members / bench->count;
    OZ_PASS(oz_device_branch(&worker->device, &bench->device));
    OZ_PASS(OZ_NEW(&worker->members, worker->member_count));
    for (int m = 0; m < worker->member_count; m++) {
        worker->members[m] = (OzMember){&bed->scene, &bed->grains};
    }
    OZ_PASS(oz_sim_create(&worker->sim, &worker->device, worker->members, worker->member_count,
                          job->options->source_dir));
    OZ_PASS(oz_sim_launch(worker->sim, steps_of_tap(&bed->scene)));
    if (job->observed) {
        OZ_PASS(oz_snapshot_create(&worker->now, &bed->scene, &bed->grains));
        OZ_PASS(oz_series_create(&worker->series, "/dev/null", &bed->scene, &bed->grains));
    }
    return OZ_OK;
}

static void close_worker(Worker *worker)
{
    oz_series_free(worker->series);
    oz_snapshot_free(&worker->now);
    oz_sim_free(worker->sim);
    free(worker->members);
    oz_device_close(&worker->device);
}

static OzStatus open_bench(Bench *bench)
{
    const OzBenchJob *job = bench->job;
    job->bed->scene.precision = job->is_double ? OZ_PRECISION_DOUBLE : OZ_PRECISION_FLOAT;
    double start = oz_clock_now();
    OZ_PASS(oz_device_open(&bench->device, job->options->device, job->threads));
    int count = bench->device.is_cpu ? job->members : 1;
    OZ_PASS(OZ_NEW(&bench->workers, count));
    bench->count = count;
    for (int k = 0; k < count; k++) {
        OZ_PASS(open_worker(&bench->workers[k], bench));
    }
    bench->row->value[OZ_BENCH_START] = oz_clock_now() - start;
    return OZ_OK;
}

static void close_bench(Bench *bench)
{
    for (int k = 0; k < bench->count; k++) {
        close_worker(&bench->workers[k]);
    }
    free(bench->workers);
    oz_device_close(&bench->device);
}

/* A sample for the tap means; at the piece's end a row. */
static OzStatus observe(Worker *worker, bool last)
{
    double start = oz_clock_now();
    for (int m = 0; m < worker->member_count; m++) {
        OZ_PASS(oz_read_snapshot_snapshot(worker->sim, m, &worker->now, last));
        oz_series_sample(worker->series, &worker->now);
        if (last) {
            OZ_PASS(oz_series_write(worker->series, &worker->now));
        }
    }
    worker->observing += oz_clock_now() - start;
    return OZ_OK;
}

/* So many steps, observed as a run would when the job says so. */
static OzStatus make_piece(Worker *worker, int steps)
{
    const OzBenchJob *job = worker->job;
    int64_t first = oz_sim_step(worker->sim);
    int samples = job->observed ? (int)job->bed->scene.observe.samples_per_tap : 1;
    for (int k = 1; k <= samples; k++) {
        OZ_PASS(oz_sim_advance(worker->sim, first + (int64_t)steps * k / samples));
        if (job->observed) {
            OZ_PASS(observe(worker, k == samples));
        }
    }
    return OZ_OK;
}

/* Seconds of a step, while caches, lists and launch sizes find their state. */
static OzStatus warm_up(Worker *worker, double *step_seconds)
{
    int most = steps_of_tap(&worker->job->bed->scene), steps = STEPS_WARM;
    double start = oz_clock_now(), end = start + 0.1 * worker->job->seconds, now = start;
    *step_seconds = 0;
    for (int made = 0; made < most && (made == 0 || now < end); made += steps) {
        double before = oz_clock_now();
        OZ_PASS(oz_sim_advance(worker->sim, oz_sim_step(worker->sim) + steps));
        now = oz_clock_now();
        *step_seconds = (now - before) / steps;
    }
    return OZ_OK;
}

static OzStatus time_pieces(Worker *worker)
{
    int tap = steps_of_tap(&worker->job->bed->scene);
    double step_seconds = 0;
    OZ_PASS(warm_up(worker, &step_seconds));
    double wanted = worker->job->seconds / PIECES_LEAST / step_seconds;
    worker->piece_steps = wanted >= tap ? tap : (int)fmax(STEPS_LEAST, wanted);
    worker->before = oz_sim_counts(worker->sim);
    worker->observing = 0;
    double end = oz_clock_now() + worker->job->seconds;
    for (int k = 0; k < PIECES_MOST && (k < PIECES_LEAST || oz_clock_now() < end); k++) {
        double wall = oz_clock_now(), cpu = oz_clock_processor();
        OZ_PASS(make_piece(worker, worker->piece_steps));
        worker->pieces[k] = oz_clock_now() - wall;
        worker->wall += worker->pieces[k];
        worker->cpu += oz_clock_processor() - cpu;
        worker->piece_count = k + 1;
    }
    return OZ_OK;
}

static void *time_thread(void *context)
{
    Worker *worker = context;
    worker->status = time_pieces(worker);
    snprintf(worker->text, sizeof worker->text, "%s", oz_status_text());
    return NULL;
}

/* All at once, the first in this thread. */
static OzStatus time_workers(Bench *bench)
{
    OzStatus status = OZ_OK;
    int started = 1;
    for (; started < bench->count && status == OZ_OK; started++) {
        Worker *worker = &bench->workers[started];
        int code = oz_thread_start(&worker->thread, time_thread, worker);
        if (code != 0) {
            status = oz_status_fail(OZ_ERR_DEVICE, "no more threads than %d: %s", started,
                                    strerror(code));
            break;
        }
    }
    time_thread(&bench->workers[0]);
    for (int k = 1; k < started; k++) {
        pthread_join(bench->workers[k].thread, NULL);
    }
    for (int k = 0; k < started && status == OZ_OK; k++) {
        const Worker *worker = &bench->workers[k];
        if (worker->status != OZ_OK) {
            status = oz_status_fail(worker->status, "%s", worker->text);
        }
    }
    return status;
}

static double per(double count, double events)
{
    return events > 0 ? count / events : NAN;
}

/* us of a step: the median of whole taps, else the mean, because the lists are not rebuilt in each
 * piece. Sorts the pieces. */
static double step_time(Worker *worker)
{
    double made = worker->piece_steps;
    bool whole = worker->piece_steps == steps_of_tap(&worker->job->bed->scene);
    oz_order_sort(worker->pieces, worker->piece_count);
    double middle =
        whole ? worker->pieces[worker->piece_count / 2] : worker->wall / worker->piece_count;
    return 1e6 * middle / made;
}

/* The time in which every scene makes a step: workers' rates add up. Counters are the first's. */
static void note_times(Bench *bench)
{
    Worker *first = &bench->workers[0];
    OzSimCounts before = first->before, after = oz_sim_counts(first->sim);
    const OzScene *scene = &bench->job->bed->scene;
    double *value = bench->row->value, rate = 0, steps = (double)(after.steps - before.steps);
    for (int k = 0; k < bench->count; k++) {
        rate += 1 / step_time(&bench->workers[k]);
    }
    double all = (double)first->piece_count * first->piece_steps;
    value[OZ_BENCH_US_STEP] = bench->count / rate;
    value[OZ_BENCH_US_LEAST] = 1e6 * first->pieces[0] / first->piece_steps;
    value[OZ_BENCH_US_CPU] = 1e6 * first->cpu / all;
    value[OZ_BENCH_OBSERVE] = bench->job->observed ? 1e6 * first->observing / all : NAN;
    value[OZ_BENCH_TAPS] = scene->period > 0 ? all * scene->step / scene->period : NAN;
    value[OZ_BENCH_PIECES] = first->piece_count;
    value[OZ_BENCH_REFRESH] = per(steps, (double)(after.refreshes - before.refreshes));
    value[OZ_BENCH_REBUILD] = per(steps, (double)(after.rebuilds - before.rebuilds));
    value[OZ_BENCH_STEPS_LAUNCH] = per(steps, (double)(after.launches - before.launches));
}

/* The mean of several moments of one more piece of the first worker. */
static OzStatus probe_piece(Bench *bench, OzCounters *mean)
{
    Worker *worker = &bench->workers[0];
    int64_t pairs = 0, touching = 0, first = oz_sim_step(worker->sim);
    for (int k = 1; k <= PROBES; k++) {
        OZ_PASS(oz_sim_advance(worker->sim, first + worker->piece_steps * k / PROBES));
        OZ_PASS(oz_counters_read(mean, worker->sim));
        pairs += mean->pairs;
        touching += mean->touching;
    }
    mean->pairs = pairs / PROBES;
    mean->touching = touching / PROBES;
    return OZ_OK;
}

/* What the simulations hold, and how far a step is from what the device could do. */
static OzStatus note_work(Bench *bench)
{
    double *value = bench->row->value, copy = 0, multiply_add = 0;
    const OzBenchJob *job = bench->job;
    OzCounters probe;
    OZ_PASS(probe_piece(bench, &probe));
    OzBenchCost cost = oz_bench_cost_step(&probe);
    cost.bytes *= bench->count;
    cost.operations *= bench->count;
    OZ_PASS(oz_limits_copy(&copy, &bench->device, job->options->source_dir, (size_t)cost.bytes,
                           job->is_double));
    OZ_PASS(oz_limits_multiply_add(&multiply_add, &bench->device, job->options->source_dir,
                                   job->is_double));
    double seconds = 1e-6 * value[OZ_BENCH_US_STEP], grains = (double)probe.grains;
    value[OZ_BENCH_NS_GRAIN] = 1e9 * seconds / (grains * bench->count);
    value[OZ_BENCH_PAIRS] = (double)probe.pairs / grains;
    value[OZ_BENCH_TOUCHING] = (double)probe.touching / grains;
    value[OZ_BENCH_BYTES] = (double)probe.bytes / grains;
    value[OZ_BENCH_GBYTES] = 1e-9 * cost.bytes / seconds;
    value[OZ_BENCH_GFLOPS] = 1e-9 * cost.operations / seconds;
    value[OZ_BENCH_COPY] = 1e-9 * copy;
    value[OZ_BENCH_MULTIPLY_ADD] = 1e-9 * multiply_add;
    value[OZ_BENCH_SHARE] = 100 * fmax(cost.bytes / copy, cost.operations / multiply_add) / seconds;
    return OZ_OK;
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
    OZ_TRY(time_workers(bench));
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
    return oz_subprocess_run(measure, &bench, row, sizeof *row);
}
