/* Periodic cells. */
#include "scene/boundary.h"

#include "scene/wall_swing.h"

#include <math.h>
#include <stdio.h>

double oz_boundary_period(const OzBoundary *boundary, int axis)
{
    bool repeats = boundary->present && boundary->along[axis] == OZ_BOUNDARY_PERIODIC;
    return repeats ? boundary->size[axis] : 0;
}

void oz_boundary_wrap(const OzBoundary *boundary, double place[3])
{
    for (int k = 0; k < 3; k++) {
        double period = oz_boundary_period(boundary, k);
        place[k] -= period > 0 ? period * rint(place[k] / period) : 0;
    }
}

static void check_sizes(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    const OzBoundary *boundary = &scene->boundary;
    bool any = false;
    for (int k = 0; k < 3; k++) {
        any |= boundary->along[k] == OZ_BOUNDARY_PERIODIC;
        if (boundary->along[k] == OZ_BOUNDARY_PERIODIC && !(boundary->size[k] > 0) &&
            oz_tree_at(root, "boundary.size")) {
            oz_tree_fault(root, faults, "boundary.size",
                          "boundary.size is %g m along %c; expected more than 0 where it is "
                          "periodic",
                          boundary->size[k], 'x' + k);
        }
    }
    if (!any) {
        oz_tree_fault(root, faults, "boundary",
                      "boundary has no periodic direction; expected one of x, y, z");
    }
}

static void check_grains(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    for (int p = 0; p < scene->population_count; p++) {
        const OzPopulation *grains = &scene->populations[p];
        double length = grains->diameter.high * (1 + grains->aspect.high);
        for (int k = 0; k < 3; k++) {
            double period = oz_boundary_period(&scene->boundary, k);
            if (period > 0 && length > OZ_BOUNDARY_LONGEST * period) {
                char path[64];
                snprintf(path, sizeof path, "grains.%d.diameter", p);
                oz_tree_fault(
                    root, faults, path,
                    "grains up to %g m long would meet two images of each other; expected "
                    "less than half the cell's %g m along %c",
                    length, period, 'x' + k);
                break;
            }
        }
    }
}

/* Whether a wall looks the same from every cell. */
static bool is_alike(const OzWall *wall, const OzBoundary *boundary)
{
    bool alike =
        wall->kind == OZ_WALL_PLANE || (wall->kind == OZ_WALL_CYLINDER && wall->length == 0);
    for (int k = 0; k < 3; k++) {
        bool is_plane = wall->kind == OZ_WALL_PLANE;
        double along = fabs(is_plane ? wall->normal[k] : wall->axis[k]);
        if (oz_boundary_period(boundary, k) > 0) {
            alike &= is_plane ? along < 1e-12 : along > 1 - 1e-12;
            alike &= !oz_wall_swing_tilts(wall) || fabs(wall->motion.axis[k]) > 1 - 1e-12;
        }
    }
    return alike;
}

static void check_walls(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    for (int w = 0; w < scene->wall_count; w++) {
        char path[64];
        snprintf(path, sizeof path, "walls.%d", w);
        if (!is_alike(&scene->walls[w], &scene->boundary)) {
            oz_tree_fault(root, faults, path,
                          "walls.%d is not the same in every cell; expected a plane along the "
                          "periodic directions, or an endless cylinder",
                          w);
        }
    }
}

void oz_boundary_check(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    if (scene->boundary.present) {
        check_sizes(scene, root, faults);
        check_grains(scene, root, faults);
        check_walls(scene, root, faults);
    }
}
