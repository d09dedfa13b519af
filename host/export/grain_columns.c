/* The rows. */
#include "export/grain_columns.h"

#include "scene/mixing.h"

#include <string.h>

static void fill_id(const OzSnapshot *snapshot, int64_t grain, double *values)
{
    (void)snapshot;
    *values = (double)grain;
}

static void fill_population(const OzSnapshot *snapshot, int64_t grain, double *values)
{
    *values = snapshot->grains->population[grain];
}

static void fill_material(const OzSnapshot *snapshot, int64_t grain, double *values)
{
    *values = oz_mixing_material(snapshot->scene, snapshot->grains->population[grain]);
}

static void fill_position(const OzSnapshot *snapshot, int64_t grain, double *values)
{
    memcpy(values, &snapshot->position[3 * grain], 3 * sizeof *values);
}

static void fill_quaternion(const OzSnapshot *snapshot, int64_t grain, double *values)
{
    memcpy(values, &snapshot->quaternion[4 * grain], 4 * sizeof *values);
}

static void fill_axis(const OzSnapshot *snapshot, int64_t grain, double *values)
{
    memcpy(values, &snapshot->axis[3 * grain], 3 * sizeof *values);
}

static void fill_velocity(const OzSnapshot *snapshot, int64_t grain, double *values)
{
    memcpy(values, &snapshot->velocity[3 * grain], 3 * sizeof *values);
}

static void fill_angular_velocity(const OzSnapshot *snapshot, int64_t grain, double *values)
{
    memcpy(values, &snapshot->angular_velocity[3 * grain], 3 * sizeof *values);
}

static void fill_diameter(const OzSnapshot *snapshot, int64_t grain, double *values)
{
    *values = snapshot->grains->diameter[grain];
}

static void fill_length(const OzSnapshot *snapshot, int64_t grain, double *values)
{
    *values = snapshot->grains->length[grain];
}

static void fill_mass(const OzSnapshot *snapshot, int64_t grain, double *values)
{
    *values = snapshot->grains->mass[grain];
}

static void fill_turned(const OzSnapshot *snapshot, int64_t grain, double *values)
{
    *values = oz_elements_turned(snapshot->grains->elements, grain, snapshot->element_angle);
}

static void fill_area(const OzSnapshot *snapshot, int64_t grain, double *values)
{
    *values = oz_elements_body_area(snapshot->grains->elements, grain);
}

enum {
    RODS = 1 << OZ_MODEL_RODS,
    FLAT = 1 << OZ_MODEL_TRIGRAINS,
    ALL = RODS | FLAT,
};

/* clang-format off: a row is a line. */
static const OzGrainColumn COLUMNS[] = {
    {"id", "1", 1, {"id"}, true, true, ALL, fill_id},
    {"population", "1", 1, {"population"}, true, true, ALL, fill_population},
    {"material", "1", 1, {"material"}, true, true, RODS, fill_material},
    {"position", "m", 3, {"x", "y", "z"}, false, false, ALL, fill_position},
    {"velocity", "m s-1", 3, {"vx", "vy", "vz"}, false, false, ALL, fill_velocity},
    {"angular_velocity",
     "rad s-1",
     3,
     {"wx", "wy", "wz"},
     false,
     false,
     ALL,
     fill_angular_velocity},
    {"quaternion", "1", 4, {"qw", "qx", "qy", "qz"}, false, false, RODS, fill_quaternion},
    {"axis", "1", 3, {"ax", "ay", "az"}, false, false, RODS, fill_axis},
    {"turned", "rad", 1, {"turned"}, false, false, FLAT, fill_turned},
    {"diameter", "m", 1, {"diameter"}, false, true, RODS, fill_diameter},
    {"length", "m", 1, {"length"}, false, true, RODS, fill_length},
    {"area", "m2", 1, {"area"}, false, true, FLAT, fill_area},
    {"mass", "kg", 1, {"mass"}, false, true, ALL, fill_mass},
    {NULL},
};
/* clang-format on */

const OzGrainColumn *oz_grain_columns_all(void)
{
    return COLUMNS;
}

bool oz_grain_columns_serves(const OzGrainColumn *column, const OzSnapshot *snapshot)
{
    bool is_listed = column->fill != fill_material || snapshot->scene->material_count > 0;
    return is_listed && (column->models & (snapshot->grains->elements ? FLAT : RODS)) != 0;
}
