/* Snapshot arrays. Knows nothing of where the state comes from. */
#include "model/snapshot.h"

#include "base/memory.h"
#include "model/motion.h"
#include "model/wall_motion.h"
#include "scene/boundary.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static OzStatus create_elements(OzSnapshot *snapshot, int64_t count)
{
    snapshot->element_count = count;
    OZ_PASS(OZ_NEW(&snapshot->element_position, 2 * count));
    OZ_PASS(OZ_NEW(&snapshot->element_angle, count));
    OZ_PASS(OZ_NEW(&snapshot->element_velocity, 2 * count));
    return OZ_NEW(&snapshot->element_angular_velocity, count);
}

OzStatus oz_snapshot_create(OzSnapshot *snapshot, const OzScene *scene, const OzGrains *grains)
{
    OzStatus status = OZ_OK;
    bool breaks = grains->elements && oz_beam_types_wear(&scene->beams);
    int64_t count = breaks ? grains->elements->free_count : grains->count; /* there may be */
    memset(snapshot, 0, sizeof *snapshot);
    snapshot->scene = scene;
    snapshot->grains = snapshot->whole = grains;
    snapshot->count = grains->count;
    OZ_TRY(OZ_NEW(&snapshot->position, 3 * count));
    OZ_TRY(OZ_NEW(&snapshot->quaternion, 4 * count));
    OZ_TRY(OZ_NEW(&snapshot->axis, 3 * count));
    OZ_TRY(OZ_NEW(&snapshot->velocity, 3 * count));
    OZ_TRY(OZ_NEW(&snapshot->angular_velocity, 3 * count));
    OZ_TRY(OZ_NEW(&snapshot->wall_offset, scene->wall_count));
    OZ_TRY(OZ_NEW(&snapshot->wall_velocity, scene->wall_count));
    OZ_TRY(OZ_NEW(&snapshot->wall_push, scene->wall_count));
    OZ_TRY(OZ_NEW(&snapshot->wall_impulse, scene->wall_count));
    if (grains->elements) {
        OZ_TRY(create_elements(snapshot, grains->elements->count));
    }
    if (breaks) {
        OZ_TRY(oz_wear_create(&snapshot->wear, grains->elements));
    }
done:
    if (status != OZ_OK) {
        oz_snapshot_free(snapshot);
    }
    return status;
}

void oz_snapshot_free(OzSnapshot *snapshot)
{
    free(snapshot->position);
    free(snapshot->quaternion);
    free(snapshot->axis);
    free(snapshot->velocity);
    free(snapshot->angular_velocity);
    free(snapshot->wall_offset);
    free(snapshot->wall_velocity);
    free(snapshot->wall_push);
    free(snapshot->wall_impulse);
    free(snapshot->element_position);
    free(snapshot->element_angle);
    free(snapshot->element_velocity);
    free(snapshot->element_angular_velocity);
    oz_contact_list_free(&snapshot->contacts);
    oz_pieces_free(snapshot->pieces);
    oz_wear_free(&snapshot->wear);
    memset(snapshot, 0, sizeof *snapshot);
}

static void copy_words(double *to, const double *from, int64_t count)
{
    if (count > 0) {
        memcpy(to, from, (size_t)count * sizeof *to);
    }
}

static void copy_elements(OzSnapshot *copy, const OzSnapshot *snapshot)
{
    int64_t count = snapshot->element_count;
    copy_words(copy->element_position, snapshot->element_position, 2 * count);
    copy_words(copy->element_angle, snapshot->element_angle, count);
    copy_words(copy->element_velocity, snapshot->element_velocity, 2 * count);
    copy_words(copy->element_angular_velocity, snapshot->element_angular_velocity, count);
    copy->element_ledger = snapshot->element_ledger;
}

static OzStatus copy_contacts(OzSnapshot *copy, const OzSnapshot *snapshot)
{
    copy->has_contacts = snapshot->has_contacts;
    for (int64_t i = 0; copy->has_contacts && i < snapshot->contacts.count; i++) {
        OZ_PASS(oz_contact_list_add(&copy->contacts, &snapshot->contacts.entry[i]));
    }
    return OZ_OK;
}

const OzGrains *oz_snapshot_whole(const OzSnapshot *snapshot)
{
    return snapshot->whole ? snapshot->whole : snapshot->grains;
}

OzStatus oz_snapshot_split(OzSnapshot *s)
{
    oz_pieces_free(s->pieces);
    s->pieces = NULL;
    if (s->wear.whole && oz_wear_broken(&s->wear) > 0) {
        OZ_PASS(oz_pieces_make(&s->pieces, s->whole, s->wear.whole, s->element_position));
    }
    s->grains = s->pieces ? s->pieces : oz_snapshot_whole(s);
    s->count = s->grains->count;
    return OZ_OK;
}

OzStatus oz_snapshot_copy(OzSnapshot *copy, const OzSnapshot *snapshot)
{
    int64_t count = snapshot->count, walls = snapshot->scene->wall_count;
    OZ_PASS(oz_snapshot_create(copy, snapshot->scene, oz_snapshot_whole(snapshot)));
    copy_words(copy->position, snapshot->position, 3 * count);
    copy_words(copy->quaternion, snapshot->quaternion, 4 * count);
    copy_words(copy->axis, snapshot->axis, 3 * count);
    copy_words(copy->velocity, snapshot->velocity, 3 * count);
    copy_words(copy->angular_velocity, snapshot->angular_velocity, 3 * count);
    copy_words(copy->wall_offset, snapshot->wall_offset, walls);
    copy_words(copy->wall_velocity, snapshot->wall_velocity, walls);
    copy_words(copy->wall_push, snapshot->wall_push, walls);
    copy->step = snapshot->step;
    copy->time = snapshot->time;
    copy->settling = snapshot->settling;
    copy->deep_count = snapshot->deep_count;
    copy->has_ledger = snapshot->has_ledger;
    copy->ledger = snapshot->ledger;
    copy_elements(copy, snapshot);
    if (copy->wear.whole) {
        oz_wear_copy(&copy->wear, &snapshot->wear);
        OZ_PASS(oz_snapshot_split(copy));
    }
    return oz_scene_shows_contacts(snapshot->scene) ? copy_contacts(copy, snapshot) : OZ_OK;
}

void oz_snapshot_place(const OzSnapshot *snapshot, int64_t grain, double place[3])
{
    OzBoundary cell = oz_snapshot_cell(snapshot);
    memcpy(place, &snapshot->position[3 * grain], 3 * sizeof *place);
    oz_boundary_wrap(&cell, place);
}

OzBoundary oz_snapshot_cell(const OzSnapshot *snapshot)
{
    return oz_boundary_at(&snapshot->scene->boundary, snapshot->time, snapshot->settling);
}

void oz_snapshot_tilt(OzSnapshot *snapshot)
{
    double tilt = oz_snapshot_cell(snapshot).tilt;
    for (int64_t i = 0; i < 3 * snapshot->count && tilt != 0; i += 3) {
        snapshot->position[i] += tilt * snapshot->position[i + 1];
    }
}

void oz_snapshot_move_walls(OzSnapshot *snapshot)
{
    const OzScene *scene = snapshot->scene;
    for (int w = 0; w < scene->wall_count; w++) {
        snapshot->wall_offset[w] = snapshot->wall_velocity[w] = 0;
        if (!snapshot->settling) {
            oz_motion_offset(&scene->walls[w].motion, snapshot->time, &snapshot->wall_offset[w],
                             &snapshot->wall_velocity[w]);
        }
    }
}

double oz_snapshot_turn(const OzSnapshot *snapshot, int wall)
{
    const OzMotion *motion = &snapshot->scene->walls[wall].motion;
    return snapshot->settling ? 0 : oz_motion_turn(motion, snapshot->time);
}

bool oz_snapshot_has_wall(const OzSnapshot *snapshot, int64_t wall)
{
    return oz_wall_motion_present(&snapshot->scene->walls[wall], snapshot->time,
                                  snapshot->settling);
}

/* Sums of a grain's elements: mass, first moments of position and velocity, turn. */
typedef struct Join {
    double mass, position[2], velocity[2], turn, inertia, momentum;
} Join;

static Join join_linear(const OzSnapshot *snapshot, int64_t first, int64_t end)
{
    const OzElements *elements = snapshot->grains->elements;
    Join join = {0};
    for (int64_t k = first; k < end; k++) {
        int64_t i = oz_elements_at(elements, k);
        double mass = elements->mass[i];
        join.mass += mass;
        join.turn += mass * (snapshot->element_angle[i] - elements->angle[i]);
        for (int c = 0; c < 2; c++) {
            join.position[c] += mass * snapshot->element_position[2 * i + c];
            join.velocity[c] += mass * snapshot->element_velocity[2 * i + c];
        }
    }
    for (int k = 0; k < 2; k++) {
        join.position[k] /= join.mass;
        join.velocity[k] /= join.mass;
    }
    join.turn /= join.mass;
    return join;
}

/* Moment of inertia and angular momentum about the centre of mass. */
static void join_angular(const OzSnapshot *snapshot, int64_t first, int64_t end, Join *join)
{
    const OzElements *elements = snapshot->grains->elements;
    for (int64_t k = first; k < end; k++) {
        int64_t i = oz_elements_at(elements, k);
        const double *r = snapshot->element_position + 2 * i,
                     *v = snapshot->element_velocity + 2 * i;
        double x = r[0] - join->position[0], y = r[1] - join->position[1];
        double u = v[0] - join->velocity[0], w = v[1] - join->velocity[1];
        join->inertia += elements->inertia[i] + elements->mass[i] * (x * x + y * y);
        join->momentum += elements->inertia[i] * snapshot->element_angular_velocity[i] +
                          elements->mass[i] * (x * w - y * u);
    }
}

void oz_snapshot_join_elements(OzSnapshot *snapshot)
{
    const OzElements *elements = snapshot->grains->elements;
    for (int64_t g = 0; g < snapshot->count; g++) {
        Join join = join_linear(snapshot, elements->first[g], elements->first[g + 1]);
        join_angular(snapshot, elements->first[g], elements->first[g + 1], &join);
        memcpy(&snapshot->position[3 * g], (double[3]){join.position[0], join.position[1], 0},
               3 * sizeof(double));
        memcpy(&snapshot->velocity[3 * g], (double[3]){join.velocity[0], join.velocity[1], 0},
               3 * sizeof(double));
        memcpy(&snapshot->angular_velocity[3 * g], (double[3]){0, 0, join.momentum / join.inertia},
               3 * sizeof(double));
        memcpy(&snapshot->quaternion[4 * g],
               (double[4]){cos(0.5 * join.turn), 0, 0, sin(0.5 * join.turn)}, 4 * sizeof(double));
    }
    oz_snapshot_turn_axes(snapshot);
}

void oz_snapshot_turn_axes(OzSnapshot *snapshot)
{
    for (int64_t i = 0; i < snapshot->count; i++) {
        oz_grains_axis(&snapshot->quaternion[4 * i], &snapshot->axis[3 * i]);
    }
}

static OzStatus elements_state(OzSnapshot *s, OzStateVisit *visit)
{
    int64_t count = s->element_count;
    OZ_PASS(oz_state_double(visit, "element_position", "m", s->element_position, 2 * count));
    OZ_PASS(oz_state_double(visit, "element_angle", "rad", s->element_angle, count));
    OZ_PASS(oz_state_double(visit, "element_velocity", "m/s", s->element_velocity, 2 * count));
    OZ_PASS(oz_state_double(visit, "element_angular_velocity", "rad/s", s->element_angular_velocity,
                            count));
    OZ_PASS(oz_wear_state(&s->wear, visit));
    return visit->is_loading && s->wear.whole ? oz_snapshot_split(s) : OZ_OK;
}

OzStatus oz_snapshot_state(OzSnapshot *s, OzStateVisit *visit)
{
    int64_t walls = s->scene->wall_count;
    OZ_PASS(oz_state_int64(visit, "step", "step", &s->step));
    OZ_PASS(oz_state_double(visit, "time", "s", &s->time, 1));
    if (s->element_count > 0) {
        OZ_PASS(elements_state(s, visit));
    }
    OZ_PASS(oz_state_double(visit, "position", "m", s->position, 3 * s->count));
    OZ_PASS(oz_state_double(visit, "quaternion", "none", s->quaternion, 4 * s->count));
    OZ_PASS(oz_state_double(visit, "axis", "none", s->axis, 3 * s->count));
    OZ_PASS(oz_state_double(visit, "velocity", "m/s", s->velocity, 3 * s->count));
    OZ_PASS(oz_state_double(visit, "angular_velocity", "rad/s", s->angular_velocity, 3 * s->count));
    OZ_PASS(oz_state_double(visit, "wall_offset", "m", s->wall_offset, walls));
    OZ_PASS(oz_state_double(visit, "wall_velocity", "m/s", s->wall_velocity, walls));
    OZ_PASS(oz_state_double(visit, "wall_push", "N", s->wall_push, walls));
    return oz_state_int64(visit, "deep_count", "none", &s->deep_count);
}
