/* Sweeps over rods, and until when they are made. */
#include "sim/part.h"

#include "base/log.h"
#include "base/memory.h"
#include "scene/boundary.h"
#include "sim/dialect.h"
#include "sim/gates.h"
#include "sim/host_mesh.h"
#include "sim/part_elements.h"
#include "sim/sort_axis.h"
#include "sim/start.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SWEEPS_MOST = 5000 };

/* Rods while they are moved. */
typedef struct Rods {
    OzGrains *grains;
    OzPhysics physics;
    const OzBoundary *boundary;
    double *axis; /* 3 x count */
    OzPairs pairs;
} Rods;

static OzVec3 half_shaft(const Rods *r, int64_t i)
{
    return oz_scale(oz_dialect_load3(&r->axis[3 * i]), r->grains->length[i] / 2);
}

static void move(Rods *r, int64_t i, OzVec3 normal, double way)
{
    OzVec3 at = oz_along(oz_dialect_load3(&r->grains->position[3 * i]), way, normal);
    oz_dialect_store3(&r->grains->position[3 * i], at);
}

/* The way from the second of a pair to the first. */
static OzVec3 apart_of(const Rods *r, OzPair pair)
{
    const double *a = &r->grains->position[3 * (int64_t)pair.a];
    const double *b = &r->grains->position[3 * (int64_t)pair.b];
    double way[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    oz_boundary_wrap(r->boundary, way);
    return oz_dialect_load3(way);
}

static void part_pair(Rods *r, OzPair pair, double *deepest)
{
    const OzGrains *g = r->grains;
    OzVec3 apart = apart_of(r, pair);
    OzVec3 one = half_shaft(r, pair.a), other = half_shaft(r, pair.b);
    OzClosest at = oz_closest(apart, one, other);
    OzVec3 gap = oz_minus(oz_along(oz_scale(other, at.t), -at.s, one), apart);
    double length = sqrt(oz_dot(gap, gap));
    double depth = (g->diameter[pair.a] + g->diameter[pair.b]) / 2 - length;
    if (!(depth > 0)) {
        return;
    }
    OzVec3 normal = length > 0 ? oz_scale(gap, 1 / length) : oz_vec3(0, 0, 1);
    double all = g->mass[pair.a] + g->mass[pair.b];
    *deepest = fmax(*deepest, depth / (fmin(g->diameter[pair.a], g->diameter[pair.b]) / 2));
    move(r, pair.a, normal, -depth * g->mass[pair.b] / all);
    move(r, pair.b, normal, depth * g->mass[pair.a] / all);
}

/* In a slot of kernel wall w, a mesh. */
static OzWallEnd mesh_end(const Rods *r, int w, OzGrain grain, OzWallDrive drive, int slot)
{
    OzHostMesh found;
    double memory[OZ_MESH_SLOTS * OZ_MESH_MEMORY] = {0};
    OzVec3 from = oz_dialect_from(&r->physics, w, grain.position, oz_vec3(0, 0, 0), drive);
    oz_host_mesh_find(&found, &r->physics, w, from, grain.half_shaft, grain.radius, memory);
    return oz_dialect_mesh_end(&found.at[slot], grain);
}

static void part_walls(Rods *r, int64_t i, double *deepest)
{
    double radius = r->grains->diameter[i] / 2;
    const OzWallDrive at_rest[OZ_WALLS_MAX] = {{.offset = 0}};
    for (int index = 0; index < r->physics.touches; index++) {
        const double *x = &r->grains->position[3 * i];
        OzGrain grain = {
            .position = {x[0], x[1], x[2]}, .half_shaft = half_shaft(r, i), .radius = radius};
        int wall, part = oz_dialect_part(&r->physics, index, &wall);
        OzWallEnd at = part < OZ_WALL_PARTS
                           ? oz_dialect_end(&r->physics, wall, part, grain, at_rest)
                           : mesh_end(r, wall, grain, at_rest[wall], part - OZ_WALL_PARTS);
        double depth = at.share * (radius - at.wall.distance);
        if (depth > 0) {
            *deepest = fmax(*deepest, depth / radius);
            move(r, i, at.wall.normal, depth);
        }
    }
}

static OzStatus sweep_rods(Rods *r, double *deepest)
{
    OZ_USE_SWITCHES(oz_host_switches_rods(&r->physics.switches));
    OZ_PASS(oz_sort_axis_pairs(&r->pairs, r->grains, r->grains->position, r->axis, 0, r->boundary));
    for (int64_t k = 0; k < r->pairs.count; k++) {
        part_pair(r, r->pairs.pair[k], deepest);
    }
    for (int64_t i = 0; i < r->grains->count; i++) {
        part_walls(r, i, deepest);
    }
    return OZ_OK;
}

static OzStatus open_rods(Rods *r, OzGrains *grains, const OzScene *scene)
{
    *r = (Rods){.grains = grains, .boundary = &scene->boundary};
    OZ_PASS(oz_physics_derive(&r->physics, scene, grains));
    oz_gates_set(&r->physics, scene, 0, true);
    OZ_PASS(OZ_NEW(&r->axis, 3 * grains->count));
    for (int64_t i = 0; i < grains->count; i++) {
        oz_grains_axis(&grains->quaternion[4 * i], &r->axis[3 * i]);
    }
    return OZ_OK;
}

/* The farthest that a grain is now from where it was, m. */
static double farthest(const OzGrains *grains, const double *before)
{
    double far = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        OzVec3 way =
            oz_minus(oz_dialect_load3(&grains->position[3 * i]), oz_dialect_load3(&before[3 * i]));
        far = fmax(far, sqrt(oz_dot(way, way)));
    }
    return far;
}

OzStatus oz_part_grains(OzGrains *grains, const OzScene *scene)
{
    OzStatus status = OZ_OK;
    Rods rods = {0};
    double *before = NULL, deepest = INFINITY;
    int sweeps = 0;
    OZ_TRY(OZ_NEW(&before, 3 * grains->count));
    memcpy(before, grains->position, 3 * (size_t)grains->count * sizeof *before);
    if (!grains->elements) {
        OZ_TRY(open_rods(&rods, grains, scene));
    }
    for (; deepest > OZ_START_ROUNDING / 2 && sweeps < SWEEPS_MOST; sweeps++) {
        deepest = 0;
        OZ_TRY(grains->elements ? oz_part_elements_sweep(grains, scene, &deepest)
                                : sweep_rods(&rods, &deepest));
    }
    if (deepest > OZ_START_ROUNDING / 2) {
        status = oz_status_fail(OZ_ERR_INPUT,
                                "%s: grains cannot be moved apart: after %d sweeps they still "
                                "overlap by %.2g of a radius; expected more room for them",
                                scene->path, sweeps, deepest);
    } else if (sweeps > 1) {
        oz_log_line("%s: overlaps at the start were removed; grains were moved by up to %.3g m",
                    scene->path, farthest(grains, before));
    }
done:
    free(before);
    free(rods.axis);
    oz_sort_axis_free(&rods.pairs);
    return status;
}
