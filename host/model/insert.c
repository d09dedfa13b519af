/* Populations become grains: sizes are drawn, told positions copied, random grains tried until they
 * touch nothing. Knows neither forces nor devices. */
#include "model/insert.h"

#include "base/memory.h"
#include "model/fill_region.h"
#include "model/insert_flat.h"
#include "model/placement.h"
#include "model/restart_csv.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Values that a grain's stream gives before its direction: diameter and aspect. */
enum { SIZE_DRAWS = 2 };

/* Where the numbers for its velocity begin: no grain tries so many places. */
enum { VELOCITY_DRAWS = 1 << 30 };

/* Directions drawn until one fits the empty container. A tube a thousandth as wide as the rod is
 * long admits about one in two million; narrower ones are refused. */
enum { TURN_LIMIT = 20000000 };

/* Positions tried before the column grows or another direction is drawn. At the density where
 * random rods of aspect 4 jam (a third of the volume) an accepted one has needed a few hundred. */
enum { TRIES_PER_ROUND = 2000 };

/* Rounds for one grain between walls on all sides, where nothing can grow. */
enum { ROUND_LIMIT = 20 };

typedef struct Rods {
    OzPlacement placement;
    OzGrains *beds; /* one for each population, empty but for files */
    OzFillRegion fill_region;
    int64_t tries_left;
} Rods;

static OzStatus read_bed(OzGrains *bed, const OzScene *scene, const OzPopulation *population)
{
    char *reason = NULL;
    OzStatus status = oz_restart_csv_read(bed, population->path);
    if (status == OZ_OK || oz_memory_text(&reason, oz_status_text()) != OZ_OK) {
        return status;
    }
    oz_status_fail(OZ_ERR_INPUT, "%s:%d: the grains' file cannot be used: %s", scene->path,
                   population->line, reason);
    free(reason);
    return OZ_ERR_INPUT;
}

static void draw_size(const OzPlacement *placement, int64_t i, const OzPopulation *population)
{
    OzGrains *grains = placement->grains;
    OzRandom random = oz_placement_stream(placement, i);
    grains->diameter[i] =
        oz_random_uniform(&random, population->diameter.low, population->diameter.high);
    grains->length[i] = grains->diameter[i] *
                        oz_random_uniform(&random, population->aspect.low, population->aspect.high);
    oz_grains_set_mass(grains, i, population->density);
}

static void copy_bed(OzGrains *grains, int64_t first, const OzGrains *bed)
{
    size_t scalars = (size_t)bed->count * sizeof(double);
    memcpy(&grains->diameter[first], bed->diameter, scalars);
    memcpy(&grains->length[first], bed->length, scalars);
    memcpy(&grains->mass[first], bed->mass, scalars);
    memcpy(&grains->inertia[first], bed->inertia, scalars);
    memcpy(&grains->inertia_axis[first], bed->inertia_axis, scalars);
    memcpy(&grains->position[3 * first], bed->position, 3 * scalars);
    memcpy(&grains->quaternion[4 * first], bed->quaternion, 4 * scalars);
    memcpy(&grains->velocity[3 * first], bed->velocity, 3 * scalars);
    memcpy(&grains->angular_velocity[3 * first], bed->angular_velocity, 3 * scalars);
}

static void make_population(Rods *rods, int p)
{
    OzPlacement *placement = &rods->placement;
    const OzPopulation *population = &placement->scene->populations[p];
    OzGrains *grains = placement->grains;
    if (population->kind == OZ_GRAINS_FILE) {
        copy_bed(grains, placement->first[p], &rods->beds[p]);
        return;
    }
    for (int64_t i = placement->first[p]; i < placement->first[p + 1]; i++) {
        draw_size(placement, i, population);
        if (population->kind == OZ_GRAINS_RANDOM) {
            placement->waiting[placement->waiting_count++] =
                (OzWaiting){grains->diameter[i] + grains->length[i], i};
        } else {
            oz_placement_put(placement, i, 3);
            memcpy(&grains->angular_velocity[3 * i], population->angular_velocity,
                   3 * sizeof *grains->angular_velocity);
            oz_grains_quaternion(population->axis, &grains->quaternion[4 * i]);
        }
    }
}

static OzCapsule capsule_of(const OzGrains *grains, int64_t i, const double axis[3])
{
    OzCapsule capsule = {.radius = 0.5 * grains->diameter[i]};
    for (int k = 0; k < 3; k++) {
        capsule.centre[k] = grains->position[3 * i + k];
        capsule.half_shaft[k] = 0.5 * grains->length[i] * axis[k];
    }
    return capsule;
}

static OzCapsule told_capsule(const void *own, int64_t i)
{
    const OzGrains *grains = ((const Rods *)own)->placement.grains;
    double axis[3];
    oz_grains_axis(&grains->quaternion[4 * i], axis);
    return capsule_of(grains, i, axis);
}

static void make_column(void *own)
{
    Rods *rods = own;
    const OzPlacement *placement = &rods->placement;
    const OzGrains *grains = placement->grains;
    double volume = 0, extent = 0;
    for (int64_t w = 0; w < placement->waiting_count; w++) {
        int64_t i = placement->waiting[w].id;
        double fill = placement->scene->populations[grains->population[i]].fill;
        volume += oz_grains_volume(grains->diameter[i], grains->length[i]) / fill;
        extent = fmax(extent, placement->waiting[w].extent);
    }
    /* A hundredth to spare, so that one grain has somewhere to go. */
    rods->fill_region = oz_fill_region_make(placement->scene, volume, 1.01 * extent);
    rods->tries_left = 1000000 + 300 * placement->waiting_count;
}

/* Draws directions until one fits into the empty container. */
static bool turn(const Rods *rods, OzRandom *random, int64_t i, OzCapsule *capsule, double axis[3])
{
    for (int64_t n = 0; n < TURN_LIMIT; n++) {
        oz_random_direction(random, axis);
        *capsule = capsule_of(rods->placement.grains, i, axis);
        if (oz_fill_region_admits(&rods->fill_region, capsule)) {
            return true;
        }
    }
    return false;
}

static bool try_positions(Rods *rods, OzRandom *random, OzCapsule *capsule)
{
    for (int n = 0; n < TRIES_PER_ROUND && rods->tries_left > 0; n++) {
        rods->tries_left--;
        oz_fill_region_draw(&rods->fill_region, random, capsule);
        if (oz_fill_region_holds(&rods->fill_region, capsule) &&
            !oz_overlap_grid_touches(&rods->placement.overlap_grid, capsule)) {
            return true;
        }
    }
    return false;
}

static OzStatus refuse_grain(const OzPlacement *placement, int64_t i)
{
    const OzGrains *grains = placement->grains;
    return oz_status_fail(OZ_ERR_INPUT,
                          "%s:%d: a grain of diameter %g m and shaft length %g m fits nowhere "
                          "between the walls; expected smaller grains or a wider container",
                          placement->scene->path,
                          placement->scene->populations[grains->population[i]].line,
                          grains->diameter[i], grains->length[i]);
}

static OzStatus place_grain(void *own, int64_t i, int64_t placed)
{
    Rods *rods = own;
    OzPlacement *placement = &rods->placement;
    OzGrains *grains = placement->grains;
    OzRandom random = oz_placement_stream(placement, i);
    OzCapsule capsule;
    double axis[3];
    random.counter = SIZE_DRAWS;
    for (int round = 1;; round++) {
        if (!turn(rods, &random, i, &capsule, axis)) {
            return refuse_grain(placement, i);
        }
        if (try_positions(rods, &random, &capsule)) {
            break;
        }
        bool raised = oz_fill_region_raise(&rods->fill_region);
        placement->raise_count += raised;
        if (rods->tries_left <= 0 || (!raised && round == ROUND_LIMIT)) {
            return oz_placement_refuse(placement, i, placed);
        }
    }
    memcpy(&grains->position[3 * i], capsule.centre, sizeof capsule.centre);
    oz_grains_quaternion(axis, &grains->quaternion[4 * i]);
    return oz_overlap_grid_add(&placement->overlap_grid, &capsule);
}

/* Throws a population's grains in all directions, all together in none. */
static void throw_population(Rods *rods, int p)
{
    OzPlacement *placement = &rods->placement;
    const int64_t *first = placement->first;
    double *velocity = placement->grains->velocity, momentum[3] = {0}, mass = 0;
    for (int64_t i = first[p]; i < first[p + 1]; i++) {
        OzRandom random = oz_placement_stream(placement, i);
        random.counter = VELOCITY_DRAWS;
        mass += placement->grains->mass[i];
        for (int k = 0; k < 3; k++) {
            velocity[3 * i + k] =
                placement->scene->populations[p].velocity_spread * oz_random_normal(&random);
            momentum[k] += placement->grains->mass[i] * velocity[3 * i + k];
        }
    }
    for (int64_t i = 3 * first[p]; i < 3 * first[p + 1]; i++) {
        velocity[i] -= momentum[i % 3] / mass;
    }
}

static OzStatus make_grains(Rods *rods)
{
    static const OzPlacementWay way = {told_capsule, make_column, place_grain, "large"};
    const OzScene *scene = rods->placement.scene;
    OZ_PASS(OZ_NEW(&rods->beds, scene->population_count));
    for (int p = 0; p < scene->population_count; p++) {
        if (scene->populations[p].kind == OZ_GRAINS_FILE) {
            OZ_PASS(read_bed(&rods->beds[p], scene, &scene->populations[p]));
        }
    }
    OZ_PASS(oz_placement_create(&rods->placement, rods->beds));
    for (int p = 0; p < scene->population_count; p++) {
        make_population(rods, p);
        if (scene->populations[p].velocity_spread > 0) {
            throw_population(rods, p);
        }
    }
    return oz_placement_fill(&rods->placement, &way, rods);
}

static OzStatus place_rods(OzGrains *grains, const OzScene *scene, OzStage *stage)
{
    Rods rods = {.placement = {.scene = scene, .grains = grains, .stage = stage}};
    memset(grains, 0, sizeof *grains);
    OzStatus status = make_grains(&rods);
    for (int p = 0; rods.beds && p < scene->population_count; p++) {
        oz_grains_free(&rods.beds[p]);
    }
    if (status != OZ_OK) {
        oz_grains_free(grains);
    }
    free(rods.beds);
    oz_placement_free(&rods.placement);
    return status;
}

OzStatus oz_insert_grains(OzGrains *grains, const OzScene *scene)
{
    OzStage stage;
    oz_stage_begin(&stage, "placing grains");
    OzStatus status = scene->model == OZ_MODEL_TRIGRAINS
                          ? oz_insert_flat_grains(grains, scene, &stage)
                          : place_rods(grains, scene, &stage);
    oz_stage_end(&stage);
    return status;
}
