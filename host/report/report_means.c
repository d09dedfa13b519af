/* Running a scene at a few settings, for many seeds. */
#include "report/report_means.h"

#include "base/log.h"
#include "base/memory.h"
#include "base/student.h"
#include "report/report_member.h"
#include "scene/keys.h"

#include <math.h>
#include <stdlib.h>

enum { SEEDS = 4, SEEDS_QUICK = 2, ROWS = 64 };

/* s of computing, by the time of a step of one member. */
static const double budget = 90, budget_quick = 10;

/* THE list: columns of series.csv whose means over the later half are compared. */
static const char *const quantities[OZ_REPORT_MEANS_QUANTITIES] = {
    "density_tap_mean", "angle_tap_mean", "contact_count",  "kinetic",    "rotational",
    "speed_mean",       "spin_mean",      "contact_number", "inclination"};

static OzMoments moments_of(const OzReportMean *setting, int quantity)
{
    return oz_student_moments(setting->value[quantity], setting->members);
}

static bool spreads(OzRange range)
{
    return range.low != range.high;
}

/* Whether another seed gives another scene. */
static bool is_random(const OzScene *scene)
{
    for (int p = 0; p < scene->population_count; p++) {
        const OzPopulation *grains = &scene->populations[p];
        bool shaped = scene->model == OZ_MODEL_TRIGRAINS && grains->shape == OZ_SHAPE_POLYGON &&
                      (grains->irregularity > 0 || spreads(grains->corners));
        if (grains->kind == OZ_GRAINS_RANDOM || shaped || spreads(grains->diameter) ||
            spreads(grains->aspect) || spreads(grains->radius) || spreads(grains->edge)) {
            return true;
        }
    }
    return false;
}

/* Wall time of a simulated second, of one member. */
static double cost_of(const OzReportPath *path, const OzReportStart *start)
{
    return path->good ? path->cost : start->step_seconds / path->step;
}

/* Wall time of a simulated second of all members of all settings. */
static double cost_of_all(const OzReportMeans *means, const OzReportStart *start)
{
    double cost = 0;
    for (int s = 0; s < means->count; s++) {
        cost += means->seeds * cost_of(&means->setting[s].path, start);
    }
    return cost;
}

/* What the budget allows of the scene's time, whole periods; at least what shows anything, for
 * which it may be exceeded threefold. */
static void choose_time(OzReportMeans *means, const OzReportStart *start, const OzOptions *options)
{
    double cost = cost_of_all(means, start), period = start->scene.period;
    double allowed = options->quick ? budget_quick : budget, duration = start->scene.duration;
    double least = fmin(duration, period > 0 ? 2 * period : duration / 20);
    double time = fmin(duration, allowed / cost - start->settled);
    means->time = fmax(least, period > 0 ? period * floor(time / period + 1e-9) : time);
    double needed = (means->time + start->settled) * cost;
    if (needed > 3 * allowed) {
        snprintf(
            means->skipped, sizeof means->skipped,
            "not run: %.3g s of %d seeds, with settling, would take about %.3g s; see orzo run "
            "--seeds",
            means->time, means->seeds, needed);
        means->seeds = 0;
    }
}

static OzStatus choose(OzMemberOrder *order, const OzReportMeans *means, int s,
                       const OzReportStart *start, const char *folder, const OzOptions *options)
{
    const OzReportPath *path = &means->setting[s].path;
    const char *integrator = oz_keys_choice_name("integrator", (int)path->integrator);
    OZ_PASS(oz_report_member_order(order, options, means->seeds));
    oz_report_member_set(order, "integrator", integrator);
    oz_report_member_set_number(order, "time.step", path->step);
    oz_report_member_set(order, "observe.at", "mean");
    if (start->scene.observe.interval_taps > 0) {
        oz_report_member_set_number(order, "observe.interval_taps", 0.25);
    } else {
        double interval = fmax(means->time / ROWS, path->step);
        oz_report_member_set_number(order, "observe.interval", interval);
    }
    if (start->is_flat) {
        oz_report_member_set_number(order, "beams.substeps", (double)path->substeps);
    }
    snprintf(order->folder, sizeof order->folder, "%s/mean_%d", folder, s);
    order->options.until = means->time;
    return OZ_OK;
}

static OzStatus read_members(OzReportMean *setting, const OzMemberOrder *order)
{
    for (uint64_t seed = order->options.seed_first; seed <= order->options.seed_last; seed++) {
        char path[OZ_MEMBER_PATH + 64];
        bool ended = oz_report_member_ended(order, seed, path);
        for (int q = 0; ended && q < OZ_REPORT_MEANS_QUANTITIES; q++) {
            double *value = &setting->value[q][setting->members];
            OZ_PASS(oz_report_member_mean(value, path, quantities[q]));
        }
        setting->members += ended;
    }
    return OZ_OK;
}

static OzStatus run_setting(OzReportMeans *means, int s, const OzReportStart *start,
                            const char *folder, const OzOptions *options)
{
    OzStatus status = OZ_OK;
    OzReportMean *setting = &means->setting[s];
    OzMemberOrder *order = NULL;
    bool any = false;
    OZ_TRY(OZ_NEW(&order, 1));
    OZ_TRY(choose(order, means, s, start, folder, options));
    oz_log_line("means: %s, %d seeds, %.3g s", setting->label, means->seeds, means->time);
    OZ_TRY(oz_report_member_run(order, setting->reason, sizeof setting->reason, &any));
    if (any) {
        OZ_TRY(read_members(setting, order));
    }
done:
    free(order);
    return status;
}

/* Of every setting's means, those that differ from the last one's by more than both intervals. */
static void compare(OzReportMeans *means)
{
    const OzReportMean *last = &means->setting[means->count - 1];
    for (int s = 0; s + 1 < means->count; s++) {
        for (int q = 0; q < OZ_REPORT_MEANS_QUANTITIES; q++) {
            OzMoments a = moments_of(&means->setting[s], q), b = moments_of(last, q);
            double both = a.interval + b.interval, difference = fabs(a.mean - b.mean);
            if (isfinite(difference) && isfinite(both)) {
                means->compared++;
                means->different += difference > both;
            }
        }
    }
}

static OzStatus choose_seeds(OzReportMeans *means, const OzScene *scene, const OzOptions *options)
{
    means->seeds = options->quick ? SEEDS_QUICK : SEEDS;
    if (options->has_seeds) {
        uint64_t more = options->seed_last - options->seed_first;
        if (more < 1 || more >= OZ_REPORT_MEANS_SEEDS) {
            return oz_status_fail(OZ_ERR_INPUT, "orzo report: expected 2 to %d seeds",
                                  OZ_REPORT_MEANS_SEEDS);
        }
        means->seeds = (int)more + 1;
    }
    if (!is_random(scene)) {
        snprintf(means->skipped, sizeof means->skipped,
                 "nothing in this scene depends on the seed: there is no ensemble");
        means->seeds = 0;
    }
    return OZ_OK;
}

OzStatus oz_report_means_study(OzReportMeans *means, const OzReportStart *start, const char *path,
                               const char *folder, const OzOptions *options)
{
    OzOptions alone = *options;
    alone.paths[0] = path;
    alone.path_count = 1;
    OZ_PASS(choose_seeds(means, &start->scene, options));
    if (means->seeds > 0) {
        choose_time(means, start, options);
    }
    for (int s = 0; s < (means->seeds > 0 ? means->count : 0); s++) {
        OZ_PASS(run_setting(means, s, start, folder, &alone));
    }
    if (means->seeds > 0) {
        compare(means);
    }
    return OZ_OK;
}

static bool has(const OzReportMeans *means, int quantity)
{
    for (int s = 0; s < means->count; s++) {
        if (isfinite(moments_of(&means->setting[s], quantity).mean)) {
            return true;
        }
    }
    return false;
}

static void print_quantity(FILE *file, const OzReportMeans *means, int q)
{
    fprintf(file, "  %-18s", quantities[q]);
    for (int s = 0; s < means->count; s++) {
        OzMoments m = moments_of(&means->setting[s], q);
        fprintf(file, "  %11.5g +- %-11.2g", m.mean, m.interval);
    }
    fprintf(file, "\n");
}

void oz_report_means_print(FILE *file, const OzReportMeans *means)
{
    bool any = false;
    if (means->seeds == 0) {
        fprintf(file, "means: %s\n", means->skipped);
        return;
    }
    fprintf(file, "means over %d seeds, later half of %.3g s, and 95 %% intervals\n  %-18s",
            means->seeds, means->time, "");
    for (int s = 0; s < means->count; s++) {
        fprintf(file, "  %-26s", means->setting[s].label);
    }
    fprintf(file, "\n");
    for (int q = 0; q < OZ_REPORT_MEANS_QUANTITIES; q++) {
        if (has(means, q)) {
            print_quantity(file, means, q);
        }
    }
    for (int s = 0; s < means->count; s++) {
        const OzReportMean *setting = &means->setting[s];
        if (setting->reason[0]) {
            fprintf(file, "  %s: %d of %d seeds reached the end: %s\n", setting->label,
                    setting->members, means->seeds, setting->reason);
        }
    }
    fprintf(file, "  left out, not defined here:");
    for (int q = 0; q < OZ_REPORT_MEANS_QUANTITIES; q++) {
        if (!has(means, q)) {
            fprintf(file, "%s %s", any ? "," : "", quantities[q]);
            any = true;
        }
    }
    fprintf(file, "%s\n", any ? "" : " nothing");
}
