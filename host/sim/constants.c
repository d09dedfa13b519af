/* Parameters from scenes. */
#include "sim/constants.h"

#include "model/calibrate.h"
#include "scene/boundary.h"
#include "scene/wall_shape.h"
#include "sim/servos.h"
#include "sim/sides.h"
#include "sim/units.h"

#include <string.h>

OzLawConstants oz_constants_law(const OzScene *scene, const OzContactValues *values)
{
    OzContactConstants constants = oz_calibrate_contact(scene, values);
    OzLawConstants law = {.stiffness = constants.stiffness,
                          .damping = constants.damping,
                          .tangential_stiffness = constants.tangential_stiffness,
                          .tangential_damping = constants.tangential_damping,
                          .friction = values->friction,
                          .adhesion = 2 * M_PI * values->surface_energy,
                          .rolling_friction = values->rolling_friction,
                          .twisting_friction = values->twisting_friction,
                          .rolling_damping = values->rolling_damping};
    return law;
}

static double larger(double a, double b)
{
    return a > b ? a : b;
}

/* The farthest that anything starts from the origin, m. */
static double extent(const OzScene *scene, const OzGrains *grains)
{
    double far = 0;
    for (int64_t i = 0; i < 3 * grains->count; i++) {
        far = larger(far, fabs(grains->position[i]));
    }
    for (int w = 0; w < scene->wall_count; w++) {
        OzWallShape sides[OZ_WALL_SIDES_MAX];
        const OzMotion *motion = &scene->walls[w].motion;
        for (int c = 0; c < 3 && motion->has_point; c++) {
            far = larger(far, fabs(motion->point[c]));
        }
        for (int k = oz_wall_shape_sides(&scene->walls[w], sides) - 1; k >= 0; k--) {
            far = larger(far, sides[k].radius);
            for (int c = 0; c < 3; c++) {
                far = larger(far, fabs(sides[k].point[c]));
            }
        }
    }
    return far;
}

/* The unit of a place in single precision: 2^-22 to 2^-17 of the smallest diameter, the finest with
 * which one and a half times the extent stays within 2^30 units (differences of two places must fit
 * 32 bits). At 40, 450 and 4500 diameters this leaves rounding of 1e-7, 5e-7 and 4e-6 diameters. */
static OzStatus choose_unit(double *unit, const OzScene *scene, const OzGrains *grains)
{
    double smallest = 1e-3, far = extent(scene, grains);
    for (int k = 0; k < 3; k++) {
        far = larger(far, oz_boundary_period(&scene->boundary, k));
    }
    for (int64_t i = 0; i < grains->count; i++) {
        smallest = i == 0 || grains->diameter[i] < smallest ? grains->diameter[i] : smallest;
    }
    for (int bits = 22; bits >= 17; bits--) {
        *unit = ldexp(smallest, -bits);
        if (1.5 * far < *unit * 0x1p30) {
            return OZ_OK;
        }
    }
    return oz_status_fail(
        OZ_ERR_INPUT,
        "%s: the scene reaches %g m from the origin, %.3g times the smallest diameter; "
        "precision: float holds 5461, precision: double any",
        scene->path, far, far / smallest);
}

static void fill_wall(OzWallParameters *to, const OzScene *scene, const OzWall *from,
                      const OzWallShape *side, double unit)
{
    to->shape = *side;
    oz_wall_shape_shift(from, 1, to->direction);
    memcpy(to->axis, from->motion.axis, sizeof to->axis);
    for (int c = 0; c < 3; c++) {
        double units = to->shape.point[c] / unit;
        to->shape.point[c] = unit < 1 ? round(units) : units;
    }
    to->law = oz_constants_law(scene, &from->contact);
}

static int fill_walls(OzParameters *parameters, int wall_order[OZ_WALLS_MAX], const OzScene *scene)
{
    OzWallSide sides[OZ_WALLS_MAX];
    int count = oz_sides_list(sides, scene);
    for (int k = 0; k < count; k++) {
        fill_wall(&parameters->wall[k], scene, &scene->walls[sides[k].wall], &sides[k].shape,
                  parameters->length_unit);
        wall_order[k] = sides[k].wall;
    }
    return count;
}

/* Reach of the largest grain, and the one grain of an equal population. */
static void fill_shapes(OzParameters *parameters, const OzGrains *grains)
{
    for (int64_t i = 0; i < grains->count; i++) {
        double reach = (grains->diameter[i] + grains->length[i]) / 2;
        parameters->reach_max = larger(parameters->reach_max, reach);
    }
    if (grains->count > 0) {
        parameters->radius = grains->diameter[0] / 2;
        parameters->radius_count = parameters->radius / parameters->length_unit;
        parameters->half_length = grains->length[0] / 2;
        parameters->mass = grains->mass[0];
        parameters->inverse_mass = 1 / grains->mass[0];
        parameters->inverse_inertia = 1 / grains->inertia[0];
        parameters->inverse_inertia_axis = 1 / grains->inertia_axis[0];
    }
}

/* By the scene's own extent and step. */
static OzStatus choose_units(OzParameters *parameters, const OzScene *scene, const OzGrains *grains)
{
    parameters->length_unit = 1;
    parameters->domain = 1e9;
    parameters->units = (OzUnits){1, 1, 1};
    if (scene->precision == OZ_PRECISION_FLOAT) {
        OZ_PASS(choose_unit(&parameters->length_unit, scene, grains));
        parameters->domain = 0x1p30;
        parameters->units = oz_units_choose(grains, scene->step);
    }
    return OZ_OK;
}

static OzStatus keep_units(OzParameters *parameters, const OzScene *scene, const OzGrains *grains,
                           const OzParameters *running)
{
    double most = running->length_unit * 0x1p30 / 1.5, far = extent(scene, grains);
    parameters->length_unit = running->length_unit;
    parameters->domain = running->domain;
    parameters->units = running->units;
    if (scene->precision == OZ_PRECISION_FLOAT && !(far < most)) {
        return oz_status_fail(OZ_ERR_INPUT,
                              "%s: the scene reaches %g m from the origin; the running one holds "
                              "places up to %.3g m",
                              scene->path, far, most);
    }
    return OZ_OK;
}

/* Whole counts in single precision, in two floats. */
static void fill_space(OzParameters *parameters, const OzScene *scene)
{
    for (int k = 0; k < 3; k++) {
        double counts = oz_boundary_period(&scene->boundary, k) / parameters->length_unit;
        bool is_float = scene->precision == OZ_PRECISION_FLOAT;
        double whole = is_float ? rint(counts) : counts;
        parameters->period[k] = is_float ? (double)(float)whole : whole;
        parameters->period_rest[k] = whole - parameters->period[k];
        parameters->inverse_period[k] = whole > 0 ? 1 / whole : 0;
    }
}

static void fill_rest(OzParameters *parameters, int wall_order[OZ_WALLS_MAX], const OzScene *scene,
                      const OzGrains *grains)
{
    parameters->inverse_unit = 1 / parameters->length_unit;
    parameters->dt = scene->step;
    memcpy(parameters->gravity, scene->gravity, sizeof scene->gravity);
    parameters->law = oz_constants_law(scene, &scene->contact);
    parameters->fluid.linear = 3 * M_PI * scene->drag.viscosity;
    parameters->fluid.square = M_PI / 8 * scene->drag.density * scene->drag.coefficient;
    memcpy(parameters->fluid.wind, scene->drag.wind, sizeof scene->drag.wind);
    parameters->deep_warn = scene->guards.overlap_warn;
    parameters->deep_stop = scene->guards.overlap_stop;
    parameters->deep_look = fmin(1, fmin(parameters->deep_warn, parameters->deep_stop));
    fill_space(parameters, scene);
    int walls = fill_walls(parameters, wall_order, scene);
    oz_servos_fill(parameters, wall_order, walls, scene, grains);
    fill_shapes(parameters, grains);
}

/* Grains of a file may be of any length. */
static OzStatus check_cell(const OzScene *scene, const OzParameters *parameters)
{
    for (int k = 0; k < 3; k++) {
        double period = oz_boundary_period(&scene->boundary, k), length = 2 * parameters->reach_max;
        if (period > 0 && length > OZ_BOUNDARY_LONGEST * period) {
            return oz_status_fail(
                OZ_ERR_INPUT,
                "%s: a grain %g m long would meet two images of another; expected "
                "less than half the cell's %g m along %c",
                scene->path, length, period, 'x' + k);
        }
    }
    return OZ_OK;
}

OzStatus oz_constants_refill(OzParameters *parameters, int wall_order[OZ_WALLS_MAX],
                             const OzScene *scene, const OzGrains *grains,
                             const OzParameters *running)
{
    OzParameters filled = {.dt = 0};
    OZ_PASS(oz_sides_check(scene));
    OZ_PASS(running ? keep_units(&filled, scene, grains, running)
                    : choose_units(&filled, scene, grains));
    fill_rest(&filled, wall_order, scene, grains);
    OZ_PASS(check_cell(scene, &filled));
    *parameters = filled;
    return OZ_OK;
}

OzStatus oz_constants_fill(OzParameters *parameters, int wall_order[OZ_WALLS_MAX],
                           const OzScene *scene, const OzGrains *grains)
{
    memset(parameters, 0, sizeof *parameters);
    return oz_constants_refill(parameters, wall_order, scene, grains, NULL);
}
