/* Running a chaotic bed at every setting, as an ensemble over seeds. */
#include "report/report_ensemble.h"

#include "base/clock.h"
#include "base/folder.h"
#include "base/memory.h"
#include "model/insert.h"
#include "model/predict.h"
#include "report/report_ensemble_table.h"
#include "scene/keys.h"

#include <stdlib.h>
#include <string.h>

static const int ladder[] = {20, 30, 50, 100};
static const int ladder_quick[] = {20, 40};

enum {
    RUNGS = sizeof ladder / sizeof ladder[0],
    RUNGS_QUICK = sizeof ladder_quick / sizeof ladder_quick[0],
    TAPS = 20,
    TAPS_QUICK = 2,
    SEEDS = 4
};

static bool is_set(const OzOptions *options, const char *key)
{
    size_t length = strlen(key);
    for (int i = 0; i < options->setting_count; i++) {
        if (strncmp(options->settings[i], key, length) == 0 &&
            options->settings[i][length] == '=') {
            return true;
        }
    }
    return false;
}

static OzStatus choose(OzMemberOrder *order, const OzOptions *options, const char *folder,
                       const OzEnsemblePoint *point, double contact_time)
{
    const char *integrator = oz_keys_choice_name("integrator", (int)point->integrator);
    OZ_PASS(oz_report_member_order(order, options, SEEDS));
    oz_report_member_set(order, "integrator", integrator);
    oz_report_member_set_number(order, "time.step", contact_time / point->steps);
    oz_report_member_set(order, "observe.ledger", "true");
    oz_report_member_set_number(order, "observe.interval_taps", 0.25);
    oz_report_member_set(order, "observe.at", "mean"); /* rows lie closer than a period */
    if (!is_set(options, "time.taps")) {
        oz_report_member_set_number(order, "time.taps", options->quick ? TAPS_QUICK : TAPS);
    }
    snprintf(order->folder, sizeof order->folder, "%s/%s_%d", folder, integrator, point->steps);
    return OZ_OK;
}

static OzStatus read_members(OzEnsemblePoint *point, const OzMemberOrder *order)
{
    OzStatus status = OZ_OK;
    const OzOptions *o = &order->options;
    OzScene scene = {0};
    OzGrains grains = {0};
    OZ_TRY(oz_scene_load(&scene, o->paths[0], o->settings, o->setting_count));
    OZ_TRY(oz_insert_grains(&grains, &scene));
    for (uint64_t seed = o->seed_first; seed <= o->seed_last; seed++) {
        double values[OZ_MEMBER_QUANTITIES];
        char path[OZ_MEMBER_PATH + 64];
        if (oz_report_member_ended(order, seed, path)) {
            OZ_TRY(oz_report_member_read(values, path, &scene, &grains));
            for (int q = 0; q < OZ_MEMBER_QUANTITIES; q++) {
                point->value[q][point->members] = values[q];
            }
            point->members++;
        }
    }
done:
    oz_grains_free(&grains);
    oz_scene_free(&scene);
    return status;
}

static OzStatus run_point(OzEnsemblePoint *point, const OzOptions *options, const char *folder,
                          double contact_time)
{
    OzStatus status = OZ_OK;
    OzMemberOrder *order = NULL;
    bool any = false;
    OZ_TRY(OZ_NEW(&order, 1));
    OZ_TRY(choose(order, options, folder, point, contact_time));
    double start = oz_clock_now();
    OZ_TRY(oz_report_member_run(order, point->reason, sizeof point->reason, &any));
    point->seconds = oz_clock_now() - start;
    if (any) {
        OZ_TRY(read_members(point, order));
    }
done:
    free(order);
    return status;
}

/* What the scene must be, and its contact time. */
static OzStatus look_at_scene(double *contact_time, char **title, OzIntegrator *integrator,
                              const OzOptions *options)
{
    OzStatus status = OZ_OK;
    OzScene scene = {0};
    bool moves = false;
    OZ_TRY(oz_scene_load(&scene, options->paths[0], options->settings, options->setting_count));
    for (int w = 0; w < scene.wall_count; w++) {
        moves |= scene.walls[w].motion.present;
    }
    if (!moves || scene.model != OZ_MODEL_RODS) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "%s: nothing taps these grains; expected rods and a wall with "
                                "motion",
                                scene.path);
        goto done;
    }
    *contact_time = scene.contact.contact_time;
    *integrator = scene.integrator;
    OZ_TRY(oz_memory_text(title, scene.name));
done:
    oz_scene_free(&scene);
    return status;
}

static OzStatus check_seeds(const OzOptions *options)
{
    if (options->has_seeds && (options->seed_last - options->seed_first < 1 ||
                               options->seed_last - options->seed_first >= OZ_ENSEMBLE_SEEDS_MAX)) {
        return oz_status_fail(OZ_ERR_INPUT, "orzo report --ensemble: expected 2 to %d seeds",
                              OZ_ENSEMBLE_SEEDS_MAX);
    }
    return OZ_OK;
}

OzStatus oz_report_ensemble_run(const OzOptions *options, const char *folder)
{
    OzStatus status = OZ_OK;
    OzEnsemblePoint *points = NULL;
    OzIntegrator asked = OZ_INTEGRATOR_EULER;
    char *title = NULL;
    double contact_time = 0;
    int count = 0, rungs = options->quick ? RUNGS_QUICK : RUNGS;
    const OzFolderUse use = {.keep = true};
    OzFolder owned = {0};
    OZ_TRY(check_seeds(options));
    OZ_TRY(look_at_scene(&contact_time, &title, &asked, options));
    OZ_TRY(OZ_NEW(&points, rungs * OZ_PREDICT_INTEGRATORS));
    OZ_TRY(oz_folder_open(&owned, folder, &use));
    OZ_TRY(oz_folder_note(folder, "ensemble.csv")); /* refused now, not at the end */
    OZ_TRY(oz_folder_note(folder, "ensemble.png"));
    for (int i = 0; i < OZ_PREDICT_INTEGRATORS; i++) {
        bool chosen = !is_set(options, "integrator") || i == (int)asked;
        for (int r = 0; chosen && r < rungs; r++) {
            OzEnsemblePoint *point = &points[count++];
            point->integrator = (OzIntegrator)i;
            point->steps = options->quick ? ladder_quick[r] : ladder[r];
            OZ_TRY(run_point(point, options, folder, contact_time));
        }
    }
    oz_report_ensemble_table_print(stdout, points, count);
    OZ_TRY(oz_report_ensemble_table_write(folder, title, points, count));
done:
    free(points);
    free(title);
    oz_folder_close(&owned);
    return status;
}
