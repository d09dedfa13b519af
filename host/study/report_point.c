/* Running one setting of a report. */
#include "study/report_point.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/random.h"
#include "compute/capture.h"
#include "compute/reference.h"
#include "compute/sim.h"
#include "model/place.h"
#include "scene/keys.h"
#include "study/report_refuse.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    OWN_SETTINGS = 3,
    SETTING_SIZE = 64,
    REPEATS_MOST = 64,
    PHASES_MOST = 256,
    COPIES = 4 /* of a scene without phases, all alike: for its time */
};

/* The seed of the phases; any will do, as each phase has a stratum of its own. */
#define PHASE_SEED 20

/* A scene at one setting, with one start for each phase. Zeroed is valid. */
typedef struct Runs {
    OzScene scene;
    OzGrains starts[PHASES_MOST];
    OzMember members[PHASES_MOST];
    int count;
    int64_t steps; /* of the whole run */
} Runs;

static void close_runs(Runs *runs)
{
    for (int i = 0; i < runs->count; i++) {
        oz_grains_free(&runs->starts[i]);
    }
    oz_scene_free(&runs->scene);
}

/* The user's settings, then the point's. */
static OzStatus load(OzScene *scene, const OzReportJob *job, const OzReportPoint *point,
                     double contact_time)
{
    char own[OWN_SETTINGS][SETTING_SIZE], *all[OZ_CLI_SETTINGS_MAX + OWN_SETTINGS];
    int count = job->options->setting_count;
    memcpy(all, job->options->settings, (size_t)count * sizeof *all);
    snprintf(own[0], SETTING_SIZE, "time.step=%.17g", contact_time / point->steps);
    snprintf(own[1], SETTING_SIZE, "integrator=%s",
             oz_keys_choice_name("integrator", (int)point->integrator));
    snprintf(own[2], SETTING_SIZE, "precision=%s",
             oz_keys_choice_name("precision", (int)point->precision));
    for (int i = 0; i < OWN_SETTINGS; i++) {
        all[count + i] = own[i];
    }
    return oz_scene_load(scene, job->path, all, contact_time > 0 ? count + OWN_SETTINGS : count);
}

/* The scene's own contact time, s, settings applied. */
static OzStatus find_contact_time(double *contact_time, const OzReportJob *job)
{
    OzScene scene = {0};
    OzReportPoint none = {.steps = 1};
    OzStatus status = load(&scene, job, &none, 0);
    *contact_time = scene.contact.contact_time;
    oz_scene_free(&scene);
    return status;
}

/* Puts every grain where it was `earlier` seconds before, in free flight. */
static void start_earlier(OzGrains *grains, const double gravity[3], double earlier)
{
    for (int64_t i = 0; i < grains->count; i++) {
        for (int c = 0; c < 3; c++) {
            double *x = &grains->position[3 * i + c], *v = &grains->velocity[3 * i + c];
            *x -= *v * earlier - 0.5 * gravity[c] * earlier * earlier;
            *v -= gravity[c] * earlier;
        }
    }
}

static OzStatus open_runs(Runs *runs, const OzReportJob *job, const OzReportPoint *point)
{
    OzStatus status = OZ_OK;
    double contact_time = 0;
    OzRandom random = oz_random_stream(PHASE_SEED, 0);
    int phases = job->row->phases ? job->phases : COPIES;
    phases = phases < PHASES_MOST ? phases : PHASES_MOST;
    OZ_TRY(find_contact_time(&contact_time, job));
    OZ_TRY(load(&runs->scene, job, point, contact_time));
    runs->steps = llround(runs->scene.duration / runs->scene.step);
    for (int i = 0; i < phases; i++) {
        OZ_TRY(oz_place_grains(&runs->starts[i], &runs->scene));
        runs->count = i + 1;
        runs->members[i] = (OzMember){&runs->scene, &runs->starts[i]};
        if (job->row->phases) {
            double share = (i + oz_random_uniform(&random, 0, 1)) / phases;
            start_earlier(&runs->starts[i], runs->scene.gravity, share * runs->scene.step);
        }
    }
done:
    return status;
}

OzStatus oz_report_point_truth(double *truth, const OzReportJob *job)
{
    OzStatus status = OZ_OK;
    OzReportJob alone = *job;
    OzReference *reference = NULL;
    OzSnapshot end = {0};
    Runs *runs = NULL;
    OzReportPoint point = {.integrator = OZ_INTEGRATOR_VELOCITY_VERLET,
                           .precision = OZ_PRECISION_DOUBLE,
                           .steps = OZ_REPORT_POINT_TRUTH};
    alone.phases = 1;
    OZ_TRY(OZ_NEW(&runs, 1));
    OZ_TRY(open_runs(runs, &alone, &point));
    OZ_TRY(oz_snapshot_create(&end, &runs->scene, &runs->starts[0]));
    if (job->row->exact) {
        *truth = job->row->exact(&end);
    } else {
        OZ_TRY(oz_reference_create(&reference, &runs->scene, &runs->starts[0]));
        OZ_TRY(oz_reference_advance(reference, runs->steps));
        OZ_TRY(oz_reference_snapshot(reference, &end));
        *truth = job->row->value(&end);
    }
done:
    oz_reference_free(reference);
    oz_snapshot_free(&end);
    if (runs) {
        close_runs(runs);
    }
    free(runs);
    return status;
}

static OzStatus take_errors(OzReportPoint *point, OzSim *sim, const Runs *runs)
{
    OzStatus status = OZ_OK;
    OzSnapshot end = {0};
    double squares = 0;
    point->error_max = 0;
    for (int i = 0; i < runs->count; i++) {
        OZ_TRY(oz_snapshot_create(&end, &runs->scene, &runs->starts[i]));
        OZ_TRY(oz_capture_snapshot(sim, i, &end, true));
        double error = oz_report_cases_error(point->row, point->row->value(&end), point->truth);
        squares += error * error;
        point->error_max = error <= point->error_max ? point->error_max : error;
        oz_snapshot_free(&end);
    }
    point->error_rms = sqrt(squares / runs->count);
done:
    oz_snapshot_free(&end);
    return status;
}

/* Runs all phases side by side. *seconds receives the wall time of one of them, but for the first
 * step, in which the driver makes itself ready; the first run's errors go into the point. */
static OzStatus run_once(double *seconds, OzReportPoint *point, const OzReportJob *job,
                         const Runs *runs, bool first)
{
    OzStatus status = OZ_OK;
    OzSim *sim = NULL;
    OZ_TRY(oz_sim_create(&sim, job->device, runs->members, runs->count, job->options->source_dir));
    OZ_TRY(oz_sim_advance(sim, 1));
    double start = oz_clock_now();
    OZ_TRY(oz_sim_advance(sim, runs->steps));
    *seconds =
        (oz_clock_now() - start) * (double)runs->steps / (double)(runs->steps - 1) / runs->count;
    if (first) {
        OZ_TRY(take_errors(point, sim, runs));
    }
done:
    oz_sim_free(sim);
    return status;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static OzStatus run_all(OzReportPoint *point, const OzReportJob *job, const Runs *runs)
{
    OzStatus status = OZ_OK;
    double seconds[REPEATS_MOST], simulated = (double)runs->steps * runs->scene.step;
    int repeats = job->repeats < REPEATS_MOST ? job->repeats : REPEATS_MOST;
    for (int k = 0; k < repeats; k++) {
        OZ_TRY(run_once(&seconds[k], point, job, runs, k == 0));
    }
    qsort(seconds, (size_t)repeats, sizeof *seconds, by_size);
    point->wall = 0.5 * (seconds[(repeats - 1) / 2] + seconds[repeats / 2]) / simulated;
    point->wall_low = seconds[0] / simulated;
    point->wall_high = seconds[repeats - 1] / simulated;
done:
    return status;
}

/* A refusal or a blow-up is an outcome. Anything else that is not finite is one, too. */
static OzStatus judge(OzReportPoint *point, OzStatus status)
{
    if (status == OZ_ERR_BLOWUP || status == OZ_ERR_INPUT) {
        snprintf(point->reason, sizeof point->reason, "%.*s", (int)sizeof point->reason - 1,
                 oz_status_text());
        return OZ_OK;
    }
    point->good = status == OZ_OK && isfinite(point->error_rms);
    if (status == OZ_OK && !point->good) {
        snprintf(point->reason, sizeof point->reason, "the result is not a number");
    }
    return status;
}

OzStatus oz_report_point_measure(OzReportPoint *point, const OzReportJob *job)
{
    OzStatus status = OZ_OK;
    Runs *runs = NULL;
    OZ_TRY(OZ_NEW(&runs, 1));
    OZ_TRY(open_runs(runs, job, point));
    point->row = job->row;
    point->step = runs->scene.step;
    point->evaluations = 1 / runs->scene.step;
    snprintf(point->scene, sizeof point->scene, "%s", runs->scene.name);
    if (!job->options->force) {
        status = oz_report_refuse_unstable(&runs->scene, &runs->starts[0]);
    }
    status = judge(point, status == OZ_OK ? run_all(point, job, runs) : status);
done:
    if (runs) {
        close_runs(runs);
    }
    free(runs);
    return status;
}
