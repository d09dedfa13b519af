/* Drawing one state again and again, in a process of its own, since drivers keep threads. */
#include "bench/bench_pictures.h"

#include "base/clock.h"
#include "base/folder.h"
#include "base/log.h"
#include "base/subprocess.h"
#include "draw/renderer.h"
#include "model/snapshot.h"

#include <string.h>

/* Seconds of processor time that a row takes at least; in pictures, one at least. */
static const double row_seconds = 0.4, quick_seconds = 0.05;

enum { WARM = 2 }; /* pictures before: memory taken, glass painted, programs built */

static const int sizes[][2] = {{320, 180}, {640, 360}, {1280, 720}, {2400, 1800}};

/* THE list of views. */
static const struct {
    const char *name;
    int count;
    OzView views[2];
} views[] = {
    {"lateral", 1, {OZ_VIEW_LATERAL}},
    {"cut", 1, {OZ_VIEW_CUT}},
    {"both", 2, {OZ_VIEW_LATERAL, OZ_VIEW_CUT}},
};

enum { SIZES = sizeof sizes / sizeof *sizes, VIEWS = sizeof views / sizeof *views };

typedef struct Result {
    double seconds[SIZES][VIEWS]; /* of a picture; 0: not of this model */
    char renderer[256];
} Result;

typedef struct Work {
    const OzBenchBed *bed;
    const OzOptions *options;
    OzRenderer *renderer;
    OzSnapshot now;
    Result *result; /* borrowed */
} Work;

static OzStatus time_look(Work *work, const OzLook *look, double *seconds)
{
    OzStatus status = OZ_OK;
    OzImage image = {0};
    double least = work->options->quick ? quick_seconds : row_seconds, start = 0, spent = 0;
    int64_t count = 0;
    OZ_TRY(oz_image_create(&image, look->width, look->height));
    for (int k = 0; k < WARM; k++) {
        OZ_TRY(oz_renderer_draw(work->renderer, &work->now, look, &image));
    }
    start = oz_clock_processor();
    for (; spent < least; count++) {
        OZ_TRY(oz_renderer_draw(work->renderer, &work->now, look, &image));
        spent = oz_clock_processor() - start;
    }
    *seconds = spent / (double)count;
done:
    oz_image_free(&image);
    return status;
}

static OzStatus time_looks(Work *work)
{
    OzLook look = oz_renderer_look(&work->bed->scene, &work->now);
    for (int s = 0; s < SIZES; s++) {
        for (int v = 0; v < (look.flat ? 1 : VIEWS); v++) {
            look.width = sizes[s][0];
            look.height = sizes[s][1];
            look.view_count = views[v].count;
            memcpy(look.views, views[v].views, sizeof look.views);
            OZ_PASS(time_look(work, &look, &work->result->seconds[s][v]));
        }
    }
    return OZ_OK;
}

static OzStatus measure(void *context)
{
    OzStatus status = OZ_OK;
    Work *work = context;
    OZ_TRY(oz_snapshot_create(&work->now, &work->bed->scene, &work->bed->grains));
    OZ_TRY(oz_renderer_create(&work->renderer, work->options->gl, work->options->source_dir));
    OZ_TRY(time_looks(work));
    snprintf(work->result->renderer, sizeof work->result->renderer, "%s",
             oz_renderer_name(work->renderer));
done:
    oz_renderer_free(work->renderer);
    oz_snapshot_free(&work->now);
    return status;
}

static void print_rows(const Result *result, FILE *text, FILE *csv)
{
    fprintf(csv, "width,height,view,ms_per_picture,pictures_per_s\n");
    fprintf(text, "%-12s %-8s %14s %14s\n", "size", "view", "ms a picture", "pictures a s");
    for (int s = 0; s < SIZES; s++) {
        for (int v = 0; v < VIEWS; v++) {
            double seconds = result->seconds[s][v];
            if (seconds > 0) {
                char size[24];
                snprintf(size, sizeof size, "%dx%d", sizes[s][0], sizes[s][1]);
                fprintf(text, "%-12s %-8s %14.2f %14.1f\n", size, views[v].name, 1e3 * seconds,
                        1 / seconds);
                fprintf(csv, "%d,%d,%s,%.6g,%.6g\n", sizes[s][0], sizes[s][1], views[v].name,
                        1e3 * seconds, 1 / seconds);
            }
        }
    }
}

OzStatus oz_bench_pictures_print(const OzBenchBed *bed, const OzOptions *options,
                                 const char *folder, const char *name, FILE *text)
{
    Result result = {0};
    Work work = {.bed = bed, .options = options, .result = &result};
    FILE *csv = NULL;
    char table[256];
    if (oz_subprocess_run(measure, &work, &result, sizeof result) != OZ_OK) {
        oz_log_line("pictures not measured: %s", oz_status_text());
        return OZ_OK;
    }
    snprintf(table, sizeof table, "%s.csv", name);
    OZ_PASS(oz_folder_create_file(&csv, folder, table));
    fprintf(text,
            "\npictures of %lld grains of %s, processor time of one core, without encoding; %s\n",
            (long long)bed->grains.count, bed->scene.name, result.renderer);
    print_rows(&result, text, csv);
    return fclose(csv) == 0 ? OZ_OK
                            : oz_status_fail(OZ_ERR_FILE, "cannot write %s/%s", folder, table);
}
