/* The straight line of the study of any scene. */
#include "report/report_own.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/folder.h"
#include "base/log.h"
#include "base/memory.h"
#include "scene/keys.h"

#include <math.h>
#include <stdlib.h>

/* Diameters, without --tolerance. */
static const double tolerance_default = 0.01;

/* Of the largest stable step: beyond, damping and order are poor even where nothing grows. */
static const double stable_share = 0.9, stable_share_unseen = 0.5;

/* Steps per cycle that stand in where no paths could be measured, and those of the small step that
 * means are compared with. */
enum { STEPS_UNSEEN = 50, STEPS_UNSEEN_FLAT = 20, STEPS_SMALL = 100, STEPS_SMALL_FLAT = 40 };

static bool is_sound(const OzReportPath *path)
{
    return path->good && path->step <= stable_share * path->largest;
}

const OzReportPath *oz_report_own_choose(const OzReportPaths *paths, double tolerance)
{
    const OzReportPath *cheapest = NULL, *best = NULL;
    for (int i = 0; i < paths->count; i++) {
        const OzReportPath *path = &paths->path[i];
        if (!is_sound(path)) {
            continue;
        }
        if (path->error <= tolerance && (!cheapest || path->cost < cheapest->cost)) {
            cheapest = path;
        }
        if (!best || path->error < best->error) {
            best = path;
        }
    }
    return cheapest ? cheapest : best;
}

/* A setting at so many steps per cycle of the model's most accurate integrator, or what the bed's
 * stability asks for. */
static OzStatus make_setting(OzReportPath *path, const OzReportStart *start, int steps)
{
    *path = (OzReportPath){.integrator =
                               start->is_flat ? OZ_INTEGRATOR_GEAR4 : OZ_INTEGRATOR_VELOCITY_VERLET,
                           .substeps = 1};
    OzStatus status = oz_report_start_limit(&path->largest, start, path->integrator, 1);
    path->step = fmin(start->cycle / steps, stable_share_unseen * path->largest);
    path->steps = start->cycle / path->step;
    return status;
}

/* A step that can be pasted: three digits, rounded down. */
static double round_step(double step)
{
    double unit = pow(10, floor(log10(step)) - 2);
    return floor(step / unit * (1 + 1e-12)) * unit;
}

static bool is_same(const OzReportPath *a, const OzReportPath *b)
{
    return a->integrator == b->integrator && a->substeps == b->substeps &&
           fabs(a->step / b->step - 1) < 0.02;
}

static void print_setting(const OzReportPath *path, const OzReportStart *start)
{
    printf("integrator: %s", oz_keys_choice_name("integrator", (int)path->integrator));
    if (path->substeps > 1) {
        printf(", beams.substeps: %lld", (long long)path->substeps);
    }
    printf(", time.step: %.4g (%.3g steps per %s)", path->step, start->cycle / path->step,
           start->cycle_name);
}

static void print_reason(const OzReportPaths *paths, const OzReportPath *advised, double tolerance)
{
    const OzReportPath *written = &paths->path[0];
    if (!advised->good) {
        printf(", on the ground of stability alone, for ");
        printf(paths->horizon > 0 ? "in the time that could be followed grains move too little"
                                  : "paths cannot be compared here");
        return;
    }
    printf(", %s %.2g diameters from the small-step path after %.3g s",
           advised->error <= tolerance ? "the cheapest that is within" : "the nearest, at",
           advised->error <= tolerance ? tolerance : advised->error, paths->horizon);
    if (written->good) {
        printf(" (as written: %.2g)", written->error);
        printf(", in %.2g times the time of the scene as written", advised->cost / written->cost);
    } else {
        printf(" (as written: %s)", written->reason);
    }
}

static void print_means(const OzReportMeans *means)
{
    if (means->compared == 0) {
        printf("; no means to compare");
    } else {
        printf(
            "; of %d means over seeds %d differ%s from those of a small step by more than chance",
            means->compared, means->different, means->different == 1 ? "s" : "");
    }
}

static void print_advice(const OzReportPaths *paths, const OzReportMeans *means,
                         const OzReportStart *start, const OzReportPath *advised, double tolerance)
{
    bool keep = is_same(advised, &paths->path[0]);
    printf("advice: %s ", keep ? "keep" : "take");
    print_setting(advised, start);
    print_reason(paths, advised, tolerance);
    print_means(means);
    printf(".\n");
    fflush(stdout);
}

/* As written, as advised if that is another, and at a small step. */
static OzStatus list_means(OzReportMeans *means, const OzReportPaths *paths,
                           const OzReportPath *advised, const OzReportStart *start)
{
    OzReportPath small;
    OzStatus status = make_setting(&small, start, start->is_flat ? STEPS_SMALL_FLAT : STEPS_SMALL);
    *means = (OzReportMeans){0};
    means->setting[means->count++] = (OzReportMean){.label = "as written", .path = paths->path[0]};
    if (!is_same(advised, &paths->path[0])) {
        means->setting[means->count++] = (OzReportMean){.label = "advised", .path = *advised};
    }
    means->setting[means->count++] = (OzReportMean){.label = "small step", .path = small};
    return status;
}

static OzStatus choose_advice(OzReportPath *advised, const OzReportPaths *paths,
                              const OzReportStart *start, double tolerance)
{
    const OzReportPath *chosen = oz_report_own_choose(paths, tolerance);
    if (!chosen || paths->moved < tolerance) {
        return make_setting(advised, start, start->is_flat ? STEPS_UNSEEN_FLAT : STEPS_UNSEEN);
    }
    *advised = *chosen;
    if (chosen != &paths->path[0]) {
        advised->step = round_step(chosen->step);
    }
    return OZ_OK;
}

static OzStatus study(OzReportStart *start, OzReportMeans *means, const char *path,
                      const char *folder, const OzOptions *options, const OzDevice *device)
{
    OzReportPaths paths;
    OzReportPath advised;
    double tolerance = options->tolerance > 0 ? options->tolerance : tolerance_default;
    OZ_PASS(oz_report_path_study(&paths, start, options, device));
    OZ_PASS(oz_report_path_write(folder, &paths));
    OZ_PASS(oz_report_start_say(stdout, start));
    oz_report_path_print(stdout, &paths, start);
    OZ_PASS(choose_advice(&advised, &paths, start, tolerance));
    OZ_PASS(list_means(means, &paths, &advised, start));
    OZ_PASS(oz_report_means_study(means, start, path, folder, options));
    oz_report_means_print(stdout, means);
    print_advice(&paths, means, start, &advised, tolerance);
    return OZ_OK;
}

/* A folder of the scene's own in the report's, which says so. */
static OzStatus open_own(OzFolder *owned, const char *folder, const char *name)
{
    OzStatus status = OZ_OK;
    const OzFolderUse use = {.keep = true};
    char *path = NULL, *noted = NULL;
    OZ_TRY(oz_file_join(&path, folder, name));
    OZ_TRY(oz_file_join(&noted, name, ""));
    OZ_TRY(oz_folder_note(folder, noted));
    OZ_TRY(oz_folder_open(owned, path, &use));
done:
    free(path);
    free(noted);
    return status;
}

OzStatus oz_report_own_study(const char *path, const char *folder, const OzOptions *options,
                             const OzDevice *device)
{
    OzStatus status = OZ_OK;
    OzReportStart start = {0};
    OzReportMeans *means = NULL;
    const char *own = NULL;
    OzFolder owned = {0};
    double begin = oz_clock_now();
    OZ_TRY(OZ_NEW(&means, 1));
    oz_log_line("%s: no answer is known for this scene: paths, means and stability are studied",
                path);
    OZ_TRY(oz_report_start_find(&start, path, options, device));
    OZ_TRY(open_own(&owned, folder, start.scene.name));
    own = owned.path;
    printf("%s: %lld grain%s, paths from %s\n", path, (long long)start.grains.count,
           start.grains.count == 1 ? "" : "s", start.how);
    OZ_TRY(study(&start, means, path, own, options, device));
    oz_log_line("%s: %.0f s; %s/paths.csv", path, oz_clock_now() - begin, own);
done:
    oz_report_start_free(&start);
    free(means);
    oz_folder_close(&owned);
    return status;
}
