/* Shapes are made, told places copied, random ones tried until they touch nothing; then all of it
 * becomes elements. Knows neither forces nor devices. */
#include "model/insert_flat.h"

#include "base/log.h"
#include "base/memory.h"
#include "base/random.h"
#include "model/element_walls.h"
#include "model/fill_region_flat.h"
#include "model/overlap_grid.h"
#include "model/shape.h"
#include "model/triangle_set.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/* Positions tried before the column grows; in a drum, which cannot, fifty times as many. Discs put
 * down at random jam near 0.55 of the area, where an accepted one has needed some thousands. */
enum { TRIES_PER_ROUND = 2000, TRIES_IN_ALL = 100000 };

/* A grain's stream gives its shape from the start and its place from here on. */
#define PLACE_DRAWS (1u << 30)

/* A grain waiting for its place. */
typedef struct Waiting {
    double reach; /* m */
    int64_t id;
} Waiting;

typedef struct Arrangement {
    const OzScene *scene;
    OzGrains *grains;
    OzTriangleSet *triangle_sets; /* of each grain                     */
    OzTriangleSet *walls;         /* of each wall                      */
    double *angle;                /* rad, of each grain                */
    int64_t *first; /* id of each population's first grain; the grains' number at the end */
    Waiting *waiting;
    int64_t waiting_count, raise_count;
    OzFillRegionFlat fill_region;
    OzOverlapGrid overlap_grid;
} Arrangement;

static OzRandom grain_stream(const Arrangement *arrangement, int64_t i)
{
    int p = arrangement->grains->population[i];
    uint64_t stream = ((uint64_t)p << 40) + (uint64_t)(i - arrangement->first[p]);
    return oz_random_stream(arrangement->scene->seed, stream);
}

static OzStatus count_grains(Arrangement *arrangement)
{
    const OzScene *scene = arrangement->scene;
    int64_t total = 0;
    for (int p = 0; p < scene->population_count; p++) {
        const OzPopulation *population = &scene->populations[p];
        if (population->count > INT32_MAX - total) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "%s:%d: too many grains; expected at most %d in all", scene->path,
                                  population->line, INT32_MAX);
        }
        arrangement->first[p] = total;
        total += population->count;
    }
    arrangement->first[scene->population_count] = total;
    return oz_grains_check_memory(scene->path, total);
}

/* Vertices are cut into triangles once, and copied from the population's first grain. */
static OzStatus make_shape(Arrangement *arrangement, int64_t i, const OzPopulation *population)
{
    OzGrains *grains = arrangement->grains;
    OzRandom random = grain_stream(arrangement, i);
    int64_t first = arrangement->first[grains->population[i]];
    double turn = oz_random_uniform(&random, 0, 2 * PI);
    arrangement->angle[i] = population->kind == OZ_GRAINS_RANDOM ? turn : population->angle;
    OzStatus status = population->shape == OZ_SHAPE_VERTICES && i > first
                          ? oz_triangle_set_copy(&arrangement->triangle_sets[i],
                                                 &arrangement->triangle_sets[first])
                          : oz_shape_make(&arrangement->triangle_sets[i], arrangement->scene,
                                          population, &random);
    grains->diameter[i] = 2 * arrangement->triangle_sets[i].reach;
    return status;
}

/* Place (in the lattice) and motion as written; random grains get their place later. */
static void put_as_told(OzGrains *grains, int64_t i, const OzPopulation *population, int64_t index)
{
    bool lattice = population->kind == OZ_GRAINS_LATTICE;
    for (int k = 0; k < 2; k++) {
        double cell = lattice ? (double)(index % population->cells[k]) : 0;
        index = lattice ? index / population->cells[k] : 0;
        grains->position[3 * i + k] = population->position[k] + cell * population->spacing[k];
        grains->velocity[3 * i + k] = population->velocity[k];
    }
    grains->angular_velocity[3 * i + 2] = population->angular_velocity[2];
}

static OzStatus make_grains(Arrangement *arrangement)
{
    const OzScene *scene = arrangement->scene;
    for (int p = 0; p < scene->population_count; p++) {
        const OzPopulation *population = &scene->populations[p];
        for (int64_t i = arrangement->first[p]; i < arrangement->first[p + 1]; i++) {
            arrangement->grains->population[i] = p;
            OZ_PASS(make_shape(arrangement, i, population));
            if (population->kind == OZ_GRAINS_RANDOM) {
                arrangement->waiting[arrangement->waiting_count++] =
                    (Waiting){arrangement->triangle_sets[i].reach, i};
            } else {
                put_as_told(arrangement->grains, i, population, i - arrangement->first[p]);
            }
        }
    }
    return OZ_OK;
}

static OzStatus make_walls(Arrangement *arrangement)
{
    double size = 0;
    for (int64_t i = 0; i < arrangement->grains->count; i++) {
        size = fmax(size, arrangement->grains->diameter[i]);
    }
    for (int w = 0; w < arrangement->scene->wall_count; w++) {
        OZ_PASS(oz_element_walls_make(&arrangement->walls[w], &arrangement->scene->walls[w], size));
    }
    return OZ_OK;
}

static OzCapsule circle_of(const Arrangement *arrangement, int64_t i)
{
    const double *position = &arrangement->grains->position[3 * i];
    return (OzCapsule){.centre = {position[0], position[1]},
                       .radius = arrangement->triangle_sets[i].reach};
}

static OzStatus add_told_grains(Arrangement *arrangement)
{
    const OzGrains *grains = arrangement->grains;
    for (int64_t i = 0; i < grains->count; i++) {
        if (arrangement->scene->populations[grains->population[i]].kind != OZ_GRAINS_RANDOM) {
            OzCapsule circle = circle_of(arrangement, i);
            OzStatus status = oz_overlap_grid_add(&arrangement->overlap_grid, &circle);
            if (status != OZ_OK) {
                return status;
            }
        }
    }
    return OZ_OK;
}

/* The largest first: small ones still fit between them. */
static int compare_waiting(const void *left, const void *right)
{
    const Waiting *a = left, *b = right;
    if (a->reach != b->reach) {
        return a->reach > b->reach ? -1 : 1;
    }
    return (a->id > b->id) - (a->id < b->id);
}

static bool try_places(Arrangement *arrangement, OzRandom *random, OzCapsule *circle)
{
    for (int n = 0; n < TRIES_PER_ROUND; n++) {
        oz_fill_region_flat_draw(&arrangement->fill_region, random, circle->centre);
        if (!oz_overlap_grid_touches(&arrangement->overlap_grid, circle) &&
            oz_fill_region_flat_holds(&arrangement->fill_region, circle->centre, circle->radius)) {
            return true;
        }
    }
    return false;
}

static OzStatus refuse_crowding(const Arrangement *arrangement, int64_t i, int64_t placed)
{
    const OzScene *scene = arrangement->scene;
    return oz_status_fail(
        OZ_ERR_INPUT,
        "%s:%d: the random grains do not fit between the walls: %lld of %lld found "
        "a place; expected fewer or smaller grains, or a larger container",
        scene->path, scene->populations[arrangement->grains->population[i]].line, (long long)placed,
        (long long)arrangement->waiting_count);
}

static OzStatus place_grain(Arrangement *arrangement, int64_t i, int64_t placed)
{
    OzRandom random = grain_stream(arrangement, i);
    OzCapsule circle = circle_of(arrangement, i);
    random.counter = PLACE_DRAWS;
    for (int tries = 0; !try_places(arrangement, &random, &circle);) {
        tries += TRIES_PER_ROUND;
        arrangement->raise_count += oz_fill_region_flat_raise(&arrangement->fill_region);
        if (tries >= TRIES_IN_ALL) {
            return refuse_crowding(arrangement, i, placed);
        }
    }
    memcpy(&arrangement->grains->position[3 * i], circle.centre, 2 * sizeof(double));
    return oz_overlap_grid_add(&arrangement->overlap_grid, &circle);
}

static OzStatus place_waiting(Arrangement *arrangement)
{
    const OzGrains *grains = arrangement->grains;
    double area = 0;
    if (!arrangement->waiting_count) {
        return OZ_OK;
    }
    qsort(arrangement->waiting, (size_t)arrangement->waiting_count, sizeof(Waiting),
          compare_waiting);
    for (int64_t w = 0; w < arrangement->waiting_count; w++) {
        const Waiting *waiting = &arrangement->waiting[w];
        area += PI * waiting->reach * waiting->reach /
                arrangement->scene->populations[grains->population[waiting->id]].fill;
    }
    arrangement->fill_region = oz_fill_region_flat_make(arrangement->scene, arrangement->walls,
                                                        area, arrangement->waiting[0].reach);
    OZ_PASS(add_told_grains(arrangement));
    for (int64_t w = 0; w < arrangement->waiting_count; w++) {
        OZ_PASS(place_grain(arrangement, arrangement->waiting[w].id, w));
    }
    if (arrangement->raise_count) {
        oz_log_line(
            "%s: the random grains needed a start column %.3g times as high as their `fill` "
            "asks for",
            arrangement->scene->path, pow(1.1, (double)arrangement->raise_count));
    }
    return OZ_OK;
}

static void count_patch(const OzTriangleSet *triangle_set, int64_t *elements, int64_t *outlines)
{
    *elements += triangle_set->triangle_count + (triangle_set->radius > 0);
    *outlines += triangle_set->outline_count;
}

static OzStatus create_elements(Arrangement *arrangement)
{
    OzElementCounts counts = {.grains = arrangement->grains->count,
                              .walls = arrangement->scene->wall_count};
    for (int64_t i = 0; i < counts.grains; i++) {
        count_patch(&arrangement->triangle_sets[i], &counts.free_elements, &counts.outlines);
        counts.beams += arrangement->triangle_sets[i].joint_count;
    }
    for (int w = 0; w < arrangement->scene->wall_count; w++) {
        count_patch(&arrangement->walls[w], &counts.wall_elements, &counts.outlines);
    }
    if (counts.free_elements + counts.wall_elements > INT32_MAX / 8) {
        return oz_status_fail(
            OZ_ERR_INPUT, "%s: %lld triangles; expected at most %d", arrangement->scene->path,
            (long long)(counts.free_elements + counts.wall_elements), INT32_MAX / 8);
    }
    return oz_elements_create(&arrangement->grains->elements, &counts);
}

/* Where the next elements, beams and outlines go. */
typedef struct Cursor {
    OzElements *elements;
    int64_t element, beam, outline, body;
} Cursor;

static void put_outline(Cursor *cursor, const OzTriangleSet *triangle_set)
{
    for (int k = 0; k < triangle_set->outline_count; k++) {
        cursor->elements->outline_element[cursor->outline] =
            (int)cursor->element + triangle_set->outline[2 * k];
        cursor->elements->outline_edge[cursor->outline++] = triangle_set->outline[2 * k + 1];
    }
}

static void put_beams(Cursor *cursor, const OzTriangleSet *triangle_set)
{
    OzElements *elements = cursor->elements;
    for (int k = 0; k < triangle_set->joint_count; k++) {
        elements->beam_a[cursor->beam] = (int)cursor->element + triangle_set->joint[2 * k];
        elements->beam_b[cursor->beam] = (int)cursor->element + triangle_set->joint[2 * k + 1];
        oz_elements_rest_beam(elements, cursor->beam++);
    }
}

/* The triangle set's elements, turned by an angle about its origin and moved to a position. */
static OzStatus put_body(Cursor *cursor, const OzTriangleSet *triangle_set,
                         const double position[2], double angle, double density)
{
    OzElements *elements = cursor->elements;
    double c = cos(angle), s = sin(angle), own[6], corners[6];
    elements->first[cursor->body] = cursor->element;
    for (int t = 0; t < triangle_set->triangle_count; t++) {
        oz_triangle_set_corners(triangle_set, t, own);
        for (int k = 0; k < 3; k++) {
            corners[2 * k] = position[0] + c * own[2 * k] - s * own[2 * k + 1];
            corners[2 * k + 1] = position[1] + s * own[2 * k] + c * own[2 * k + 1];
        }
        elements->body[cursor->element + t] = (int)cursor->body;
        OzStatus status = oz_elements_set_triangle(elements, cursor->element + t, corners, density);
        if (status != OZ_OK) {
            return status;
        }
    }
    if (triangle_set->radius > 0) {
        elements->body[cursor->element] = (int)cursor->body;
        oz_elements_set_disc(elements, cursor->element, position, triangle_set->radius, density);
    }
    return OZ_OK;
}

static void end_body(Cursor *cursor, const OzTriangleSet *triangle_set)
{
    cursor->element += triangle_set->triangle_count + (triangle_set->radius > 0);
    cursor->elements->first[++cursor->body] = cursor->element;
}

/* Mass, inertia and orientation of a grain from its elements, and theirs of its motion. */
static void finish_grain(OzGrains *grains, int64_t i, double angle)
{
    const OzElements *elements = grains->elements;
    const double *centre = grains->position + 3 * i, *velocity = grains->velocity + 3 * i;
    double angular_velocity = grains->angular_velocity[3 * i + 2];
    for (int64_t k = elements->first[i]; k < elements->first[i + 1]; k++) {
        double x = elements->position[2 * k] - centre[0];
        double y = elements->position[2 * k + 1] - centre[1];
        grains->mass[i] += elements->mass[k];
        grains->inertia[i] += elements->inertia[k] + elements->mass[k] * (x * x + y * y);
        elements->velocity[2 * k] = velocity[0] - angular_velocity * y;
        elements->velocity[2 * k + 1] = velocity[1] + angular_velocity * x;
        elements->angular_velocity[k] = angular_velocity;
    }
    grains->inertia_axis[i] = grains->inertia[i];
    grains->quaternion[4 * i] = cos(angle / 2);
    grains->quaternion[4 * i + 3] = sin(angle / 2);
}

static OzStatus make_elements(Arrangement *arrangement)
{
    OzGrains *grains = arrangement->grains;
    const OzScene *scene = arrangement->scene;
    const double origin[2] = {0, 0};
    OZ_PASS(create_elements(arrangement));
    Cursor cursor = {.elements = grains->elements};
    for (int64_t i = 0; i < grains->count; i++) {
        const OzTriangleSet *triangle_set = &arrangement->triangle_sets[i];
        OZ_PASS(put_body(&cursor, triangle_set, grains->position + 3 * i, arrangement->angle[i],
                         scene->populations[grains->population[i]].density));
        put_beams(&cursor, triangle_set);
        put_outline(&cursor, triangle_set);
        end_body(&cursor, triangle_set);
        finish_grain(grains, i, arrangement->angle[i]);
    }
    for (int w = 0; w < scene->wall_count; w++) {
        OZ_PASS(put_body(&cursor, &arrangement->walls[w], origin, 0, 0));
        put_outline(&cursor, &arrangement->walls[w]);
        end_body(&cursor, &arrangement->walls[w]);
    }
    return OZ_OK;
}

static OzStatus arrange(Arrangement *arrangement)
{
    const OzScene *scene = arrangement->scene;
    OZ_PASS(OZ_NEW(&arrangement->first, scene->population_count + 1));
    OZ_PASS(count_grains(arrangement));
    int64_t total = arrangement->first[scene->population_count];
    OZ_PASS(oz_grains_create(arrangement->grains, total));
    OZ_PASS(OZ_NEW(&arrangement->triangle_sets, total));
    OZ_PASS(OZ_NEW(&arrangement->angle, total));
    OZ_PASS(OZ_NEW(&arrangement->waiting, total));
    OZ_PASS(OZ_NEW(&arrangement->walls, scene->wall_count));
    OZ_PASS(make_grains(arrangement));
    OZ_PASS(make_walls(arrangement));
    OZ_PASS(place_waiting(arrangement));
    return make_elements(arrangement);
}

OzStatus oz_insert_flat_grains(OzGrains *grains, const OzScene *scene)
{
    Arrangement arrangement = {.scene = scene, .grains = grains};
    memset(grains, 0, sizeof *grains);
    OzStatus status = arrange(&arrangement);
    for (int64_t i = 0; arrangement.triangle_sets && i < grains->count; i++) {
        oz_triangle_set_free(&arrangement.triangle_sets[i]);
    }
    for (int w = 0; arrangement.walls && w < scene->wall_count; w++) {
        oz_triangle_set_free(&arrangement.walls[w]);
    }
    if (status != OZ_OK) {
        oz_grains_free(grains);
    }
    free(arrangement.first);
    free(arrangement.triangle_sets);
    free(arrangement.walls);
    free(arrangement.angle);
    free(arrangement.waiting);
    oz_overlap_grid_free(&arrangement.overlap_grid);
    return status;
}
