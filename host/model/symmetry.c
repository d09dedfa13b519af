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

static double distance(const OzPatch *patch, int a, int b)
{
    const double *p = patch->vertex + 2 * a, *q = patch->vertex + 2 * b;
    return hypot(p[0] - q[0], p[1] - q[1]);
}

/* Twice the area of three corners, counter-clockwise positive. */
static double cross(const OzPatch *patch, const int corner[3])
{
    const double *a = patch->vertex + 2 * corner[0], *b = patch->vertex + 2 * corner[1],
                 *c = patch->vertex + 2 * corner[2];
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

/* Edges and turns in a row determine a polygon: those of a corner and of its image are the same. */
static bool agrees_at(const OzPatch *patch, const Map *map, int i, double size)
{
    const int here[3] = {i, (i + 1) % map->count, (i + 2) % map->count};
    int there[3];
    for (int k = 0; k < 3; k++) {
        there[k] = image(map, here[k]);
    }
    double turn = cross(patch, there) * (map->mirrored ? -1 : 1);
    return fabs(distance(patch, here[0], here[1]) - distance(patch, there[0], there[1])) <=
               TOLERANCE * size &&
           fabs(distance(patch, here[0], here[2]) - distance(patch, there[0], there[2])) <=
               TOLERANCE * size &&
           fabs(cross(patch, here) - turn) <= TOLERANCE * size * size;
}

static bool maps_outline(const OzPatch *patch, const Map *map)
{
    double size = 0;
    for (int i = 0; i < map->count; i++) {
        size = fmax(size, distance(patch, 0, i));
    }
    for (int i = 0; i < map->count; i++) {
        if (!agrees_at(patch, map, i, size)) {
            return false;
        }
    }
    return true;
}

static bool has_triangle(const OzPatch *patch, const int corner[3])
{
    for (int t = 0; t < patch->triangle_count; t++) {
        const int *own = patch->triangle + 3 * t;
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

static bool maps_triangles(const OzPatch *patch, const Map *map)
{
    for (int t = 0; t < patch->triangle_count; t++) {
        int corner[3];
        for (int k = 0; k < 3; k++) {
            corner[k] = image(map, patch->triangle[3 * t + k]);
        }
        if (!has_triangle(patch, corner)) {
            return false;
        }
    }
    return true;
}

bool oz_symmetry_is_kept(const OzPatch *patch)
{
    for (int k = 0; k < 2 * patch->vertex_count; k++) {
        Map map = {k / 2, patch->vertex_count, k % 2};
        if (maps_outline(patch, &map) && !maps_triangles(patch, &map)) {
            return false;
        }
    }
    return true;
}
