/* A hashed grid for each power of two of the diameter. A member is entered in every cell that its
 * shaft's sample points fall into, so that a cell is never much wider than the grains it lists,
 * however long they are. Hash collisions only cost a distance test. */
#include "model/overlap_grid.h"

#include "base/memory.h"
#include "scene/boundary.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEVEL_COUNT = 64, LEVEL_OF_ONE_METRE = 40 };

/* Points along a shaft, evenly, both ends included. */
typedef struct Samples {
    double first[3], step[3];
    int64_t count;
} Samples;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double clamp(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

/* The farthest of its points from its centre, m. */
static double reach_of(const OzCapsule *capsule)
{
    return sqrt(dot(capsule->half_shaft, capsule->half_shaft)) + capsule->radius;
}

/* The same capsule within the cell of a periodic boundary. */
static OzCapsule wrapped(const OzOverlapGrid *overlap_grid, const OzCapsule *capsule)
{
    OzCapsule here = *capsule;
    if (overlap_grid->boundary) {
        oz_boundary_wrap(overlap_grid->boundary, here.centre);
    }
    return here;
}

/* The class of diameters that starts above half of level_diameter(level). */
static int level_of(double diameter)
{
    int exponent = 0;
    frexp(diameter, &exponent);
    return (int)clamp(exponent + LEVEL_OF_ONE_METRE, 0, LEVEL_COUNT - 1);
}

static double level_diameter(int level)
{
    return ldexp(1, level - LEVEL_OF_ONE_METRE);
}

/* Two diameters: a grain of the level then looks for its like in 2 or 3 cells along each axis. */
static double level_cell(int level)
{
    return 2 * level_diameter(level);
}

/* At most half a cell apart, so that every point of the shaft has one within a quarter of a cell.
 */
static Samples sample_shaft(const OzCapsule *capsule, double cell)
{
    Samples samples;
    double length = 2 * sqrt(dot(capsule->half_shaft, capsule->half_shaft));
    samples.count = (int64_t)ceil(length / (0.5 * cell)) + 1;
    for (int k = 0; k < 3; k++) {
        double divisions = samples.count > 1 ? (double)(samples.count - 1) : 1;
        samples.first[k] = capsule->centre[k] - capsule->half_shaft[k];
        samples.step[k] = 2 * capsule->half_shaft[k] / divisions;
    }
    return samples;
}

static void sample_point(double point[3], const Samples *samples, int64_t i)
{
    for (int k = 0; k < 3; k++) {
        point[k] = samples->first[k] + (double)i * samples->step[k];
    }
}

/* Beyond 1e15 cells all cells are one: slow, never wrong. */
static int64_t cell_of(double coordinate, double cell)
{
    return (int64_t)clamp(floor(coordinate / cell), -1e15, 1e15);
}

static uint64_t hash_of(int level, int64_t x, int64_t y, int64_t z)
{
    uint64_t h = (uint64_t)level * 0x9e3779b97f4a7c15u;
    h = (h ^ (uint64_t)x) * 0xff51afd7ed558ccdu;
    h = ((h ^ (h >> 32)) ^ (uint64_t)y) * 0xc4ceb9fe1a85ec53u;
    h = ((h ^ (h >> 32)) ^ (uint64_t)z) * 0xff51afd7ed558ccdu;
    return h ^ (h >> 32);
}

/* Least squared distance from point + s direction, s in [-1, 1], to the origin. */
static double reach2(const double point[3], const double direction[3])
{
    double length2 = dot(direction, direction);
    double s = length2 > 0 ? clamp(-dot(point, direction) / length2, -1, 1) : 0;
    double nearest[3];
    for (int k = 0; k < 3; k++) {
        nearest[k] = point[k] + s * direction[k];
    }
    return dot(nearest, nearest);
}

/* The squared distance is a convex quadratic on the square of both shaft coordinates: its least
 * value lies on one of the four sides (an end against a shaft) or at the one inner stationary
 * point, and every candidate is a distance that occurs, so near-parallel rounding cannot make it
 * too small. */
double oz_overlap_grid_distance(const OzCapsule *one, const OzCapsule *two)
{
    const double *a = one->half_shaft, *b = two->half_shaft;
    double between[3], side[4][3], best = INFINITY;
    for (int k = 0; k < 3; k++) {
        between[k] = one->centre[k] - two->centre[k];
        side[0][k] = between[k] + a[k];
        side[1][k] = between[k] - a[k];
        side[2][k] = between[k] - b[k];
        side[3][k] = between[k] + b[k];
    }
    for (int i = 0; i < 4; i++) {
        best = fmin(best, reach2(side[i], i < 2 ? b : a));
    }
    double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b);
    double determinant = aa * bb - ab * ab;
    if (determinant > 0) {
        double s = (ab * dot(b, between) - bb * dot(a, between)) / determinant;
        double t = (aa * dot(b, between) - ab * dot(a, between)) / determinant;
        double inner[3];
        for (int k = 0; k < 3; k++) {
            inner[k] = between[k] + clamp(s, -1, 1) * a[k] - clamp(t, -1, 1) * b[k];
        }
        best = fmin(best, dot(inner, inner));
    }
    return sqrt(best);
}

/* The spheres around both are compared first: cheap, and enough for most candidates. */
static bool touching(const OzCapsule *a, const OzCapsule *b)
{
    double between[3];
    for (int k = 0; k < 3; k++) {
        between[k] = a->centre[k] - b->centre[k];
    }
    double contact = a->radius + b->radius;
    double far =
        sqrt(dot(a->half_shaft, a->half_shaft)) + sqrt(dot(b->half_shaft, b->half_shaft)) + contact;
    return dot(between, between) < far * far && oz_overlap_grid_distance(a, b) < contact;
}

static OzStatus grow_heads(OzOverlapGrid *overlap_grid)
{
    int64_t head_count = overlap_grid->head_count ? 2 * overlap_grid->head_count : 1024;
    int64_t *heads;
    OZ_PASS(OZ_NEW(&heads, head_count));
    free(overlap_grid->heads);
    overlap_grid->heads = heads;
    overlap_grid->head_count = head_count;
    memset(heads, 0xff, (size_t)head_count * sizeof *heads);
    for (int64_t i = 0; i < overlap_grid->entry_count; i++) {
        int64_t *head = &heads[overlap_grid->entries[i].hash & (uint64_t)(head_count - 1)];
        overlap_grid->entries[i].next = *head;
        *head = i;
    }
    return OZ_OK;
}

static OzStatus add_entry(OzOverlapGrid *overlap_grid, uint64_t hash)
{
    OZ_PASS(OZ_ROOM(&overlap_grid->entries, &overlap_grid->entry_capacity,
                    overlap_grid->entry_count + 1, "placed grains"));
    if (overlap_grid->entry_count >= overlap_grid->head_count) {
        OZ_PASS(grow_heads(overlap_grid));
    }
    int64_t *head = &overlap_grid->heads[hash & (uint64_t)(overlap_grid->head_count - 1)];
    overlap_grid->entries[overlap_grid->entry_count] =
        (OzOverlapGridEntry){.hash = hash, .member = overlap_grid->count, .next = *head};
    *head = overlap_grid->entry_count++;
    return OZ_OK;
}

/* What decides the size class: the diameter, or for needles a part of the length, so that none is
 * entered in more than some hundred cells. */
static double girth(const OzCapsule *capsule)
{
    double length = 2 * sqrt(dot(capsule->half_shaft, capsule->half_shaft));
    return fmax(2 * capsule->radius, length / 256);
}

OzStatus oz_overlap_grid_add(OzOverlapGrid *overlap_grid, const OzCapsule *capsule)
{
    OzCapsule here = wrapped(overlap_grid, capsule);
    int level = level_of(girth(capsule));
    double cell = level_cell(level), point[3];
    Samples samples = sample_shaft(&here, cell);
    uint64_t last = 0;
    OZ_PASS(OZ_ROOM(&overlap_grid->members, &overlap_grid->capacity, overlap_grid->count + 1,
                    "placed grains"));
    for (int64_t i = 0; i < samples.count; i++) {
        sample_point(point, &samples, i);
        uint64_t hash = hash_of(level, cell_of(point[0], cell), cell_of(point[1], cell),
                                cell_of(point[2], cell));
        if (i == 0 || hash != last) {
            OZ_PASS(add_entry(overlap_grid, hash));
        }
        last = hash;
    }
    overlap_grid->reach_max = fmax(overlap_grid->reach_max, reach_of(capsule));
    overlap_grid->members[overlap_grid->count++] = here;
    overlap_grid->levels |= (uint64_t)1 << level;
    return OZ_OK;
}

static bool cell_touches(const OzOverlapGrid *overlap_grid, uint64_t hash, const OzCapsule *capsule)
{
    int64_t i = overlap_grid->heads[hash & (uint64_t)(overlap_grid->head_count - 1)];
    for (; i >= 0; i = overlap_grid->entries[i].next) {
        if (overlap_grid->entries[i].hash == hash &&
            touching(&overlap_grid->members[overlap_grid->entries[i].member], capsule)) {
            return true;
        }
    }
    return false;
}

static bool cells_touch(const OzOverlapGrid *overlap_grid, int level, const double point[3],
                        double reach, const OzCapsule *capsule)
{
    int64_t low[3], high[3];
    for (int k = 0; k < 3; k++) {
        low[k] = cell_of(point[k] - reach, level_cell(level));
        high[k] = cell_of(point[k] + reach, level_cell(level));
    }
    for (int64_t x = low[0]; x <= high[0]; x++) {
        for (int64_t y = low[1]; y <= high[1]; y++) {
            for (int64_t z = low[2]; z <= high[2]; z++) {
                if (cell_touches(overlap_grid, hash_of(level, x, y, z), capsule)) {
                    return true;
                }
            }
        }
    }
    return false;
}

/* The closest points of touching shafts are at most both radii apart. The shortest way between them
 * is across a shaft unless it starts at its end, and ends are samples: so the samples nearest to
 * them, each within a quarter cell along its shaft, are further apart by Pythagoras only. */
static bool level_touches(const OzOverlapGrid *overlap_grid, int level, const OzCapsule *capsule)
{
    double cell = level_cell(level), point[3];
    double reach = hypot(capsule->radius + 0.5 * level_diameter(level), 0.5 * cell);
    Samples samples = sample_shaft(capsule, cell);
    for (int64_t i = 0; i < samples.count; i++) {
        sample_point(point, &samples, i);
        if (cells_touch(overlap_grid, level, point, reach, capsule)) {
            return true;
        }
    }
    return false;
}

static bool image_touches(const OzOverlapGrid *overlap_grid, const OzCapsule *capsule)
{
    for (int level = 0; level < LEVEL_COUNT; level++) {
        if ((overlap_grid->levels >> level & 1) && level_touches(overlap_grid, level, capsule)) {
            return true;
        }
    }
    return false;
}

/* A capsule's images that may reach into the cell, from one axis on. */
static bool images_touch(const OzOverlapGrid *overlap_grid, const OzCapsule *capsule, int axis)
{
    double period = axis < 3 ? oz_boundary_period(overlap_grid->boundary, axis) : 0;
    double far = overlap_grid->reach_max + reach_of(capsule);
    if (axis == 3) {
        return image_touches(overlap_grid, capsule);
    }
    for (int cells = -1; cells <= 1; cells++) {
        OzCapsule image = *capsule;
        image.centre[axis] += cells * period;
        bool meets = period > 0 && fabs(image.centre[axis]) < period / 2 + far;
        if ((cells == 0 || meets) && images_touch(overlap_grid, &image, axis + 1)) {
            return true;
        }
    }
    return false;
}

bool oz_overlap_grid_touches(const OzOverlapGrid *overlap_grid, const OzCapsule *capsule)
{
    OzCapsule here = wrapped(overlap_grid, capsule);
    if (!overlap_grid->boundary || !overlap_grid->boundary->present) {
        return image_touches(overlap_grid, capsule);
    }
    return images_touch(overlap_grid, &here, 0);
}

void oz_overlap_grid_free(OzOverlapGrid *overlap_grid)
{
    free(overlap_grid->members);
    free(overlap_grid->entries);
    free(overlap_grid->heads);
    memset(overlap_grid, 0, sizeof *overlap_grid);
}
