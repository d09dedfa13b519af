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

double oz_boundary_strain(const OzBoundary *boundary, double time, bool settling)
{
    double rate = settling ? 0 : boundary->shear_rate;
    return boundary->strain + rate * (time - boundary->since);
}

double oz_boundary_turns(const OzBoundary *boundary, double strain)
{
    return boundary->is_sheared ? rint(strain * boundary->size[1] / boundary->size[0]) : 0;
}

double oz_boundary_tilt(const OzBoundary *boundary, double strain)
{
    double turns = oz_boundary_turns(boundary, strain);
    return boundary->is_sheared ? strain - turns * boundary->size[0] / boundary->size[1] : 0;
}

OzBoundary oz_boundary_at(const OzBoundary *boundary, double time, bool settling)
{
    OzBoundary now = *boundary;
    now.strain = oz_boundary_strain(boundary, time, settling);
    now.since = time;
    now.tilt = oz_boundary_tilt(boundary, now.strain);
    return now;
}

void oz_boundary_take_over(OzBoundary *next, const OzBoundary *running, double time)
{
    bool same = next->shear_rate == running->shear_rate;
    next->strain = same ? running->strain : oz_boundary_strain(running, time, false);
    next->since = same ? running->since : time;
}

OzStatus oz_boundary_check_next(const OzScene *running, const OzScene *next)
{
    if (running->boundary.is_sheared && !next->boundary.is_sheared) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: boundary.shear_rate is not there, and the running scene's cell "
                              "is sheared; expected boundary.shear_rate, 0 to stop",
                              next->path);
    }
    return OZ_OK;
}

/* Along y first: a cell's step there is one along x, too, where it tilts. */
void oz_boundary_wrap(const OzBoundary *boundary, double place[3])
{
    static const int order[3] = {1, 0, 2};
    for (int i = 0; i < 3; i++) {
        int k = order[i];
        double period = oz_boundary_period(boundary, k);
        double way = period > 0 ? period * rint(place[k] / period) : 0;
        place[k] -= way;
        place[0] -= k == 1 ? boundary->tilt * way : 0;
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

/* The flow's velocity grows along y without end: nothing else may tell one y from another. */
static void check_shear(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    const OzBoundary *boundary = &scene->boundary;
    double strain = fabs(boundary->shear_rate) * scene->step;
    if (!(oz_boundary_period(boundary, 0) > 0 && oz_boundary_period(boundary, 1) > 0)) {
        oz_tree_fault(root, faults, "boundary.shear_rate",
                      "boundary.shear_rate in a cell that is open along x or y; expected x and y: "
                      "periodic");
    }
    if (scene->gravity[0] != 0 || scene->gravity[1] != 0) {
        oz_tree_fault(root, faults, "boundary.shear_rate",
                      "boundary.shear_rate with gravity along x or y, in which the sheared cell "
                      "falls without end; expected gravity: [0, 0, g]");
    }
    if (strain > OZ_BOUNDARY_STEP_MOST) {
        oz_tree_fault(root, faults, "boundary.shear_rate",
                      "boundary.shear_rate strains the cell by %g in a step; expected at most %g",
                      strain, OZ_BOUNDARY_STEP_MOST);
    }
    if (scene->broadphase == OZ_BROADPHASE_SORT_AXIS) {
        oz_tree_fault(root, faults, "boundary.shear_rate",
                      "boundary.shear_rate with broadphase: sort-axis, which knows no shear; "
                      "expected another");
    }
    bool is_shown =
        scene->movie.colour == OZ_COLOUR_ORDER || scene->snapshots.colour == OZ_COLOUR_ORDER;
    if (scene->fields.present) {
        oz_tree_fault(root, faults, "boundary.shear_rate",
                      "fields of a sheared cell, whose images they would look for as if it stood "
                      "upright; expected no fields");
    }
    if (scene->observe.order || is_shown) {
        oz_tree_fault(root, faults, "boundary.shear_rate",
                      "order in a sheared cell, which neighbours are looked for as if it stood "
                      "upright; expected neither observe.order nor colours by it");
    }
}

void oz_boundary_check(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    if (scene->boundary.present) {
        check_sizes(scene, root, faults);
        check_grains(scene, root, faults);
        check_walls(scene, root, faults);
        if (scene->boundary.is_sheared) {
            check_shear(scene, root, faults);
        }
    }
}
