/* What of the walls a bed lies in. */
#include "observe/basin.h"

#include "scene/boundary.h"
#include "scene/wall_shape.h"
#include "scene/wall_swing.h"

#include <math.h>

static const double PI = 3.14159265358979323846, LEVEL = 1 - 1e-9;

/* Turning about the vertical leaves a level wall level. */
static bool tilts(const OzWall *wall)
{
    return oz_wall_swing_has(wall) && !(fabs(wall->motion.axis[2]) > LEVEL);
}

static bool is_box(const OzWall *wall)
{
    return wall->kind == OZ_WALL_BOX && !tilts(wall);
}

static bool is_level(const OzWall *wall)
{
    return wall->normal[2] > LEVEL && !tilts(wall);
}

static bool is_plane(const OzWall *wall)
{
    return wall->kind == OZ_WALL_PLANE && is_level(wall);
}

static bool is_pot(const OzWall *wall)
{
    return is_box(wall) || (oz_wall_shape_is_upright(wall) && wall->length > 0);
}

static bool is_plate(const OzWall *wall)
{
    return (wall->kind == OZ_WALL_DISC || wall->kind == OZ_WALL_RECTANGLE) && is_level(wall);
}

static int first(const OzScene *scene, bool (*is)(const OzWall *wall))
{
    for (int w = 0; w < scene->wall_count; w++) {
        const OzWall *wall = &scene->walls[w];
        if (!(wall->since > 0) && !(wall->until > 0) && is(wall)) {
            return w;
        }
    }
    return -1;
}

int oz_basin_floor(const OzScene *scene)
{
    bool (*const kinds[])(const OzWall *) = {is_plane, is_pot, is_plate};
    int floor = -1;
    for (int k = 0; k < 3 && floor < 0; k++) {
        floor = first(scene, kinds[k]);
    }
    return floor;
}

double oz_basin_bottom(const OzWall *floor)
{
    double axis[3] = {0, 0, 0};
    if (floor->kind == OZ_WALL_CYLINDER) {
        oz_wall_shape_axis(floor, axis);
    }
    return floor->point[2] + fmin(axis[2] * floor->length, 0);
}

double oz_basin_area(const OzScene *scene)
{
    int w = first(scene, oz_wall_shape_is_upright);
    if (w >= 0) {
        return PI / 4 * scene->walls[w].diameter * scene->walls[w].diameter;
    }
    w = first(scene, is_box);
    return w < 0 ? oz_boundary_period(&scene->boundary, 0) * oz_boundary_period(&scene->boundary, 1)
                 : scene->walls[w].size[0] * scene->walls[w].size[1];
}
