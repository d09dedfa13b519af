/* Which points the walls leave to grains placed at random. Knows nothing of other grains. */
#include "model/fill_region.h"

#include "scene/wall_shape.h"

#include <math.h>

/* A plane counts as lying across an axis when its normal is within 1e-6 of it: written normals are
 * normalised in double, and a millionth of a slope is far below any overlap that matters. */
static const double across = 1 - 1e-12;

static void bound_by_plane(OzFillRegion *fill_region, const OzWall *wall)
{
    for (int k = 0; k < 3; k++) {
        if (wall->normal[k] > across) {
            fill_region->low[k] = fmax(fill_region->low[k], wall->point[k]);
            fill_region->walled_low[k] = true;
        } else if (wall->normal[k] < -across) {
            fill_region->high[k] = fmin(fill_region->high[k], wall->point[k]);
            fill_region->walled_high[k] = true;
        }
    }
}

static void bound_between(OzFillRegion *fill_region, int k, double low, double high)
{
    fill_region->low[k] = fmax(fill_region->low[k], low);
    fill_region->high[k] = fmin(fill_region->high[k], high);
    fill_region->walled_low[k] = fill_region->walled_high[k] = true;
}

/* A round body about its axis: within its radius across, and its length along; endless, it bounds
 * what lies across alone. */
static void bound_by_tube(OzFillRegion *fill_region, const OzWall *wall)
{
    double radius = 0.5 * wall->diameter, axis[3];
    oz_wall_shape_axis(wall, axis);
    for (int k = 0; k < 3; k++) {
        double along = axis[k], reach = radius * sqrt(fmax(0, 1 - along * along));
        double far = wall->point[k] + along * wall->length;
        if (wall->length > 0 || fabs(along) < sqrt(1 - across)) {
            bound_between(fill_region, k, fmin(wall->point[k], far) - reach,
                          fmax(wall->point[k], far) + reach);
        }
    }
}

static void bound_by_cylinder(OzFillRegion *fill_region, const OzWall *wall)
{
    bound_by_tube(fill_region, wall);
    if (oz_wall_shape_is_upright(wall)) {
        fill_region->radius = fmin(fill_region->radius, 0.5 * wall->diameter);
    }
}

static void bound_by_sphere(OzFillRegion *fill_region, const OzWall *wall)
{
    double radius = 0.5 * wall->diameter;
    for (int k = 0; k < 3; k++) {
        bound_between(fill_region, k, wall->point[k] - radius, wall->point[k] + radius);
    }
}

static void bound_by_box(OzFillRegion *fill_region, const OzWall *wall)
{
    for (int k = 0; k < 3; k++) {
        double low = wall->point[k] - (k == 2 ? 0 : wall->size[k] / 2);
        bound_between(fill_region, k, low, low + wall->size[k]);
    }
}

#define ROW(NAME, name, choice, fine)    [OZ_WALL_##NAME] = bound_by_##name,
#define COMPOUND_ROW(NAME, name, choice) [OZ_WALL_##NAME] = bound_by_##name,
static void (*const bounds[])(OzFillRegion *fill_region,
                              const OzWall *wall) = {OZ_WALLS(ROW) OZ_COMPOUND_WALLS(COMPOUND_ROW)};
#undef ROW
#undef COMPOUND_ROW

static bool walled(const OzFillRegion *fill_region, int k)
{
    return fill_region->walled_low[k] && fill_region->walled_high[k];
}

/* The length that the directions without walls on both sides must share. */
static double free_length(const OzFillRegion *fill_region, double volume, double extent)
{
    int free_count = 0;
    double area = isfinite(fill_region->radius) ? 0.25 * 3.14159265358979323846 : 1;
    for (int k = 0; k < 3; k++) {
        if (walled(fill_region, k)) {
            area *= fmax(fill_region->high[k] - fill_region->low[k], 0);
        } else {
            free_count++;
        }
    }
    double length = free_count && area > 0 ? pow(volume / area, 1.0 / free_count) : extent;
    return fmax(length, extent);
}

static void cut_off(OzFillRegion *fill_region, int k, double length)
{
    if (fill_region->walled_low[k] && !fill_region->walled_high[k]) {
        fill_region->high[k] = fill_region->low[k] + length;
    } else if (fill_region->walled_high[k] && !fill_region->walled_low[k]) {
        fill_region->low[k] = fill_region->high[k] - length;
    } else if (!walled(fill_region, k)) {
        bool upwards = k == 2 && isfinite(fill_region->radius);
        fill_region->low[k] = upwards ? 0 : -0.5 * length;
        fill_region->high[k] = fill_region->low[k] + length;
    }
}

OzFillRegion oz_fill_region_make(const OzScene *scene, double volume, double extent)
{
    OzFillRegion fill_region = {.scene = scene,
                                .low = {-INFINITY, -INFINITY, -INFINITY},
                                .high = {INFINITY, INFINITY, INFINITY},
                                .radius = INFINITY};
    for (int w = 0; w < scene->wall_count; w++) {
        if (scene->walls[w].side == OZ_SIDE_INSIDE) {
            bounds[scene->walls[w].kind](&fill_region, &scene->walls[w]);
        }
    }
    double length = free_length(&fill_region, volume, extent);
    for (int k = 0; k < 3; k++) {
        cut_off(&fill_region, k, length);
    }
    return fill_region;
}

bool oz_fill_region_raise(OzFillRegion *fill_region)
{
    int free_count = 0;
    for (int k = 0; k < 3; k++) {
        free_count += !walled(fill_region, k);
    }
    for (int k = 0; k < 3; k++) {
        double more =
            (fill_region->high[k] - fill_region->low[k]) * (pow(1.1, 1.0 / free_count) - 1);
        bool both = !fill_region->walled_low[k] && !fill_region->walled_high[k];
        bool centred = both && !(k == 2 && isfinite(fill_region->radius));
        if (walled(fill_region, k)) {
            continue;
        }
        fill_region->low[k] -= centred ? 0.5 * more : fill_region->walled_high[k] ? more : 0;
        fill_region->high[k] += centred ? 0.5 * more : fill_region->walled_high[k] ? 0 : more;
    }
    return free_count > 0;
}

bool oz_fill_region_admits(const OzFillRegion *fill_region, const OzCapsule *capsule)
{
    for (int k = 0; k < 3; k++) {
        double extent = 2 * (fabs(capsule->half_shaft[k]) + capsule->radius);
        if (fill_region->high[k] - fill_region->low[k] < extent) {
            return false;
        }
    }
    return hypot(capsule->half_shaft[0], capsule->half_shaft[1]) <=
           fill_region->radius - capsule->radius;
}

void oz_fill_region_draw(const OzFillRegion *fill_region, OzRandom *random, OzCapsule *capsule)
{
    for (int k = 0; k < 3; k++) {
        double margin = fabs(capsule->half_shaft[k]) + capsule->radius;
        capsule->centre[k] =
            oz_random_uniform(random, fill_region->low[k] + margin, fill_region->high[k] - margin);
    }
}

static bool end_is_free(const OzWall *wall, const double end[3], double radius)
{
    return oz_wall_shape_distance(wall, 0, end, NULL) >= radius;
}

bool oz_fill_region_holds(const OzFillRegion *fill_region, const OzCapsule *capsule)
{
    double ends[2][3];
    for (int k = 0; k < 3; k++) {
        ends[0][k] = capsule->centre[k] - capsule->half_shaft[k];
        ends[1][k] = capsule->centre[k] + capsule->half_shaft[k];
    }
    for (int w = 0; w < fill_region->scene->wall_count; w++) {
        const OzWall *wall = &fill_region->scene->walls[w];
        if (!end_is_free(wall, ends[0], capsule->radius) ||
            !end_is_free(wall, ends[1], capsule->radius)) {
            return false;
        }
    }
    return true;
}
