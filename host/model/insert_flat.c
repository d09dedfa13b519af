/* Shapes are made, told places copied, random ones tried until they touch nothing; then all of it
 * becomes elements. Knows neither forces nor devices. */
#include "model/insert_flat.h"

#include "base/memory.h"
#include "model/element_walls.h"
#include "model/fill_region_flat.h"
#include "model/placement.h"
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

typedef struct Arrangement {
    OzPlacement placement;
    OzTriangleSet *triangle_sets; /* of each grain      */
    OzTriangleSet *walls;         /* of each wall       */
    double *angle;                /* rad, of each grain */
    OzFillRegionFlat fill_region;
} Arrangement;

/* Vertices are cut into triangles once, and copied from the population's first grain. */
static OzStatus make_shape(Arrangement *arrangement, int64_t i, const OzPopulation *population)
{
    const OzPlacement *placement = &arrangement->placement;
    OzGrains *grains = placement->grains;
    OzRandom random = oz_placement_stream(placement, i);
    int64_t first = placement->first[grains->population[i]];
    double turn = oz_random_uniform(&random, 0, 2 * PI);
    arrangement->angle[i] = population->kind == OZ_GRAINS_RANDOM ? turn : population->angle;
    OzStatus status =
        population->shape == OZ_SHAPE_VERTICES && i > first
            ? oz_triangle_set_copy(&arrangement->triangle_sets[i],
                                   &arrangement->triangle_sets[first])
            : oz_shape_make(&arrangement->triangle_sets[i], placement->scene, population, &random);
    grains->diameter[i] = 2 * arrangement->triangle_sets[i].reach;
    return status;
}

/* Random grains get their place later. */
static OzStatus make_grain(Arrangement *arrangement, int64_t i)
{
    OzPlacement *placement = &arrangement->placement;
    OzGrains *grains = placement->grains;
    const OzPopulation *population = &placement->scene->populations[grains->population[i]];
    OZ_PASS(make_shape(arrangement, i, population));
    if (population->kind == OZ_GRAINS_RANDOM) {
        placement->waiting[placement->waiting_count++] =
            (OzWaiting){arrangement->triangle_sets[i].reach, i};
    } else {
        oz_placement_put(placement, i, 2);
        grains->angular_velocity[3 * i + 2] = population->angular_velocity[2];
    }
    return OZ_OK;
}

static OzStatus make_walls(Arrangement *arrangement)
{
    const OzGrains *grains = arrangement->placement.grains;
    const OzScene *scene = arrangement->placement.scene;
    double size = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        size = fmax(size, grains->diameter[i]);
    }
    for (int w = 0; w < scene->wall_count; w++) {
        OZ_PASS(oz_element_walls_make(&arrangement->walls[w], &scene->walls[w], size));
    }
    return OZ_OK;
}

static OzCapsule circle_of(const void *own, int64_t i)
{
    const Arrangement *arrangement = own;
    const double *position = &arrangement->placement.grains->position[3 * i];
    return (OzCapsule){.centre = {position[0], position[1]},
                       .radius = arrangement->triangle_sets[i].reach};
}

static void make_region(void *own)
{
    Arrangement *arrangement = own;
    const OzPlacement *placement = &arrangement->placement;
    double area = 0;
    for (int64_t w = 0; w < placement->waiting_count; w++) {
        const OzWaiting *waiting = &placement->waiting[w];
        area += PI * waiting->extent * waiting->extent /
                placement->scene->populations[placement->grains->population[waiting->id]].fill;
    }
    arrangement->fill_region = oz_fill_region_flat_make(placement->scene, arrangement->walls, area,
                                                        placement->waiting[0].extent);
}

static bool try_places(const Arrangement *arrangement, OzRandom *random, OzCapsule *circle)
{
    for (int n = 0; n < TRIES_PER_ROUND; n++) {
        oz_fill_region_flat_draw(&arrangement->fill_region, random, circle->centre);
        if (!oz_overlap_grid_touches(&arrangement->placement.overlap_grid, circle) &&
            oz_fill_region_flat_holds(&arrangement->fill_region, circle->centre, circle->radius)) {
            return true;
        }
    }
    return false;
}

static OzStatus place_grain(void *own, int64_t i, int64_t placed)
{
    Arrangement *arrangement = own;
    OzPlacement *placement = &arrangement->placement;
    OzRandom random = oz_placement_stream(placement, i);
    OzCapsule circle = circle_of(own, i);
    random.counter = PLACE_DRAWS;
    for (int tries = 0; !try_places(arrangement, &random, &circle);) {
        tries += TRIES_PER_ROUND;
        placement->raise_count += oz_fill_region_flat_raise(&arrangement->fill_region);
        if (tries >= TRIES_IN_ALL) {
            return oz_placement_refuse(placement, i, placed);
        }
    }
    memcpy(&placement->grains->position[3 * i], circle.centre, 2 * sizeof(double));
    return oz_overlap_grid_add(&placement->overlap_grid, &circle);
}

static void count_patch(const OzTriangleSet *triangle_set, int64_t *elements, int64_t *outlines)
{
    *elements += triangle_set->triangle_count + (triangle_set->radius > 0);
    *outlines += triangle_set->outline_count;
}

static OzStatus create_elements(Arrangement *arrangement)
{
    const OzScene *scene = arrangement->placement.scene;
    OzGrains *grains = arrangement->placement.grains;
    OzElementCounts counts = {.grains = grains->count, .walls = scene->wall_count};
    for (int64_t i = 0; i < counts.grains; i++) {
        count_patch(&arrangement->triangle_sets[i], &counts.free_elements, &counts.outlines);
        counts.beams += arrangement->triangle_sets[i].joint_count;
    }
    for (int w = 0; w < scene->wall_count; w++) {
        count_patch(&arrangement->walls[w], &counts.wall_elements, &counts.outlines);
    }
    if (counts.free_elements + counts.wall_elements > INT32_MAX / 8) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: %lld triangles; expected at most %d", scene->path,
                              (long long)(counts.free_elements + counts.wall_elements),
                              INT32_MAX / 8);
    }
    return oz_elements_create(&grains->elements, &counts);
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
    OzGrains *grains = arrangement->placement.grains;
    const OzScene *scene = arrangement->placement.scene;
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
    static const OzPlacementWay way = {circle_of, make_region, place_grain, "high"};
    OZ_PASS(oz_placement_create(&arrangement->placement, NULL));
    int64_t total = arrangement->placement.grains->count;
    OZ_PASS(OZ_NEW(&arrangement->triangle_sets, total));
    OZ_PASS(OZ_NEW(&arrangement->angle, total));
    OZ_PASS(OZ_NEW(&arrangement->walls, arrangement->placement.scene->wall_count));
    for (int64_t i = 0; i < total; i++) {
        OZ_PASS(make_grain(arrangement, i));
    }
    OZ_PASS(make_walls(arrangement));
    OZ_PASS(oz_placement_fill(&arrangement->placement, &way, arrangement));
    return make_elements(arrangement);
}

OzStatus oz_insert_flat_grains(OzGrains *grains, const OzScene *scene, OzStage *stage)
{
    Arrangement arrangement = {.placement = {.scene = scene, .grains = grains, .stage = stage}};
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
    free(arrangement.triangle_sets);
    free(arrangement.walls);
    free(arrangement.angle);
    oz_placement_free(&arrangement.placement);
    return status;
}
