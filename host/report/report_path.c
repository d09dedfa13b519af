/* Following grains at many settings. */
#include "report/report_path.h"

#include "base/clock.h"
#include "base/folder.h"
#include "base/log.h"
#include "base/memory.h"
#include "scene/keys.h"
#include "sim/read_snapshot.h"
#include "sim/sim.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LOOKS = 24, LADDER_MOST = 8 };

/* s for all paths, by the time of a step as written. */
static const double budget = 60, budget_quick = 5;

/* One integrator at its steps per cycle; those that no scene is stable at are left out. */
typedef struct Method {
    OzIntegrator integrator;
    int64_t substeps;
    double ladder[LADDER_MOST], quick[LADDER_MOST]; /* ending with 0 */
} Method;

static const Method rods[] = {
    {OZ_INTEGRATOR_EULER, 1, {20, 30, 50, 100, 200}, {20, 50, 100}},
    {OZ_INTEGRATOR_SYMPLECTIC_EULER, 1, {15, 20, 30, 50, 100, 200}, {20, 50, 100}},
    {OZ_INTEGRATOR_VELOCITY_VERLET, 1, {15, 20, 30, 50, 100, 200}, {20, 50, 100}},
};
static const Method flat[] = {
    {OZ_INTEGRATOR_GEAR4, 1, {14, 20, 40, 80}, {20, 40}},
    {OZ_INTEGRATOR_VELOCITY_VERLET, 1, {14, 20, 40, 80}, {20, 40}},
    {OZ_INTEGRATOR_VELOCITY_VERLET, 4, {5, 8, 14}, {5, 8}},
};
enum { METHODS = sizeof rods / sizeof rods[0], FLAT_METHODS = sizeof flat / sizeof flat[0] };

/* Steps per cycle of the finer small-step path; the other takes half as many. */
static double truth_steps(const OzReportStart *start, const OzOptions *options)
{
    return (start->is_flat ? 320 : 800) / (options->quick ? 2 : 1);
}

static void add(OzReportPaths *paths, OzIntegrator integrator, int64_t substeps, double steps,
                double step)
{
    if (paths->count < OZ_REPORT_PATH_MOST) {
        paths->path[paths->count++] = (OzReportPath){
            .integrator = integrator, .substeps = substeps, .steps = steps, .step = step};
    }
}

/* The scene as written, then the ladders. */
static void list_paths(OzReportPaths *paths, const OzReportStart *start, bool quick)
{
    const OzScene *scene = &start->scene;
    const Method *methods = start->is_flat ? flat : rods;
    int count = start->is_flat ? FLAT_METHODS : METHODS;
    bool has_beams = start->is_flat && start->grains.elements->beam_count > 0;
    add(paths, scene->integrator, start->is_flat ? scene->beams.substeps : 1,
        start->cycle / scene->step, scene->step);
    for (int m = 0; m < count; m++) {
        const double *ladder = quick ? methods[m].quick : methods[m].ladder;
        for (int k = 0; ladder[k] > 0 && (methods[m].substeps == 1 || has_beams); k++) {
            add(paths, methods[m].integrator, methods[m].substeps, ladder[k],
                start->cycle / ladder[k]);
        }
    }
}

static double mean_diameter(const OzGrains *grains)
{
    double sum = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        sum += grains->diameter[i];
    }
    return sum / (double)grains->count;
}

/* How long anything is worth following, s. */
static double time_worth(const OzReportStart *start)
{
    const OzScene *scene = &start->scene;
    const double *g = scene->gravity;
    double gravity = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    bool few = start->grains.count < OZ_REPORT_START_FEW;
    double time = few                 ? scene->duration
                  : scene->period > 0 ? scene->period
                  : gravity > 0       ? 20 * sqrt(mean_diameter(&start->grains) / gravity)
                                      : scene->duration;
    return fmin(time, scene->duration);
}

/* What the budget allows: all settings and both small-step paths, which take twice the time of a
 * step in single precision. */
static double time_allowed(const OzReportPaths *paths, const OzReportStart *start,
                           const OzOptions *options)
{
    double per_cycle = 2 * 1.5 * paths->truth_steps;
    for (int i = 0; i < paths->count; i++) {
        per_cycle += paths->path[i].steps;
    }
    double cycles = (options->quick ? budget_quick : budget) / (per_cycle * start->step_seconds);
    return cycles * start->cycle;
}

/* A setting of the scene from the start on. The scene's text and arrays are the start's. */
typedef struct Worker {
    const OzReportStart *start;
    OzScene scene;
    int64_t steps; /* from look to look */
    double *place; /* looks x 3 x grains, m, owned */
    bool touched;  /* at a look            */
    double wall;   /* s per simulated s    */
} Worker;

static OzStatus open_worker(Worker *worker, const OzReportStart *start, const OzReportPath *path,
                            OzPrecision precision, double interval, int looks)
{
    *worker = (Worker){.start = start, .scene = start->scene};
    worker->scene.settle.present = false;
    worker->scene.observe.ledger = false;
    worker->scene.integrator = path->integrator;
    worker->scene.beams.substeps = path->substeps;
    worker->scene.precision = precision;
    worker->steps = (int64_t)ceil(interval / path->step - 1e-9);
    worker->steps = worker->steps > 1 ? worker->steps : 1;
    worker->scene.step = interval / (double)worker->steps;
    return OZ_NEW(&worker->place, 3 * start->grains.count * looks);
}

static OzStatus look(Worker *worker, OzSim *sim, OzSnapshot *now, int k)
{
    size_t words = 3 * (size_t)now->count;
    OZ_PASS(oz_read_snapshot_snapshot(sim, 0, now, true));
    memcpy(worker->place + (size_t)k * words, now->position, words * sizeof(double));
    worker->touched |= now->contacts.count > 0;
    return OZ_OK;
}

static OzStatus follow(Worker *worker, int looks, const OzOptions *options, const OzDevice *device)
{
    OzStatus status = OZ_OK;
    OzSim *sim = NULL;
    OzSnapshot now = {0};
    OzMember member = {&worker->scene, &worker->start->grains};
    OZ_TRY(oz_sim_create(&sim, device, &member, 1, options->source_dir));
    OZ_TRY(oz_snapshot_create(&now, &worker->scene, &worker->start->grains));
    OZ_TRY(oz_sim_advance(sim, 1)); /* the driver makes itself ready */
    double begin = oz_clock_now(), steps = (double)(looks * worker->steps - 1);
    for (int k = 0; k < looks; k++) {
        OZ_TRY(oz_sim_advance(sim, (k + 1) * worker->steps));
        OZ_TRY(look(worker, sim, &now, k));
    }
    worker->wall = (oz_clock_now() - begin) / (fmax(steps, 1) * worker->scene.step);
done:
    oz_snapshot_free(&now);
    oz_sim_free(sim);
    return status;
}

/* Rms distance of grains between two states, in diameters. */
static double distance(const OzGrains *grains, const double *x, const double *y)
{
    double squares = 0;
    for (int64_t i = 0; i < 3 * grains->count; i++) {
        squares += (x[i] - y[i]) * (x[i] - y[i]);
    }
    return sqrt(squares / (double)grains->count) / mean_diameter(grains);
}

static const double *place_at(const Worker *worker, int look)
{
    return worker->place + look * 3 * worker->start->grains.count;
}

/* Between a look of one worker and one of another. */
static double apart(const Worker *a, int look_a, const Worker *b, int look_b)
{
    return distance(&a->start->grains, place_at(a, look_a), place_at(b, look_b));
}

/* The last look up to which both agree, -1 without any. */
static int find_horizon(OzReportPaths *paths, const Worker *coarse, const Worker *fine)
{
    int last = -1;
    for (int k = 0; k < LOOKS; k++) {
        double now = apart(coarse, k, fine, k);
        if (!(now <= OZ_REPORT_PATH_APART)) {
            break;
        }
        paths->apart = now;
        last = k;
    }
    paths->horizon = (last + 1) * paths->longest / LOOKS;
    paths->touched = fine->touched || coarse->touched;
    if (last >= 0) {
        const OzGrains *grains = &fine->start->grains;
        paths->moved = distance(grains, place_at(fine, last), grains->position);
    }
    return last;
}

static OzStatus measure(OzReportPath *path, const OzReportPaths *paths, const Worker *truth,
                        int look_of_truth, const OzOptions *options, const OzDevice *device)
{
    OzStatus status = OZ_OK;
    Worker worker = {0};
    const OzReportStart *start = truth->start;
    path->error = path->wall = NAN;
    OZ_TRY(open_worker(&worker, start, path, start->scene.precision, paths->horizon, 1));
    status = path->step < path->largest
                 ? OZ_OK
                 : oz_status_fail(OZ_ERR_INPUT, "unstable: the largest stable step is %.4g s",
                                  path->largest);
    status = status == OZ_OK ? follow(&worker, 1, options, device) : status;
    if (status == OZ_OK) {
        path->error = apart(&worker, 0, truth, look_of_truth);
        path->wall = worker.wall;
    }
    path->good = status == OZ_OK && isfinite(path->error);
    status = oz_status_outcome(status, path->reason, sizeof path->reason);
done:
    free(worker.place);
    return status;
}

/* "velocity-verlet, 4 substeps" */
static void name_path(const OzReportPath *path, char *text, size_t size)
{
    const char *name = oz_keys_choice_name("integrator", (int)path->integrator);
    snprintf(text, size, path->substeps > 1 ? "%s, %lld substeps" : "%s", name,
             (long long)path->substeps);
}

static OzStatus measure_all(OzReportPaths *paths, const Worker *truth, int look_of_truth,
                            const OzOptions *options, const OzDevice *device)
{
    for (int i = 0; i < paths->count; i++) {
        OzReportPath *path = &paths->path[i];
        char name[64];
        name_path(path, name, sizeof name);
        if (i == 0 || path->integrator != path[-1].integrator ||
            path->substeps != path[-1].substeps) {
            oz_log_line("paths: %s%s", name, i == 0 ? ", as written" : "");
        }
        OZ_PASS(measure(path, paths, truth, look_of_truth, options, device));
    }
    return OZ_OK;
}

/* The two small-step paths. */
static OzStatus follow_truths(OzReportPaths *paths, Worker *coarse, Worker *fine,
                              const OzReportStart *start, const OzOptions *options,
                              const OzDevice *device)
{
    OzPrecision precision = device->has_double ? OZ_PRECISION_DOUBLE : OZ_PRECISION_FLOAT;
    for (int k = 0; k < 2; k++) {
        double steps = paths->truth_steps / (k == 0 ? 2 : 1);
        OzReportPath path = {.integrator = start->is_flat ? OZ_INTEGRATOR_GEAR4
                                                          : OZ_INTEGRATOR_VELOCITY_VERLET,
                             .substeps = 1,
                             .steps = steps,
                             .step = start->cycle / steps};
        oz_log_line("paths: small steps, %.0f per %s, for %.3g s", steps, start->cycle_name,
                    paths->longest);
        Worker *worker = k == 0 ? coarse : fine;
        OZ_PASS(open_worker(worker, start, &path, precision, paths->longest / LOOKS, LOOKS));
        OZ_PASS(follow(worker, LOOKS, options, device));
    }
    return OZ_OK;
}

static OzStatus find_limits(OzReportPaths *paths, const OzReportStart *start)
{
    for (int i = 0; i < paths->count; i++) {
        OzReportPath *path = &paths->path[i];
        OZ_PASS(oz_report_start_limit(&path->largest, start, path->integrator, path->substeps));
    }
    return OZ_OK;
}

/* Other programs only lengthen times: the least of an integrator's is nearest to its own. */
static void find_costs(OzReportPaths *paths)
{
    for (int i = 0; i < paths->count; i++) {
        OzReportPath *path = &paths->path[i];
        double least = INFINITY;
        for (int k = 0; k < paths->count; k++) {
            const OzReportPath *other = &paths->path[k];
            bool alike = other->integrator == path->integrator && other->substeps == path->substeps;
            least = alike && other->good ? fmin(least, other->wall * other->step) : least;
        }
        path->cost = least / path->step;
    }
}

OzStatus oz_report_path_study(OzReportPaths *paths, const OzReportStart *start,
                              const OzOptions *options, const OzDevice *device)
{
    OzStatus status = OZ_OK;
    Worker coarse = {0}, fine = {0};
    *paths = (OzReportPaths){.truth_steps = truth_steps(start, options)};
    list_paths(paths, start, options->quick);
    OZ_TRY(find_limits(paths, start));
    paths->longest = fmin(time_worth(start), time_allowed(paths, start, options));
    if (!(paths->longest > 0)) {
        OZ_TRY(oz_status_fail(OZ_ERR_INPUT,
                              "%s: no time to follow; expected a time.duration above 0",
                              start->scene.path));
    }
    status = follow_truths(paths, &coarse, &fine, start, options, device);
    if (status == OZ_ERR_BLOWUP) {
        oz_log_line("small steps: %s", oz_status_text());
        status = OZ_OK;
        goto done;
    }
    OZ_TRY(status);
    int last = find_horizon(paths, &coarse, &fine);
    if (last >= 0) {
        OZ_TRY(measure_all(paths, &fine, last, options, device));
        find_costs(paths);
    }
done:
    free(coarse.place);
    free(fine.place);
    return status;
}

static void print_row(FILE *file, const OzReportPath *path, bool written)
{
    char name[64];
    name_path(path, name, sizeof name);
    fprintf(file, "  %-28s %8.1f %11.4g", name, path->steps, path->step);
    if (path->good) {
        fprintf(file, " %12.3g %12.4g", path->error, path->wall);
    } else {
        fprintf(file, " %12s %12s  %s", "-", "-", path->reason);
    }
    fprintf(file, "%s\n", written ? "  as written" : "");
}

void oz_report_path_print(FILE *file, const OzReportPaths *paths, const OzReportStart *start)
{
    if (!(paths->horizon > 0)) {
        fprintf(file,
                "paths: those of two small steps part within %.3g s by more than %g diameters: "
                "none can be compared\n",
                paths->longest / LOOKS, OZ_REPORT_PATH_APART);
        return;
    }
    fprintf(file,
            "paths: those of %g and %g steps per %s agree for %.3g s%s (to %.2g diameters, while "
            "grains move by %.2g)%s\n",
            paths->truth_steps / 2, paths->truth_steps, start->cycle_name, paths->horizon,
            paths->horizon < paths->longest ? ", then they part" : ", all that was followed",
            paths->apart, paths->moved,
            paths->touched ? "" : "; nothing touched at any look, which says little");
    fprintf(file, "  %-28s %8s %11s %12s %12s\n", "integrator", "steps", "step, s", "error, d",
            "wall, s/s");
    for (int i = 0; i < paths->count; i++) {
        print_row(file, &paths->path[i], i == 0);
    }
}

OzStatus oz_report_path_write(const char *folder, const OzReportPaths *paths)
{
    FILE *csv = NULL;
    OZ_PASS(oz_folder_create_file(&csv, folder, "paths.csv"));
    fprintf(csv, "integrator,substeps,steps_per_cycle,step,largest_stable_step,horizon,"
                 "error_diameters,wall_per_second,reason\n");
    for (int i = 0; i < paths->count; i++) {
        const OzReportPath *p = &paths->path[i];
        fprintf(csv, "%s,%lld,%.9g,%.9g,%.9g,%.9g,",
                oz_keys_choice_name("integrator", (int)p->integrator), (long long)p->substeps,
                p->steps, p->step, p->largest, paths->horizon);
        if (p->good) {
            fprintf(csv, "%.6g,%.6g,\n", p->error, p->wall);
        } else {
            fprintf(csv, ",,\"%s\"\n", p->reason);
        }
    }
    bool whole = !ferror(csv);
    return fclose(csv) == 0 && whole
               ? OZ_OK
               : oz_status_fail(OZ_ERR_FILE, "cannot write %s/paths.csv", folder);
}
