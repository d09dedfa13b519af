/* Stiff and extreme scenes of trigrains, and what must come out of them. They share their switches,
 * so that two kernel programs, float and double, serve the suite: gear4, beams, the ledger, and a
 * wall that could move (by less than an atom where it is not meant to). */
#include "report/report_extreme_elements.h"

#include "observe/element_energy.h"

#include <math.h>
#include <stddef.h>

/* A motion by less than any rounding. */
#define STILL "motion: {frequency: 1, amplitude: 1e-18}"

#define GRAIN(shape, position, velocity, more)                                                     \
    "  - {kind: single, shape: " shape ", position: [" position "], velocity: [" velocity "]" more \
    "}\n"
#define DIE(position, velocity, more) GRAIN("square, edge: 2e-3", position, velocity, more)

/* Two dice, the first at 0.5 m/s; a corner of it meets a face of the other. */
#define MEETING DIE("0, 0", "0.5, 0", ", angle: 20") DIE("2.3e-3, 3e-4", "0, 0", "")

/* Two dice face to face that overlap by a share of their edge, at rest. */
#define OVERLAPPING(distance) DIE("0, 0", "0, 0", "") DIE(distance ", 0", "0, 0", "")

#define STAR(position, velocity, more)                                                             \
    GRAIN("star, corners: 5, radius: 4e-3, depth: 0.5", position, velocity, more)

/* A hook: concave, of unlike triangles. */
#define HOOK(position, velocity, more)                                                             \
    GRAIN("vertices, vertices: [0, 0, 6e-3, 0, 6e-3, 2e-3, 2.5e-3, 2.5e-3, 2e-3, 6e-3, 0, 6e-3]",  \
          position, velocity, more)

/* A needle of 20 mm, 0.04 mm wide in its middle. */
#define NEEDLE(position, velocity, more)                                                           \
    GRAIN("vertices, vertices: [-1e-2, 0, 0, -2e-5, 1e-2, 0, 0, 2e-5]", position, velocity, more)

#define FLOOR "  - {kind: floor, width: 40e-3, thickness: 10e-3, point: [0, 0], " STILL "}\n"

#define GRAVITY "gravity=[0, -9.81]"

/* A light die hits a heavy one, softly enough for kind i alone. */
#define HEAVY DIE("0, 0", "0.05, 0", ", angle: 20") DIE("2.29e-3, 3e-4", "0, 0", ", density: 4e6")

#define LYING DIE("0, 1e-3", "0, 0", "")

/* Nine dice that fall a little, in columns. */
#define HEAP                                                                                       \
    "  - {kind: lattice, shape: square, edge: 2e-3, cells: [3, 3], spacing: [2.5e-3, 2.1e-3], "    \
    "position: [-2.5e-3, 1.1e-3]}\n"

/* The end of a row. */
#define ELEMENTS     OZ_MODEL_TRIGRAINS, false, NULL
#define NAMED(says)  OZ_MODEL_TRIGRAINS, false, says
#define FORCED(says) OZ_MODEL_TRIGRAINS, true, says
#define REFUSED      NULL, NULL, 0, 0, 0
#define DOUBLE_ONLY  (-1)

/* Kinetic and potential, at the start. */
static double energy_start(const OzSnapshot *end)
{
    const OzElements *elements = end->grains->elements;
    const double *g = end->scene->gravity;
    double sum = 0;
    for (int64_t i = 0; i < elements->free_count; i++) {
        const double *x = &elements->position[2 * i], *v = &elements->velocity[2 * i];
        sum += elements->mass[i] * ((v[0] * v[0] + v[1] * v[1]) / 2 - g[0] * x[0] - g[1] * x[1]) +
               elements->inertia[i] / 2 * elements->angular_velocity[i] *
                   elements->angular_velocity[i];
    }
    return sum;
}

static double energy_now(const OzSnapshot *end)
{
    return oz_element_energy_translational(end) + oz_element_energy_rotational(end) +
           oz_element_energy_potential(end) + oz_element_energy_stored(end);
}

/* What the ledger cannot account for, over the energy at the start: without a start overlap. */
static double residual(const OzSnapshot *end)
{
    double change = energy_now(end) - energy_start(end);
    return fabs(change + oz_element_energy_lost(end) - end->element_ledger.work_walls) /
           energy_start(end);
}

static double momentum_change(const OzSnapshot *end)
{
    const OzGrains *g = end->grains;
    double before = 0, now = 0;
    for (int64_t i = 0; i < g->count; i++) {
        before += g->mass[i] * g->velocity[3 * i];
        now += g->mass[i] * end->velocity[3 * i];
    }
    return fabs(now - before) / fabs(before);
}

static double parting_speed(const OzSnapshot *end)
{
    return end->velocity[3] - end->velocity[0];
}

static double fall(const OzSnapshot *end)
{
    double way = end->position[1] - end->grains->position[1];
    return way / (0.5 * end->scene->gravity[1] * end->time * end->time);
}

static double count(const OzSnapshot *end)
{
    return (double)end->count;
}

/* How much lower the first grain is than it was, in its edges: a die's circle is 1.4 edges wide. */
static double sinking(const OzSnapshot *end)
{
    const OzGrains *g = end->grains;
    return (g->position[1] - end->position[1]) / (g->diameter[0] / sqrt(2));
}

static double spin_rate(const OzSnapshot *end)
{
    return fabs(end->angular_velocity[2]);
}

/* How far the first grain slid, in its edges. */
static double sliding(const OzSnapshot *end)
{
    const OzGrains *g = end->grains;
    return fabs(end->position[0] - g->position[0]) / (g->diameter[0] / sqrt(2));
}

/* The farthest centre of a grain from the origin, over the first wall's radius. */
static double farthest(const OzSnapshot *end)
{
    double most = 0;
    for (int64_t i = 0; i < end->count; i++) {
        most = fmax(most, hypot(end->position[3 * i], end->position[3 * i + 1]));
    }
    return most / (end->scene->walls[0].diameter / 2);
}

#define RESIDUAL   "energy unaccounted for", residual
#define NEEDLE_HIT NEEDLE("0, 0", "0, 0", "") DIE("5e-3, 1.02e-3", "0, -0.05", "")

/* clang-format off */
static const OzExtremeCase rows[] = {
    {"at the origin", MEETING, NULL, {NULL}, NULL, RESIDUAL, 0, 1e-6, 1e-5, ELEMENTS},
    /* in float a coordinate of 2 m is rounded to 1e-7 m, a tenth of the overlap */
    {"1000 edges from the origin", DIE("2, 0", "0.5, 0", ", angle: 20")
     DIE("2.0023, 3e-4", "0, 0", ""), NULL, {NULL}, NULL, RESIDUAL, 0, 1e-6, 0.3, ELEMENTS},
    {"sliver of 20 mm x 0.04 mm", NEEDLE_HIT, NULL, {NULL}, NULL, REFUSED,
     NAMED("beams.area_min")},
    /* the overlap, 2e-6 m, is a thousand roundings of its coordinates in float */
    {"sliver, limits lowered", NEEDLE_HIT, NULL, {"beams.area_min=1e-8"}, NULL, RESIDUAL, 0, 1e-6,
     2e-3, ELEMENTS},
    /* only kind i has a potential: the force of the others jumps where kinds change */
    {"two stars", STAR("0, 0", "0.5, 0", "") STAR("7e-3, 5e-4", "0, 0", ", angle: 20"), NULL,
     {NULL}, NULL, RESIDUAL, 0, 0.05, 0, ELEMENTS},
    {"two hooks, one in the other", HOOK("0, 0", "0.5, 0", "")
     HOOK("4e-3, 3e-3", "0, 0", ", angle: 180"), NULL, {NULL}, NULL, RESIDUAL, 0, 1e-6, 1e-3,
     ELEMENTS},
    {"a die inside another", GRAIN("square, edge: 2e-2", "0, 0", "0, 0", "")
     DIE("6e-3, 0", "0, 0", ""), NULL, {NULL}, NULL, REFUSED, NAMED("wholly inside")},
    /* Y w d^2 / 2 of two masses without loss is 4.5 m/s; beams take most of it */
    {"overlap of 10 % at the start", OVERLAPPING("1.8e-3"), NULL, {NULL}, NULL,
     "parting speed, m/s", parting_speed, 1, 4.5, 0, ELEMENTS},
    {"overlap of 50 % at the start", OVERLAPPING("1e-3"), NULL, {NULL}, NULL, REFUSED,
     NAMED("a beam of it")},
    {"overlap of 100 % at the start", OVERLAPPING("0"), NULL, {NULL}, NULL, REFUSED,
     NAMED("more than half")},
    {"a hit that goes too deep", DIE("0, 0", "50, 0", ", angle: 20")
     DIE("2.3e-3, 3e-4", "0, 0", ""), NULL, {NULL}, NULL, REFUSED, NAMED("more than half")},
    {"an edge per step", DIE("0, 0", "2000, 0", "") DIE("0, 0.1", "0, 0", ""), NULL, {NULL}, NULL,
     REFUSED, NAMED("in one step")},
    /* in float a step of 1e-8 s at 0.5 m/s is a few roundings of a coordinate, and beams' forces
     * are 1e6 times theirs */
    {"beams x 1e6", MEETING, NULL, {"beams.stiffness=1e8", "time.step=1e-8",
     "time.duration=6e-4"}, NULL, RESIDUAL, 0, 1e-6, DOUBLE_ONLY, ELEMENTS},
    {"beams x 1e6, step as before", MEETING, NULL, {"beams.stiffness=1e8"}, NULL, REFUSED,
     NAMED("unstable")},
    {"beams x 1e6, 3 steps in one, forced", MEETING, NULL, {"beams.stiffness=1e8",
     "time.step=1.1e-7"}, NULL, REFUSED, FORCED("stopped at step")},
    {"Y x 1e6", MEETING, NULL, {"triangles.stiffness=2e12", "time.step=9e-9",
     "time.duration=2e-4"}, NULL, RESIDUAL, 0, 1e-6, 0.01, ELEMENTS},
    {"Y x 1e6, step as before", MEETING, NULL, {"triangles.stiffness=2e12"}, NULL, REFUSED,
     NAMED("unstable")},
    {"step 3 times too long", HEAP, FLOOR, {GRAVITY, "time.step=3e-5"}, NULL, REFUSED,
     NAMED("unstable")},
    /* contacts alone are unstable here: no beam folds, nothing is fast, the ledger alone tells */
    {"step 3 times too long, forced", HEAP, FLOOR, {GRAVITY, "time.step=3e-5",
     "time.duration=0.3"}, NULL, RESIDUAL, 0.1, 10, 0, FORCED(NULL)},
    {"one triangle", GRAIN("vertices, vertices: [0, 0, 2e-3, 0, 1e-3, 2e-3]", "0, 0", "0, 0", "")
     DIE("1, 0", "0, 0", ""), NULL, {GRAVITY, "time.duration=0.01"}, NULL, "fall over g t^2 / 2",
     fall, 0.9999, 1.0001, 0, ELEMENTS},
    {"zero grains", "  - {kind: random, shape: square, edge: 2e-3, count: 0}\n", NULL, {NULL}, NULL,
     "grains", count, 0, 0, 0, ELEMENTS},
    {"mass ratio 1e6: energy", HEAVY, NULL, {NULL}, NULL, RESIDUAL, 0, 1e-6, 1e-3, ELEMENTS},
    /* in float the heavy die takes roundings of 1e6 masses */
    {"mass ratio 1e6: momentum", HEAVY, NULL, {NULL}, NULL, "momentum's change, as a share",
     momentum_change, 0, 1e-12, 1e-3, ELEMENTS},
    /* in float it grows until a guard stops it */
    {"beams without damping for 1e6 steps", MEETING, NULL, {"beams.damping=0", "time.duration=1"},
     "time.duration=0.03", RESIDUAL, 0, 1e-6, DOUBLE_ONLY, ELEMENTS},
    /* overlap 2e-5, the rest is beams that yield under the die's weight; in float corners jump by
     * thousandths of that overlap, and the die swings and walks */
    {"die at rest for 1e6 steps: sinking", LYING, FLOOR, {GRAVITY, "time.duration=1"},
     "time.duration=0.1", "sinking, edges", sinking, 0, 3e-4, 0, ELEMENTS},
    {"die at rest for 1e6 steps: spin", LYING, FLOOR, {GRAVITY, "time.duration=1"},
     "time.duration=0.1", "spin, rad/s", spin_rate, 0, 1e-9, 0.3, ELEMENTS},
    {"die at rest for 1e6 steps: sliding", LYING, FLOOR, {GRAVITY, "time.duration=1"},
     "time.duration=0.1", "way, edges", sliding, 0, 1e-9, 0.3, ELEMENTS},
    /* 5 times gravity at the rim */
    {"drum at 50 rad/s", "  - {kind: lattice, shape: square, edge: 2e-3, cells: [3, 3], "
     "spacing: [4e-3, 4e-3], position: [-4e-3, -4e-3], angle: 10}\n", "  - {kind: drum, "
     "diameter: 40e-3, teeth: 60, tooth_depth: 0.5e-3, thickness: 3e-3, "
     "motion: {angular_velocity: 50}}\n", {GRAVITY, "time.duration=0.5"}, "time.duration=0.1",
     "farthest centre, radii", farthest, 0.5, 1, 0, ELEMENTS},
    {NULL, NULL, NULL, {NULL}, NULL, NULL, NULL, 0, 0, 0, ELEMENTS},
};
/* clang-format on */

const OzExtremeSuite oz_report_extreme_elements_suite = {
    .common = "model: trigrains\n"
              "time: {step: 1e-6, duration: 3e-3}\n"
              "gravity: [0, 0]\n"
              "observe: {ledger: true}\n",
    .walls = "  - {kind: floor, width: 40e-3, point: [0, -1], " STILL "}\n",
    .rows = rows,
};
