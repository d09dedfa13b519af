/* The free side of containers made of triangles. Knows nothing of grains but circles around them.
 */
#include "model/fill_region_flat.h"

#include <math.h>
#include <stddef.h>

/* The first wall of the highest rank that the scene has; NULL where none encloses anything. */
static const OzWall *find_container(const OzScene *scene)
{
#define ROW(NAME, name, choice, rank) [OZ_WALL_##NAME] = rank,
    static const int ranks[OZ_WALLS_END] = {OZ_TRIGRAINS_WALLS(ROW)};
#undef ROW
    const OzWall *found = NULL;
    for (int w = 0; w < scene->wall_count; w++) {
        int rank = ranks[scene->walls[w].kind];
        if (rank > (found ? ranks[found->kind] : 0)) {
            found = &scene->walls[w];
        }
    }
    return found;
}

/* How high the region must be for this area, m. */
static double height_for(const OzWall *wall, double area)
{
    if (wall->kind != OZ_WALL_HOPPER) {
        return area / wall->width;
    }
    double rise = (wall->width - wall->opening) / 2 * tan(wall->slope);
    return area / wall->width + rise * (wall->width - wall->opening) / (2 * wall->width);
}

static void box_of_container(OzFillRegionFlat *fill_region, double area, double reach)
{
    const OzWall *wall = fill_region->container;
    bool round = wall->kind == OZ_WALL_DRUM;
    double half = (round ? wall->diameter : wall->width) / 2;
    fill_region->low[0] = wall->point[0] - half;
    fill_region->high[0] = wall->point[0] + half;
    fill_region->low[1] = round ? wall->point[1] - half : wall->point[1];
    fill_region->high[1] =
        round ? wall->point[1] + half
              : wall->point[1] + wall->tooth_depth + fmax(height_for(wall, area), 2 * reach);
}

/* Between the outermost ends of the segments, from the lowest end upwards. */
static void box_of_segments(OzFillRegionFlat *fill_region, const OzScene *scene, double area,
                            double reach)
{
    double low[2] = {INFINITY, INFINITY}, high = -INFINITY;
    for (int w = 0; w < scene->wall_count; w++) {
        const OzWall *wall = &scene->walls[w];
        low[0] = fmin(low[0], fmin(wall->from[0], wall->to[0]));
        high = fmax(high, fmax(wall->from[0], wall->to[0]));
        low[1] = fmin(low[1], fmin(wall->from[1], wall->to[1]));
    }
    double width = fmax(high - low[0], 2.1 * reach);
    fill_region->low[0] = low[0];
    fill_region->low[1] = low[1];
    fill_region->high[0] = low[0] + width;
    fill_region->high[1] = low[1] + fmax(area / width, 2.1 * reach);
}

OzFillRegionFlat oz_fill_region_flat_make(const OzScene *scene, const OzTriangleSet *walls,
                                          double area, double reach)
{
    OzFillRegionFlat fill_region = {
        .container = find_container(scene), .walls = walls, .wall_count = scene->wall_count};
    if (fill_region.container) {
        box_of_container(&fill_region, area, reach);
    } else if (scene->wall_count) {
        box_of_segments(&fill_region, scene, area, reach);
    } else {
        double half = fmax(sqrt(area) / 2, 1.05 * reach);
        fill_region.low[0] = fill_region.low[1] = -half;
        fill_region.high[0] = fill_region.high[1] = half;
    }
    return fill_region;
}

bool oz_fill_region_flat_raise(OzFillRegionFlat *fill_region)
{
    bool round = fill_region->container && fill_region->container->kind == OZ_WALL_DRUM;
    if (!round) {
        fill_region->high[1] += 0.1 * (fill_region->high[1] - fill_region->low[1]);
    }
    return !round;
}

void oz_fill_region_flat_draw(const OzFillRegionFlat *fill_region, OzRandom *random,
                              double point[2])
{
    for (int k = 0; k < 2; k++) {
        point[k] = oz_random_uniform(random, fill_region->low[k], fill_region->high[k]);
    }
}

static double distance_to_line(const double *a, const double *b, const double *p)
{
    double x = b[0] - a[0], y = b[1] - a[1];
    double along = ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / (x * x + y * y);
    along = fmin(fmax(along, 0), 1);
    return hypot(p[0] - a[0] - along * x, p[1] - a[1] - along * y);
}

/* From a point to a triangle, m; 0 inside. */
static double distance_to(const double corners[6], const double point[2])
{
    double nearest = INFINITY;
    int left = 0;
    for (int c = 0; c < 3; c++) {
        const double *a = corners + 2 * c, *b = corners + 2 * ((c + 1) % 3);
        double side = (b[0] - a[0]) * (point[1] - a[1]) - (point[0] - a[0]) * (b[1] - a[1]);
        left += side > 0;
        nearest = fmin(nearest, distance_to_line(a, b, point));
    }
    return left == 0 || left == 3 ? 0 : nearest;
}

static bool touches_wall(const OzFillRegionFlat *fill_region, const double centre[2], double radius)
{
    double corners[6];
    for (int w = 0; w < fill_region->wall_count; w++) {
        for (int t = 0; t < fill_region->walls[w].triangle_count; t++) {
            oz_triangle_set_corners(&fill_region->walls[w], t, corners);
            if (distance_to(corners, centre) <= radius) {
                return true;
            }
        }
    }
    return false;
}

/* Above the opening, between the sides and above both slopes, with teeth and radius to spare. */
static bool is_in_hopper(const OzWall *wall, double x, double y, double spare)
{
    double beside = fabs(x) - wall->opening / 2;
    return y >= spare && fabs(x) + spare <= wall->width / 2 &&
           y * cos(wall->slope) - fmax(beside, 0) * sin(wall->slope) >= spare;
}

/* Whether a circle lies inside a container; x and y: of its centre, seen from the container's
 * point. */
static bool inside_drum(const OzWall *wall, double x, double y, double radius)
{
    return hypot(x, y) + radius + wall->tooth_depth <= wall->diameter / 2;
}

static bool inside_hopper(const OzWall *wall, double x, double y, double radius)
{
    return is_in_hopper(wall, x, y, radius + wall->tooth_depth);
}

static bool inside_vessel(const OzWall *wall, double x, double y, double radius)
{
    return fabs(x) + radius <= wall->width / 2 && y >= radius + wall->tooth_depth;
}

static bool inside_floor(const OzWall *wall, double x, double y, double radius)
{
    return inside_vessel(wall, x, y, radius);
}

/* No container: see find_container. */
static bool inside_segment(const OzWall *wall, double x, double y, double radius)
{
    (void)wall, (void)x, (void)y, (void)radius;
    return true;
}

#define ROW(NAME, name, choice, rank) [OZ_WALL_##NAME] = inside_##name,
static bool (*const insides[])(const OzWall *wall, double x, double y,
                               double radius) = {OZ_TRIGRAINS_WALLS(ROW)};
#undef ROW

static bool is_inside(const OzFillRegionFlat *fill_region, const double centre[2], double radius)
{
    const OzWall *wall = fill_region->container;
    if (!wall) {
        return centre[0] - radius >= fill_region->low[0] &&
               centre[0] + radius <= fill_region->high[0] &&
               centre[1] - radius >= fill_region->low[1] &&
               centre[1] + radius <= fill_region->high[1];
    }
    return insides[wall->kind](wall, centre[0] - wall->point[0], centre[1] - wall->point[1],
                               radius);
}

bool oz_fill_region_flat_holds(const OzFillRegionFlat *fill_region, const double centre[2],
                               double radius)
{
    return is_inside(fill_region, centre, radius) && !touches_wall(fill_region, centre, radius);
}
