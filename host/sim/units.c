/* Dimensions of the kernels' numbers. */
#include "sim/units.h"

#include <math.h>

/* The nearest power of two below. */
static double power_of_two(double value)
{
    int exponent;
    frexp(value, &exponent);
    return ldexp(1, exponent - 1);
}

/* Smallest and largest of an array; false of an empty one. */
static bool find_range(const double *values, int64_t count, double *least, double *most)
{
    for (int64_t i = 0; i < count; i++) {
        *least = i == 0 ? values[i] : fmin(*least, values[i]);
        *most = i == 0 ? values[i] : fmax(*most, values[i]);
    }
    return count > 0;
}

OzUnits oz_units_choose(const OzGrains *grains, double step)
{
    const OzElements *elements = grains->elements;
    int64_t count = elements ? elements->free_count : grains->count;
    double small = 1e-3, large, light = 1e-6, heavy = 1e-6;
    find_range(elements ? elements->reach : grains->diameter, count, &small, &large);
    find_range(elements ? elements->mass : grains->mass, count, &light, &heavy);
    return (OzUnits){.length = power_of_two(small),
                     .time = power_of_two(32 * step),
                     .mass = power_of_two(sqrt(light) * sqrt(heavy))};
}

double oz_units_speed(const OzUnits *units)
{
    return units->length / units->time;
}

double oz_units_spin(const OzUnits *units, bool is_momentum)
{
    return (is_momentum ? oz_units_inertia(units) : 1) / units->time;
}

double oz_units_force(const OzUnits *units)
{
    return units->mass * oz_units_speed(units) / units->time;
}

double oz_units_inertia(const OzUnits *units)
{
    return units->mass * units->length * units->length;
}

double oz_units_energy(const OzUnits *units)
{
    return units->mass * oz_units_speed(units) * oz_units_speed(units);
}

/* What constants of laws are counted in, by the names that kernels/laws.h gives them. */
typedef enum Dimension {
    ONE,
    PER_TIME,  /* 1/s, of a damping per unit of mass     */
    PER_TIME2, /* 1/s^2, of a stiffness per unit of mass */
    PRESSURE,  /* Pa                                     */
    HERTZIAN   /* N/m^(3/2)                              */
} Dimension;

static double unit_of(Dimension dimension, const OzUnits *u)
{
    double acceleration = u->length / (u->time * u->time);
    switch (dimension) {
    case PER_TIME:
        return 1 / u->time;
    case PER_TIME2:
        return 1 / (u->time * u->time);
    case PRESSURE:
        return u->mass * acceleration / (u->length * u->length);
    case HERTZIAN:
        return u->mass * acceleration / (u->length * sqrt(u->length));
    default:
        return 1;
    }
}

void oz_units_law(OzLawConstants *law, const OzUnits *u, int id)
{
#define ROW(NAME, name, choice, linear, stiffness, damping) [OZ_LAW_##NAME] = {stiffness, damping},
    static const struct {
        Dimension stiffness, damping;
    } dimensions[] = {OZ_LAWS(ROW)};
#undef ROW
    double stiffness = unit_of(dimensions[id].stiffness, u);
    double damping = unit_of(dimensions[id].damping, u);
    law->stiffness /= stiffness;
    law->adhesion /= oz_units_force(u) / u->length;
    law->damping /= damping;
    law->tangential_stiffness /= stiffness;
    law->tangential_damping /= damping;
}

static void count_wall(OzWallParameters *wall, const OzUnits *u, int law)
{
    wall->shape.radius /= u->length;
    for (int c = 0; c < 2; c++) {
        wall->shape.extent[c] /= u->length;
    }
    oz_units_law(&wall->law, u, law);
}

static void count_servo(OzServoConstants *servo, const OzUnits *u)
{
    servo->mass /= u->mass;
    servo->damping /= u->mass / u->time;
    servo->force /= oz_units_force(u);
    servo->pressure /= oz_units_force(u) / (u->length * u->length);
    for (int k = 0; k < 2; k++) {
        servo->gap[k] /= u->length;
    }
}

static void count_grain(OzParameters *p, const OzUnits *u)
{
    p->radius /= u->length;
    p->half_length /= u->length;
    p->mass /= u->mass;
    p->inverse_mass *= u->mass;
    p->inverse_inertia *= oz_units_inertia(u);
    p->inverse_inertia_axis *= oz_units_inertia(u);
}

/* What both models' parameters have for the lists: OZ_PARAMETERS_LISTS. */
#define COUNT_LISTS(p, u)                                                                          \
    do {                                                                                           \
        (p)->outer_least /= (u)->length;                                                           \
        (p)->outer_most /= (u)->length;                                                            \
        (p)->outer_time /= (u)->time;                                                              \
        (p)->skin_least /= (u)->length;                                                            \
        (p)->skin_most /= (u)->length;                                                             \
        (p)->skin_time /= (u)->time;                                                               \
        (p)->inverse_cell *= (u)->length;                                                          \
        (p)->reach_max /= (u)->length;                                                             \
    } while (0)

OzParameters oz_units_parameters(const OzParameters *si, int law)
{
    OzParameters p = *si;
    const OzUnits *u = &si->units;
    p.length_unit /= u->length;
    p.inverse_unit *= u->length;
    p.dt /= u->time;
    p.drag *= u->time;
    for (int c = 0; c < 3; c++) {
        p.gravity[c] *= u->time * u->time / u->length;
    }
    p.fluid.linear /= u->mass / (u->length * u->time);
    p.fluid.square /= u->mass / (u->length * u->length * u->length);
    for (int c = 0; c < 3; c++) {
        p.fluid.wind[c] /= oz_units_speed(u);
    }
    oz_units_law(&p.law, u, law);
    for (int w = 0; w < OZ_WALLS_MAX; w++) {
        count_wall(&p.wall[w], u, law);
    }
    for (int s = 0; s < OZ_SERVOS_MAX; s++) {
        count_servo(&p.servo[s], u);
    }
    COUNT_LISTS(&p, u);
    count_grain(&p, u);
    p.units = (OzUnits){1, 1, 1};
    return p;
}

static void count_beam(OzBeamConstants *beam, const OzUnits *u)
{
    double volume = u->length * u->length * u->length;
    beam->stiffness /= oz_units_force(u) / u->length;
    beam->bending /= oz_units_force(u) / u->length * volume;
    beam->damping /= u->mass / u->time;
    beam->damping_bending /= u->mass / u->time * volume;
}

static void count_disc(OzDiscLaw *law, const OzUnits *u)
{
    double linear = 1 / (u->time * u->time);
    double power = oz_units_force(u) / (u->length * sqrt(u->length));
    law->stiffness /= law->hertz > 0 ? power : linear;
    law->damping *= u->time;
    law->tangential_damping *= u->time;
}

static void count_strength(OzBeamStrength *strength, const OzUnits *u)
{
    strength->pulled *= oz_units_force(u);
    strength->pressed *= oz_units_force(u);
    strength->bent *= oz_units_energy(u);
}

OzElementParameters oz_units_elements(const OzElementParameters *si)
{
    OzElementParameters p = *si;
    const OzUnits *u = &si->units;
    p.dt /= u->time;
    p.drag *= u->time;
    p.domain /= u->length;
    for (int c = 0; c < 2; c++) {
        p.gravity[c] *= u->time * u->time / u->length;
        p.middle[c] /= u->length;
    }
    p.stiffness /= oz_units_force(u) / (u->length * u->length);
    count_beam(&p.beam, u);
    count_strength(&p.strength, u);
    count_strength(&p.yield, u);
    for (int w = 0; w <= OZ_ELEMENT_WALLS_MAX; w++) {
        count_disc(&p.law[w], u);
    }
    COUNT_LISTS(&p, u);
    p.units = (OzUnits){1, 1, 1};
    return p;
}
