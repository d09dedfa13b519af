/* Level lines of walls by bisection. */
#include "draw/wall_levels.h"

#include "scene/wall_shape.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

enum {
    LEVELS = 9,
    SEGMENTS = 96 /* of a turn: as circles of other walls have */
};

static bool is_within(const OzWallLevels *levels, const double point[3])
{
    return oz_wall_shape_distance(levels->wall, levels->offset, point, NULL) > 0;
}

/* Where a ray meets the wall; false where it begins behind the wall or stays free as far as the
 * picture goes. */
static bool find_edge(const OzWallLevels *levels, double angle, double z, double point[3])
{
    const double *middle = levels->wall->point;
    double low = 0, high = 8 * levels->camera->unit, at = 0;
    for (int i = 0; i < 40; i++) {
        at = i == 0 ? low : i == 1 ? high : 0.5 * (low + high);
        point[0] = middle[0] + at * cos(angle);
        point[1] = middle[1] + at * sin(angle);
        point[2] = z;
        bool found_within = is_within(levels, point);
        if (i < 2 && found_within != (i == 0)) {
            return false;
        }
        *(found_within ? &low : &high) = at;
    }
    return true;
}

static void add_level(const OzWallLevels *levels, double z, OzMesh *behind, OzMesh *before,
                      const float rgba[4])
{
    double points[2][3];
    bool known[2];
    known[0] = find_edge(levels, 0, z, points[0]);
    for (int i = 1; i <= (levels->is_cut ? SEGMENTS / 2 : SEGMENTS); i++) {
        known[i % 2] = find_edge(levels, 2 * PI * i / SEGMENTS, z, points[i % 2]);
        if (known[0] && known[1]) {
            oz_mesh_line(2 * i <= SEGMENTS ? behind : before, levels->camera, points[1 - i % 2],
                         points[i % 2], levels->line_width, rgba);
        }
    }
}

void oz_wall_levels_add(const OzWallLevels *levels, OzMesh *behind, OzMesh *before,
                        const float rgba[4])
{
    for (int i = 0; i < LEVELS; i++) {
        double share = (i + 0.5) / LEVELS;
        add_level(levels, levels->low + share * (levels->high - levels->low), behind, before, rgba);
    }
}
