/* Running a chaotic bed at every setting, as an ensemble over seeds. */
#include "study/report_ensemble.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/folder.h"
#include "base/memory.h"
#include "model/place.h"
#include "model/predict.h"
#include "run.h"
#include "scene/keys.h"
#include "study/report_ensemble_table.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const int ladder[] = {20, 30, 50, 100};
static const int ladder_quick[] = {20, 40};

enum {
    RUNGS = sizeof ladder / sizeof ladder[0],
    RUNGS_QUICK = sizeof ladder_quick / sizeof ladder_quick[0],
    TAPS = 20,
    TAPS_QUICK = 2,
    SEEDS = 4,
    OWN_SETTINGS = 6,
    SETTING_SIZE = 64,
    PATH_SIZE = 1024
};

/* One setting of the study, as the options of a run. */
typedef struct Setting {
    OzOptions options;
    char own[OWN_SETTINGS][SETTING_SIZE], folder[PATH_SIZE];
} Setting;

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

static void set(Setting *setting, int i, const char *key, const char *value)
{
    snprintf(setting->own[i], SETTING_SIZE, "%s=%s", key, value);
    setting->options.settings[setting->options.setting_count++] = setting->own[i];
}

static void set_number(Setting *setting, int i, const char *key, double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.17g", value);
    set(setting, i, key, text);
}

static OzStatus choose(Setting *setting, const OzOptions *options, const char *folder,
                       const OzEnsemblePoint *point, double contact_time)
{
    const char *integrator = oz_keys_choice_name("integrator", (int)point->integrator);
    *setting = (Setting){.options = *options};
    if (options->setting_count + OWN_SETTINGS > OZ_CLI_SETTINGS_MAX) {
        return oz_status_fail(OZ_ERR_INPUT, "orzo report: at most %d --set here",
                              OZ_CLI_SETTINGS_MAX - OWN_SETTINGS);
    }
    set(setting, 0, "integrator", integrator);
    set_number(setting, 1, "time.step", contact_time / point->steps);
    set(setting, 2, "observe.ledger", "true");
    set_number(setting, 3, "observe.interval_taps", 0.25);
    set(setting, 4, "observe.at", "mean"); /* rows lie closer than a period */
    if (!is_set(options, "time.taps")) {
        set_number(setting, 5, "time.taps", options->quick ? TAPS_QUICK : TAPS);
    }
    snprintf(setting->folder, PATH_SIZE, "%s/%s_%d", folder, integrator, point->steps);
    setting->options.out = setting->folder;
    setting->options.no_video = true;
    setting->options.overwrite = true;
    if (!options->has_seeds) {
        setting->options.has_seeds = true;
        setting->options.seed_first = 1;
        setting->options.seed_last = SEEDS;
    }
    return OZ_OK;
}

/* A member that a guard stopped leaves no final.csv: only those that reached the end count. */
static OzStatus read_members(OzEnsemblePoint *point, const Setting *setting)
{
    OzStatus status = OZ_OK;
    const OzOptions *o = &setting->options;
    OzScene scene = {0};
    OzGrains grains = {0};
    OZ_TRY(oz_scene_load(&scene, o->paths[0], o->settings, o->setting_count));
    OZ_TRY(oz_place_grains(&grains, &scene));
    for (uint64_t seed = o->seed_first; seed <= o->seed_last; seed++) {
        double values[OZ_MEMBER_QUANTITIES];
        char path[PATH_SIZE + 64];
        int length = snprintf(path, sizeof path, "%s/seed_%05llu/final.csv", setting->folder,
                              (unsigned long long)seed);
        if (access(path, R_OK) == 0) {
            snprintf(path + length - strlen("final.csv"), 16, "series.csv");
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
    Setting *setting = NULL;
    OZ_TRY(OZ_NEW(&setting, 1));
    OZ_TRY(choose(setting, options, folder, point, contact_time));
    double start = oz_clock_now();
    OzStatus ran = oz_run_scene(&setting->options);
    point->seconds = oz_clock_now() - start;
    if (ran != OZ_OK) {
        snprintf(point->reason, sizeof point->reason, "%.*s", (int)sizeof point->reason - 1,
                 oz_status_text());
        status = ran == OZ_ERR_BLOWUP || ran == OZ_ERR_INPUT ? OZ_OK : ran;
    }
    if (ran == OZ_OK || ran == OZ_ERR_BLOWUP) {
        OZ_TRY(read_members(point, setting));
    }
done:
    free(setting);
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
