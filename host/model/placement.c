/* Populations' numbers, streams and places. Knows no shapes. */
#include "model/placement.h"

#include "base/log.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Grains between words on how far placing is: some milliseconds. */
enum { SAY_EVERY = 1000 };

/* A movie can only follow a grain that there is. */
static OzStatus check_followed(const OzScene *scene, int64_t count)
{
    const OzMovieSettings *movie = &scene->movie;
    if (!movie->has_follow || movie->follow < count) {
        return OZ_OK;
    }
    return oz_status_fail(OZ_ERR_INPUT,
                          "%s: movie.follow is %lld, a grain that is not there; expected 0 to %lld",
                          scene->path, (long long)movie->follow, (long long)count - 1);
}

OzStatus oz_placement_create(OzPlacement *placement, const OzGrains *beds)
{
    const OzScene *scene = placement->scene;
    int64_t total = 0;
    placement->overlap_grid.boundary = &scene->boundary;
    OZ_PASS(OZ_NEW(&placement->first, scene->population_count + 1));
    for (int p = 0; p < scene->population_count; p++) {
        const OzPopulation *population = &scene->populations[p];
        bool is_file = beds && population->kind == OZ_GRAINS_FILE;
        int64_t count = is_file ? beds[p].count : population->count;
        if (count < 0 || count > INT32_MAX - total) {
            return oz_status_fail(OZ_ERR_INPUT,
                                  "%s:%d: too many grains; expected at most %d in all", scene->path,
                                  population->line, INT32_MAX);
        }
        placement->first[p] = total;
        total += count;
    }
    placement->first[scene->population_count] = total;
    OZ_PASS(oz_grains_check_memory(scene->path, total));
    OZ_PASS(check_followed(scene, total));
    OZ_PASS(oz_grains_create(placement->grains, total));
    for (int p = 0; p < scene->population_count; p++) {
        for (int64_t i = placement->first[p]; i < placement->first[p + 1]; i++) {
            placement->grains->population[i] = p;
        }
    }
    return OZ_NEW(&placement->waiting, total);
}

void oz_placement_free(OzPlacement *placement)
{
    free(placement->first);
    free(placement->waiting);
    oz_overlap_grid_free(&placement->overlap_grid);
}

OzRandom oz_placement_stream(const OzPlacement *placement, int64_t i)
{
    int p = placement->grains->population[i];
    uint64_t stream = ((uint64_t)p << 40) + (uint64_t)(i - placement->first[p]);
    return oz_random_stream(placement->scene->seed, stream);
}

void oz_placement_put(const OzPlacement *placement, int64_t i, int axes)
{
    OzGrains *grains = placement->grains;
    const OzPopulation *population = &placement->scene->populations[grains->population[i]];
    int64_t index = i - placement->first[grains->population[i]];
    bool lattice = population->kind == OZ_GRAINS_LATTICE;
    for (int k = 0; k < axes; k++) {
        double cell = lattice ? (double)(index % population->cells[k]) : 0;
        index = lattice ? index / population->cells[k] : 0;
        grains->position[3 * i + k] = population->position[k] + cell * population->spacing[k];
        grains->velocity[3 * i + k] = population->velocity[k];
    }
}

static int compare(const void *left, const void *right)
{
    const OzWaiting *a = left, *b = right;
    if (a->extent != b->extent) {
        return a->extent > b->extent ? -1 : 1;
    }
    return (a->id > b->id) - (a->id < b->id);
}

static OzStatus add_told_grains(OzPlacement *placement, const OzPlacementWay *way, const void *own)
{
    const OzGrains *grains = placement->grains;
    for (int64_t i = 0; i < grains->count; i++) {
        if (placement->scene->populations[grains->population[i]].kind != OZ_GRAINS_RANDOM) {
            OzCapsule capsule = way->capsule(own, i);
            OZ_PASS(oz_overlap_grid_add(&placement->overlap_grid, &capsule));
        }
    }
    return OZ_OK;
}

OzStatus oz_placement_fill(OzPlacement *placement, const OzPlacementWay *way, void *own)
{
    int64_t count = placement->waiting_count;
    if (!count) {
        return OZ_OK;
    }
    OZ_PASS(add_told_grains(placement, way, own));
    qsort(placement->waiting, (size_t)count, sizeof *placement->waiting, compare);
    way->begin(own);
    for (int64_t w = 0; w < count; w++) {
        OZ_PASS(way->place(own, placement->waiting[w].id, w));
        if (w % SAY_EVERY == 0) {
            oz_stage_say(placement->stage, "placing grains: %lld of %lld", (long long)w,
                         (long long)count);
        }
    }
    if (placement->raise_count) {
        oz_log_line("%s: the random grains needed a start column %.3g times as %s as their `fill` "
                    "asks for",
                    placement->scene->path, pow(1.1, (double)placement->raise_count), way->grown);
    }
    return OZ_OK;
}

OzStatus oz_placement_refuse(const OzPlacement *placement, int64_t i, int64_t placed)
{
    int p = placement->grains->population[i];
    return oz_status_fail(OZ_ERR_INPUT,
                          "%s:%d: the random grains do not fit between the walls: %lld of %lld "
                          "found a place; expected fewer or smaller grains, or a larger container",
                          placement->scene->path, placement->scene->populations[p].line,
                          (long long)placed, (long long)placement->waiting_count);
}
