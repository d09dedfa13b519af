/* Holding grains, walls and step of two scenes against each other. */
#include "run/from_check.h"

#include "model/wall_motion.h"
#include "scene/wall_mesh.h"
#include "scene/wall_swing.h"

#include <math.h>
#include <stdio.h>

/* The first of count that differs; count when none does. */
static int64_t first_other(const double *a, const double *b, int64_t count)
{
    int64_t i = 0;
    while (i < count && a[i] == b[i]) {
        i++;
    }
    return i;
}

/* Sizes are drawn by the seed: why they differ, where it does. */
static const char *tell_seeds(const OzFromMember *from, const OzScene *scene, char text[96])
{
    bool same = scene->seed == from->scene.seed;
    snprintf(text, 96, same ? "" : " (here of seed %llu, there of seed %llu)",
             (unsigned long long)scene->seed, (unsigned long long)from->scene.seed);
    return text;
}

/* Bodies by their elements: of walls those too. */
static OzStatus check_elements(const OzFromMember *from, const OzScene *scene,
                               const OzElements *own)
{
    const OzElements *then = from->grains.elements;
    char seeds[96];
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
                              "grains; expected the same grains and walls%s",
                              scene->path, (long long)own->count, (long long)own->free_count,
                              from->file->path, (long long)then->count, (long long)then->free_count,
                              tell_seeds(from, scene, seeds));
    }
    int64_t body = own->body[differs];
    bool wall = body >= own->grain_count;
    return oz_status_fail(OZ_ERR_INPUT,
                          "%s: %s %lld is not that of %s; expected the same grains and walls "
                          "(only their motion may change)%s",
                          scene->path, wall ? "wall" : "grain",
                          (long long)(wall ? body - own->grain_count : body), from->file->path,
                          tell_seeds(from, scene, seeds));
}

static OzStatus check_grains(const OzFromMember *from, const OzScene *scene, const OzGrains *own)
{
    const OzGrains *then = &from->grains;
    char seeds[96];
    if (own->count != then->count) {
        return oz_status_fail(
            OZ_ERR_INPUT, "%s: has %lld grains, and %s has %lld; expected the same grains",
            scene->path, (long long)own->count, from->file->path, (long long)then->count);
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
            "the same grains%s",
            scene->path, (long long)differs, own->diameter[differs], own->length[differs],
            own->mass[differs], from->file->path, then->diameter[differs], then->length[differs],
            then->mass[differs], tell_seeds(from, scene, seeds));
    }
    return OZ_OK;
}

/* Springs at a mesh are those of its triangles. */
static OzStatus check_mesh(const OzFromMember *from, const OzScene *scene, int w)
{
    char name[96];
    const OzWall *wall = &scene->walls[w];
    snprintf(name, sizeof name, "worker/sim/meshes_%d/mesh_%d/hash", from->index, w);
    const OzStateEntry *saved = oz_state_find(&from->file->state, name);
    if (wall->mesh && (!saved || saved->kind != OZ_STATE_INT64 ||
                       *(const int64_t *)saved->data != (int64_t)wall->mesh->hash)) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: walls.%d, %s, has other triangles than in %s; expected the same "
                              "file, scale and sides",
                              scene->path, w, wall->path, from->file->path);
    }
    return OZ_OK;
}

/* A wall's place is that of its motion at time 0: grains that touch it would be hit by a jump. Half
 * a step's way is left at whole periods; a hundredth of the smallest radius is allowed, a hundredth
 * of the overlap that a run warns of. */
static OzStatus check_walls(const OzFromMember *from, const OzScene *scene)
{
    double smallest = INFINITY;
    double time = from->file->head.settles ? 0 : from->file->head.time;
    for (int64_t i = 0; i < from->grains.count; i++) {
        smallest = fmin(smallest, from->grains.diameter[i]);
    }
    if (scene->wall_count != from->scene.wall_count) {
        return oz_status_fail(
            OZ_ERR_INPUT, "%s: has %d walls, and %s has %d; expected the same walls", scene->path,
            scene->wall_count, from->file->path, from->scene.wall_count);
    }
    for (int w = 0; w < scene->wall_count; w++) {
        const OzWall *then = &from->scene.walls[w];
        OZ_PASS(check_mesh(from, scene, w));
        if (then->servo.present && !scene->walls[w].servo.present) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "%s: walls.%d is a piston in %s and none here; expected a servo, "
                                  "which goes on from where it stands",
                                  scene->path, w, from->file->path);
        }
        OzWallPose pose = oz_wall_motion_pose(then, time, false);
        bool smooth = then->kind == OZ_WALL_DRUM && then->tooth_count == 0;
        double turn = fmod(fabs(pose.turn), 2 * 3.14159265358979323846);
        bool is_endless = then->kind == OZ_WALL_PLANE && oz_wall_swing_has(then);
        double reach = fmax(oz_wall_swing_reach(then), fmax(then->diameter, then->width));
        reach = is_endless ? 1 : reach; /* a metre: more than any bed */
        double jump = fabs(pose.rise) + (smooth ? 0 : turn * reach);
        bool begins = oz_wall_motion_present(&scene->walls[w], 0, true);
        bool gone = begins && !oz_wall_motion_present(then, time, false);
        if (gone) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "%s: walls.%d is gone in %s, and is there at the start; expected "
                                  "a state of a time when it is there (--from DIR@time=T)",
                                  scene->path, w, from->file->path);
        }
        if (!(jump <= 0.005 * smallest)) {
            return oz_status_fail(
                OZ_ERR_INPUT,
                "%s: walls.%d stands elsewhere in %s, and begins where it was built; expected a "
                "state at whole periods (--from DIR@tap=N) or of walls at rest",
                scene->path, w, from->file->path);
        }
    }
    return OZ_OK;
}

OzStatus oz_from_check_scene(const OzFromMember *from, const OzScene *scene, const OzGrains *grains)
{
    if (scene->model != from->scene.model) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: is of another model than %s", scene->path,
                              from->file->path);
    }
    if (scene->step != from->scene.step) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: time.step is %.9g s, and in %s %.9g s; expected the same",
                              scene->path, scene->step, from->file->path, from->scene.step);
    }
    if (scene->precision != from->scene.precision) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: precision is not that of %s; expected the same",
                              scene->path, from->file->path);
    }
    OZ_PASS(check_grains(from, scene, grains));
    OZ_PASS(check_walls(from, scene));
    return grains->elements ? check_elements(from, scene, grains->elements) : OZ_OK;
}
