/* Densities, angles and order of a bed, as physics.md 1.6 (Pournin et al. 2005, section 4) defines
 * them. Knows nothing of files, rows or tap means. */
#include "observe/measure.h"

#include "base/memory.h"
#include "observe/basin.h"
#include "observe/clip.h"
#include "scene/wall_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double DEGREES = 57.29577951308232;
/* The share of the volume that counts as outliers; the slack keeps 50 equal grains of 1000 within
 * it whatever the rounding of their sum. */
static const double OUTLIERS = 0.05, OUTLIERS_SLACK = 1 + 1e-9;
/* The slab leaves out the ordered floor layer and, in the paper's bed, the loose top. */
static const double SLAB_LOW = 2e-3, SLAB_HIGH = 10e-3;

OzStatus oz_measure_create(OzMeasure *measure, const OzScene *scene, const OzGrains *grains)
{
    OzStatus status = OZ_OK;
    memset(measure, 0, sizeof *measure);
    measure->floor = oz_basin_floor(scene);
    measure->area = oz_basin_area(scene);
    int64_t most = grains->elements ? grains->elements->free_count : grains->count; /* in pieces */
    OZ_TRY(OZ_NEW(&measure->volume, most));
    OZ_TRY(OZ_NEW(&measure->heap, most));
    OZ_TRY(OZ_NEW(&measure->top, most));
    for (int64_t i = 0; i < grains->count; i++) {
        measure->volume[i] = oz_grains_volume(grains->diameter[i], grains->length[i]);
        measure->total += measure->volume[i];
        measure->mass += grains->mass[i];
    }
done:
    if (status != OZ_OK) {
        oz_measure_free(measure);
    }
    return status;
}

void oz_measure_free(OzMeasure *measure)
{
    free(measure->volume);
    free(measure->heap);
    free(measure->top);
    memset(measure, 0, sizeof *measure);
}

static double floor_height(const OzMeasure *measure, const OzSnapshot *snapshot)
{
    int w = measure->floor;
    double shift[3];
    oz_wall_shape_shift(&snapshot->scene->walls[w], snapshot->wall_offset[w], shift);
    return oz_basin_bottom(&snapshot->scene->walls[w]) + shift[2];
}

/* Sinks heap[root] until no grain below it is higher. */
static void sink(int64_t *heap, const double *top, int64_t count, int64_t root)
{
    int64_t grain = heap[root];
    for (int64_t child = 2 * root + 1; child < count; child = 2 * root + 1) {
        if (child + 1 < count && top[heap[child + 1]] > top[heap[child]]) {
            child++;
        }
        if (top[heap[child]] <= top[grain]) {
            break;
        }
        heap[root] = heap[child];
        root = child;
    }
    heap[root] = grain;
}

static void order_by_top(OzMeasure *measure, const OzSnapshot *snapshot)
{
    const OzGrains *grains = snapshot->grains;
    for (int64_t i = 0; i < snapshot->count; i++) {
        double rise =
            (grains->length[i] * fabs(snapshot->axis[3 * i + 2]) + grains->diameter[i]) / 2;
        measure->top[i] = snapshot->position[3 * i + 2] + rise;
        measure->heap[i] = i;
    }
    for (int64_t root = snapshot->count / 2 - 1; root >= 0; root--) {
        sink(measure->heap, measure->top, snapshot->count, root);
    }
}

static bool find_height(OzMeasure *measure, const OzSnapshot *snapshot, double *value)
{
    int64_t count = snapshot->count, *heap = measure->heap;
    if (count == 0 || measure->floor < 0) {
        return false;
    }
    order_by_top(measure, snapshot);
    double budget = OUTLIERS * OUTLIERS_SLACK * measure->total;
    while (count > 1 && measure->volume[heap[0]] <= budget) {
        budget -= measure->volume[heap[0]];
        heap[0] = heap[--count];
        sink(heap, measure->top, count, 0);
    }
    *value = measure->top[heap[0]] - floor_height(measure, snapshot);
    return true;
}

/* total / (area x height); a bed that is not above its floor has no density. */
static bool fill_fraction(const OzMeasure *measure, double height, double *value)
{
    *value = measure->total / (measure->area * height);
    return measure->area > 0 && !(height <= 0);
}

bool oz_measure_density_all(OzMeasure *measure, const OzSnapshot *snapshot, double *value)
{
    double height = 0;
    return measure->area > 0 && find_height(measure, snapshot, &height) &&
           fill_fraction(measure, height, value);
}

double oz_measure_density_of_all(double all)
{
    return (1 - OUTLIERS) * all;
}

bool oz_measure_density(OzMeasure *measure, const OzSnapshot *snapshot, double *value)
{
    double all = 0;
    bool present = oz_measure_density_all(measure, snapshot, &all);
    *value = oz_measure_density_of_all(all);
    return present;
}

bool oz_measure_density_com(const OzMeasure *measure, const OzSnapshot *snapshot, double *value)
{
    double moment = 0;
    if (snapshot->count == 0 || measure->floor < 0) {
        return false;
    }
    for (int64_t i = 0; i < snapshot->count; i++) {
        moment += snapshot->grains->mass[i] * snapshot->position[3 * i + 2];
    }
    double centre = moment / measure->mass - floor_height(measure, snapshot);
    return fill_fraction(measure, 2 * centre, value);
}

bool oz_measure_density_slab(const OzMeasure *measure, const OzSnapshot *snapshot, double *value)
{
    const OzGrains *grains = snapshot->grains;
    double volume = 0;
    if (measure->area == 0 || measure->floor < 0) {
        return false;
    }
    double floor_z = floor_height(measure, snapshot);
    for (int64_t i = 0; i < snapshot->count; i++) {
        double d = grains->diameter[i], l = grains->length[i], axis_z = snapshot->axis[3 * i + 2];
        double below = floor_z - snapshot->position[3 * i + 2];
        volume += oz_clip_below(d, l, axis_z, below + SLAB_HIGH) -
                  oz_clip_below(d, l, axis_z, below + SLAB_LOW);
    }
    *value = volume / (measure->area * (SLAB_HIGH - SLAB_LOW));
    return true;
}

/* Degrees between an axis and the floor; the arc tangent keeps upright rods exact, where the arc
 * sine of a rounded axis would not. */
static double angle_to_floor(const double axis[3])
{
    return DEGREES * atan2(fabs(axis[2]), sqrt(axis[0] * axis[0] + axis[1] * axis[1]));
}

bool oz_measure_angle(const OzSnapshot *snapshot, double *value)
{
    double sum = 0;
    int64_t rods = 0;
    for (int64_t i = 0; i < snapshot->count; i++) {
        if (snapshot->grains->length[i] > 0) {
            sum += angle_to_floor(&snapshot->axis[3 * i]);
            rods++;
        }
    }
    *value = rods > 0 ? sum / (double)rods : 0;
    return rods > 0;
}

void oz_measure_layers(const OzMeasure *measure, const OzSnapshot *snapshot,
                       OzLayer layers[OZ_MEASURE_LAYERS])
{
    memset(layers, 0, OZ_MEASURE_LAYERS * sizeof *layers);
    if (measure->floor < 0) {
        return;
    }
    double bottom = oz_basin_bottom(&snapshot->scene->walls[measure->floor]);
    for (int64_t i = 0; i < snapshot->count; i++) {
        double level = floor((snapshot->position[3 * i + 2] - bottom) /
                             snapshot->scene->observe.layer_thickness);
        if (!(level >= 0 && level < OZ_MEASURE_LAYERS)) {
            continue;
        }
        OzLayer *layer = &layers[(int)level];
        layer->count++;
        if (snapshot->grains->length[i] > 0) {
            layer->angle_sum += angle_to_floor(&snapshot->axis[3 * i]);
            layer->rod_count++;
        }
    }
}

/* Largest eigenvalue of a symmetric traceless 3x3 matrix from its invariants (Smith 1961): the
 * three are p cos((phase + 2 pi k) / 3) with p^2 = 2/3 of the sum of squares. */
static double largest_eigenvalue(double q[3][3])
{
    double square = q[0][0] * q[0][0] + q[1][1] * q[1][1] + q[2][2] * q[2][2] +
                    2 * (q[0][1] * q[0][1] + q[0][2] * q[0][2] + q[1][2] * q[1][2]);
    double determinant = q[0][0] * (q[1][1] * q[2][2] - q[1][2] * q[1][2]) -
                         q[0][1] * (q[0][1] * q[2][2] - q[1][2] * q[0][2]) +
                         q[0][2] * (q[0][1] * q[1][2] - q[1][1] * q[0][2]);
    double p = sqrt(2 * square / 3);
    if (p < 1e-30) { /* isotropic to rounding; its cube must not underflow */
        return 0;
    }
    double cosine = 4 * determinant / (p * p * p);
    cosine = cosine > 1 ? 1 : cosine < -1 ? -1 : cosine;
    return p * cos(acos(cosine) / 3);
}

bool oz_measure_nematic(const OzSnapshot *snapshot, double *value)
{
    double q[3][3] = {{0}};
    int64_t rods = 0;
    for (int64_t i = 0; i < snapshot->count; i++) {
        const double *u = &snapshot->axis[3 * i];
        bool rod = snapshot->grains->length[i] > 0;
        rods += rod;
        for (int k = 0; rod && k < 9; k++) {
            q[k / 3][k % 3] += 1.5 * u[k / 3] * u[k % 3] - (k % 4 == 0 ? 0.5 : 0);
        }
    }
    for (int k = 0; rods > 0 && k < 9; k++) {
        q[k / 3][k % 3] /= (double)rods;
    }
    *value = largest_eigenvalue(q);
    return rods > 0;
}
