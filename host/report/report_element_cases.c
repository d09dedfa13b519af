/* Outcomes of the report's scenes of trigrains. The snapshot's grains are the start. */
#include "report/report_element_cases.h"

#include "observe/element_energy.h"
#include "report/report_midpoint.h"

#include <math.h>
#include <stddef.h>

/* Of a beam's length and in radians: what is not linear in the mode itself is its square, 1e-8, and
 * in float it is still a thousand roundings of a coordinate. */
#define AMPLITUDE 1e-4

static const double PI = 3.14159265358979323846;

enum { AXIAL, SYMMETRIC, ANTISYMMETRIC, MODES };

/* y = rate / frequency exp(-decay t) sin(frequency t). */
typedef struct Mode {
    double frequency, decay; /* rad/s, 1/s */
} Mode;

/* Free vibration of two triangles alike and the beam between them, in closed form. */
static Mode mode_of(const OzScene *scene, const OzElements *elements, int which)
{
    const OzBeamValues *beams = &scene->beams;
    double m = elements->mass[0], inertia = elements->inertia[0], length = elements->beam_length[0];
    double bending = beams->stiffness * beams->second_moment / (length * inertia);
    double damping = beams->damping * beams->second_moment / (2 * length * inertia);
    double swing = 1 + 4 * inertia / (m * length * length);
    double square, decay;
    switch (which) {
    case AXIAL:
        square = 2 * beams->stiffness / m;
        decay = beams->damping / m;
        break;
    case SYMMETRIC:
        square = 2 * bending;
        decay = damping;
        break;
    default:
        square = 6 * bending * swing;
        decay = damping * (beams->damping_shear == OZ_SHEAR_BALANCED ? swing : 1);
    }
    return (Mode){sqrt(square - decay * decay), decay};
}

/* Elongation over the length, and the bends' half difference and half sum: one number a mode. */
static void read_modes(const OzSnapshot *now, double mode[MODES])
{
    const OzElements *elements = now->grains->elements;
    const double *x = now->element_position, *angle = now->element_angle;
    double direction = atan2(x[3] - x[1], x[2] - x[0]);
    double a = remainder(angle[0] - direction - elements->beam_rest_a[0], 2 * PI);
    double b = remainder(angle[1] - direction - elements->beam_rest_b[0], 2 * PI);
    mode[AXIAL] = hypot(x[2] - x[0], x[3] - x[1]) / elements->beam_length[0] - 1;
    mode[SYMMETRIC] = (a - b) / 2;
    mode[ANTISYMMETRIC] = (a + b) / 2;
}

/* The rates of the same at the start. */
static void read_rates(const OzElements *elements, double rate[MODES])
{
    const double *x = elements->position, *v = elements->velocity,
                 *angular_velocity = elements->angular_velocity;
    double apart[2] = {x[2] - x[0], x[3] - x[1]}, passing[2] = {v[2] - v[0], v[3] - v[1]};
    double square = apart[0] * apart[0] + apart[1] * apart[1];
    double turning = (apart[0] * passing[1] - apart[1] * passing[0]) / square;
    rate[AXIAL] = (apart[0] * passing[0] + apart[1] * passing[1]) / square;
    rate[SYMMETRIC] = (angular_velocity[0] - angular_velocity[1]) / 2;
    rate[ANTISYMMETRIC] = (angular_velocity[0] + angular_velocity[1]) / 2 - turning;
}

/* One mode alone, without momentum and angular momentum. */
static void start_mode(const OzScene *scene, OzGrains *grains, int which)
{
    OzElements *elements = grains->elements;
    double *x = elements->position, *v = elements->velocity,
           *angular_velocity = elements->angular_velocity;
    double m = elements->mass[0], inertia = elements->inertia[0], length = elements->beam_length[0];
    double rate = AMPLITUDE * mode_of(scene, elements, which).frequency;
    double swing = 1 + 4 * inertia / (m * length * length);
    double stretching = 0, turning = 0;
    if (which == AXIAL) {
        stretching = rate;
    } else {
        angular_velocity[0] = which == SYMMETRIC ? rate : rate / swing;
        angular_velocity[1] = which == SYMMETRIC ? -rate : rate / swing;
        turning = which == SYMMETRIC ? 0 : rate / swing - rate;
    }
    double apart[2] = {x[2] - x[0], x[3] - x[1]};
    for (int c = 0; c < 2; c++) {
        double across = c == 0 ? -apart[1] : apart[0];
        v[2 + c] = 0.5 * (stretching * apart[c] + turning * across);
        v[c] = -v[2 + c];
    }
}

/* What is left of a started mode beyond its closed form, over the amplitude. The others are left
 * out: turning stretches the beam by the square of the amplitude. */
static int values_modes(const OzSnapshot *end, double *values)
{
    const OzElements *elements = end->grains->elements;
    double rate[MODES];
    read_modes(end, values);
    read_rates(elements, rate);
    for (int k = 0; k < MODES; k++) {
        Mode mode = mode_of(end->scene, elements, k);
        double t = end->time, decayed = exp(-mode.decay * t) * sin(mode.frequency * t);
        double amplitude = rate[k] / mode.frequency;
        bool started = fabs(amplitude) > 0.5 * AMPLITUDE;
        values[k] = started ? values[k] / amplitude - decayed : 0;
    }
    return MODES;
}

/* Of all grains at the start. */
static double kinetic_start(const OzGrains *grains)
{
    double sum = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        const double *v = &grains->velocity[3 * i], w = grains->angular_velocity[3 * i + 2];
        sum += grains->mass[i] * (v[0] * v[0] + v[1] * v[1]) + grains->inertia[i] * w * w;
    }
    return sum / 2;
}

/* Velocities and spins of two grains, each times the root of the share of the start's energy that
 * its square makes: the squares add up to what is left of the energy. */
static int values_motion(const OzSnapshot *end, double *values)
{
    const OzGrains *grains = end->grains;
    double whole = 2 * kinetic_start(grains);
    for (int64_t i = 0; i < 2; i++) {
        double mass = sqrt(grains->mass[i] / whole), inertia = sqrt(grains->inertia[i] / whole);
        values[3 * i] = mass * end->velocity[3 * i];
        values[3 * i + 1] = mass * end->velocity[3 * i + 1];
        values[3 * i + 2] = inertia * end->angular_velocity[3 * i + 2];
    }
    return 6;
}

/* Change of all energy, moving and stored, over that of the start. */
static int values_energy(const OzSnapshot *end, double *values)
{
    double now = oz_element_energy_translational(end) + oz_element_energy_rotational(end) +
                 oz_element_energy_stored(end);
    values[0] = now / kinetic_start(end->grains) - 1;
    return 1;
}

#define TRIGRAINS .model = OZ_MODEL_TRIGRAINS

const OzReportCase oz_report_element_cases_rows[] = {
    {"beam_vibration", "the shape of a beam", "", false, TRIGRAINS, .values = values_modes,
     .zero = true, .starts = MODES, .floor = AMPLITUDE * AMPLITUDE, .start = start_mode},
    {"two_dice", "velocities and spins", "", true, TRIGRAINS, .values = values_motion},
    {"undamped_dice", "the energy", "", true, TRIGRAINS, .values = values_energy, .zero = true},
    {"settled_pile", "energy", "", false, TRIGRAINS, .study = oz_report_midpoint_study},
    {NULL},
};
