/* Finding the state and holding it against the scene that shall begin with it. */
#include "run/from.h"

#include "base/file.h"
#include "base/log.h"
#include "base/memory.h"
#include "model/insert.h"
#include "model/step_clock.h"
#include "model/wall_motion.h"
#include "run/state_file.h"
#include "sim/branch.h"

#include <glob.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* "DIR@tap=3" in its parts: the folder is cut off at the mark; at is -1 without. */
typedef struct Asked {
    char *folder; /* owned */
    bool taps;
    double at; /* taps, or s */
} Asked;

static OzStatus take_apart(Asked *asked, const char *text)
{
    char *end = NULL;
    OZ_PASS(oz_memory_text(&asked->folder, text));
    char *mark = strrchr(asked->folder, '@');
    asked->at = -1;
    if (!mark || oz_file_exists(text)) {
        return OZ_OK;
    }
    asked->taps = strncmp(mark, "@tap=", 5) == 0;
    const char *number = asked->taps ? mark + 5 : strncmp(mark, "@time=", 6) == 0 ? mark + 6 : "";
    asked->at = strtod(number, &end);
    if (!*number || *end || !(asked->at >= 0 && asked->at < 1e12)) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "--from %s: expected DIR, DIR@tap=300 or DIR@time=2.5 (in s)", text);
    }
    *mark = '\0';
    return OZ_OK;
}

static OzStatus read_state(OzFrom *from)
{
    OZ_PASS(oz_state_file_read(&from->state, from->path));
    OzStateVisit visit = oz_state_load(&from->state);
    return oz_checkpoint_head_state(&from->head, &visit);
}

/* Moments that are there, in words. */
static void tell_kept(const char *folder, char *text, size_t size)
{
    glob_t found = {0};
    char *pattern = NULL;
    size_t used = 0;
    *text = '\0';
    if (oz_file_join(&pattern, folder, "checkpoints/*.h5") == OZ_OK &&
        glob(pattern, 0, NULL, &found) == 0) {
        for (size_t i = 0; i < found.gl_pathc && used < size; i++) {
            const char *name = strrchr(found.gl_pathv[i], '/') + 1;
            used += (size_t)snprintf(text + used, size - used, "%s%.*s", i ? ", " : "",
                                     (int)(strlen(name) - strlen(".h5")), name);
        }
    }
    globfree(&found);
    free(pattern);
}

/* Where walls stand is told by the scene, which then says nothing of what came later. */
static OzStatus refuse_changed(const char *folder)
{
    OzStatus status = OZ_OK;
    char *path = NULL;
    OZ_TRY(oz_file_join(&path, folder, "reloads.csv"));
    if (oz_file_exists(path)) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "--from %s: that run was changed while it ran (reloads.csv); "
                                "expected one that was not",
                                folder);
    }
done:
    free(path);
    return status;
}

/* Neither is there a state of that name, nor is the newest of that moment. */
static OzStatus refuse_moment(const Asked *asked, const char *text, const char *wanted)
{
    char kept[512];
    tell_kept(asked->folder, kept, sizeof kept);
    return oz_status_fail(OZ_ERR_INPUT,
                          "--from %s: there is no state %s; expected one of those kept in "
                          "%s/checkpoints (%s), by checkpoint.taps or times of that run's scene",
                          text, wanted, asked->folder, kept[0] ? kept : "none");
}

/* One that was kept; the newest where it is of that moment. */
static OzStatus read_moment(OzFrom *from, const Asked *asked, const char *text)
{
    OzStatus status = OZ_OK;
    const OzScene *scene = &from->scene;
    char moment[64], name[128];
    OzStepClock clock = oz_step_clock_begin(scene->step);
    double time = asked->taps ? asked->at * scene->period : asked->at;
    time = oz_step_clock_time(&clock, oz_step_clock_nearest(&clock, time));
    if (asked->taps && scene->period <= 0) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "--from %s: that run has no taps; expected @time=", text);
    }
    oz_checkpoint_name(moment, sizeof moment, time, scene->period);
    snprintf(name, sizeof name, "checkpoints/%s.h5", moment);
    OZ_TRY(oz_file_join(&from->path, asked->folder, name));
    if (oz_file_exists(from->path)) {
        return read_state(from);
    }
    free(from->path);
    from->path = NULL;
    OZ_TRY(oz_file_join(&from->path, asked->folder, "state.h5"));
    if (!oz_file_exists(from->path)) {
        return refuse_moment(asked, text, moment);
    }
    OZ_TRY(read_state(from));
    if (fabs(from->head.time - time) > 0.5 * scene->step) {
        status = refuse_moment(asked, text, moment);
    }
done:
    return status;
}

static OzStatus read_newest(OzFrom *from, const Asked *asked)
{
    OZ_PASS(oz_file_join(&from->path, asked->folder, "state.h5"));
    if (!oz_file_exists(from->path)) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "--from %s: there is no state.h5; expected the folder of a plain run "
                              "that has ended or was stopped",
                              asked->folder);
    }
    return read_state(from);
}

OzStatus oz_from_open(OzFrom *from, const char *text, OzInputs *inputs)
{
    OzStatus status = OZ_OK;
    Asked asked = {0};
    char *path = NULL;
    OZ_TRY(take_apart(&asked, text));
    OZ_TRY(refuse_changed(asked.folder));
    OZ_TRY(oz_file_join(&path, asked.folder, "scene.yaml"));
    OZ_TRY(oz_scene_load(&from->scene, path, NULL, 0));
    OZ_TRY(asked.at >= 0 ? read_moment(from, &asked, text) : read_newest(from, &asked));
    OZ_TRY(oz_insert_grains(&from->grains, &from->scene));
    OZ_TRY(oz_inputs_add(inputs, from->path));
    OZ_TRY(oz_inputs_add(inputs, path));
done:
    free(path);
    free(asked.folder);
    return status;
}

void oz_from_free(OzFrom *from)
{
    oz_state_free(&from->state);
    oz_checkpoint_head_free(&from->head);
    oz_grains_free(&from->grains);
    oz_scene_free(&from->scene);
    free(from->path);
    *from = (OzFrom){0};
}

/* The first of count that differs; count when none does. */
static int64_t first_other(const double *a, const double *b, int64_t count)
{
    int64_t i = 0;
    while (i < count && a[i] == b[i]) {
        i++;
    }
    return i;
}

/* Bodies by their elements: of walls those too. */
static OzStatus check_elements(const OzFrom *from, const OzScene *scene, const OzElements *own)
{
    const OzElements *then = from->grains.elements;
    int64_t differs = own->count;
    if (own->count == then->count && own->free_count == then->free_count &&
        own->beam_count == then->beam_count && own->wall_count == then->wall_count) {
        int64_t corner = first_other(own->corner, then->corner, 6 * own->count) / 6;
        int64_t radius = first_other(own->radius, then->radius, own->count);
        int64_t mass = first_other(own->mass, then->mass, own->count);
        int64_t place = own->free_count + first_other(own->position + 2 * own->free_count,
                                                      then->position + 2 * own->free_count,
                                                      2 * (own->count - own->free_count)) /
                                              2;
        differs = corner < radius ? corner : radius;
        differs = mass < differs ? mass : differs;
        differs = place < differs ? place : differs;
        if (differs == own->count) {
            return OZ_OK;
        }
    }
    if (differs == own->count) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: has %lld elements, %lld of grains, and %s has %lld, %lld of "
                              "grains; expected the same grains and walls",
                              scene->path, (long long)own->count, (long long)own->free_count,
                              from->path, (long long)then->count, (long long)then->free_count);
    }
    int64_t body = own->body[differs];
    bool wall = body >= own->grain_count;
    return oz_status_fail(OZ_ERR_INPUT,
                          "%s: %s %lld is not that of %s; expected the same grains and walls "
                          "(only their motion may change)",
                          scene->path, wall ? "wall" : "grain",
                          (long long)(wall ? body - own->grain_count : body), from->path);
}

static OzStatus check_grains(const OzFrom *from, const OzScene *scene, const OzGrains *own)
{
    const OzGrains *then = &from->grains;
    if (own->count != then->count) {
        return oz_status_fail(
            OZ_ERR_INPUT, "%s: has %lld grains, and %s has %lld; expected the same grains",
            scene->path, (long long)own->count, from->path, (long long)then->count);
    }
    int64_t diameter = first_other(own->diameter, then->diameter, own->count);
    int64_t length = first_other(own->length, then->length, own->count);
    int64_t mass = first_other(own->mass, then->mass, own->count);
    int64_t differs = diameter < length ? diameter : length;
    differs = mass < differs ? mass : differs;
    if (differs < own->count) {
        return oz_status_fail(
            OZ_ERR_INPUT,
            "%s: grain %lld is %g m thick, %g m long, %g kg, and in %s %g m, %g m, %g kg; expected "
            "the same grains",
            scene->path, (long long)differs, own->diameter[differs], own->length[differs],
            own->mass[differs], from->path, then->diameter[differs], then->length[differs],
            then->mass[differs]);
    }
    return OZ_OK;
}

/* A wall's place is that of its motion at time 0: grains that touch it would be hit by a jump. Half
 * a step's way is left at whole periods; a hundredth of the smallest radius is allowed, a hundredth
 * of the overlap that a run warns of. */
static OzStatus check_walls(const OzFrom *from, const OzScene *scene)
{
    double smallest = INFINITY;
    for (int64_t i = 0; i < from->grains.count; i++) {
        smallest = fmin(smallest, from->grains.diameter[i]);
    }
    if (scene->wall_count != from->scene.wall_count) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: has %d walls, and %s has %d; expected the same walls",
                              scene->path, scene->wall_count, from->path, from->scene.wall_count);
    }
    for (int w = 0; w < scene->wall_count; w++) {
        const OzWall *then = &from->scene.walls[w];
        OzWallPose pose = oz_wall_motion_pose(then, from->head.time, false);
        bool smooth = then->kind == OZ_WALL_DRUM && then->tooth_count == 0;
        double turn = fmod(fabs(pose.turn), 2 * 3.14159265358979323846);
        double jump = fabs(pose.rise) + (smooth ? 0 : turn * fmax(then->diameter, then->width));
        bool gone = !oz_wall_motion_present(then, from->head.time, false);
        if (!(jump <= 0.005 * smallest) || gone) {
            return oz_status_fail(
                OZ_ERR_INPUT,
                "%s: walls.%d %s in %s, and begins where it was built; expected a state at whole "
                "periods (--from DIR@tap=N) or of walls at rest",
                scene->path, w, gone ? "is gone" : "stands elsewhere", from->path);
        }
    }
    return OZ_OK;
}

OzStatus oz_from_check(const OzFrom *from, const OzScene *scene, const OzGrains *grains)
{
    if (scene->model != from->scene.model) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: is of another model than %s", scene->path,
                              from->path);
    }
    if (scene->seed != from->scene.seed) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: seed is %llu, and the grains of %s are those of %llu; expected "
                              "--set seed=%llu",
                              scene->path, (unsigned long long)scene->seed, from->path,
                              (unsigned long long)from->scene.seed,
                              (unsigned long long)from->scene.seed);
    }
    if (scene->step != from->scene.step) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: time.step is %.9g s, and in %s %.9g s; expected the same",
                              scene->path, scene->step, from->path, from->scene.step);
    }
    if (scene->precision != from->scene.precision) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: precision is not that of %s; expected the same",
                              scene->path, from->path);
    }
    OZ_PASS(check_grains(from, scene, grains));
    OZ_PASS(check_walls(from, scene));
    return grains->elements ? check_elements(from, scene, grains->elements) : OZ_OK;
}

OzStatus oz_from_begin(const OzFrom *from, OzWorker *workers, int count)
{
    if (!from->path) {
        return OZ_OK;
    }
    for (int k = 0; k < count; k++) {
        OZ_PASS(oz_branch_take(workers[k].sim, &from->state, "worker/"));
    }
    oz_log_line("grains are those of %s, step %lld (%.9g s)", from->path,
                (long long)from->head.step, from->head.time);
    return OZ_OK;
}
