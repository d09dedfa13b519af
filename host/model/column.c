/* Which points the walls leave to grains placed at random. Knows nothing of other grains. */
#include "model/column.h"

#include "scene/wall_shape.h"

#include <math.h>

/* A plane counts as lying across an axis when its normal is within 1e-6 of it: written normals are
 * normalised in double, and a millionth of a slope is far below any overlap that matters. */
static const double across = 1 - 1e-12;

static void bound_by_plane(OzColumn *column, const OzWall *wall)
{
    for (int k = 0; k < 3; k++) {
        if (wall->normal[k] > across) {
            column->low[k] = fmax(column->low[k], wall->point[k]);
            column->walled_low[k] = true;
        } else if (wall->normal[k] < -across) {
            column->high[k] = fmin(column->high[k], wall->point[k]);
            column->walled_high[k] = true;
        }
    }
}

static void bound_by_cylinder(OzColumn *column, const OzWall *wall)
{
    double radius = 0.5 * wall->diameter;
    column->radius = fmin(column->radius, radius);
    for (int k = 0; k < 2; k++) {
        column->low[k] = fmax(column->low[k], -radius);
        column->high[k] = fmin(column->high[k], radius);
        column->walled_low[k] = column->walled_high[k] = true;
    }
}

#define ROW(NAME, name, choice, fine) [OZ_WALL_##NAME] = bound_by_##name,
static void (*const bounds[])(OzColumn *column, const OzWall *wall) = {OZ_WALLS(ROW)};
#undef ROW

static bool walled(const OzColumn *column, int k)
{
    return column->walled_low[k] && column->walled_high[k];
}

/* The length that the directions without walls on both sides must share. */
static double free_length(const OzColumn *column, double volume, double extent)
{
    int free_count = 0;
    double area = isfinite(column->radius) ? 0.25 * 3.14159265358979323846 : 1;
    for (int k = 0; k < 3; k++) {
        if (walled(column, k)) {
            area *= fmax(column->high[k] - column->low[k], 0);
        } else {
            free_count++;
        }
    }
    double length = free_count && area > 0 ? pow(volume / area, 1.0 / free_count) : extent;
    return fmax(length, extent);
}

static void cut_off(OzColumn *column, int k, double length)
{
    if (column->walled_low[k] && !column->walled_high[k]) {
        column->high[k] = column->low[k] + length;
    } else if (column->walled_high[k] && !column->walled_low[k]) {
        column->low[k] = column->high[k] - length;
    } else if (!walled(column, k)) {
        bool upwards = k == 2 && isfinite(column->radius);
        column->low[k] = upwards ? 0 : -0.5 * length;
        column->high[k] = column->low[k] + length;
    }
}

OzColumn oz_column_make(const OzScene *scene, double volume, double extent)
{
    OzColumn column = {.scene = scene,
                       .low = {-INFINITY, -INFINITY, -INFINITY},
                       .high = {INFINITY, INFINITY, INFINITY},
                       .radius = INFINITY};
    for (int w = 0; w < scene->wall_count; w++) {
        bounds[scene->walls[w].kind](&column, &scene->walls[w]);
    }
    double length = free_length(&column, volume, extent);
    for (int k = 0; k < 3; k++) {
        cut_off(&column, k, length);
    }
    return column;
}

bool oz_column_raise(OzColumn *column)
{
    int free_count = 0;
    for (int k = 0; k < 3; k++) {
        free_count += !walled(column, k);
    }
    for (int k = 0; k < 3; k++) {
        double more = (column->high[k] - column->low[k]) * (pow(1.1, 1.0 / free_count) - 1);
        bool both = !column->walled_low[k] && !column->walled_high[k];
        bool centred = both && !(k == 2 && isfinite(column->radius));
        if (walled(column, k)) {
            continue;
        }
        column->low[k] -= centred ? 0.5 * more : column->walled_high[k] ? more : 0;
        column->high[k] += centred ? 0.5 * more : column->walled_high[k] ? 0 : more;
    }
    return free_count > 0;
}

bool oz_column_admits(const OzColumn *column, const OzCapsule *capsule)
{
    for (int k = 0; k < 3; k++) {
        double extent = 2 * (fabs(capsule->half_shaft[k]) + capsule->radius);
        if (column->high[k] - column->low[k] < extent) {
            return false;
        }
    }
    return hypot(capsule->half_shaft[0], capsule->half_shaft[1]) <=
           column->radius - capsule->radius;
}

void oz_column_draw(const OzColumn *column, OzRandom *random, OzCapsule *capsule)
{
    for (int k = 0; k < 3; k++) {
        double margin = fabs(capsule->half_shaft[k]) + capsule->radius;
        capsule->centre[k] =
            oz_random_uniform(random, column->low[k] + margin, column->high[k] - margin);
    }
}

static bool end_is_free(const OzWall *wall, const double end[3], double radius)
{
    return oz_wall_shape_distance(wall, 0, end, NULL) >= radius;
}

bool oz_column_holds(const OzColumn *column, const OzCapsule *capsule)
{
    double ends[2][3];
    for (int k = 0; k < 3; k++) {
        ends[0][k] = capsule->centre[k] - capsule->half_shaft[k];
        ends[1][k] = capsule->centre[k] + capsule->half_shaft[k];
    }
    for (int w = 0; w < column->scene->wall_count; w++) {
        const OzWall *wall = &column->scene->walls[w];
        if (!end_is_free(wall, ends[0], capsule->radius) ||
            !end_is_free(wall, ends[1], capsule->radius)) {
            return false;
        }
    }
    return true;
}
