/* Members by number: which settings each has on top of the command's own. */
#include "plan.h"

#include "base/log.h"
#include "base/memory.h"
#include "model/beam_limits.h"
#include "model/place.h"
#include "model/predict.h"
#include "scene/sweep.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SETTING_SIZE = 1024 };

const char *oz_plan_value(const OzPlan *plan, int64_t i)
{
    return plan->scene.sweep.count ? plan->scene.sweep.values[i / plan->seed_count] : NULL;
}

uint64_t oz_plan_seed(const OzPlan *plan, int64_t i)
{
    if (plan->options->has_seeds) {
        return plan->options->seed_first + (uint64_t)(i % plan->seed_count);
    }
    bool swept = plan->scene.sweep.count && strcmp(plan->scene.sweep.key, "seed") == 0;
    return swept ? strtoull(oz_plan_value(plan, i), NULL, 10) : plan->scene.seed;
}

/* The scene of member i: the command's settings, the value, the seed. */
static OzStatus load_scene(const OzPlan *plan, int64_t i, OzScene *scene)
{
    const OzOptions *options = plan->options;
    char *settings[OZ_CLI_SETTINGS_MAX + 2], value[SETTING_SIZE], seed[SETTING_SIZE];
    int count = options->setting_count;
    memcpy(settings, options->settings, (size_t)count * sizeof *settings);
    if (plan->scene.sweep.count) {
        snprintf(value, sizeof value, "%s=%s", plan->scene.sweep.key, oz_plan_value(plan, i));
        settings[count++] = value;
    }
    if (options->has_seeds) {
        snprintf(seed, sizeof seed, "seed=%" PRIu64, oz_plan_seed(plan, i));
        settings[count++] = seed;
    }
    OzStatus status = oz_scene_load(scene, options->paths[0], settings, count);
    oz_sweep_free(&scene->sweep);
    return status;
}

static OzStatus check_pieces(const OzScene *scene, const OzGrains *grains, bool force)
{
    OzBeamLimit limit;
    if (scene->integrator == OZ_INTEGRATOR_RK4) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: integrator rk4 is on the host alone, to compare with; expected "
                              "gear4 or velocity-verlet",
                              scene->path);
    }
    if (scene->precision == OZ_PRECISION_FLOAT) {
        oz_log_line("warning: precision float rounds away what a step of %g s moves: energies and "
                    "rest are not to be trusted; double is the default",
                    scene->step);
    }
    OzStatus status = oz_beam_limits_find(&limit, scene, grains);
    if (status != OZ_OK || scene->step < limit.largest_step) {
        return status;
    }
    if (!force) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: time.step %g s is unstable for %s of grain %lld; expected below "
                              "%g s, or --force",
                              scene->path, scene->step, limit.beam < 0 ? "contacts" : "the beams",
                              (long long)limit.grain, limit.largest_step);
    }
    oz_log_line("warning: time.step %g s is unstable, above %g s", scene->step, limit.largest_step);
    return OZ_OK;
}

OzStatus oz_plan_judge(const OzScene *scene, const OzGrains *grains, bool force)
{
    if (scene->model == OZ_MODEL_TRIGRAINS) {
        return check_pieces(scene, grains, force);
    }
    OzPrediction *rows = NULL;
    int count = 0;
    OzStatus status = oz_predict_scene(&rows, &count, scene, grains);
    for (int i = 0; status == OZ_OK && i < count; i++) {
        const char *between = rows[i].wall < 0 ? "two grains" : "a grain and a wall";
        if (!rows[i].stable && !force) {
            status = oz_status_fail(OZ_ERR_INPUT,
                                    "%s: time.step %g s is unstable for a contact of %s; expected "
                                    "below %g s, or --force",
                                    scene->path, scene->step, between, rows[i].largest_step);
        } else if (!rows[i].stable || !rows[i].tangential_stable) {
            oz_log_line("warning: at time.step %g s %s contact of %s is unstable", scene->step,
                        rows[i].stable ? "a sticking" : "a", between);
        }
    }
    free(rows);
    return status;
}

OzStatus oz_plan_load(const OzPlan *plan, int64_t i, OzScene *scene, OzGrains *grains)
{
    OzStatus status = OZ_OK;
    OZ_TRY(load_scene(plan, i, scene));
    OZ_TRY(oz_place_grains(grains, scene));
    OZ_TRY(oz_plan_judge(scene, grains, plan->options->force));
done:
    return status;
}

/* "friction" of contact.friction, "velocity.0" of grains.1.velocity.0. */
static const char *last_word(const char *path)
{
    const char *word = path + strlen(path);
    while (word > path && (word[-1] != '.' || isdigit((unsigned char)*word))) {
        word--;
    }
    return word;
}

/* The key's last word and the value, with nothing in it that a folder's name should not have. */
static void name_value(const OzPlan *plan, int64_t i, char *name, size_t size)
{
    snprintf(name, size, "%s_%s", last_word(plan->scene.sweep.key), oz_plan_value(plan, i));
    for (char *letter = name; *letter; letter++) {
        if (!isalnum((unsigned char)*letter) && !strchr("._+-", *letter)) {
            *letter = '_';
        }
    }
}

OzStatus oz_plan_name(const OzPlan *plan, int64_t i, char **name)
{
    char value[160] = "", seed[32] = "";
    if (plan->scene.sweep.count) {
        name_value(plan, i, value, sizeof value);
    }
    if (plan->options->has_seeds) {
        snprintf(seed, sizeof seed, "%sseed_%05" PRIu64, value[0] ? "_" : "",
                 oz_plan_seed(plan, i));
    }
    *name = NULL;
    if (asprintf(name, "%s%s", value, seed) < 0) {
        *name = NULL;
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a member's name");
    }
    return OZ_OK;
}

/* Two values must not come to the same folder. */
static OzStatus check_names(const OzPlan *plan)
{
    char one[160], other[160];
    for (int i = 1; i < plan->scene.sweep.count; i++) {
        name_value(plan, i * plan->seed_count, one, sizeof one);
        for (int k = 0; k < i; k++) {
            name_value(plan, k * plan->seed_count, other, sizeof other);
            if (strcmp(one, other) == 0) {
                return oz_status_fail(
                    OZ_ERR_INPUT,
                    "%s: two values of the sweep of %s would both be written into "
                    "%s; expected values that differ in letters and digits",
                    plan->scene.path, plan->scene.sweep.key, one);
            }
        }
    }
    return OZ_OK;
}

static OzStatus check_values(OzPlan *plan)
{
    OzStatus status = OZ_OK;
    const OzSweep *sweep = &plan->scene.sweep;
    if (plan->count > OZ_PLAN_MEMBERS_MAX) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: %lld members; expected at most %d",
                              plan->scene.path, (long long)plan->count, OZ_PLAN_MEMBERS_MAX);
    }
    if (sweep->count && plan->options->has_seeds && strcmp(sweep->key, "seed") == 0) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: sweeps the seed; expected that or --seeds",
                              plan->scene.path);
    }
    OZ_TRY(check_names(plan));
    for (int v = 0; v < sweep->count; v++) {
        OzScene scene;
        status = load_scene(plan, v * plan->seed_count, &scene);
        status = status == OZ_OK ? oz_inputs_add_scene(&plan->inputs, &scene) : status;
        oz_scene_free(&scene);
        OZ_TRY(status);
    }
done:
    return status;
}

OzStatus oz_plan_create(OzPlan *plan, const OzOptions *options)
{
    OzStatus status = OZ_OK;
    *plan = (OzPlan){.options = options, .seed_count = 1};
    OZ_TRY(
        oz_scene_load(&plan->scene, options->paths[0], options->settings, options->setting_count));
    if (options->has_seeds) {
        plan->seed_count = (int64_t)(options->seed_last - options->seed_first) + 1;
    }
    plan->is_ensemble = options->has_seeds || plan->scene.sweep.count > 0;
    plan->count = plan->seed_count * (plan->scene.sweep.count ? plan->scene.sweep.count : 1);
    OZ_TRY(oz_inputs_add_scene(&plan->inputs, &plan->scene));
    OZ_TRY(check_values(plan));
done:
    return status;
}

void oz_plan_free(OzPlan *plan)
{
    oz_scene_free(&plan->scene);
    oz_inputs_free(&plan->inputs);
    *plan = (OzPlan){0};
}
