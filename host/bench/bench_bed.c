/* Beds for the benchmark. */
#include "bench/bench_bed.h"

#include "base/embed.h"
#include "base/memory.h"
#include "base/random.h"
#include "base/subprocess.h"
#include "model/insert.h"
#include "sim/read_snapshot.h"
#include "sim/settle.h"
#include "sim/sim.h"
#include "scene/wall_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define AN6 "scenes/an6.yaml"

static OzStatus load_scene(OzScene *scene, const OzOptions *options, const char *path)
{
    OzStatus status = OZ_OK;
    char *text = NULL;
    if (path) {
        return oz_scene_load(scene, path, options->settings, options->setting_count);
    }
    OZ_TRY(oz_embed_read(&text, options->source_dir, AN6));
    OZ_TRY(oz_scene_parse(scene, AN6, text, options->settings, options->setting_count));
done:
    free(text);
    return status;
}

OzStatus oz_bench_bed_load(OzBenchBed *bed, const OzOptions *options, const char *path)
{
    OzStatus status = OZ_OK;
    *bed = (OzBenchBed){0};
    OZ_TRY(load_scene(&bed->scene, options, path));
    OZ_TRY(oz_insert_grains(&bed->grains, &bed->scene));
done:
    if (status != OZ_OK) {
        oz_bench_bed_free(bed);
    }
    return status;
}

void oz_bench_bed_free(OzBenchBed *bed)
{
    oz_grains_free(&bed->grains);
    oz_scene_free(&bed->scene);
    *bed = (OzBenchBed){0};
}

/* The first cylinder of a scene; NULL without one. */
static OzWall *find_cylinder(OzScene *scene)
{
    for (int w = 0; w < scene->wall_count; w++) {
        if (oz_wall_shape_is_upright(&scene->walls[w])) {
            return &scene->walls[w];
        }
    }
    return NULL;
}

/* Four planes, width and depth apart, in place of the cylinder, with its contact values. */
static OzStatus wall_in(OzScene *scene, double width, double depth)
{
    static const double normals[4][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    size_t count = (size_t)scene->wall_count;
    OzStatus status =
        oz_memory_grow((void **)&scene->walls, count, count + 3, sizeof(OzWall), "walls");
    OzWall *cylinder = status == OZ_OK ? find_cylinder(scene) : NULL;
    if (!cylinder) {
        return status == OZ_OK ? oz_status_fail(OZ_ERR_INPUT, "%s has no cylinder", scene->path)
                               : status;
    }
    OzWall plane = *cylinder;
    plane.kind = OZ_WALL_PLANE;
    scene->wall_count += 3;
    for (int k = 0; k < 4; k++) {
        OzWall *wall = k == 0 ? cylinder : &scene->walls[count + (size_t)k - 1];
        *wall = plane;
        for (int c = 0; c < 3; c++) {
            wall->normal[c] = normals[k][c];
            wall->point[c] = -normals[k][c] * (c == 0 ? width : depth) / 2;
        }
    }
    return OZ_OK;
}

static OzStatus load_box(OzScene *scene, const OzOptions *options, double *width, double *depth,
                         int64_t count, double shape)
{
    OZ_PASS(load_scene(scene, options, NULL));
    const OzWall *cylinder = find_cylinder(scene);
    double diameter = cylinder ? cylinder->diameter : 0;
    double share = (double)count / (double)scene->populations[0].count;
    double area = 0.25 * 3.14159265358979323846 * diameter * diameter * share;
    *width = sqrt(area * shape);
    *depth = area / *width;
    OZ_PASS(wall_in(scene, *width, *depth));
    scene->populations[0].count = count;
    return OZ_OK;
}

OzStatus oz_bench_bed_box(OzBenchBed *bed, double *side, const OzOptions *options, int64_t count)
{
    OzStatus status = OZ_OK;
    *bed = (OzBenchBed){0};
    OZ_TRY(load_box(&bed->scene, options, side, side, count, 1));
    OZ_TRY(oz_insert_grains(&bed->grains, &bed->scene));
done:
    if (status != OZ_OK) {
        oz_bench_bed_free(bed);
    }
    return status;
}

typedef struct Shake {
    const OzBenchBed *bed;
    const OzOptions *options;
    int first_tap, takes;
    double *states; /* takes x grains x words */
} Shake;

static void put_state(double *words, const OzSnapshot *now)
{
    for (int64_t i = 0; i < now->count; i++, words += OZ_BENCH_BED_WORDS) {
        memcpy(words, &now->position[3 * i], 3 * sizeof *words);
        memcpy(words + 3, &now->quaternion[4 * i], 4 * sizeof *words);
        memcpy(words + 7, &now->velocity[3 * i], 3 * sizeof *words);
        memcpy(words + 10, &now->angular_velocity[3 * i], 3 * sizeof *words);
    }
}

static void take_state(OzGrains *grains, int64_t i, const double *words)
{
    memcpy(&grains->position[3 * i], words, 3 * sizeof *words);
    memcpy(&grains->quaternion[4 * i], words + 3, 4 * sizeof *words);
    memcpy(&grains->velocity[3 * i], words + 7, 3 * sizeof *words);
    memcpy(&grains->angular_velocity[3 * i], words + 10, 3 * sizeof *words);
}

static OzStatus shake(void *context)
{
    OzStatus status = OZ_OK;
    Shake *s = context;
    const OzBenchBed *bed = s->bed;
    OzDevice device = {0};
    OzSim *sim = NULL;
    OzSnapshot now = {0};
    OzMember member = {&bed->scene, &bed->grains};
    double seconds = 0;
    OZ_TRY(oz_device_open(&device, s->options->device, s->options->threads));
    OZ_TRY(oz_sim_create(&sim, &device, &member, 1, s->options->source_dir));
    OZ_TRY(oz_snapshot_create(&now, &bed->scene, &bed->grains));
    OZ_TRY(oz_settle_run(sim, &seconds, NULL, NULL));
    for (int k = 0; k < s->takes; k++) {
        double time = bed->scene.period * (s->first_tap + k);
        OZ_TRY(oz_sim_advance(sim, oz_step_clock_nearest(oz_sim_clock(sim), time)));
        OZ_TRY(oz_read_snapshot_snapshot(sim, 0, &now, false));
        put_state(s->states + (size_t)k * (size_t)now.count * OZ_BENCH_BED_WORDS, &now);
    }
done:
    oz_snapshot_free(&now);
    oz_sim_free(sim);
    oz_device_close(&device);
    return status;
}

/* *states receives the bed at first_tap and at the takes - 1 taps after; the caller frees it. */
static OzStatus shake_bed(OzBenchBed *bed, const OzOptions *options, int first_tap, int takes,
                          double **states)
{
    size_t words = (size_t)bed->grains.count * OZ_BENCH_BED_WORDS;
    OZ_PASS(OZ_NEW(states, words * (size_t)takes));
    Shake s = {bed, options, first_tap, takes, *states};
    OZ_PASS(oz_subprocess_run(shake, &s, *states, words * (size_t)takes * sizeof(double)));
    for (int64_t i = 0; i < bed->grains.count; i++) {
        take_state(&bed->grains, i, *states + (size_t)i * OZ_BENCH_BED_WORDS);
    }
    bed->scene.settle.present = false;
    return OZ_OK;
}

OzStatus oz_bench_bed_settle(OzBenchBed *bed, const OzOptions *options, int taps)
{
    double *states = NULL;
    OzStatus status = shake_bed(bed, options, taps, 1, &states);
    free(states);
    return status;
}

void oz_bench_bed_take(OzBenchBed *bed, const OzBenchBed *from)
{
    size_t count = (size_t)from->grains.count;
    memcpy(bed->grains.position, from->grains.position, 3 * count * sizeof(double));
    memcpy(bed->grains.quaternion, from->grains.quaternion, 4 * count * sizeof(double));
    memcpy(bed->grains.velocity, from->grains.velocity, 3 * count * sizeof(double));
    memcpy(bed->grains.angular_velocity, from->grains.angular_velocity, 3 * count * sizeof(double));
    bed->scene.settle.present = false;
}

OzStatus oz_bench_bed_tile(OzBenchTile *tile, const OzOptions *options, int64_t count)
{
    OzStatus status = OZ_OK;
    *tile = (OzBenchTile){0};
    OZ_TRY(oz_bench_bed_box(&tile->bed, &tile->side, options, count));
    OZ_TRY(shake_bed(&tile->bed, options, OZ_BENCH_BED_TAPS, OZ_BENCH_BED_TAKES, &tile->states));
done:
    if (status != OZ_OK) {
        oz_bench_bed_free_tile(tile);
    }
    return status;
}

void oz_bench_bed_free_tile(OzBenchTile *tile)
{
    oz_bench_bed_free(&tile->bed);
    free(tile->states);
    *tile = (OzBenchTile){0};
}

/* v turned by quarters about z. */
static void turn_vector(double v[3], int quarters)
{
    for (int k = 0; k < quarters; k++) {
        double x = v[0];
        v[0] = -v[1];
        v[1] = x;
    }
}

/* A grain's state turned by quarters about z and moved. */
static void turn_state(double words[OZ_BENCH_BED_WORDS], int quarters, double x, double y)
{
    double half = 0.25 * 3.14159265358979323846 * quarters, c = cos(half), s = sin(half);
    double *q = words + 3, w = q[0], i = q[1], j = q[2], k = q[3];
    q[0] = c * w - s * k;
    q[1] = c * i - s * j;
    q[2] = c * j + s * i;
    q[3] = c * k + s * w;
    turn_vector(words, quarters);
    turn_vector(words + 7, quarters);
    turn_vector(words + 10, quarters);
    words[0] += x;
    words[1] += y;
}

/* One tile into grains first ... of the paved bed. */
static void lay_tile(OzGrains *grains, int64_t first, const OzBenchTile *tile, OzRandom *random,
                     double x, double y)
{
    const OzGrains *from = &tile->bed.grains;
    uint64_t bits = oz_random_bits(random);
    int quarters = (int)(bits & 3), take = (int)((bits >> 2) % OZ_BENCH_BED_TAKES);
    const double *states = tile->states + (size_t)take * (size_t)from->count * OZ_BENCH_BED_WORDS;
    for (int64_t i = 0; i < from->count; i++, states += OZ_BENCH_BED_WORDS) {
        double words[OZ_BENCH_BED_WORDS];
        memcpy(words, states, sizeof words);
        turn_state(words, quarters, x, y);
        take_state(grains, first + i, words);
        grains->diameter[first + i] = from->diameter[i];
        grains->length[first + i] = from->length[i];
        grains->mass[first + i] = from->mass[i];
        grains->inertia[first + i] = from->inertia[i];
        grains->inertia_axis[first + i] = from->inertia_axis[i];
    }
}

/* The largest divisor of count that is not above its root. */
static int64_t near_root(int64_t count)
{
    int64_t divisor = 1;
    for (int64_t d = 1; d * d <= count; d++) {
        divisor = count % d == 0 ? d : divisor;
    }
    return divisor;
}

OzStatus oz_bench_bed_pave(OzBenchBed *bed, const OzBenchTile *tile, const OzOptions *options,
                           int64_t count)
{
    OzStatus status = OZ_OK;
    int64_t size = tile->bed.grains.count, tiles = (count + size / 2) / size;
    tiles = tiles < 1 ? 1 : tiles;
    int64_t deep = near_root(tiles), wide = tiles / deep;
    double width = 0, depth = 0;
    OzRandom random = oz_random_stream(tile->bed.scene.seed, 0);
    *bed = (OzBenchBed){0};
    OZ_TRY(
        load_box(&bed->scene, options, &width, &depth, tiles * size, (double)wide / (double)deep));
    OZ_TRY(oz_grains_create(&bed->grains, tiles * size));
    for (int64_t t = 0; t < tiles; t++) {
        double x = ((double)(t % wide) - 0.5 * (double)(wide - 1)) * tile->side;
        double y = ((double)(t / wide) - 0.5 * (double)(deep - 1)) * tile->side;
        lay_tile(&bed->grains, t * size, tile, &random, x, y);
    }
    bed->scene.settle.present = false;
done:
    if (status != OZ_OK) {
        oz_bench_bed_free(bed);
    }
    return status;
}
