/* The straight line of one benchmark. This process makes no OpenCL call: every measurement runs
 * apart. */
#include "bench/bench.h"

#include "base/file.h"
#include "base/folder.h"
#include "base/log.h"
#include "base/memory.h"
#include "bench/bench_features.h"
#include "bench/bench_json.h"
#include "bench/bench_limits.h"
#include "bench/bench_pictures.h"
#include "bench/bench_plot.h"
#include "bench/bench_shares.h"
#include "bench/bench_start.h"
#include "bench/bench_table.h"
#include "bench/bench_yardstick.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIZES_MAX = 32, ROWS_MAX = 512, SETTINGS_MAX = 4 };

/* Seconds that all timed pieces together shall take, unless --budget says otherwise. */
static const double full_budget = 600, quick_budget = 45;

/* A row whose fewest steps would take more than so many times its seconds is left out. */
static const double patience = 6;

/* Steps that a row makes at least, warming up included, and bytes a grain on the host. */
static const double least_steps = 80, host_bytes = 400;

/* Simulated seconds after settling, at which trigrains have begun to move. */
static const double warm_time = 0.1;

/* Threads and number format of a row. */
typedef struct Setting {
    int threads;
    bool is_double;
} Setting;

typedef struct Bench {
    const OzOptions *options;
    OzBenchDevice device;
    int64_t sizes[SIZES_MAX];
    int size_count;
    Setting settings[SETTINGS_MAX];
    int setting_count;
    double seconds; /* of a row of weight 1 */
    char *folder;
    OzFolder owned; /* the folder, in use */
    FILE *csv;
    OzBenchRecord before; /* --compare                              */
    OzBenchBed first;     /* an6, or the first scene given, settled */
    OzBenchTile tile;     /* made when the first large bed needs it */
    OzBenchRow rows[ROWS_MAX];
    int row_count;
} Bench;

static OzStatus read_sizes(Bench *bench)
{
    static const int64_t full[] = {250,   500,   1000,   2000,   4000,
                                   16000, 64000, 100000, 250000, 1000000};
    static const int64_t quick[] = {250, 1000, 4000, 16000};
    const OzOptions *options = bench->options;
    if (!options->sizes) {
        bench->size_count = options->quick ? 4 : 10;
        memcpy(bench->sizes, options->quick ? quick : full,
               (size_t)bench->size_count * sizeof full[0]);
        return OZ_OK;
    }
    for (const char *at = options->sizes; *at && bench->size_count < SIZES_MAX;) {
        char *end = NULL;
        long long size = strtoll(at, &end, 10);
        if (end == at || size < 1 || size > 100000000 || (*end && *end != ',')) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "orzo: '%s' is wrong; expected --sizes N,N,... with "
                                  "numbers of grains from 1 to 1e8",
                                  options->sizes);
        }
        bench->sizes[bench->size_count++] = size;
        at = end + (*end == ',');
    }
    return OZ_OK;
}

/* One and all threads, or those asked for; float, and double where the device has it. */
static void choose_settings(Bench *bench)
{
    const OzBenchDevice *device = &bench->device;
    bool one_too = device->is_cpu && device->threads > 1 && bench->options->threads == 0;
    for (int precision = 0; precision < (device->has_double ? 2 : 1); precision++) {
        if (one_too) {
            bench->settings[bench->setting_count++] = (Setting){1, precision == 1};
        }
        bench->settings[bench->setting_count++] = (Setting){device->threads, precision == 1};
    }
}

/* Shares of the budget that a row takes: scenes run for many taps, large beds take long for a part
 * of one. */
static double weight_of(double grains, bool is_scene)
{
    return is_scene ? 3 : grains < 10000 ? 1 : grains < 200000 ? 3 : 6;
}

/* Shares the budget out among the rows to come: beds by settings, and the scenes side by side. */
static void share_budget(Bench *bench)
{
    const OzOptions *options = bench->options;
    int scenes = options->path_count > 0 ? options->path_count : 1;
    double shares = scenes * (bench->setting_count + 1) * weight_of(0, true);
    double budget = options->budget > 0 ? options->budget
                    : options->quick    ? quick_budget
                                        : full_budget;
    for (int k = 0; k < bench->size_count && options->path_count == 0; k++) {
        shares += bench->setting_count * weight_of((double)bench->sizes[k], false);
    }
    bench->seconds = budget / shares;
    printf("budget %.0f s: about %.2g s for a row of a small bed, 3 times that for a scene or a "
           "large bed, 6 times for the largest; making beds takes longer\n",
           budget, bench->seconds);
}

/* Wall times are worth little while other programs run; the table's processor times then tell more.
 */
static void warn_of_others(void)
{
    double load = 0;
    if (getloadavg(&load, 1) == 1 && load > 0.5) {
        printf("other programs are running (load %.1f): trust `cpu us` more than wall times, and "
               "no comparison of threads\n",
               load);
    }
}

static OzStatus open_bench(Bench *bench)
{
    const OzFolderUse use = {.keep = true};
    OZ_PASS(read_sizes(bench));
    if (bench->options->compare) {
        OZ_PASS(oz_bench_json_read(&bench->before, bench->options->compare));
    }
    OZ_PASS(
        oz_file_join(&bench->folder, NULL, bench->options->out ? bench->options->out : "bench"));
    OZ_PASS(oz_folder_open(&bench->owned, bench->folder, &use));
    OZ_PASS(oz_folder_create_file(&bench->csv, bench->folder, "bench.csv"));
    warn_of_others();
    OZ_PASS(oz_bench_limits_device(&bench->device, bench->options));
    OZ_PASS(oz_bench_limits_print(&bench->device, bench->options, stdout));
    choose_settings(bench);
    share_budget(bench);
    oz_bench_table_begin(stdout, bench->csv);
    return OZ_OK;
}

/* The last measured row of a setting, NULL before there is one. */
static const OzBenchRow *last_row(const Bench *bench, Setting setting)
{
    for (int r = bench->row_count - 1; r >= 0; r--) {
        const double *value = bench->rows[r].value;
        bool same_threads = !bench->device.is_cpu || value[OZ_BENCH_THREADS] == setting.threads;
        if (same_threads && value[OZ_BENCH_BITS] == (setting.is_double ? 64 : 32) &&
            value[OZ_BENCH_MEMBERS] == 1) {
            return &bench->rows[r];
        }
    }
    return NULL;
}

/* Whether a bed of so many grains fits into memory and time, judged by the row before. */
static bool affordable(const Bench *bench, Setting setting, double grains, double row_seconds)
{
    const OzBenchRow *last = last_row(bench, setting);
    if (!last) {
        return true;
    }
    double need = grains * last->value[OZ_BENCH_BYTES], room = (double)bench->device.memory;
    double host = grains * host_bytes + (bench->device.is_cpu ? need : 0);
    if (need > room || host > 0.9 * oz_bench_limits_free_memory()) {
        printf("%.0f grains, %s, left out: they need %.1f GB\n", grains,
               setting.is_double ? "double" : "float", 1e-9 * (need > room ? need : host));
        return false;
    }
    double seconds = 1e-9 * last->value[OZ_BENCH_NS_GRAIN] * grains * least_steps;
    if (seconds > patience * row_seconds) {
        printf("%.0f grains, %s, %d thread%s, left out: %.0f steps would take about %.0f s (see "
               "--budget)\n",
               grains, setting.is_double ? "double" : "float", setting.threads,
               setting.threads == 1 ? "" : "s", least_steps, seconds);
        return false;
    }
    return true;
}

static void keep_row(Bench *bench, const OzBenchRow *row)
{
    oz_bench_table_add(row, stdout, bench->csv);
    if (bench->row_count < ROWS_MAX) {
        bench->rows[bench->row_count++] = *row;
    }
}

/* observed: a scene, looked at as in a run; else a bed of the ladder. */
static OzStatus run_bed(Bench *bench, OzBenchBed *bed, const char *name, bool observed)
{
    double grains = (double)bed->grains.count;
    double seconds = bench->seconds * weight_of(grains, observed);
    for (int s = 0; s < bench->setting_count; s++) {
        Setting setting = bench->settings[s];
        OzBenchRow row;
        OzBenchJob job = {.options = bench->options,
                          .bed = bed,
                          .name = name,
                          .members = 1,
                          .threads = setting.threads,
                          .is_double = setting.is_double,
                          .observed = observed,
                          .seconds = seconds};
        if (!affordable(bench, setting, grains, seconds)) {
            continue;
        }
        OZ_PASS(oz_bench_row_measure(&row, &job));
        keep_row(bench, &row);
    }
    return OZ_OK;
}

/* What seeds side by side gain over the same ones one after the other on one thread. */
static void tell_gain(const Bench *bench, const OzBenchRow *many)
{
    const OzBenchRow *one = last_row(bench, (Setting){1, false});
    if (one && bench->device.is_cpu) {
        double count = many->value[OZ_BENCH_MEMBERS];
        printf(
            "%.0f scenes side by side, a thread each, as `orzo run --seeds` makes them: %.2f times "
            "the steps of one scene on one thread\n",
            count, count * one->value[OZ_BENCH_US_STEP] / many->value[OZ_BENCH_US_STEP]);
    }
}

/* As many equal scenes as the device has units. */
static OzStatus run_side_by_side(Bench *bench, OzBenchBed *bed, const char *name)
{
    OzBenchRow row;
    OzBenchJob job = {.options = bench->options,
                      .bed = bed,
                      .name = name,
                      .members = bench->device.units,
                      .threads = bench->device.threads,
                      .observed = true,
                      .seconds = bench->seconds * weight_of(0, true)};
    if (job.members < 2) {
        return OZ_OK;
    }
    OzStatus status = oz_bench_row_measure(&row, &job);
    if (status == OZ_OK) {
        keep_row(bench, &row);
        tell_gain(bench, &row);
    }
    return status;
}

/* Keeps the first scene of rods; trigrains are only taken apart. */
static OzStatus run_scene(Bench *bench, const char *path)
{
    OzStatus status = OZ_OK;
    OzBenchBed later = {0}, *bed = &later;
    OZ_TRY(oz_bench_bed_load(bed, bench->options, path));
    if (bed->scene.model == OZ_MODEL_TRIGRAINS) {
        char name[256];
        snprintf(name, sizeof name, "shares_%s", bed->scene.name);
        status = oz_bench_shares_print(bed, fmin(warm_time, bed->scene.duration), bench->options,
                                       bench->folder, name, stdout);
        goto done;
    }
    if (!bench->first.scene.path) {
        bench->first = later;
        later = (OzBenchBed){0};
        bed = &bench->first;
    }
    OZ_TRY(oz_bench_bed_settle(bed, bench->options, 0));
    OZ_TRY(run_bed(bench, bed, bed->scene.name, true));
    OZ_TRY(run_side_by_side(bench, bed, bed->scene.name));
done:
    oz_bench_bed_free(&later);
    return status;
}

/* The yardstick steps an6's bed. */
static OzStatus run_yardstick(Bench *bench)
{
    OzBenchRow row;
    bool found = false;
    OZ_PASS(oz_bench_yardstick_measure(&row, &found, &bench->first, bench->options, bench->folder));
    if (found) {
        keep_row(bench, &row);
        oz_bench_yardstick_compare(&row, bench->rows, bench->row_count, stdout);
    }
    return OZ_OK;
}

/* Small beds settle by themselves, larger ones are paved. */
static OzStatus make_bed(Bench *bench, OzBenchBed *bed, int64_t count)
{
    double side = 0;
    if (count <= bench->first.grains.count) {
        OZ_PASS(oz_bench_bed_box(bed, &side, bench->options, count));
        return oz_bench_bed_settle(bed, bench->options, OZ_BENCH_BED_TAPS);
    }
    if (!bench->tile.states) {
        OZ_PASS(oz_bench_bed_tile(&bench->tile, bench->options, bench->first.grains.count));
    }
    return oz_bench_bed_pave(bed, &bench->tile, bench->options, count);
}

static OzStatus run_ladder(Bench *bench)
{
    OzStatus status = OZ_OK;
    OzBenchBed bed = {0};
    for (int k = 0; k < bench->size_count; k++) {
        oz_bench_bed_free(&bed);
        OZ_TRY(make_bed(bench, &bed, bench->sizes[k]));
        OZ_TRY(run_bed(bench, &bed, "box", false));
    }
done:
    oz_bench_bed_free(&bed);
    return status;
}

/* The largest bed of the ladder that is taken apart: larger ones would only take longer. 0: none is
 * large. */
static int64_t large_size(const Bench *bench)
{
    int64_t large = 0;
    for (int k = 0; k < bench->size_count && bench->options->path_count == 0; k++) {
        bool fits = bench->sizes[k] >= 10000 && bench->sizes[k] <= 100000;
        large = fits && bench->sizes[k] > large ? bench->sizes[k] : large;
    }
    return large;
}

/* Where the time of an6 (or of the first scene given) and of a large bed goes, and what an6's
 * features cost. */
static OzStatus take_apart(Bench *bench)
{
    OzStatus status = OZ_OK;
    const OzOptions *options = bench->options;
    OzBenchBed bed = {0};
    int64_t large = large_size(bench);
    OZ_TRY(oz_bench_bed_settle(&bench->first, options, OZ_BENCH_BED_TAPS));
    bench->first.scene.precision = OZ_PRECISION_FLOAT;
    OZ_TRY(oz_bench_shares_print(&bench->first, 0, options, bench->folder, "shares", stdout));
    OZ_TRY(oz_bench_pictures_print(&bench->first, options, bench->folder, "pictures", stdout));
    if (large > 0) {
        OZ_TRY(make_bed(bench, &bed, large));
        bed.scene.movie.present = false;
        bed.scene.precision = OZ_PRECISION_FLOAT;
        OZ_TRY(oz_bench_shares_print(&bed, 0, options, bench->folder, "shares_large", stdout));
        OZ_TRY(oz_bench_pictures_print(&bed, options, bench->folder, "pictures_large", stdout));
    }
    if (options->features && options->path_count == 0) {
        OZ_TRY(oz_bench_features_print(&bench->first, options, bench->folder, stdout));
    }
done:
    oz_bench_bed_free(&bed);
    return status;
}

static OzStatus draw_plot(const Bench *bench)
{
    OZ_PASS(oz_folder_note(bench->folder, "bench.png"));
    return oz_bench_plot_draw(bench->folder, bench->device.name, bench->rows, bench->row_count);
}

/* bench.json, and what was before beside it. */
static OzStatus record(Bench *bench)
{
    OzBenchRecord now = {.device = bench->device.name,
                         .version = (char *)(uintptr_t)ORZO_VERSION,
                         .rows = bench->rows,
                         .row_count = bench->row_count};
    OZ_PASS(oz_bench_start_print(&now.start_cold, &now.start_warm, &bench->first, bench->options,
                                 stdout));
    return oz_bench_json_leave(&now, &bench->before, bench->folder, stdout);
}

static OzStatus run_all(Bench *bench)
{
    const OzOptions *options = bench->options;
    OZ_PASS(open_bench(bench));
    for (int p = 0; p < options->path_count; p++) {
        OZ_PASS(run_scene(bench, options->paths[p]));
    }
    if (options->path_count == 0) {
        OZ_PASS(run_scene(bench, NULL));
        OZ_PASS(run_yardstick(bench));
        OZ_PASS(run_ladder(bench));
    }
    if (!bench->first.scene.path) {
        return OZ_OK; /* no rods */
    }
    oz_bench_table_explain(stdout);
    OZ_PASS(record(bench));
    OZ_PASS(take_apart(bench));
    return draw_plot(bench);
}

static OzStatus close_bench(Bench *bench, OzStatus status)
{
    if (bench->csv && fclose(bench->csv) != 0 && status == OZ_OK) {
        status = oz_status_fail(OZ_ERR_FILE, "cannot write %s/bench.csv", bench->folder);
    }
    oz_bench_json_free(&bench->before);
    oz_bench_bed_free_tile(&bench->tile);
    oz_bench_bed_free(&bench->first);
    oz_folder_close(&bench->owned);
    free(bench->folder);
    free(bench);
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
    }
    return status;
}

OzStatus oz_bench_run(const OzOptions *options)
{
    Bench *bench = NULL;
    OzStatus status = OZ_NEW(&bench, 1);
    if (status != OZ_OK) {
        oz_log_line("%s", oz_status_text());
        return status;
    }
    bench->options = options;
    setvbuf(stdout, NULL, _IOLBF, 0); /* rows are seen as they come, in a pipe too */
    return close_bench(bench, run_all(bench));
}
