/* Scenes at the settings of a report. */
#include "report/report_runs.h"

#include "base/memory.h"
#include "base/random.h"
#include "model/beam_limits.h"
#include "model/insert.h"
#include "scene/keys.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    OWN_SETTINGS = 4,
    SETTING_SIZE = 64,
    COPIES = 4 /* of a scene without phases, all alike: for its time */
};

/* The seed of the phases; any will do, as each phase has a stratum of its own. */
#define PHASE_SEED 20

static const double PI = 3.14159265358979323846;

static bool is_flat(const OzReportJob *job)
{
    return job->row->model == OZ_MODEL_TRIGRAINS;
}

/* The user's settings, then the point's. */
static OzStatus load(OzScene *scene, const OzReportJob *job, const OzReportPoint *point,
                     double cycle)
{
    char own[OWN_SETTINGS][SETTING_SIZE], *all[OZ_CLI_SETTINGS_MAX + OWN_SETTINGS];
    int count = job->options->setting_count, more = is_flat(job) ? OWN_SETTINGS : OWN_SETTINGS - 1;
    memcpy(all, job->options->settings, (size_t)count * sizeof *all);
    snprintf(own[0], SETTING_SIZE, "time.step=%.17g", cycle / point->steps);
    snprintf(own[1], SETTING_SIZE, "integrator=%s",
             oz_keys_choice_name("integrator", (int)point->integrator));
    snprintf(own[2], SETTING_SIZE, "precision=%s",
             oz_keys_choice_name("precision", (int)point->precision));
    snprintf(own[3], SETTING_SIZE, "beams.substeps=%d", point->substeps > 1 ? point->substeps : 1);
    for (int i = 0; i < more; i++) {
        all[count + i] = own[i];
    }
    return oz_scene_load(scene, job->path, all, cycle > 0 ? count + more : count);
}

/* What `steps` divides, s, with the user's settings: rods' contact time; of elements the period of
 * the fastest vibration. */
static OzStatus find_cycle(double *cycle, const OzReportJob *job)
{
    OzStatus status = OZ_OK;
    OzScene scene = {0};
    OzGrains grains = {0};
    OzBeamLimit limit;
    OzReportPoint none = {.steps = 1};
    OZ_TRY(load(&scene, job, &none, 0));
    *cycle = scene.contact.contact_time;
    if (is_flat(job)) {
        OZ_TRY(oz_insert_grains(&grains, &scene));
        OZ_TRY(oz_beam_limits_find(&limit, &scene, &grains));
        *cycle = 2 * PI / limit.rate;
    }
done:
    oz_grains_free(&grains);
    oz_scene_free(&scene);
    return status;
}

/* Puts every grain, and what it is made of, where it was `earlier` seconds before, in free flight
 * without spin. */
static void start_earlier(OzGrains *grains, const double gravity[3], double earlier)
{
    for (int64_t i = 0; i < grains->count; i++) {
        for (int c = 0; c < 3; c++) {
            double *x = &grains->position[3 * i + c], *v = &grains->velocity[3 * i + c];
            *x -= *v * earlier - 0.5 * gravity[c] * earlier * earlier;
            *v -= gravity[c] * earlier;
        }
    }
    OzElements *elements = grains->elements;
    for (int64_t k = 0; elements && k < 2 * elements->free_count; k++) {
        double g = gravity[k % 2];
        elements->position[k] -= elements->velocity[k] * earlier - 0.5 * g * earlier * earlier;
        elements->velocity[k] -= g * earlier;
    }
}

static int copies_of(const OzReportJob *job)
{
    int own = job->row->starts > 0 ? job->row->starts : COPIES;
    int copies = job->row->phases ? job->phases : own;
    return copies < OZ_REPORT_RUNS_MOST ? copies : OZ_REPORT_RUNS_MOST;
}

static OzStatus place(OzReportRuns *runs, const OzReportJob *job)
{
    OzRandom random = oz_random_stream(PHASE_SEED, 0);
    int copies = copies_of(job);
    for (int i = 0; i < copies; i++) {
        OZ_PASS(oz_insert_grains(&runs->starts[i], &runs->scene));
        runs->count = i + 1;
        runs->members[i] = (OzMember){&runs->scene, &runs->starts[i]};
        if (job->row->phases) {
            double share = (i + oz_random_uniform(&random, 0, 1)) / copies;
            start_earlier(&runs->starts[i], runs->scene.gravity, share * runs->scene.step);
        }
        if (job->row->start) {
            job->row->start(&runs->scene, &runs->starts[i], i);
        }
    }
    return OZ_OK;
}

OzStatus oz_report_runs_open(OzReportRuns **out, const OzReportJob *job, const OzReportPoint *point)
{
    OzStatus status = OZ_OK;
    OzReportRuns *runs = NULL;
    double cycle = 0;
    OZ_TRY(OZ_NEW(&runs, 1));
    OZ_TRY(find_cycle(&cycle, job));
    OZ_TRY(load(&runs->scene, job, point, cycle));
    runs->steps = llround(runs->scene.duration / runs->scene.step);
    OZ_TRY(place(runs, job));
done:
    *out = runs;
    return status;
}

void oz_report_runs_close(OzReportRuns *runs)
{
    if (!runs) {
        return;
    }
    for (int i = 0; i < runs->count; i++) {
        oz_grains_free(&runs->starts[i]);
    }
    oz_scene_free(&runs->scene);
    free(runs);
}
