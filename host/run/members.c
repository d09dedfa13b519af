/* Members by number: which settings each has on top of the command's own. */
#include "run/members.h"

#include "base/log.h"
#include "base/memory.h"
#include "base/stage.h"
#include "model/beam_limits.h"
#include "model/insert.h"
#include "model/prediction.h"
#include "model/servo_nature.h"
#include "scene/sweep.h"
#include "sim/part.h"
#include "sim/resolution.h"
#include "sim/start.h"

#include <ctype.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SETTING_SIZE = 1024 };

const char *oz_members_value(const OzMembers *plan, int64_t i)
{
    return plan->scene.sweep.count ? plan->scene.sweep.values[i / plan->seed_count] : NULL;
}

/* The place of `seed` among the swept keys, or -1. */
static int seed_key(const OzSweep *sweep)
{
    for (int k = 0; k < sweep->key_count; k++) {
        if (strcmp(sweep->keys[k].path, "seed") == 0) {
            return k;
        }
    }
    return -1;
}

uint64_t oz_members_seed(const OzMembers *plan, int64_t i)
{
    const OzSweep *sweep = &plan->scene.sweep;
    if (plan->options->has_seeds) {
        return plan->options->seed_first + (uint64_t)(i % plan->seed_count);
    }
    int k = seed_key(sweep);
    return k < 0 ? plan->scene.seed : strtoull(oz_sweep_value(sweep, i, k), NULL, 10);
}

/* The scene of member i: the command's settings, the values, the seed. */
static OzStatus load_scene(const OzMembers *plan, int64_t i, OzScene *scene)
{
    const OzOptions *options = plan->options;
    const OzSweep *sweep = &plan->scene.sweep;
    char *settings[OZ_CLI_SETTINGS_MAX + OZ_SWEEP_KEYS_MAX + 1];
    char texts[OZ_SWEEP_KEYS_MAX + 1][SETTING_SIZE];
    int count = options->setting_count, own = 0;
    memcpy(settings, options->settings, (size_t)count * sizeof *settings);
    for (; own < sweep->key_count; own++) {
        snprintf(texts[own], SETTING_SIZE, "%s=%s", sweep->keys[own].path,
                 oz_sweep_value(sweep, i / plan->seed_count, own));
    }
    if (options->has_seeds) {
        snprintf(texts[own++], SETTING_SIZE, "seed=%" PRIu64, oz_members_seed(plan, i));
    }
    for (int k = 0; k < own; k++) {
        settings[count++] = texts[k];
    }
    OzStatus status = oz_scene_load(scene, options->paths[0], settings, count);
    oz_sweep_free(&scene->sweep);
    if (status == OZ_OK && plan->is_ensemble && isinf(scene->duration) && options->until < 0) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: an endless run of an ensemble, whose others might never begin; "
                              "expected --until, or a time.duration in s",
                              scene->path);
    }
    return status;
}

static OzStatus check_elements(const OzScene *scene, const OzGrains *grains, bool force)
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

/* Of how many contacts' stiffness is a guess: no reason to refuse. */
static void warn_of_pistons(const OzScene *scene, const OzGrains *grains)
{
    for (int w = 0; w < scene->wall_count; w++) {
        bool is_piston = scene->walls[w].servo.present;
        double largest = is_piston ? oz_servo_nature_of(scene, grains, w).largest_step : INFINITY;
        if (scene->step >= largest) {
            oz_log_line("warning: time.step %g s may be unstable for the piston walls.%d, above "
                        "about %.3g s; expected a heavier one or less damping",
                        scene->step, w, largest);
        }
    }
}

static OzStatus check_contacts(const OzScene *scene, const OzGrains *grains, bool force)
{
    OzPrediction *rows = NULL;
    int count = 0;
    OzStatus status = oz_prediction_rows(&rows, &count, scene, grains);
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
    warn_of_pistons(scene, grains);
    return status == OZ_OK ? oz_resolution_judge(scene, grains, force) : status;
}

OzStatus oz_members_judge_step(const OzScene *scene, const OzGrains *grains, bool force)
{
    bool flat = scene->model == OZ_MODEL_TRIGRAINS;
    return flat ? check_elements(scene, grains, force) : check_contacts(scene, grains, force);
}

OzStatus oz_members_judge(const OzScene *scene, const OzGrains *grains, bool force)
{
    OZ_PASS(oz_members_judge_step(scene, grains, force));
    return oz_start_judge(scene, grains, force);
}

OzStatus oz_members_place(OzGrains *grains, const OzScene *scene)
{
    OZ_PASS(oz_insert_grains(grains, scene));
    if (scene->settle.present && scene->settle.overlaps == OZ_OVERLAPS_REMOVE) {
        OZ_PASS(oz_part_grains(grains, scene));
    }
    return OZ_OK;
}

OzStatus oz_members_load(const OzMembers *plan, int64_t i, OzScene *scene, OzGrains *grains)
{
    OZ_PASS(load_scene(plan, i, scene));
    OZ_PASS(oz_members_place(grains, scene));
    return oz_members_judge(scene, grains, plan->options->force);
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

/* A swept key's name in a folder's: its last word, or all of it where another ends alike. */
static const char *name_of(const OzSweep *sweep, int k)
{
    const char *word = last_word(sweep->keys[k].path);
    for (int other = 0; other < sweep->key_count; other++) {
        if (other != k && strcmp(word, last_word(sweep->keys[other].path)) == 0) {
            return sweep->keys[k].path;
        }
    }
    return word;
}

/* Keys and values of a combination, with nothing in them that a folder's name should not have. */
static OzStatus name_values(const OzMembers *plan, int64_t combination, char **name)
{
    const OzSweep *sweep = &plan->scene.sweep;
    size_t length = 0;
    *name = NULL;
    FILE *file = open_memstream(name, &length);
    for (int k = 0; file && k < sweep->key_count; k++) {
        fprintf(file, "%s%s_%s", k ? "_" : "", name_of(sweep, k),
                oz_sweep_value(sweep, combination, k));
    }
    if (!file || fclose(file) != 0 || !*name) {
        return oz_status_fail(OZ_ERR_MEMORY, "out of memory for a member's name");
    }
    for (char *letter = *name; *letter; letter++) {
        if (!isalnum((unsigned char)*letter) && !strchr("._+-", *letter)) {
            *letter = '_';
        }
    }
    return OZ_OK;
}

OzStatus oz_members_name(const OzMembers *plan, int64_t i, char **name)
{
    OzStatus status = OZ_OK;
    char *values = NULL, seed[32] = "";
    *name = NULL;
    OZ_TRY(name_values(plan, i / plan->seed_count, &values));
    if (plan->options->has_seeds) {
        snprintf(seed, sizeof seed, "%sseed_%05" PRIu64, values[0] ? "_" : "",
                 oz_members_seed(plan, i));
    }
    if (asprintf(name, "%s%s", values, seed) < 0) {
        *name = NULL;
        status = oz_status_fail(OZ_ERR_MEMORY, "out of memory for a member's name");
    }
done:
    free(values);
    return status;
}

static int compare_texts(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Two combinations must not come to the same folder. */
static OzStatus check_names(const OzMembers *plan)
{
    OzStatus status = OZ_OK;
    char **names = NULL;
    int count = plan->scene.sweep.count, made = 0;
    OZ_TRY(OZ_NEW(&names, count));
    for (; made < count; made++) {
        OZ_TRY(name_values(plan, made, &names[made]));
    }
    if (count > 0) {
        qsort(names, (size_t)count, sizeof *names, compare_texts);
    }
    for (int i = 1; i < count; i++) {
        if (strcmp(names[i - 1], names[i]) == 0) {
            status = oz_status_fail(
                OZ_ERR_INPUT,
                "%s: two members of the sweep of %s would both be written into %s; expected values "
                "that differ in letters and digits",
                plan->scene.path, plan->scene.sweep.key, names[i]);
            goto done;
        }
    }
done:
    for (int i = 0; names && i < made; i++) {
        free(names[i]);
    }
    free(names);
    return status;
}

/* What is wrong with members, so far. */
typedef struct Wrongs {
    char text[8192];
    size_t used;
} Wrongs;

/* A member's scene is read with its values as settings; what is wrong with such a value is told as
 * it was written, in the sweep. Each line of a failure once. */
static void add_wrong(Wrongs *wrongs, const OzSweep *sweep, const char *line, size_t length)
{
    char told[1024];
    snprintf(told, sizeof told, "%.*s", (int)length, line);
    for (int k = 0; k < sweep->key_count; k++) {
        const OzSweepKey *key = &sweep->keys[k];
        size_t own = strlen(key->path);
        if (strncmp(line, "--set ", 6) == 0 && strncmp(line + 6, key->path, own) == 0 &&
            line[6 + own] == '=') {
            snprintf(told, sizeof told, "%s: in the sweep, %.*s", key->place, (int)(length - 6),
                     line + 6);
        }
    }
    if (!strstr(wrongs->text, told) && wrongs->used < sizeof wrongs->text) {
        wrongs->used +=
            (size_t)snprintf(wrongs->text + wrongs->used, sizeof wrongs->text - wrongs->used,
                             "%s%s", wrongs->used ? "\n" : "", told);
    }
}

static void add_failure(Wrongs *wrongs, const OzSweep *sweep)
{
    for (const char *line = oz_status_text(); *line; line += *line == '\n') {
        size_t length = strcspn(line, "\n");
        add_wrong(wrongs, sweep, line, length);
        line += length;
    }
}

/* Whether each combination can be loaded, all errors in one go; their grains are placed later, one
 * after the other. */
static OzStatus try_values(OzMembers *plan)
{
    OzStatus status = OZ_OK;
    OzStage stage;
    Wrongs wrongs = {.used = 0};
    int count = plan->scene.sweep.count;
    oz_stage_begin(&stage, "reading %d scenes of the sweep", count);
    for (int v = 0; status == OZ_OK && v < count; v++) {
        OzScene scene;
        oz_stage_say(&stage, "reading scenes of the sweep: %d of %d", v, count);
        status = load_scene(plan, v * plan->seed_count, &scene);
        if (status == OZ_OK) {
            status = oz_inputs_add_scene(&plan->inputs, &scene);
        } else if (status == OZ_ERR_INPUT) {
            add_failure(&wrongs, &plan->scene.sweep);
            status = OZ_OK;
        }
        oz_scene_free(&scene);
    }
    oz_stage_end(&stage);
    return status == OZ_OK && wrongs.used > 0 ? oz_status_fail(OZ_ERR_INPUT, "%s", wrongs.text)
                                              : status;
}

static OzStatus check_values(OzMembers *plan)
{
    const OzSweep *sweep = &plan->scene.sweep;
    if (plan->count > OZ_MEMBERS_MAX) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: %lld members; expected at most %d",
                              plan->scene.path, (long long)plan->count, OZ_MEMBERS_MAX);
    }
    if (plan->options->has_seeds && seed_key(sweep) >= 0) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: sweeps the seed; expected that or --seeds",
                              plan->scene.path);
    }
    OZ_PASS(check_names(plan));
    return try_values(plan);
}

OzStatus oz_members_create(OzMembers *plan, const OzOptions *options)
{
    *plan = (OzMembers){.options = options, .seed_count = 1};
    OZ_PASS(
        oz_scene_load(&plan->scene, options->paths[0], options->settings, options->setting_count));
    if (options->has_seeds) {
        plan->seed_count = (int64_t)(options->seed_last - options->seed_first) + 1;
    }
    plan->is_ensemble = options->has_seeds || plan->scene.sweep.count > 0;
    plan->count = plan->seed_count * (plan->scene.sweep.count ? plan->scene.sweep.count : 1);
    OZ_PASS(oz_inputs_add_scene(&plan->inputs, &plan->scene));
    if (options->from) {
        OZ_PASS(oz_from_open(&plan->from, options->from, &plan->inputs));
    }
    if (plan->from.asked && options->has_seeds && oz_from_is_single(&plan->from)) {
        oz_log_line("warning: a seed places grains and nothing else: from one state, members of "
                    "all seeds are the same run");
    }
    return check_values(plan);
}

void oz_members_free(OzMembers *plan)
{
    oz_scene_free(&plan->scene);
    oz_inputs_free(&plan->inputs);
    oz_from_free(&plan->from);
    *plan = (OzMembers){0};
}
