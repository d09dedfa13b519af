/* Measuring shares. */
#include "bench/bench_shares.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/folder.h"
#include "base/log.h"
#include "base/order.h"
#include "base/subprocess.h"
#include "draw/pictures.h"
#include "observe/frames.h"
#include "observe/schedule.h"
#include "observe/series.h"
#include "sim/models.h"
#include "sim/read_snapshot.h"
#include "sim/settle.h"
#include "sim/stage_timing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOMENTS = 4, /* of a piece at which the bed stands still; --quick: 1 */
    PIECES = 6,  /* of a tap, or of piece_seconds                 */
    WARM = 64,   /* steps: lists made, arrays touched                */
    LEAST = 32,  /* steps of a piece                               */
    SAMPLES = 64,
    ROWS = 16,
    FRAMES = 12
};

/* A tap of a large bed takes too long: its pieces end after about so many seconds. */
static const double piece_seconds = 1.5;

/* THE list of parts, after the model's stages, in the order of the table. */
#define PARTS(X)                                                                                   \
    X(REST, "the rest", "a whole step less the above: launches, colder caches, what is -")         \
    X(STEP, "whole step", "in launches: median of taps; of a large bed, mean of less")             \
    X(SAMPLE, "samples", "host, beside the step")                                                  \
    X(ROW, "rows of series.csv", "host, beside the step")                                          \
    X(DRAW, "drawing", "host, beside the step, wall time")                                         \
    X(ENCODE, "encoding", "host, beside the step, wall time")

enum {
#define PART_ID(id, name, how) PART_##id,
    PARTS(PART_ID)
#undef PART_ID
        PART_COUNT
};

static const struct {
    const char *name, *how;
} parts[] = {
#define PART_ROW(id, name, how) {name, how},
    PARTS(PART_ROW)
#undef PART_ROW
};

typedef struct Share {
    double seconds; /* of one call; NAN: not measured */
    double calls_per_step;
} Share;

/* What is measured, in a process of its own. */
typedef struct Result {
    Share stage[OZ_TIMED_MOST], part[PART_COUNT];
    int64_t touches[OZ_CONTACT_KINDS]; /* contacts at the end, by kind */
} Result;

/* A scene being taken apart. Zeroed is valid. */
typedef struct Shares {
    const OzBenchBed *bed;
    const OzModel *model;
    const OzOptions *options;
    const char *folder;
    double warm; /* s of the scene before anything is timed */
    OzDevice device;
    OzSim *sim;
    OzSnapshot now;
    OzSeries *series;
    OzPictures *pictures;
    int64_t piece;  /* steps */
    Result *result; /* borrowed */
} Shares;

static OzStatus open_shares(Shares *s)
{
    OzMember member = {&s->bed->scene, &s->bed->grains};
    double settled = 0;
    OZ_PASS(oz_device_open(&s->device, s->options->device,
                           s->options->threads ? s->options->threads : 1));
    OZ_PASS(oz_sim_create(&s->sim, &s->device, &member, 1, s->options->source_dir));
    OZ_PASS(oz_settle_run(s->sim, &settled, NULL, NULL));
    OZ_PASS(oz_sim_advance(s->sim, oz_step_clock_nearest(oz_sim_clock(s->sim), s->warm)));
    OZ_PASS(oz_snapshot_create(&s->now, &s->bed->scene, &s->bed->grains));
    return oz_series_create(&s->series, "/dev/null", &s->bed->scene, &s->bed->grains);
}

static double per_step(double events, double steps)
{
    return steps > 0 ? events / steps : 0;
}

/* Steps of a piece: a tap if that is quick enough. */
static OzStatus choose_piece(Shares *s)
{
    const OzScene *scene = &s->bed->scene;
    double tap = scene->period > 0 ? scene->period / scene->step : 1000;
    int64_t first = oz_sim_step(s->sim);
    OZ_PASS(oz_sim_advance(s->sim, first + WARM / 2));
    double start = oz_stage_timing_clock(&s->device);
    OZ_PASS(oz_sim_advance(s->sim, first + WARM));
    double each = (oz_stage_timing_clock(&s->device) - start) / (WARM - WARM / 2);
    s->piece = llround(fmin(tap, fmax(LEAST, piece_seconds / each)));
    return OZ_OK;
}

/* Lists are not rebuilt in every short piece, so their mean is taken. */
static double piece_time(double times[PIECES], bool whole_taps)
{
    double sum = 0;
    for (int k = 0; k < PIECES; k++) {
        sum += times[k];
    }
    oz_order_sort(times, PIECES);
    return whole_taps ? 0.5 * (times[PIECES / 2 - 1] + times[PIECES / 2]) : sum / PIECES;
}

static void note_rates(Shares *s, OzSimCounts before, OzSimCounts after)
{
    double steps = (double)(after.steps - before.steps);
    const double rates[] = {
        [OZ_TIMED_STEP] = 1,
        [OZ_TIMED_REFRESH] = per_step((double)(after.refreshes - before.refreshes), steps),
        [OZ_TIMED_REBUILD] = per_step((double)(after.rebuilds - before.rebuilds), steps)};
    for (int i = 0; i < s->model->stage_count; i++) {
        s->result->stage[i].calls_per_step = rates[s->model->stages[i].rate];
    }
}

static OzStatus time_steps(Shares *s)
{
    double times[PIECES];
    OZ_PASS(choose_piece(s));
    OzSimCounts before = oz_sim_counts(s->sim);
    for (int k = 0; k < PIECES; k++) {
        double start = oz_stage_timing_clock(&s->device);
        OZ_PASS(oz_sim_advance(s->sim, oz_sim_step(s->sim) + s->piece));
        times[k] = oz_stage_timing_clock(&s->device) - start;
    }
    note_rates(s, before, oz_sim_counts(s->sim));
    const OzScene *scene = &s->bed->scene;
    bool whole = scene->period <= 0 || (double)s->piece >= floor(scene->period / scene->step);
    s->result->part[PART_STEP] = (Share){piece_time(times, whole) / (double)s->piece, 1};
    return OZ_OK;
}

static OzStatus time_stages(Shares *s)
{
    int64_t first = oz_sim_step(s->sim);
    int moments = s->options->quick ? 1 : MOMENTS;
    Share *stage = s->result->stage;
    for (int k = 1; k <= moments; k++) {
        double now[OZ_TIMED_MOST];
        OZ_PASS(oz_sim_advance(s->sim, first + s->piece * k / moments));
        OZ_PASS(oz_stage_timing_measure(now, s->sim, s->options->source_dir));
        for (int i = 0; i < s->model->stage_count; i++) {
            stage[i].seconds += now[i] / moments;
        }
    }
    double rest = s->result->part[PART_STEP].seconds;
    for (int i = 0; i < s->model->stage_count; i++) {
        rest -= stage[i].seconds * stage[i].calls_per_step;
    }
    s->result->part[PART_REST] = (Share){rest, 1};
    return OZ_OK;
}

static double rate(double interval, double step)
{
    return interval > 0 ? step / interval : 0;
}

static OzStatus time_observing(Shares *s, const OzSchedule *schedule)
{
    double start = oz_stage_timing_clock(&s->device);
    for (int k = 0; k < SAMPLES; k++) {
        OZ_PASS(oz_read_snapshot_snapshot(s->sim, 0, &s->now, false));
        oz_series_sample(s->series, &s->now);
    }
    double middle = oz_stage_timing_clock(&s->device);
    for (int k = 0; k < ROWS; k++) {
        OZ_PASS(oz_read_snapshot_snapshot(s->sim, 0, &s->now, true));
        OZ_PASS(oz_series_write(s->series, &s->now));
    }
    double step = s->bed->scene.step;
    OzContactSums sums = oz_contact_list_sum(&s->now.contacts);
    memcpy(s->result->touches, sums.kinds, sizeof sums.kinds);
    s->result->part[PART_SAMPLE] =
        (Share){(middle - start) / SAMPLES, rate(schedule->track[OZ_TRACK_SAMPLE].interval, step)};
    s->result->part[PART_ROW] = (Share){(oz_stage_timing_clock(&s->device) - middle) / ROWS,
                                        rate(schedule->track[OZ_TRACK_ROW].interval, step)};
    return OZ_OK;
}

/* Frames after the first, which opens GL and the encoder. */
static OzStatus draw_frames(Shares *s, double frames_per_step)
{
    double drawing[2] = {0}, encoding[2] = {0};
    for (int k = 0; k <= FRAMES; k++) {
        OZ_PASS(oz_pictures_add(s->pictures, &s->now, OZ_FRAME_MOVIE));
        oz_pictures_times(s->pictures, &drawing[k > 0], &encoding[k > 0]);
    }
    s->result->part[PART_DRAW] = (Share){(drawing[1] - drawing[0]) / FRAMES, frames_per_step};
    s->result->part[PART_ENCODE] = (Share){(encoding[1] - encoding[0]) / FRAMES, frames_per_step};
    return OZ_OK;
}

/* A machine without GL or an encoder still has the other shares. */
static OzStatus time_pictures(Shares *s, const OzSchedule *schedule)
{
    OzPicturesSettings settings = {.folder = s->folder,
                                   .source_dir = s->options->source_dir,
                                   .backend = s->options->gl,
                                   .device = s->device.name};
    if (!s->bed->scene.movie.present) {
        return OZ_OK;
    }
    OZ_PASS(oz_file_make_folder(s->folder));
    OZ_PASS(oz_pictures_create(&s->pictures, &settings, &s->bed->scene));
    if (draw_frames(s, rate(schedule->track[OZ_TRACK_FRAME].interval, s->bed->scene.step)) !=
        OZ_OK) {
        oz_log_line("drawing and encoding not measured: %s", oz_status_text());
    }
    return OZ_OK;
}

static OzStatus measure(void *context)
{
    OzStatus status = OZ_OK;
    Shares *s = context;
    OZ_TRY(open_shares(s));
    OzSchedule schedule = oz_schedule_create(&s->bed->scene, -1);
    OZ_TRY(time_steps(s));
    OZ_TRY(time_stages(s));
    OZ_TRY(time_observing(s, &schedule));
    OZ_TRY(time_pictures(s, &schedule));
done:
    oz_pictures_finish(s->pictures);
    oz_series_free(s->series);
    oz_snapshot_free(&s->now);
    oz_sim_free(s->sim);
    oz_device_close(&s->device);
    return status;
}

/* One number into the table and into the file; what was not measured is - and empty. */
static void print_number(double value, int width, int decimals, FILE *text, FILE *csv)
{
    if (isfinite(value)) {
        fprintf(text, " %*.*f", width, decimals, value);
        fprintf(csv, ",%.6g", value);
    } else {
        fprintf(text, " %*s", width, "-");
        fprintf(csv, ",");
    }
}

static void print_part(const char *name, const char *how, Share part, double step, FILE *text,
                       FILE *csv)
{
    double us = 1e6 * part.seconds * part.calls_per_step;
    fprintf(text, "%-21s", name);
    fprintf(csv, "%s", name);
    print_number(1e6 * part.seconds, 12, 2, text, csv);
    print_number(part.calls_per_step, 13, 6, text, csv);
    print_number(us, 12, 3, text, csv);
    print_number(1e-4 * us / step, 9, 1, text, csv);
    fprintf(text, "  %s\n", how);
    fprintf(csv, "\n");
}

/* Trigrains' contacts are computed by one piece of code for all kinds, so its time is theirs by
 * number. */
static void print_kinds(const Result *result, Share all, double step, FILE *text, FILE *csv)
{
    static const char *const names[OZ_CONTACT_KINDS] = {
        "", "  kind i", "  kind ii", "  kind iii", "  kind iv", "  kind v", "  kind vi", "  discs"};
    double sum = 0;
    for (int k = 0; k < OZ_CONTACT_KINDS; k++) {
        sum += (double)result->touches[k];
    }
    for (int k = 1; k < OZ_CONTACT_KINDS; k++) {
        if (result->touches[k] > 0) {
            Share share = {all.seconds * (double)result->touches[k] / sum, all.calls_per_step};
            print_part(names[k], "a share of these by number", share, step, text, csv);
        }
    }
}

static OzStatus print_all(const Result *result, const OzModel *model, const char *folder,
                          const char *name, FILE *text)
{
    OzStatus status = OZ_OK;
    double step = result->part[PART_STEP].seconds;
    FILE *csv = NULL;
    OZ_TRY(oz_folder_create_file(&csv, folder, name));
    fprintf(csv, "part,us_per_call,calls_per_step,us_per_step,percent_of_step\n");
    fprintf(text, "%-22s %12s %13s %11s %9s  %s\n", "part", "us a call", "calls a step",
            "us a step", "of a step", "how measured");
    for (int i = 0; i < model->stage_count; i++) {
        print_part(model->stages[i].name, model->stages[i].how, result->stage[i], step, text, csv);
        if (i == model->contact_stage) {
            print_kinds(result, result->stage[i], step, text, csv);
        }
    }
    for (int p = 0; p < PART_COUNT; p++) {
        print_part(parts[p].name, parts[p].how, result->part[p], step, text, csv);
    }
done:
    if (csv) {
        fclose(csv);
    }
    return status;
}

OzStatus oz_bench_shares_print(const OzBenchBed *bed, double warm, const OzOptions *options,
                               const char *folder, const char *name, FILE *text)
{
    OzStatus status = OZ_OK;
    Result result = {0};
    const OzModel *model = oz_models_of(&bed->scene);
    char *movie = NULL, table[256];
    result.part[PART_DRAW].seconds = result.part[PART_ENCODE].seconds = NAN;
    snprintf(table, sizeof table, "%s.csv", name);
    OZ_TRY(oz_file_join(&movie, folder, name));
    Shares s = {.bed = bed,
                .model = model,
                .options = options,
                .folder = movie,
                .warm = warm,
                .result = &result};
    OZ_TRY(oz_subprocess_run(measure, &s, &result, sizeof result));
    fprintf(text, "\nshares of %lld %ss of %s, %s (of a CPU: processor time)\n",
            (long long)model->body_count(&bed->grains), model->body, bed->scene.name,
            bed->scene.precision == OZ_PRECISION_FLOAT ? "float" : "double");
    OZ_TRY(print_all(&result, model, folder, table, text));
done:
    free(movie);
    return status;
}
