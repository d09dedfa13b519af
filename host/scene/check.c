/* The checks that need more than one value, and the values that follow from others. */
#include "scene/check.h"

#include "base/memory.h"
#include "base/order.h"
#include "scene/check_flat.h"
#include "scene/check_materials.h"
#include "scene/check_motion.h"
#include "scene/check_solid.h"
#include "scene/check_tables.h"
#include "scene/keys.h"
#include "scene/phases.h"
#include "scene/value.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Checker {
    OzScene *scene;
    OzNode *root;
    OzFaults *faults;
} Checker;

#define fault(checker, ...) oz_tree_fault((checker)->root, (checker)->faults, __VA_ARGS__)

static bool is_written(const Checker *checker, const char *path)
{
    return oz_tree_at(checker->root, path) != NULL;
}

static double length_of(const double vector[3])
{
    return sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
}

/* Leaves a vector that is of unit length to rounding, so that a written scene loads to the same
 * bits. */
static void make_unit(Checker *checker, double vector[3], const char *list, int i, const char *name)
{
    double length = length_of(vector);
    if (length == 0) {
        char path[64];
        snprintf(path, sizeof path, "%s.%d.%s", list, i, name);
        fault(checker, path, "%s has length zero; expected a direction", path);
    } else if (fabs(length - 1) > 1e-15) {
        for (int axis = 0; axis < 3; axis++) {
            vector[axis] /= length;
        }
    }
}

/* A wall turns about its own axis; those that have none are told one. */
static void derive_axes(Checker *checker, OzWall *wall, int i)
{
    bool is_axial = wall->kind == OZ_WALL_CYLINDER || wall->kind == OZ_WALL_CONE;
    const double *own = is_axial ? wall->axis : wall->normal;
    if (length_of(wall->motion.velocity) > 0) { /* which says the direction */
        memcpy(wall->motion.direction, wall->motion.velocity, sizeof wall->motion.direction);
    }
    make_unit(checker, wall->motion.direction, "walls", i, "motion.direction");
    bool is_told = wall->kind == OZ_WALL_SPHERE || wall->kind == OZ_WALL_MESH ||
                   wall->kind == OZ_WALL_RECTANGLE || wall->kind == OZ_WALL_BOX ||
                   wall->motion.has_axis;
    if (is_told) {
        make_unit(checker, wall->motion.axis, "walls", i, "motion.axis");
    } else {
        memcpy(wall->motion.axis, own, sizeof wall->motion.axis);
    }
}

/* Across the rectangle's normal. */
static void derive_edge(Checker *checker, OzWall *wall, int i)
{
    make_unit(checker, wall->edge, "walls", i, "edge");
    double along = 0;
    for (int c = 0; c < 3; c++) {
        along += wall->edge[c] * wall->normal[c];
    }
    if (fabs(along) > 1 - 1e-9) {
        char path[64];
        snprintf(path, sizeof path, "walls.%d.edge", i);
        fault(checker, path, "%s is along the normal; expected one across it", path);
    } else if (fabs(along) > 1e-15) {
        for (int c = 0; c < 3; c++) {
            wall->edge[c] -= along * wall->normal[c];
        }
        make_unit(checker, wall->edge, "walls", i, "edge");
    }
}

/* Directions that the wall is built along, as unit vectors. */
static void derive_directions(Checker *checker, OzWall *wall, int i)
{
    bool is_sheet = wall->kind == OZ_WALL_RECTANGLE || wall->kind == OZ_WALL_DISC;
    if (is_sheet || (wall->kind == OZ_WALL_PLANE && checker->scene->model == OZ_MODEL_RODS)) {
        make_unit(checker, wall->normal, "walls", i, "normal");
    }
    if (wall->kind == OZ_WALL_CYLINDER || wall->kind == OZ_WALL_CONE) {
        make_unit(checker, wall->axis, "walls", i, "axis");
    }
    if (wall->kind == OZ_WALL_RECTANGLE) {
        derive_edge(checker, wall, i);
    }
}

static void derive_walls(Checker *checker)
{
    OzScene *scene = checker->scene;
    for (int i = 0; i < scene->wall_count; i++) {
        OzWall *wall = &scene->walls[i];
        derive_directions(checker, wall, i);
        if (wall->motion.present && scene->model == OZ_MODEL_RODS) {
            derive_axes(checker, wall, i);
        }
        double gravity = length_of(scene->gravity);
        oz_check_motion_derive(&wall->motion, gravity, i, checker->root, checker->faults);
        if (wall->motion.present && wall->motion.frequency > 0 && scene->period == 0) {
            scene->period = 1 / wall->motion.frequency;
        }
    }
}

static bool check_taps(Checker *checker, const char *path)
{
    if (checker->scene->period > 0 || !is_written(checker, path)) {
        return true;
    }
    const OzKey *key = oz_keys_find(path);
    const char *group = key->rival ? path : "", *dot = strchr(group, '.');
    const char *other = key->rival ? key->rival : key->fallback ? key->fallback : "without it";
    fault(checker, path, "%s without a moving wall; expected a wall with motion, or %.*s%s%s", path,
          dot ? (int)(dot - group) + 1 : 0, group, other, key->rival ? ", in s" : "");
    return false;
}

/* s between rows where nothing says it, a step at least. Without a duration there is no second row.
 */
static double own_interval(const OzScene *scene)
{
    double shown = scene->movie.speed > 0 ? scene->movie.speed : 1;
    double interval = isinf(scene->duration) ? 0.1 * shown : scene->duration / 100;
    return scene->duration > 0 ? fmax(interval, scene->step) : 1;
}

static void derive_times(Checker *checker)
{
    OzScene *scene = checker->scene;
    check_taps(checker, "time.taps");
    check_taps(checker, "observe.interval_taps");
    check_taps(checker, "contacts.interval_taps");
    check_taps(checker, "fields.interval_taps");
    if (scene->taps > 0) {
        scene->duration = scene->taps * scene->period;
    }
    bool is_free = scene->observe.interval == 0 && scene->observe.interval_taps == 0;
    scene->observe.interval_taps = is_free && scene->period > 0 ? 1 : scene->observe.interval_taps;
    if (scene->observe.interval_taps > 0) {
        scene->observe.interval = scene->observe.interval_taps * scene->period;
    }
    if (scene->movie.speed == 0 && scene->movie.length == 0) {
        scene->movie.speed = 1;
    }
    if (scene->observe.interval == 0) {
        scene->observe.interval = own_interval(scene);
    }
}

static int sort_unique(double *numbers, int count)
{
    int kept = 0;
    oz_order_sort(numbers, count);
    for (int i = 0; i < count; i++) {
        if (i == 0 || numbers[i] > numbers[kept - 1]) {
            numbers[kept++] = numbers[i];
        }
    }
    return kept;
}

/* Moments in order, each once; those written in taps become the times. */
static OzStatus derive_moments(Checker *checker, const char *key, double *taps, int *tap_count,
                               double **times, int *count)
{
    *tap_count = sort_unique(taps, *tap_count);
    *count = sort_unique(*times, *count);
    if (!check_taps(checker, key) || *tap_count == 0) {
        return OZ_OK;
    }
    free(*times);
    *times = NULL;
    *count = 0;
    OZ_PASS(OZ_NEW(times, *tap_count));
    *count = *tap_count;
    for (int i = 0; i < *count; i++) {
        (*times)[i] = taps[i] * checker->scene->period;
    }
    return OZ_OK;
}

static OzStatus derive_snapshots(Checker *checker)
{
    OzSnapshotSettings *shots = &checker->scene->snapshots;
    OzCheckpoints *kept = &checker->scene->checkpoint;
    OZ_PASS(derive_moments(checker, "snapshots.taps", shots->taps, &shots->tap_count, &shots->times,
                           &shots->count));
    check_taps(checker, "checkpoint.interval_taps");
    return derive_moments(checker, "checkpoint.taps", kept->taps, &kept->tap_count, &kept->times,
                          &kept->count);
}

static void derive_populations(Checker *checker)
{
    OzScene *scene = checker->scene;
    for (int i = 0; i < scene->population_count; i++) {
        OzPopulation *grains = &scene->populations[i];
        bool told = grains->kind == OZ_GRAINS_SINGLE || grains->kind == OZ_GRAINS_LATTICE;
        if (told && scene->model == OZ_MODEL_RODS) {
            make_unit(checker, grains->axis, "grains", i, "axis");
        }
        if (grains->kind == OZ_GRAINS_SINGLE) {
            grains->count = 1;
        } else if (grains->kind == OZ_GRAINS_FILE) {
            grains->count = -1;
        } else if (grains->kind == OZ_GRAINS_LATTICE) {
            double product = 1;
            for (int axis = 0; axis < (scene->model == OZ_MODEL_RODS ? 3 : 2); axis++) {
                product *= (double)grains->cells[axis];
            }
            /* Far beyond the limit the exact number no longer matters, only that it fits. */
            grains->count = product < 1e18 ? (int64_t)product : (int64_t)1e18;
        }
    }
}

static void check_grain_count(Checker *checker)
{
    const OzScene *scene = checker->scene;
    double count = 0;
    for (int i = 0; i < scene->population_count; i++) {
        const OzPopulation *grains = &scene->populations[i];
        double before = count;
        count += grains->kind == OZ_GRAINS_FILE ? 0 : (double)grains->count;
        if (before <= OZ_CHECK_GRAINS_MAX && count > OZ_CHECK_GRAINS_MAX) {
            char path[64];
            snprintf(path, sizeof path, "grains.%d.%s", i,
                     grains->kind == OZ_GRAINS_LATTICE ? "cells" : "count");
            fault(checker, path,
                  "%g grains need about %.3g GB of memory; expected at most %d in all", count,
                  count * 1500 / 1e9, OZ_CHECK_GRAINS_MAX);
        }
    }
}

static void check_interval(Checker *checker, const char *key, double interval, const char *file)
{
    double rows = checker->scene->duration / interval, step = checker->scene->step;
    if (interval > 0 && isfinite(rows) && rows > OZ_CHECK_ROWS_MAX) {
        fault(checker, key, "%.3g rows of %s; expected at most %g", rows, file, OZ_CHECK_ROWS_MAX);
    }
    if (is_written(checker, key) && interval < step) {
        fault(checker, key, "%s is shorter than a time step; expected at least %g s", key, step);
    }
}

static void check_run_length(Checker *checker)
{
    const OzScene *scene = checker->scene;
    double steps = scene->step > 0 ? scene->duration / scene->step : 0;
    if (isfinite(steps) && steps > OZ_CHECK_STEPS_MAX) {
        fault(checker, is_written(checker, "time.taps") ? "time.taps" : "time.duration",
              "%.3g steps; expected at most %g", steps, OZ_CHECK_STEPS_MAX);
    }
    check_interval(checker, "observe.interval", scene->observe.interval, "series.csv");
    double taps = scene->contacts.interval_taps * scene->period;
    check_interval(checker, "contacts.interval", fmax(scene->contacts.interval, taps),
                   "contacts.csv");
    taps = scene->fields.interval_taps * scene->period;
    check_interval(checker, "fields.interval", fmax(scene->fields.interval, taps), "fields.csv");
}

static void check_export(Checker *checker)
{
    const OzScene *scene = checker->scene;
    const char *own = "export_interval";
    check_interval(checker, own, scene->export_interval, "the export");
    if (is_written(checker, own) && scene->export_count == 0) {
        fault(checker, own, "%s without export; expected formats, as in export: [vtk]", own);
    }
    for (int i = 1; i < scene->export_count; i++) {
        for (int k = 0; k < i; k++) {
            if (scene->exports[i] == scene->exports[k]) {
                fault(checker, "export", "export names a format twice; expected each once");
            }
        }
    }
}

/* Rows at one phase lie whole periods apart. */
static void check_phase(Checker *checker)
{
    const OzScene *scene = checker->scene;
    double periods = scene->period > 0 ? scene->observe.interval / scene->period : 1;
    if (scene->observe.at == OZ_OBSERVE_MEAN || !check_taps(checker, "observe.at")) {
        return;
    }
    if (round(periods) < 1 || fabs(periods - round(periods)) > 1e-6 * periods) {
        fault(checker, "observe.at",
              "observe.at with rows %.6g periods apart, which are not all at one phase; expected a "
              "whole observe.interval_taps",
              periods);
    }
}

static void check_movie(Checker *checker)
{
    const OzMovieSettings *movie = &checker->scene->movie;
    if (!movie->present) {
        return;
    }
    if (movie->width % 2 || movie->height % 2) {
        fault(checker, "movie.size",
              "movie.size is %d x %d; expected even numbers, video halves its colours",
              movie->width, movie->height);
    }
    bool is_endless = isinf(checker->scene->duration);
    if (is_endless && movie->length > 0) {
        fault(checker, "movie.length",
              "movie.length of an endless run, over which its pictures cannot be spread; expected "
              "movie.speed");
    }
    double length = movie->length > 0 ? movie->length : checker->scene->duration / movie->speed;
    if (!is_endless && length * movie->fps > OZ_CHECK_FRAMES_MAX) {
        fault(checker, movie->length > 0 ? "movie.length" : "movie.speed",
              "%.3g pictures of movie; expected at most %g", length * movie->fps,
              OZ_CHECK_FRAMES_MAX);
    }
}

/* False when what was written is no law: what goes with it cannot be said. */
static bool knows_law(const Checker *checker)
{
    const OzNode *law = oz_tree_at(checker->root, "contact.law");
    const char *name = oz_keys_choice_name("contact.law", (int)checker->scene->contact.law);
    return !law || (law->text && strcmp(law->text, name) == 0);
}

/* In the items of a list, or at the top. */
static void refuse_law(Checker *checker, const char *list, int count, const char *name)
{
    for (int i = 0; i < count; i++) {
        char path[96], item[24] = "";
        if (list[0]) {
            snprintf(item, sizeof item, "%s.%d.", list, i);
        }
        snprintf(path, sizeof path, "%s%s", item, name);
        if (is_written(checker, path)) {
            fault(checker, path, "%s makes no sense with contact.law %s; expected another law",
                  path, oz_keys_choice_name("contact.law", (int)checker->scene->contact.law));
        }
    }
}

/* Keys of other laws than the scene's; a wall's row belongs to the laws of the row it inherits. */
static void check_laws(Checker *checker)
{
    const OzScene *scene = checker->scene;
    if (!knows_law(checker)) {
        return;
    }
    for (const OzKey *key = oz_keys_all(); key->path; key++) {
        if (!key->laws || key->laws >> scene->contact.law & 1 ||
            !oz_keys_serves(key, (int)scene->model)) {
            continue;
        }
        const char *name = strchr(key->path, '.') + 1;
        refuse_law(checker, "", 1, key->path);
        refuse_law(checker, "walls", scene->wall_count, key->path);
        refuse_law(checker, "materials", scene->material_count, name);
        refuse_law(checker, "pairs", scene->pair_count, name);
    }
}

/* Choices are made once for all contacts, as one set of kernels serves them all. */
static void check_wall_choices(Checker *checker)
{
    const char *prefix = "walls[].";
    for (const OzKey *key = oz_keys_all(); key->path; key++) {
        const char *name = key->path + strlen(prefix);
        bool choice = strncmp(key->path, prefix, strlen(prefix)) == 0 && key->inherits &&
                      key->type == OZ_KEY_CHOICE && oz_keys_serves(key, (int)checker->scene->model);
        for (int i = 0; choice && i < checker->scene->wall_count; i++) {
            int own = *(const int *)oz_value_at(key, &checker->scene->walls[i]);
            int common = *(const int *)oz_value_at(oz_keys_find(key->inherits), checker->scene);
            if (own != common) {
                char path[96];
                snprintf(path, sizeof path, "walls.%d.%s", i, name);
                fault(checker, path, "%s is %s and %s %s; expected the same for all contacts", path,
                      key->choices[own], key->inherits, key->choices[common]);
            }
        }
    }
}

/* With `restitution_calibration: discrete` a hit lasts a whole number of steps. */
static void fit_step(Checker *checker)
{
    OzScene *scene = checker->scene;
    scene->written_step = scene->step;
    if (scene->contact.restitution_calibration != OZ_CALIBRATION_DISCRETE) {
        return;
    }
    if (scene->contact.law != OZ_LAW_HOOKE) {
        fault(checker, "contact.restitution_calibration",
              "contact.restitution_calibration is discrete; expected none with contact.law %s",
              oz_keys_choice_name("contact.law", (int)scene->contact.law));
    } else if (scene->step > 0 && scene->contact.contact_time > 0) {
        double count = round(scene->contact.contact_time / scene->step);
        scene->step = scene->contact.contact_time / fmax(count, 2);
    }
}

OzStatus oz_check_scene(OzScene *scene, OzNode *root, OzFaults *faults)
{
    Checker checker = {scene, root, faults};
    oz_check_materials_resolve(scene, root, faults);
    check_laws(&checker);
    check_wall_choices(&checker);
    fit_step(&checker);
    derive_walls(&checker);
    derive_times(&checker);
    derive_populations(&checker);
    OzStatus status = derive_snapshots(&checker);
    check_grain_count(&checker);
    check_run_length(&checker);
    oz_phases_check(scene, root, faults);
    check_export(&checker);
    check_phase(&checker);
    check_movie(&checker);
    if (scene->model == OZ_MODEL_TRIGRAINS) {
        oz_check_flat_scene(scene, root, faults);
    } else {
        oz_check_solid_scene(scene, root, faults);
        oz_check_tables_fields(scene, root, faults);
    }
    return status;
}
