/* Choosing sizes. */
#include "sim/element_sizes.h"

#include "model/wear.h"
#include "sim/element_laws.h"
#include "sim/sizes.h"
#include "sim/units.h"

#include <limits.h>
#include <math.h>
#include <string.h>

/* Skins of an element in the lists, measured on a flowing hopper: larger ones are used up less
 * often but hold more pairs. Lengths in mean reaches of the free elements; the steps are those for
 * which a element's skin shall last at its present speed. */
static const double least_outer = 0.15, most_outer = 0.6, outer_steps = 400;
static const double least_skin = 0.01, most_skin = 0.1, skin_steps = 30;

/* An element that reaches farther than so many mean ones would make everybody's cells too large. */
static const double small_most = 3;

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
    p->strength = oz_element_laws_strength(scene);
    p->yield = oz_element_laws_yield(scene);
    for (int w = -1; w < scene->wall_count; w++) {
        p->law[w + 1] = oz_element_laws_disc(scene, w);
    }
    p->outer_most = scene->skin > 0 ? scene->skin / 2 : most_outer * reach;
    p->outer_least = scene->skin > 0 ? p->outer_most : least_outer * reach;
    p->outer_time = outer_steps * scene->step;
    p->skin_most = fmin(most_skin * reach, p->outer_least / 2);
    p->skin_least = fmin(least_skin * reach, p->skin_most);
    p->skin_time = skin_steps * scene->step;
    p->reach_max = small_reach(elements, reach);
    double cell = 2 * (p->reach_max + p->outer_most);
    extents(elements, p->middle, size);
    /* Far enough for any flight, near enough for cells counted in 32 bits. */
    p->domain = fmin(1e6 * fmax(size[0], size[1]), 1e9 * cell);
    return OZ_OK;
}

OzStatus oz_element_sizes_choose(void *sizes, void *parameters, const OzScene *scene,
                                 const OzGrains *grains, const void *switches)
{
    OzElementSizes *z = sizes;
    const OzElementSwitches *s = switches;
    const OzElements *elements = grains->elements;
    double middle[2], size[2];
    OzElementParameters *p = parameters;
    *z = (OzElementSizes){0};
    z->free_slots = oz_sizes_up((double)elements->free_count, s->lanes);
    z->slots =
        z->free_slots + oz_sizes_up((double)(elements->count - elements->free_count), s->lanes);
    z->free_blocks = z->free_slots / s->lanes;
    z->blocks = z->slots / s->lanes;
    z->beam_blocks = oz_sizes_up((double)elements->beam_count, s->lanes) / s->lanes;
    z->walls = scene->wall_count;
    if (s->strength && oz_wear_scars(elements) > INT_MAX / 2) {
        return oz_status_fail(OZ_ERR_INPUT, "%s: grains of too many triangles to break",
                              scene->path);
    }
    z->scars = s->strength ? (int)oz_wear_scars(elements) : 0;
    oz_sizes_regions((OzSizesHead *)(void *)z, switches, z->free_slots);
    extents(elements, middle, size);
    oz_sizes_cells((OzSizesHead *)(void *)z, &p->inverse_cell, p->reach_max + p->outer_most, size,
                   2, elements->count);
    return OZ_OK;
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
    z->scars = larger(z->scars, other->scars);
    z->region_slots = larger(z->region_slots, other->region_slots);
    z->outer_capacity = larger(z->outer_capacity, other->outer_capacity);
    z->inner_capacity = larger(z->inner_capacity, other->inner_capacity);
    z->back_capacity = larger(z->back_capacity, other->back_capacity);
    z->cells = 1;
    for (int k = 0; k < 3; k++) {
        z->cells_along[k] = larger(z->cells_along[k], other->cells_along[k]);
        z->cells *= z->cells_along[k];
    }
}
