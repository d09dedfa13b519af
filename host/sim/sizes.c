/* Choosing sizes. */
#include "sim/sizes.h"

#include "sim/mesh_pack.h"

/* Skins of a grain in the lists, measured on the tapped bed of Pournin et al.: larger ones are used
 * up less often but hold more pairs. Lengths in mean diameters; the steps are those for which a
 * grain's skin shall last at its present speed. */
typedef struct Skins {
    double outer_least, outer_most, outer_steps, least, most, steps;
} Skins;

/* Of many grains the fastest is faster, and none may outrun its skin: large scenes let them grow
 * further (at 50 000 grains lists then last 1.4 times as long, and a step takes 0.9 of the time).
 */
static const Skins small_skins = {0.25, 0.7, 60, 0.008, 0.12, 12};
static const Skins large_skins = {0.6, 1.0, 60, 0.008, 0.3, 12};

enum {
    OUTER_PAIRS = 10, /* a grain, at first; lists grow when that is too few */
    INNER_PAIRS = 4,
    BACK_PAIRS = 16,
    FACES = 16,          /* triangles of a mesh */
    MOTION_STEPS = 8192, /* of one launch */
    LARGE_REGION = 4096, /* slots; at 64 000 rods a step of tiles half as large takes 1.08 times as
                            long, of twice as large ones as long */
    NARROW_REGION = 256, /* of devices with many small cores */
    LARGE_REGIONS = 16   /* at least, each then smaller */
};

int oz_sizes_up(double count, int to)
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

void oz_sizes_regions(OzSizesHead *z, const OzSwitchesHead *s, int slots)
{
    int large = s->group > 1 ? NARROW_REGION : LARGE_REGION;
    double share_slots =
        s->resort ? fmin(large, (double)slots / LARGE_REGIONS) : ceil((double)slots / s->group);
    z->members = 1;
    z->region_slots = oz_sizes_up(fmax(1, share_slots), s->lanes);
    int filled = (int)fmax(1, ceil((double)slots / z->region_slots));
    z->regions = s->resort ? filled : s->group; /* one for each work-item, some may be empty */
    double share = fmax(1, (double)slots / z->regions);
    z->outer_capacity = oz_sizes_up(OUTER_PAIRS * share + 16, s->lanes);
    z->inner_capacity = oz_sizes_up(INNER_PAIRS * share + 16, s->lanes);
    z->back_capacity = BACK_PAIRS;
    z->face_capacity = FACES;
    z->motion_steps = MOTION_STEPS;
}

static double mean_diameter(const OzGrains *grains)
{
    double sum = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        sum += grains->diameter[i];
    }
    return grains->count > 0 ? sum / (double)grains->count : 1;
}

/* Extent of the start along each axis, m. */
static void extents(double size[3], const OzGrains *grains)
{
    for (int c = 0; c < 3; c++) {
        double low = INFINITY, high = -INFINITY;
        for (int64_t i = 0; i < grains->count; i++) {
            low = fmin(low, grains->position[3 * i + c]);
            high = fmax(high, grains->position[3 * i + c]);
        }
        size[c] = grains->count > 0 ? high - low : 0;
    }
}

/* The axes from the shortest extent to the longest: slots follow the first, so that grains which
 * meet across the others stand no farther apart in memory than need be. */
static void order_axes(int axis[3], const double *size, int axes)
{
    axis[2] = 2;
    for (int k = 0; k < axes; k++) {
        int to = k;
        for (; to > 0 && size[axis[to - 1]] > size[k]; to--) {
            axis[to] = axis[to - 1];
        }
        axis[to] = k;
    }
}

void oz_sizes_cells(OzSizesHead *z, double *inverse_cell, double reach, const double *size,
                    int axes, int64_t bodies)
{
    double cell = fmax(2 * reach, 1e-300), budget = fmax(64, 4.0 * (double)bodies);
    int least = 4, *cells = z->cells_along;
    *inverse_cell = 1 / cell;
    order_axes(z->axis, size, axes);
    cells[2] = 1;
    for (int k = 0; k < axes; k++) {
        double wanted = fmin(size[z->axis[k]] / cell + 1, fmax(budget, least));
        cells[k] = power_of_two(fmax(wanted, least));
    }
    while ((double)cells[0] * cells[1] * cells[2] > budget) {
        int *largest = cells;
        for (int k = 1; k < axes; k++) {
            largest = cells[k] > *largest ? &cells[k] : largest;
        }
        if (*largest / 2 < least) {
            break;
        }
        *largest /= 2;
    }
    z->cells = cells[0] * cells[1] * cells[2];
}

/* A sheared cell's lattice is longer and shorter along x, which rows of cells follow. */
static void put_first(OzSizesHead *z, int axis)
{
    for (int k = 2; k > 0; k--) {
        if (z->axis[k] == axis) {
            int cells = z->cells_along[k];
            z->axis[k] = z->axis[k - 1];
            z->cells_along[k] = z->cells_along[k - 1];
            z->axis[k - 1] = axis;
            z->cells_along[k - 1] = cells;
        }
    }
}

OzStatus oz_sizes_choose(void *sizes, void *parameters, const OzScene *scene,
                         const OzGrains *grains, const void *switches)
{
    OzSizes *z = sizes;
    OzParameters *p = parameters;
    const OzSwitches *s = switches;
    double diameter = mean_diameter(grains);
    const Skins *skins = s->resort ? &large_skins : &small_skins;
    *z = (OzSizes){0};
    p->outer_most = scene->skin > 0 ? scene->skin / 2 : skins->outer_most * diameter;
    p->outer_least = fmin(skins->outer_least * diameter, p->outer_most);
    p->outer_time = skins->outer_steps * scene->step;
    p->skin_most = fmin(skins->most * diameter, p->outer_least / 2);
    p->skin_least = fmin(skins->least * diameter, p->skin_most);
    p->skin_time = skins->steps * scene->step;
    z->count = (int)grains->count;
    z->slots = oz_sizes_up((double)z->count, s->lanes);
    z->blocks = z->slots / s->lanes;
    oz_sizes_regions((OzSizesHead *)(void *)z, switches, z->slots);
    double size[3];
    extents(size, grains);
    oz_sizes_cells((OzSizesHead *)(void *)z, &p->inverse_cell, p->reach_max + p->outer_most, size,
                   3, grains->count);
    if (s->shear) {
        put_first((OzSizesHead *)(void *)z, 0);
    }
    return oz_mesh_pack_sizes(z, scene, p);
}

void oz_sizes_join(void *sizes, const void *other)
{
    OzSizes *own = sizes, before = *own;
    *own = *(const OzSizes *)other;
    own->mesh_faces = before.mesh_faces > own->mesh_faces ? before.mesh_faces : own->mesh_faces;
    own->mesh_cells = before.mesh_cells > own->mesh_cells ? before.mesh_cells : own->mesh_cells;
    own->mesh_items = before.mesh_items > own->mesh_items ? before.mesh_items : own->mesh_items;
}
