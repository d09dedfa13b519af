/* By points spread evenly through the inside, each in a grain or not: right for any shape, and what
 * sticks out of the inside is left out by itself. */
#include "report/report_validate_packing.h"

#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Walls order what lies beside them: three lengths of a grain are left out. */
static const double MARGIN = 3;
enum { POINTS = 100000, LAYERS = 64, BEARING = 2 };

/* The inside, m: about the z axis. */
typedef struct Inside {
    double radius, low, high;
} Inside;

/* By height: which grains reach into each of LAYERS layers of the inside. */
typedef struct Layers {
    int64_t *grains[LAYERS], count[LAYERS];
} Layers;

static double reach_of(const OzSnapshot *now, int64_t i)
{
    return (now->grains->diameter[i] + now->grains->length[i]) / 2;
}

static int by_value(const void *one, const void *other)
{
    double a = *(const double *)one, b = *(const double *)other;
    return (a > b) - (a < b);
}

/* Up to where 95 % of the centres lie, less the margin. */
static OzStatus find_inside(Inside *inside, const OzSnapshot *now)
{
    double *heights = NULL, size = 0;
    OZ_PASS(OZ_NEW(&heights, now->count));
    for (int64_t i = 0; i < now->count; i++) {
        heights[i] = now->position[3 * i + 2];
        size = fmax(size, 2 * reach_of(now, i));
    }
    qsort(heights, (size_t)now->count, sizeof *heights, by_value);
    double top = now->count > 0 ? heights[now->count * 19 / 20] : 0;
    free(heights);
    *inside = (Inside){now->scene->walls[1].diameter / 2 - MARGIN * size, MARGIN * size,
                       top - MARGIN * size};
    return OZ_OK;
}

static bool is_inside(const Inside *inside, const double *x)
{
    return x[2] > inside->low && x[2] < inside->high && hypot(x[0], x[1]) < inside->radius;
}

static void free_layers(Layers *layers)
{
    for (int l = 0; l < LAYERS; l++) {
        free(layers->grains[l]);
    }
    free(layers);
}

static OzStatus sort_into_layers(Layers *layers, const OzSnapshot *now, const Inside *inside)
{
    double thickness = (inside->high - inside->low) / LAYERS;
    for (int l = 0; l < LAYERS; l++) {
        double low = inside->low + l * thickness, high = low + thickness;
        OZ_PASS(OZ_NEW(&layers->grains[l], now->count));
        for (int64_t i = 0; i < now->count; i++) {
            double z = now->position[3 * i + 2], reach = reach_of(now, i);
            if (z + reach > low && z - reach < high) {
                layers->grains[l][layers->count[l]++] = i;
            }
        }
    }
    return OZ_OK;
}

static bool holds(const OzSnapshot *now, int64_t i, const double point[3])
{
    const double *x = &now->position[3 * i], *u = &now->axis[3 * i];
    double way[3] = {point[0] - x[0], point[1] - x[1], point[2] - x[2]};
    double half = now->grains->length[i] / 2, radius = now->grains->diameter[i] / 2, square = 0;
    double along = fmin(fmax(way[0] * u[0] + way[1] * u[1] + way[2] * u[2], -half), half);
    for (int k = 0; k < 3; k++) {
        square += pow(way[k] - along * u[k], 2);
    }
    return square < radius * radius;
}

/* The k-th of points that fill the inside evenly: by height in order, across it at random. */
static void place_point(OzRandom *random, const Inside *inside, int k, double point[3])
{
    double share = (k + oz_random_uniform(random, 0, 1)) / POINTS;
    double angle = oz_random_uniform(random, 0, 8 * atan(1));
    double radius = inside->radius * sqrt(oz_random_uniform(random, 0, 1));
    point[0] = radius * cos(angle);
    point[1] = radius * sin(angle);
    point[2] = inside->low + share * (inside->high - inside->low);
}

static double share_filled(const Layers *layers, const OzSnapshot *now, const Inside *inside)
{
    OzRandom random = oz_random_stream(1, 0);
    double filled = 0;
    for (int k = 0; k < POINTS; k++) {
        double point[3];
        int layer = (int)((int64_t)k * LAYERS / POINTS);
        bool found = false;
        place_point(&random, inside, k, point);
        for (int64_t j = 0; j < layers->count[layer] && !found; j++) {
            found = holds(now, layers->grains[layer][j], point);
        }
        filled += found;
    }
    return filled / POINTS;
}

static OzStatus measure_density(double *density, const OzSnapshot *now, const Inside *inside)
{
    Layers *layers = NULL;
    *density = NAN;
    if (!(inside->radius > 0 && inside->high > inside->low)) {
        return OZ_OK;
    }
    OZ_PASS(OZ_NEW(&layers, 1));
    OzStatus status = sort_into_layers(layers, now, inside);
    if (status == OZ_OK) {
        *density = share_filled(layers, now, inside);
    }
    free_layers(layers);
    return status;
}

/* Contacts of each grain with others, and with walls too in `held`, among those that are kept. */
static void count_contacts(int32_t *touching, int32_t *held, const OzSnapshot *now,
                           const uint8_t *kept)
{
    memset(touching, 0, (size_t)now->count * sizeof *touching);
    memset(held, 0, (size_t)now->count * sizeof *held);
    for (int64_t c = 0; c < now->contacts.count; c++) {
        const OzContactEntry *e = &now->contacts.entry[c];
        bool again = c > 0 && e[-1].a == e->a && e[-1].b == e->b;
        if (again || !kept[e->a] || (e->b >= 0 && !kept[e->b])) {
            continue;
        }
        held[e->a]++;
        if (e->b >= 0) {
            held[e->b]++;
            touching[e->a]++;
            touching[e->b]++;
        }
    }
}

static double mean_contacts(const int32_t *touching, const OzSnapshot *now, const uint8_t *kept,
                            const Inside *inside)
{
    double sum = 0, count = 0;
    for (int64_t i = 0; i < now->count; i++) {
        if (kept[i] && is_inside(inside, &now->position[3 * i])) {
            sum += touching[i];
            count++;
        }
    }
    return sum / count;
}

static OzStatus measure_contacts(OzTrialNumbers numbers, const OzSnapshot *now,
                                 const Inside *inside)
{
    OzStatus status = OZ_OK;
    int32_t *touching = NULL, *held = NULL;
    uint8_t *kept = NULL;
    OZ_TRY(OZ_NEW(&touching, now->count));
    OZ_TRY(OZ_NEW(&held, now->count));
    OZ_TRY(OZ_NEW(&kept, now->count));
    memset(kept, 1, (size_t)now->count);
    count_contacts(touching, held, now, kept);
    numbers[OZ_LOOK_PACKING_CONTACTS] = mean_contacts(touching, now, kept, inside);
    for (bool changed = true; changed;) {
        changed = false;
        for (int64_t i = 0; i < now->count; i++) {
            if (kept[i] && held[i] < BEARING) {
                kept[i] = 0;
                changed = true;
            }
        }
        count_contacts(touching, held, now, kept);
    }
    numbers[OZ_LOOK_PACKING_BACKBONE] = mean_contacts(touching, now, kept, inside);
done:
    free(touching);
    free(held);
    free(kept);
    return status;
}

void oz_report_validate_packing_look(OzTrialNumbers numbers, const OzSnapshot *now, int look)
{
    Inside inside;
    if (look == 0) {
        return;
    }
    numbers[OZ_LOOK_PACKING_ASPECT] = now->grains->length[0] / now->grains->diameter[0];
    numbers[OZ_LOOK_PACKING_OVERLAP] =
        oz_contact_list_sum(&now->contacts).overlap_max / now->grains->diameter[0];
    numbers[OZ_LOOK_PACKING_DENSITY] = numbers[OZ_LOOK_PACKING_CONTACTS] = NAN;
    numbers[OZ_LOOK_PACKING_BACKBONE] = NAN;
    if (find_inside(&inside, now) == OZ_OK &&
        measure_density(&numbers[OZ_LOOK_PACKING_DENSITY], now, &inside) == OZ_OK) {
        (void)measure_contacts(numbers, now, &inside);
    }
}
