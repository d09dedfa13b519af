/* Choosing sizes. */
#include "sim/element_sizes.h"

#include "sim/element_laws.h"
#include "sim/units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Skins of an element in the lists, measured on a flowing hopper: larger ones are used up less
 * often but hold more pairs. Lengths in mean reaches of the free elements; the steps are those for
 * which a element's skin shall last at its present speed. */
static const double least_outer = 0.15, most_outer = 0.6, outer_steps = 400;
static const double least_skin = 0.01, most_skin = 0.1, skin_steps = 30;

/* An element that reaches farther than so many mean ones would make everybody's cells too large. */
static const double small_most = 3;

enum {
    OUTER_PAIRS = 8, /* an element, at first; lists grow when that is too few */
    INNER_PAIRS = 4,
    BACK_PAIRS = 12,
    MOTION_STEPS = 8192 /* of one launch */
};

static int round_up(double count, int to)
{
    return (int)(ceil(count / to) * to);
}

static int power_of_two(double least)
{
    int power = 1;
    while (power < least && power < 1 << 20) {
        power *= 2;
    }
    return power;
}

static double mean_reach(const OzElements *elements)
{
    double sum = 0;
    for (int64_t i = 0; i < elements->free_count; i++) {
        sum += elements->reach[i];
    }
    return elements->free_count > 0 ? sum / (double)elements->free_count : 1;
}

/* The longest reach that still is a small one. */
static double small_reach(const OzElements *elements, double mean)
{
    double reach = 0;
    for (int64_t i = 0; i < elements->count; i++) {
        if (elements->reach[i] <= small_most * mean) {
            reach = fmax(reach, elements->reach[i]);
        }
    }
    return reach;
}

/* The box of all elements: middle and size, m. */
static void extents(const OzElements *elements, double middle[2], double size[2])
{
    for (int c = 0; c < 2; c++) {
        double low = INFINITY, high = -INFINITY;
        for (int64_t i = 0; i < elements->count; i++) {
            low = fmin(low, elements->position[2 * i + c] - elements->reach[i]);
            high = fmax(high, elements->position[2 * i + c] + elements->reach[i]);
        }
        middle[c] = elements->count > 0 ? (low + high) / 2 : 0;
        size[c] = elements->count > 0 ? high - low : 1;
    }
}

OzStatus oz_element_sizes_parameters(void *parameters, const OzScene *scene, const OzGrains *grains,
                                     const void *running)
{
    OzElementParameters *p = parameters;
    const OzElements *elements = grains->elements;
    double reach = mean_reach(elements), size[2];
    memset(p, 0, sizeof *p);
    if (scene->wall_count > OZ_ELEMENT_WALLS_MAX) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: %d walls, at most %d", scene->path,
                              scene->wall_count, OZ_ELEMENT_WALLS_MAX);
    }
    p->units = (OzUnits){1, 1, 1};
    if (scene->precision == OZ_PRECISION_FLOAT) {
        p->units = running ? ((const OzElementParameters *)running)->units
                           : oz_units_choose(grains, scene->step);
    }
    p->dt = scene->step;
    p->gravity[0] = scene->gravity[0];
    p->gravity[1] = scene->gravity[1];
    p->stiffness = scene->triangles.stiffness;
    p->deep_warn = scene->guards.overlap_warn;
    p->deep_stop = scene->guards.overlap_stop;
    p->beam = oz_element_laws_beam(scene);
    for (int w = -1; w < scene->wall_count; w++) {
        p->law[w + 1] = oz_element_laws_disc(scene, w);
    }
    p->outer_most = scene->skin > 0 ? scene->skin / 2 : most_outer * reach;
    p->outer_least = scene->skin > 0 ? p->outer_most : least_outer * reach;
    p->outer_time = outer_steps * scene->step;
    p->skin_most = fmin(most_skin * reach, p->outer_least / 2);
    p->skin_least = fmin(least_skin * reach, p->skin_most);
    p->skin_time = skin_steps * scene->step;
    p->reach_small = small_reach(elements, reach);
    double cell = 2 * (p->reach_small + p->outer_most);
    p->inverse_cell = 1 / cell;
    extents(elements, p->middle, size);
    /* Far enough for any flight, near enough for cells counted in 32 bits. */
    p->domain = fmin(1e6 * fmax(size[0], size[1]), 1e9 * cell);
    return OZ_OK;
}

static void choose_cells(OzElementSizes *z, const OzElementParameters *p,
                         const OzElements *elements)
{
    double middle[2], size[2], budget = fmax(64, 4.0 * (double)elements->count);
    extents(elements, middle, size);
    z->cells_x = power_of_two(fmin(fmax(4, size[0] * p->inverse_cell + 1), budget));
    z->cells_y = power_of_two(fmin(fmax(4, size[1] * p->inverse_cell + 1), budget));
    while ((double)z->cells_x * z->cells_y > budget && (z->cells_x > 4 || z->cells_y > 4)) {
        *(z->cells_x > z->cells_y ? &z->cells_x : &z->cells_y) /= 2;
    }
    z->cells = z->cells_x * z->cells_y;
}

void oz_element_sizes_choose(void *sizes, void *parameters, const OzScene *scene,
                             const OzGrains *grains, const void *switches)
{
    OzElementSizes *z = sizes;
    const OzElementSwitches *s = switches;
    const OzElements *elements = grains->elements;
    *z = (OzElementSizes){0};
    z->free_slots = round_up((double)elements->free_count, s->lanes);
    z->slots = z->free_slots + round_up((double)(elements->count - elements->free_count), s->lanes);
    z->free_blocks = z->free_slots / s->lanes;
    z->blocks = z->slots / s->lanes;
    z->beam_blocks = round_up((double)elements->beam_count, s->lanes) / s->lanes;
    z->regions = s->group;
    z->region_slots = round_up(fmax(1, ceil((double)z->free_slots / s->group)), s->lanes);
    z->outer_capacity = round_up(OUTER_PAIRS * (double)z->region_slots + 16, s->lanes);
    z->inner_capacity = round_up(INNER_PAIRS * (double)z->region_slots + 16, s->lanes);
    z->back_capacity = BACK_PAIRS;
    z->walls = scene->wall_count;
    z->motion_steps = MOTION_STEPS;
    z->members = 1;
    choose_cells(z, parameters, elements);
}

static int larger(int a, int b)
{
    return a > b ? a : b;
}

void oz_element_sizes_join(void *sizes, const void *another)
{
    OzElementSizes *z = sizes;
    const OzElementSizes *other = another;
    z->slots = larger(z->slots - z->free_slots, other->slots - other->free_slots) +
               larger(z->free_slots, other->free_slots);
    z->blocks = larger(z->blocks - z->free_blocks, other->blocks - other->free_blocks) +
                larger(z->free_blocks, other->free_blocks);
    z->free_slots = larger(z->free_slots, other->free_slots);
    z->free_blocks = larger(z->free_blocks, other->free_blocks);
    z->beam_blocks = larger(z->beam_blocks, other->beam_blocks);
    z->region_slots = larger(z->region_slots, other->region_slots);
    z->outer_capacity = larger(z->outer_capacity, other->outer_capacity);
    z->inner_capacity = larger(z->inner_capacity, other->inner_capacity);
    z->back_capacity = larger(z->back_capacity, other->back_capacity);
    z->cells_x = larger(z->cells_x, other->cells_x);
    z->cells_y = larger(z->cells_y, other->cells_y);
    z->cells = z->cells_x * z->cells_y;
}
