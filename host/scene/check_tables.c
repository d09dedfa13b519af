/* The checks of fields. */
#include "scene/check_tables.h"

#include "scene/boundary.h"

#include <math.h>
#include <stdio.h>

/* Of a grain's diameter: the points that stand for a body's volume (observe/coarse_body.h) are told
 * apart in less. */
static const double LEAST_WIDTH = 0.1;

static void check_range(const OzScene *scene, OzNode *root, OzFaults *faults, int axis)
{
    const OzFieldTable *fields = &scene->fields;
    double length = fields->range[axis][1] - fields->range[axis][0];
    double period = oz_boundary_period(&scene->boundary, axis);
    bool is_looked_along = fields->cells[axis] > 1 || fields->has_range[axis];
    char path[16];
    snprintf(path, sizeof path, "fields.%c", 'x' + axis);
    if (fields->has_range[axis] && !(length > 0)) {
        oz_tree_fault(root, faults, path,
                      "%s ends at %g m and begins at %g m; expected an end above that", path,
                      fields->range[axis][1], fields->range[axis][0]);
    } else if (fields->has_range[axis] && period > 0 && length > period * (1 + 1e-12)) {
        oz_tree_fault(root, faults, path,
                      "%s is %g m long, longer than the periodic cell; expected at most %g m", path,
                      length, period);
    } else if (period > 0 && is_looked_along && fields->width > period) {
        oz_tree_fault(
            root, faults, "fields.width",
            "fields.width is %g m, more than the periodic cell's %g m along %c; expected less",
            fields->width, period, 'x' + axis);
    }
}

static void check_width(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    double largest = 0;
    for (int p = 0; p < scene->population_count; p++) {
        largest = fmax(largest, scene->populations[p].diameter.high);
    }
    if (scene->fields.width > 0 && scene->fields.width < LEAST_WIDTH * largest) {
        oz_tree_fault(
            root, faults, "fields.width",
            "fields.width is %g m, of grains of up to %g m; expected at least a tenth of that",
            scene->fields.width, largest);
    }
}

void oz_check_tables_fields(const OzScene *scene, OzNode *root, OzFaults *faults)
{
    const int64_t *cells = scene->fields.cells;
    if (!scene->fields.present) {
        return;
    }
    double count = (double)cells[0] * (double)cells[1] * (double)cells[2];
    if (count > OZ_CHECK_CELLS_MAX) {
        oz_tree_fault(root, faults, "fields.cells",
                      "fields.cells are %g; expected at most %d in all", count, OZ_CHECK_CELLS_MAX);
    }
    for (int axis = 0; axis < 3; axis++) {
        check_range(scene, root, faults, axis);
    }
    check_width(scene, root, faults);
}
