/* The linearised force of a bed: contacts as springs between points of rigid bodies. */
#include "sim/stiffness.h"

#include "base/log.h"
#include "base/memory.h"
#include "base/random.h"
#include "model/calibrate.h"
#include "model/predict.h"
#include "scene/boundary.h"
#include "scene/mixing.h"
#include "sim/contacts.h"
#include "sim/dialect.h"
#include "sim/sort_axis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    FREEDOMS = 6,    /* of a grain: three ways, three turns */
    ITERATIONS = 100 /* settled beds of 1000 rods: within 1 % */
};

/* One touching point: a's and b's, or a's at a wall (b < 0). */
typedef struct Spring {
    int64_t a, b;
    OzVec3 normal, arm_a, arm_b;
    double stiffness, tangential;       /* N/m */
    double damping, tangential_damping; /* kg/s */
    double radius, inertia;             /* m, kg m^2, as kernels/contact.h has them */
    double rolling, rolling_damping;    /* N m, N m s */
} Spring;

typedef struct Bed {
    const OzSnapshot *now;
    Spring *springs;
    int64_t count, capacity;
    double *swing, *force;
} Bed;

static OzVec3 load(const double *x)
{
    return oz_vec3(x[0], x[1], x[2]);
}

static OzStatus add(Bed *bed, const OzContactValues *values, double mass, Spring spring)
{
    OzContactConstants c = oz_calibrate_contact(bed->now->scene, values);
    bool sticks = values->friction > 0;
    OZ_PASS(OZ_ROOM(&bed->springs, &bed->capacity, bed->count + 1, "springs"));
    spring.stiffness = mass * c.stiffness;
    spring.damping = mass * c.damping;
    spring.tangential = sticks ? mass * c.tangential_stiffness : 0;
    spring.tangential_damping = sticks ? mass * c.tangential_damping : 0;
    if (bed->now->scene->contact.rolling == OZ_ROLLING_RESISTS_BY_SPRING) { /* contact_rolling.h */
        double lever = values->rolling_friction * spring.radius;
        spring.rolling = 2.25 * spring.stiffness * lever * lever;
        spring.rolling_damping =
            2 * values->rolling_damping * sqrt(1.4 * spring.inertia * spring.rolling);
    }
    bed->springs[bed->count++] = spring;
    return OZ_OK;
}

/* kg m^2, but for a sphere's 7/5 about its contact. */
static double inertia_of(const OzGrains *grains, int64_t i)
{
    return 0.25 * grains->mass[i] * grains->diameter[i] * grains->diameter[i];
}

/* Which material of grains it is of. */
static int kind_of(const OzScene *scene, const OzGrains *grains, int64_t i)
{
    return oz_mixing_count(scene) > 1 ? oz_mixing_kind(scene, grains->population[i]) : 0;
}

static OzStatus add_pair(Bed *bed, int64_t a, int64_t b)
{
    const OzGrains *g = bed->now->grains;
    const double *x = &bed->now->position[3 * a], *y = &bed->now->position[3 * b];
    double between[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
    OzBoundary cell = oz_snapshot_cell(bed->now);
    oz_boundary_wrap(&cell, between);
    OzVec3 apart = load(between);
    double reach = 0.5 * (g->diameter[a] + g->diameter[b]);
    OzVec3 half_a = oz_scale(load(&bed->now->axis[3 * a]), 0.5 * g->length[a]);
    OzVec3 half_b = oz_scale(load(&bed->now->axis[3 * b]), 0.5 * g->length[b]);
    OzClosest at = oz_closest(apart, half_a, half_b);
    OzVec3 arm_a = oz_scale(half_a, at.s), arm_b = oz_scale(half_b, at.t);
    OzVec3 way = oz_minus(oz_minus(arm_b, arm_a), apart);
    double distance = sqrt(oz_dot(way, way));
    if (distance >= reach || !(distance > 0)) {
        return OZ_OK;
    }
    Spring spring = {.a = a, .b = b, .normal = oz_scale(way, 1 / distance)};
    spring.arm_a = oz_along(arm_a, 0.5 * g->diameter[a], spring.normal);
    spring.arm_b = oz_along(arm_b, -0.5 * g->diameter[b], spring.normal);
    double mass = g->mass[a] * g->mass[b] / (g->mass[a] + g->mass[b]);
    double a2 = inertia_of(g, a), b2 = inertia_of(g, b);
    spring.inertia = a2 * b2 / (a2 + b2);
    spring.radius = 0.5 * g->diameter[a] * g->diameter[b] / (g->diameter[a] + g->diameter[b]);
    OzContactValues values;
    const OzScene *scene = bed->now->scene;
    oz_mixing_grains(&values, scene, kind_of(scene, g, a), kind_of(scene, g, b));
    return add(bed, &values, mass, spring);
}

static OzStatus add_walls(Bed *bed, OzContacts *contacts, int64_t i)
{
    OzContactList *found = contacts->list;
    found->count = 0;
    for (int index = 0; index < contacts->physics.touches; index++) {
        OZ_PASS(oz_contacts_wall(contacts, i, index, NULL));
    }
    for (int64_t k = 0; k < found->count; k++) {
        const OzContactEntry *e = &found->entry[k];
        OzVec3 arm = oz_minus(load(e->point), load(&bed->now->position[3 * i]));
        Spring spring = {.a = i, .b = -1, .normal = load(e->normal), .arm_a = arm};
        spring.radius = 0.5 * bed->now->grains->diameter[i];
        spring.inertia = inertia_of(bed->now->grains, i);
        OzContactValues values;
        oz_mixing_wall(&values, bed->now->scene, -1 - e->b,
                       kind_of(bed->now->scene, bed->now->grains, i));
        OZ_PASS(add(bed, &values, bed->now->grains->mass[i], spring));
    }
    return OZ_OK;
}

static OzStatus find_springs(Bed *bed)
{
    OzStatus status = OZ_OK;
    OzPairs pairs = {0};
    OzContactList at_walls = {0};
    OzContacts contacts;
    OzBoundary cell = oz_snapshot_cell(bed->now);
    OZ_TRY(oz_contacts_begin(&contacts, bed->now, &at_walls));
    OZ_TRY(
        oz_sort_axis_pairs(&pairs, bed->now->grains, bed->now->position, bed->now->axis, 0, &cell));
    for (int64_t k = 0; k < pairs.count; k++) {
        OZ_TRY(add_pair(bed, pairs.pair[k].a, pairs.pair[k].b));
    }
    for (int64_t a = 0; a < bed->now->count; a++) {
        OZ_TRY(add_walls(bed, &contacts, a));
    }
done:
    oz_sort_axis_free(&pairs);
    oz_contact_list_free(&at_walls);
    return status;
}

static OzVec3 point_way(const double *swing, int64_t i, OzVec3 arm)
{
    const double *u = &swing[FREEDOMS * i];
    return oz_along(load(u), 1, oz_cross(load(u + 3), arm));
}

static void push(double *force, int64_t i, OzVec3 arm, OzVec3 by)
{
    double *f = &force[FREEDOMS * i];
    OzVec3 torque = oz_cross(arm, by);
    const double add[FREEDOMS] = {by.x, by.y, by.z, torque.x, torque.y, torque.z};
    for (int c = 0; c < FREEDOMS; c++) {
        f[c] += add[c];
    }
}

/* The couple of a rolling spring; returns twice the power that its dashpot would take. */
static double apply_rolling(Bed *bed, const Spring *s)
{
    OzVec3 turn = oz_scale(load(&bed->swing[FREEDOMS * s->a + 3]), -1);
    double *a = &bed->force[FREEDOMS * s->a + 3];
    if (s->b >= 0) {
        turn = oz_along(turn, 1, load(&bed->swing[FREEDOMS * s->b + 3]));
    }
    turn = oz_along(turn, -oz_dot(turn, s->normal), s->normal);
    const double couple[3] = {turn.x, turn.y, turn.z};
    for (int c = 0; c < 3; c++) {
        a[c] -= s->rolling * couple[c];
        if (s->b >= 0) {
            bed->force[FREEDOMS * s->b + 3 + c] += s->rolling * couple[c];
        }
    }
    return s->rolling_damping * oz_dot(turn, turn);
}

/* force = K swing; returns twice the power that dashpots would take from a swing at these rates. */
static double apply(Bed *bed)
{
    double power = 0;
    memset(bed->force, 0, (size_t)bed->now->count * FREEDOMS * sizeof *bed->force);
    for (int64_t k = 0; k < bed->count; k++) {
        const Spring *s = &bed->springs[k];
        OzVec3 way = oz_scale(point_way(bed->swing, s->a, s->arm_a), -1);
        if (s->b >= 0) {
            way = oz_along(way, 1, point_way(bed->swing, s->b, s->arm_b));
        }
        double along = oz_dot(way, s->normal);
        OzVec3 across = oz_along(way, -along, s->normal);
        OzVec3 by = oz_along(oz_scale(across, s->tangential), s->stiffness * along, s->normal);
        push(bed->force, s->a, s->arm_a, oz_scale(by, -1));
        if (s->b >= 0) {
            push(bed->force, s->b, s->arm_b, by);
        }
        power += s->damping * along * along + s->tangential_damping * oz_dot(across, across);
        power += s->rolling > 0 ? apply_rolling(bed, s) : 0;
    }
    return power;
}

/* Force over mass, torque over inertia (about the shaft and across it). */
static void divide_by_mass(const OzSnapshot *now, double *force)
{
    for (int64_t i = 0; i < now->count; i++) {
        double *f = &force[FREEDOMS * i];
        OzVec3 axis = load(&now->axis[3 * i]), torque = load(f + 3);
        double about = oz_dot(torque, axis);
        double across = 1 / now->grains->inertia[i], along = 1 / now->grains->inertia_axis[i];
        OzVec3 turn = oz_along(oz_scale(torque, across), (along - across) * about, axis);
        for (int c = 0; c < 3; c++) {
            f[c] /= now->grains->mass[i];
        }
        f[3] = turn.x;
        f[4] = turn.y;
        f[5] = turn.z;
    }
}

static double product(const double *a, const double *b, int64_t count)
{
    double sum = 0;
    for (int64_t i = 0; i < count; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

/* The largest eigenvalue is u.Ku / u.Mu at the swing u that grows fastest under (1/M) K; its
 * damping is u.Cu / u.Mu. With w = Ku / M the next swing, u.M w = u.Ku: so u.Mu comes from the last
 * round's w. */
static void iterate(Bed *bed, OzStiffness *result)
{
    int64_t freedoms = FREEDOMS * bed->now->count;
    OzRandom random = oz_random_stream(bed->now->scene->seed, 0);
    for (int64_t i = 0; i < freedoms; i++) {
        bed->swing[i] = oz_random_uniform(&random, -1, 1);
    }
    double before = 0; /* u.Mu */
    for (int k = 0; k < ITERATIONS; k++) {
        double power = apply(bed), work = product(bed->swing, bed->force, freedoms);
        double *forces = bed->swing;
        if (before > 0) {
            result->stiffness = work / before;
            result->damping = power / before;
        }
        /* w.Mw = w.Ku, before masses divide it away */
        memcpy(forces, bed->force, (size_t)freedoms * sizeof *forces);
        divide_by_mass(bed->now, bed->force);
        double size = product(forces, bed->force, freedoms);
        if (!(size > 0)) {
            return;
        }
        double scale = 1 / sqrt(size);
        for (int64_t i = 0; i < freedoms; i++) {
            bed->swing[i] = bed->force[i] * scale;
        }
        before = 1;
    }
}

bool oz_stiffness_applies(const OzScene *scene)
{
    return scene->model == OZ_MODEL_RODS && oz_contact_is_linear(scene->contact.law);
}

OzStatus oz_stiffness_measure(OzStiffness *result, const OzSnapshot *now)
{
    OzStatus status = OZ_OK;
    Bed bed = {.now = now};
    *result = (OzStiffness){.largest_step = INFINITY};
    OZ_TRY(OZ_NEW(&bed.swing, now->count * FREEDOMS));
    OZ_TRY(OZ_NEW(&bed.force, now->count * FREEDOMS));
    OZ_TRY(find_springs(&bed));
    iterate(&bed, result);
    result->contacts = bed.count;
    result->largest_step =
        oz_predict_largest_step(now->scene->integrator, result->stiffness, result->damping);
done:
    free(bed.springs);
    free(bed.swing);
    free(bed.force);
    return status;
}

/* The stiffest swing of grain i that lies along x on the wall. */
static OzStatus lie(OzStiffness *result, const OzScene *scene, const OzGrains *grains, int64_t i,
                    int w)
{
    OzStatus status = OZ_OK;
    double axis[3] = {1, 0, 0}, swing[FREEDOMS], force[FREEDOMS];
    const OzGrains one = {.count = 1,
                          .mass = &grains->mass[i],
                          .inertia = &grains->inertia[i],
                          .inertia_axis = &grains->inertia_axis[i]};
    const OzSnapshot now = {.scene = scene, .grains = &one, .count = 1, .axis = axis};
    Bed bed = {.now = &now, .swing = swing, .force = force};
    double radius = 0.5 * grains->diameter[i], half = 0.5 * grains->length[i];
    for (int end = -1; end <= 1; end += half > 0 ? 2 : 3) {
        Spring spring = {.b = -1, .normal = {0, 0, -1}, .arm_a = {end * half, 0, -radius}};
        spring.radius = radius;
        spring.inertia = inertia_of(grains, i);
        OzContactValues values;
        oz_mixing_wall(&values, scene, w, kind_of(scene, grains, i));
        OZ_TRY(add(&bed, &values, grains->mass[i], spring));
    }
    *result = (OzStiffness){.contacts = bed.count};
    iterate(&bed, result);
    result->largest_step =
        oz_predict_largest_step(scene->integrator, result->stiffness, result->damping);
done:
    free(bed.springs);
    return status;
}

static double aspect_of(const OzGrains *grains, int64_t i)
{
    return grains->length[i] / grains->diameter[i];
}

OzStatus oz_stiffness_at_wall(OzStiffness *result, const OzScene *scene, const OzGrains *grains,
                              int w)
{
    *result = (OzStiffness){.largest_step = INFINITY};
    for (int kind = 0; kind < oz_mixing_count(scene); kind++) {
        int64_t longest = -1, shortest = -1;
        for (int64_t i = 0; i < grains->count; i++) {
            if (kind_of(scene, grains, i) == kind) {
                double aspect = aspect_of(grains, i);
                longest = longest < 0 || aspect > aspect_of(grains, longest) ? i : longest;
                shortest = shortest < 0 || aspect < aspect_of(grains, shortest) ? i : shortest;
            }
        }
        for (int k = 0; longest >= 0 && k < 2; k++) {
            OzStiffness other;
            OZ_PASS(lie(&other, scene, grains, k ? shortest : longest, w));
            *result = other.largest_step < result->largest_step ? other : *result;
        }
    }
    return OZ_OK;
}

void oz_stiffness_say(const OzStiffness *stiffness, const OzScene *scene)
{
    double margin = stiffness->largest_step / scene->step;
    if (stiffness->contacts == 0) {
        return;
    }
    oz_log_line("%lld contacts together: largest stable step %.4g s, margin %.3g%s",
                (long long)stiffness->contacts, stiffness->largest_step, margin,
                margin < 1 ? "; warning: at this step the bed cannot come to rest" : "");
}
