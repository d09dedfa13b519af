/* Populations become grains: sizes are drawn, told positions copied, random grains tried until they
 * touch nothing. Knows neither forces nor devices. */
#include "model/insert.h"

#include "base/log.h"
#include "base/memory.h"
#include "base/random.h"
#include "base/stage.h"
#include "model/fill_region.h"
#include "model/insert_flat.h"
#include "model/overlap_grid.h"
#include "model/restart_csv.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Values that a grain's stream gives before its direction: diameter and aspect. */
enum { SIZE_DRAWS = 2 };

/* Directions drawn until one fits the empty container. A tube a thousandth as wide as the rod is
 * long admits about one in two million; narrower ones are refused. */
enum { TURN_LIMIT = 20000000 };

/* Positions tried before the column grows or another direction is drawn. At the density where
 * random rods of aspect 4 jam (a third of the volume) an accepted one has needed a few hundred. */
enum { TRIES_PER_ROUND = 2000 };

/* Rounds for one grain between walls on all sides, where nothing can grow. */
enum { ROUND_LIMIT = 20 };

/* Grains between words on how far placing is: some milliseconds. */
enum { SAY_EVERY = 1000 };

/* A grain waiting for its place. */
typedef struct Waiting {
    double extent; /* m, shaft and caps */
    int64_t id;
} Waiting;

typedef struct Placement {
    const OzScene *scene;
    OzGrains *grains;
    OzGrains *beds; /* one for each population, empty but for files */
    int64_t *first; /* id of each population's first grain          */
    Waiting *waiting;
    int64_t waiting_count;
    OzFillRegion fill_region;
    OzOverlapGrid overlap_grid;
    int64_t tries_left, raise_count;
    OzStage *stage;
} Placement;

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

/* Reads the files, finds each population's ids and the number of grains. */
static OzStatus count_grains(Placement *place, int64_t *total)
{
    const OzScene *scene = place->scene;
    *total = 0;
    for (int p = 0; p < scene->population_count; p++) {
        const OzPopulation *population = &scene->populations[p];
        int64_t count = population->count;
        if (population->kind == OZ_GRAINS_FILE) {
            OZ_PASS(read_bed(&place->beds[p], scene, population));
            count = place->beds[p].count;
        }
        if (count < 0 || count > INT32_MAX - *total) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "%s:%d: too many grains; expected at most %d in all", scene->path,
                                  population->line, INT32_MAX);
        }
        place->first[p] = *total;
        *total += count;
    }
    return OZ_OK;
}

static OzRandom grain_stream(const Placement *place, int64_t i)
{
    int p = place->grains->population[i];
    uint64_t stream = ((uint64_t)p << 40) + (uint64_t)(i - place->first[p]);
    return oz_random_stream(place->scene->seed, stream);
}

static void draw_size(Placement *place, int64_t i, const OzPopulation *population)
{
    OzGrains *grains = place->grains;
    OzRandom random = grain_stream(place, i);
    grains->diameter[i] =
        oz_random_uniform(&random, population->diameter.low, population->diameter.high);
    grains->length[i] = grains->diameter[i] *
                        oz_random_uniform(&random, population->aspect.low, population->aspect.high);
    oz_grains_set_mass(grains, i, population->density);
}

/* Position (in the lattice), direction and motion as written; random grains get their place later.
 */
static void put_as_told(OzGrains *grains, int64_t i, const OzPopulation *population, int64_t index)
{
    bool lattice = population->kind == OZ_GRAINS_LATTICE;
    for (int k = 0; k < 3; k++) {
        double cell = lattice ? (double)(index % population->cells[k]) : 0;
        index = lattice ? index / population->cells[k] : 0;
        grains->position[3 * i + k] = population->position[k] + cell * population->spacing[k];
        grains->velocity[3 * i + k] = population->velocity[k];
        grains->angular_velocity[3 * i + k] = population->angular_velocity[k];
    }
    oz_grains_quaternion(population->axis, &grains->quaternion[4 * i]);
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

static void make_population(Placement *place, int p, int64_t count)
{
    const OzPopulation *population = &place->scene->populations[p];
    OzGrains *grains = place->grains;
    for (int64_t i = place->first[p]; i < place->first[p] + count; i++) {
        grains->population[i] = p;
        if (population->kind == OZ_GRAINS_RANDOM) {
            draw_size(place, i, population);
            place->waiting[place->waiting_count++] =
                (Waiting){grains->diameter[i] + grains->length[i], i};
        } else if (population->kind != OZ_GRAINS_FILE) {
            draw_size(place, i, population);
            put_as_told(grains, i, population, i - place->first[p]);
        }
    }
    if (population->kind == OZ_GRAINS_FILE) {
        copy_bed(grains, place->first[p], &place->beds[p]);
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

static OzStatus add_told_grains(Placement *place)
{
    const OzGrains *grains = place->grains;
    for (int64_t i = 0; i < grains->count; i++) {
        if (place->scene->populations[grains->population[i]].kind == OZ_GRAINS_RANDOM) {
            continue;
        }
        double axis[3];
        oz_grains_axis(&grains->quaternion[4 * i], axis);
        OzCapsule capsule = capsule_of(grains, i, axis);
        OzStatus status = oz_overlap_grid_add(&place->overlap_grid, &capsule);
        if (status != OZ_OK) {
            return status;
        }
    }
    return OZ_OK;
}

/* The longest first: they need the most room, and short ones still fit between them. */
static int compare_waiting(const void *left, const void *right)
{
    const Waiting *a = left, *b = right;
    if (a->extent != b->extent) {
        return a->extent > b->extent ? -1 : 1;
    }
    return a->id < b->id ? -1 : a->id > b->id;
}

static void make_column(Placement *place)
{
    double volume = 0, extent = 0;
    for (int64_t w = 0; w < place->waiting_count; w++) {
        int64_t i = place->waiting[w].id;
        const OzGrains *grains = place->grains;
        double fill = place->scene->populations[grains->population[i]].fill;
        volume += oz_grains_volume(grains->diameter[i], grains->length[i]) / fill;
        extent = fmax(extent, place->waiting[w].extent);
    }
    /* A hundredth to spare, so that one grain has somewhere to go. */
    place->fill_region = oz_fill_region_make(place->scene, volume, 1.01 * extent);
}

/* Draws directions until one fits into the empty container. */
static bool turn(Placement *place, OzRandom *random, int64_t i, OzCapsule *capsule, double axis[3])
{
    for (int64_t n = 0; n < TURN_LIMIT; n++) {
        oz_random_direction(random, axis);
        *capsule = capsule_of(place->grains, i, axis);
        if (oz_fill_region_admits(&place->fill_region, capsule)) {
            return true;
        }
    }
    return false;
}

static bool try_positions(Placement *place, OzRandom *random, OzCapsule *capsule)
{
    for (int n = 0; n < TRIES_PER_ROUND && place->tries_left > 0; n++) {
        place->tries_left--;
        oz_fill_region_draw(&place->fill_region, random, capsule);
        if (oz_fill_region_holds(&place->fill_region, capsule) &&
            !oz_overlap_grid_touches(&place->overlap_grid, capsule)) {
            return true;
        }
    }
    return false;
}

static OzStatus refuse_grain(const Placement *place, int64_t i)
{
    const OzGrains *grains = place->grains;
    return oz_status_fail(OZ_ERR_INPUT,
                          "%s:%d: a grain of diameter %g m and shaft length %g m fits nowhere "
                          "between the walls; expected smaller grains or a wider container",
                          place->scene->path, place->scene->populations[grains->population[i]].line,
                          grains->diameter[i], grains->length[i]);
}

static OzStatus refuse_crowding(const Placement *place, int64_t i, int64_t placed)
{
    int p = place->grains->population[i];
    return oz_status_fail(OZ_ERR_INPUT,
                          "%s:%d: the random grains do not fit between the walls: %lld of %lld "
                          "found a place; expected fewer or smaller grains, or a larger container",
                          place->scene->path, place->scene->populations[p].line, (long long)placed,
                          (long long)place->waiting_count);
}

static OzStatus place_grain(Placement *place, int64_t i, int64_t placed)
{
    OzGrains *grains = place->grains;
    OzRandom random = grain_stream(place, i);
    OzCapsule capsule;
    double axis[3];
    random.counter = SIZE_DRAWS;
    for (int round = 1;; round++) {
        if (!turn(place, &random, i, &capsule, axis)) {
            return refuse_grain(place, i);
        }
        if (try_positions(place, &random, &capsule)) {
            break;
        }
        bool raised = oz_fill_region_raise(&place->fill_region);
        place->raise_count += raised;
        if (place->tries_left <= 0 || (!raised && round == ROUND_LIMIT)) {
            return refuse_crowding(place, i, placed);
        }
    }
    memcpy(&grains->position[3 * i], capsule.centre, sizeof capsule.centre);
    oz_grains_quaternion(axis, &grains->quaternion[4 * i]);
    return oz_overlap_grid_add(&place->overlap_grid, &capsule);
}

static OzStatus place_waiting(Placement *place)
{
    int64_t count = place->waiting_count;
    if (!count) {
        return OZ_OK;
    }
    OZ_PASS(add_told_grains(place));
    qsort(place->waiting, (size_t)count, sizeof *place->waiting, compare_waiting);
    make_column(place);
    place->tries_left = 1000000 + 300 * count;
    for (int64_t w = 0; w < count; w++) {
        OZ_PASS(place_grain(place, place->waiting[w].id, w));
        if (w % SAY_EVERY == 0) {
            oz_stage_say(place->stage, "placing grains: %lld of %lld", (long long)w,
                         (long long)count);
        }
    }
    if (place->raise_count) {
        oz_log_line("%s: the random grains needed a start column %.3g times as large as their "
                    "`fill` asks for",
                    place->scene->path, pow(1.1, (double)place->raise_count));
    }
    return OZ_OK;
}

static OzStatus make_grains(Placement *place)
{
    const OzScene *scene = place->scene;
    int64_t total = 0;
    OZ_PASS(OZ_NEW(&place->beds, scene->population_count));
    OZ_PASS(OZ_NEW(&place->first, scene->population_count));
    OZ_PASS(count_grains(place, &total));
    OZ_PASS(oz_grains_check_memory(scene->path, total));
    OZ_PASS(oz_grains_create(place->grains, total));
    OZ_PASS(OZ_NEW(&place->waiting, total));
    for (int p = 0; p < scene->population_count; p++) {
        bool last = p + 1 == scene->population_count;
        make_population(place, p, (last ? total : place->first[p + 1]) - place->first[p]);
    }
    return place_waiting(place);
}

static OzStatus place_rods(OzGrains *grains, const OzScene *scene, OzStage *stage)
{
    Placement place = {.scene = scene, .grains = grains, .stage = stage};
    memset(grains, 0, sizeof *grains);
    OzStatus status = make_grains(&place);
    for (int p = 0; place.beds && p < scene->population_count; p++) {
        oz_grains_free(&place.beds[p]);
    }
    if (status != OZ_OK) {
        oz_grains_free(grains);
    }
    free(place.beds);
    free(place.first);
    free(place.waiting);
    oz_overlap_grid_free(&place.overlap_grid);
    return status;
}

OzStatus oz_insert_grains(OzGrains *grains, const OzScene *scene)
{
    OzStage stage;
    oz_stage_begin(&stage, "placing grains");
    OzStatus status = scene->model == OZ_MODEL_TRIGRAINS ? oz_insert_flat_grains(grains, scene)
                                                         : place_rods(grains, scene, &stage);
    oz_stage_end(&stage);
    return status;
}
