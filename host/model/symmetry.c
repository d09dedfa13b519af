/* Maps of a polygon's corners onto each other, and of its triangles. Knows no beams. */
#include "model/symmetry.h"

#include <math.h>

/* Corners are written with few digits. */
static const double TOLERANCE = 1e-3;

/* Corner i goes to first + i, or with mirrored to first - i, round the polygon. */
typedef struct Map {
    int first, count;
    bool mirrored;
} Map;

static int image(const Map *map, int corner)
{
    int to = map->mirrored ? map->first - corner : map->first + corner;
    return (to % map->count + map->count) % map->count;
}

static double distance(const OzTriangleSet *triangle_set, int a, int b)
{
    const double *p = triangle_set->vertex + 2 * a, *q = triangle_set->vertex + 2 * b;
    return hypot(p[0] - q[0], p[1] - q[1]);
}

/* Twice the area of three corners, counter-clockwise positive. */
static double cross(const OzTriangleSet *triangle_set, const int corner[3])
{
    const double *a = triangle_set->vertex + 2 * corner[0],
                 *b = triangle_set->vertex + 2 * corner[1],
                 *c = triangle_set->vertex + 2 * corner[2];
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

/* Edges and turns in a row determine a polygon: those of a corner and of its image are the same. */
static bool agrees_at(const OzTriangleSet *triangle_set, const Map *map, int i, double size)
{
    const int here[3] = {i, (i + 1) % map->count, (i + 2) % map->count};
    int there[3];
    for (int k = 0; k < 3; k++) {
        there[k] = image(map, here[k]);
    }
    double turn = cross(triangle_set, there) * (map->mirrored ? -1 : 1);
    return fabs(distance(triangle_set, here[0], here[1]) -
                distance(triangle_set, there[0], there[1])) <= TOLERANCE * size &&
           fabs(distance(triangle_set, here[0], here[2]) -
                distance(triangle_set, there[0], there[2])) <= TOLERANCE * size &&
           fabs(cross(triangle_set, here) - turn) <= TOLERANCE * size * size;
}

static bool maps_outline(const OzTriangleSet *triangle_set, const Map *map)
{
    double size = 0;
    for (int i = 0; i < map->count; i++) {
        size = fmax(size, distance(triangle_set, 0, i));
    }
    for (int i = 0; i < map->count; i++) {
        if (!agrees_at(triangle_set, map, i, size)) {
            return false;
        }
    }
    return true;
}

static bool has_triangle(const OzTriangleSet *triangle_set, const int corner[3])
{
    for (int t = 0; t < triangle_set->triangle_count; t++) {
        const int *own = triangle_set->triangle + 3 * t;
        int same = 0;
        for (int k = 0; k < 9; k++) {
            same += own[k / 3] == corner[k % 3];
        }
        if (same == 3) {
            return true;
        }
    }
    return false;
}

static bool maps_triangles(const OzTriangleSet *triangle_set, const Map *map)
{
    for (int t = 0; t < triangle_set->triangle_count; t++) {
        int corner[3];
        for (int k = 0; k < 3; k++) {
            corner[k] = image(map, triangle_set->triangle[3 * t + k]);
        }
        if (!has_triangle(triangle_set, corner)) {
            return false;
        }
    }
    return true;
}

bool oz_symmetry_is_kept(const OzTriangleSet *triangle_set)
{
    for (int k = 0; k < 2 * triangle_set->vertex_count; k++) {
        Map map = {k / 2, triangle_set->vertex_count, k % 2};
        if (maps_outline(triangle_set, &map) && !maps_triangles(triangle_set, &map)) {
            return false;
        }
    }
    return true;
}
