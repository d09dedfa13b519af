/* Stiff and extreme scenes, and what must come out of them. They share their switches, so that four
 * kernel programs serve the suite, in float and double: one for rods of unlike length, and one for
 * scenes whose rods cannot be unlike, with line contacts, which few of them have. All have
 * friction, a plane that may move and a cylinder, which is far away unless a row has its own. */
#include "report/report_extreme_cases.h"

#include "report/report_cases.h"
#include "report/report_energy.h"

#include <math.h>
#include <stddef.h>

#define GRAIN(diameter, aspect, position, axis, velocity, more)                                    \
    "  - {kind: single, diameter: " diameter ", aspect: " aspect ", position: [" position          \
    "], axis: [" axis "], velocity: [" velocity "]" more "}\n"
#define ROD(aspect, position, axis, velocity) GRAIN("5e-3", aspect, position, axis, velocity, "")

/* Two rods whose middles meet along z, at 0.1 m/s, in the middle of a step: at its very beginning
 * rounding decides whether the hit gets one force more, and restitution is off by 3 %. */
#define HIT(aspect_a, axis_a, aspect_b, axis_b)                                                    \
    ROD(aspect_a, "0, 0, 0.1", axis_a, "0, 0, 0")                                                  \
    ROD(aspect_b, "0, 0, 0.105011", axis_b, "0, 0, -0.1")
#define CROSSED HIT("4", "1, 0, 0", "5", "0, 1, 0")

/* Two rods side by side, so deep in one another. */
#define OVERLAPPING(distance)                                                                      \
    ROD("4", "0, 0, 0.1", "1, 0, 0", "0, 0, 0")                                                    \
    ROD("5", "0, 0, 0.1" distance, "0, 1, 0", "0, 0, 0")

#define GRAVITY "gravity=[0, 0, -9.81]"
#define LINE    "contact.parallel=line"
#define COLUMN(height)                                                                             \
    "  - {kind: lattice, diameter: 5e-3, aspect: 4, axis: [0, 1, 0], cells: [1, 1, " height "], "  \
    "spacing: [0, 0, 5e-3], position: [0, 0, 2.5e-3]}\n"
#define LYING ROD("4", "0, 0, 2.5e-3", "0, 1, 0", "0, 0, 0") COMPANION

/* A light rod that lies far away, so that grains are not all alike. */
#define COMPANION GRAIN("5e-3", "1", "0, 0.5, 2.5e-3", "1, 0, 0", "0, 0, 0", ", density: 1")

/* A floor at rest that could move, in a cylinder that nothing reaches: up to 170 diameters from the
 * origin it does not make places coarser in float. The wide one is for what is longer or farther.
 */
#define STILL          "motion: {frequency: 30, acceleration_ratio: 0}"
#define BORE           "  - {kind: cylinder, diameter: 1.6}\n"
#define FLOOR(contact) "  - {kind: plane, contact: {" contact "}, " STILL "}\n" BORE
#define WIDE           "  - {kind: plane, " STILL "}\n  - {kind: cylinder, diameter: 10.5}\n"

/* A floor that moves, in a cylinder of 20 mm. */
#define SHAKEN(motion)                                                                             \
    "  - {kind: plane, motion: {" motion "}}\n  - {kind: cylinder, diameter: 20e-3}\n"
#define HEAP                                                                                       \
    ROD("2", "0, 0, 3e-3", "0, 1, 0", "0, 0, 0")                                                   \
    ROD("3", "0, 0, 9e-3", "1, 0, 0", "0, 0, 0")                                                   \
    ROD("0", "0, 0, 15e-3", "0, 0, 1", "0, 0, 0")

/* Of the first two grains along z. */
static double restitution(const OzSnapshot *end)
{
    const double *before = end->grains->velocity;
    return (end->velocity[5] - end->velocity[2]) / (before[2] - before[5]);
}

/* Of the first grain at a wall below it. */
static double rebound(const OzSnapshot *end)
{
    return -end->velocity[2] / end->grains->velocity[2];
}

static double energy_share(const OzSnapshot *end)
{
    return oz_report_energy_now(end) / oz_report_energy_start(end);
}

static double energy_drift(const OzSnapshot *end)
{
    return energy_share(end) - 1;
}

static double parting_speed(const OzSnapshot *end)
{
    return end->velocity[5] - end->velocity[2];
}

/* How far grain 0 went sideways, and how far it is from resting at -depth, in its diameter. */
static double unrest(const OzSnapshot *end)
{
    const OzGrains *g = end->grains;
    const double squared_rate = 9.869604401089358 + 0.4804530139182014; /* pi^2 + ln^2 0.5 */
    double time = end->scene->contact.contact_time;
    double depth = -end->scene->gravity[2] * time * time / squared_rate / 2;
    double x = end->position[0] - g->position[0], y = end->position[1] - g->position[1];
    double z = end->position[2] - (0.5 * g->diameter[0] - depth);
    return sqrt(x * x + y * y + z * z) / g->diameter[0];
}

static double spin_rate(const OzSnapshot *end)
{
    const double *w = end->angular_velocity;
    return sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
}

/* Velocity along x of grain 0 as a share of what it had. */
static double speed_kept(const OzSnapshot *end)
{
    return end->velocity[0] / end->grains->velocity[0];
}

/* Way fallen over g t^2 / 2. */
static double fall(const OzSnapshot *end)
{
    double way = end->grains->position[2] - end->position[2];
    return -way / (0.5 * end->scene->gravity[2] * end->time * end->time);
}

/* The lowest point of any grain above the first wall's plane, in the smallest diameter. */
static double clearance(const OzSnapshot *end)
{
    double least = INFINITY, diameter = INFINITY;
    for (int64_t i = 0; i < end->count; i++) {
        double r = 0.5 * end->grains->diameter[i];
        double half = 0.5 * end->grains->length[i] * fabs(end->axis[3 * i + 2]);
        least = fmin(least, end->position[3 * i + 2] - half - r - end->wall_offset[0]);
        diameter = fmin(diameter, 2 * r);
    }
    return least / diameter;
}

/* The farthest any grain of a column is from the z axis, or above where touching grains would be,
 * in its diameter. */
static double lean(const OzSnapshot *end)
{
    double most = 0;
    for (int64_t i = 0; i < end->count; i++) {
        const double *x = &end->position[3 * i], d = end->grains->diameter[i];
        most = fmax(most, hypot(x[0], x[1]) / d);
        most = fmax(most, x[2] / d - ((double)i + 0.5));
    }
    return most;
}

static double count(const OzSnapshot *end)
{
    return (double)end->count;
}

/* The end of a row: no step is forced, and any message will do. */
#define RODS OZ_MODEL_RODS, false, NULL

#define RESTITUTION "restitution", restitution, 0.485, 0.515, 0
#define PARALLEL(angle)                                                                            \
    {                                                                                              \
        "parallel within " angle " rad", HIT("4", "1, 0, 0", "5", "1, " angle ", 0"), NULL,        \
            {NULL}, NULL, RESTITUTION, RODS                                                        \
    }
#define ASPECT(aspect, walls)                                                                      \
    {                                                                                              \
        "aspect " aspect, HIT(aspect, "1, 0, 0", "5", "0, 1, 0"), walls, {NULL}, NULL,             \
            RESTITUTION, RODS                                                                      \
    }

/* clang-format off */
static const OzExtremeCase rows[] = {
    /* the overlap, 3e-8 m, is a hundred roundings of the distance in float */
    {"stiffness x 1e6", CROSSED, NULL, {"contact.contact_time=1e-6", "time.step=1.9e-8",
     "time.duration=1.3e-4"}, NULL, "restitution", restitution, 0.47, 0.53, 0, RODS},
    {"stiffness x 1e6, step as before", CROSSED, NULL, {"contact.contact_time=1e-6"}, NULL, NULL,
     NULL, 0, 0, 0, RODS},
    {"wall 1000 times stiffer", ROD("4", "0, 0, 12.511e-3", "0, 0, 1", "0, 0, -0.1"),
     FLOOR("contact_time: 3.1622777e-5"), {LINE, "time.step=6e-7"}, NULL,
     "rebound", rebound, 0.485, 0.515, 0, RODS},
    ASPECT("0", NULL), ASPECT("1e-6", NULL), ASPECT("1", NULL), ASPECT("100", NULL),
    ASPECT("1000", WIDE),
    {"size ratio 100",
     GRAIN("0.5", "1", "0, 0, 1", "1, 0, 0", "0, 0, 0", "") ROD("5", "0, 0, 1.252511", "0, 1, 0",
     "0, 0, -0.1"), NULL, {NULL}, NULL, RESTITUTION, RODS},
    {"mass ratio 1e6", GRAIN("5e-3", "4", "0, 0, 0.1", "1, 0, 0", "0, 0, 0", ", density: 1e4")
     GRAIN("5e-3", "4", "0, 0, 0.105011", "0, 1, 0", "0, 0, -0.1", ", density: 1e-2"), NULL, {NULL},
     NULL, RESTITUTION, RODS},
    PARALLEL("1e-1"), PARALLEL("1e-3"), PARALLEL("1e-6"), PARALLEL("1e-9"), PARALLEL("1e-12"),
    PARALLEL("0"),
    {"anti-parallel", HIT("4", "1, 0, 0", "5", "-1, 0, 0"), NULL, {NULL}, NULL,
     RESTITUTION, RODS},
    {"collinear, end to end", ROD("4", "0, 0, 0.1", "0, 0, 1", "0, 0, 0") ROD("5", "0, 0, 0.127511",
     "0, 0, 1", "0, 0, -0.1"), NULL, {NULL}, NULL, RESTITUTION, RODS},
    {"crossed at 90 degrees", CROSSED, NULL, {NULL}, NULL, RESTITUTION, RODS},
    {"sweeping through parallel, off-centre", ROD("4", "0, 0, 0.1", "1, 0, 0", "0, 0, 0")
     GRAIN("5e-3", "5", "5e-3, 0, 0.105011", "1, -6e-4, 0", "0, 0, -0.1", ", spin: [0, 0, 1]"),
     NULL, {NULL}, NULL, "energy left, as a share", energy_share, 0.1, 1.0, 0, RODS},
    {"shafts that intersect", OVERLAPPING(""), NULL, {NULL}, NULL, NULL, NULL, 0, 0, 0, RODS},
    {"identical positions", ROD("4", "0, 0, 0.1", "1, 0, 0", "0, 0, 0") ROD("4", "0, 0, 0.1",
     "1, 0, 0", "0, 0, 0") COMPANION, NULL, {NULL}, NULL, NULL, NULL, 0, 0, 0, RODS},
    /* a spring let go: at most sqrt(kappa) x overlap = 3217 1/s x 0.5 mm */
    {"overlap of 10 % at the start", OVERLAPPING("045"), NULL, {NULL}, NULL, "parting speed, m/s",
     parting_speed, 0.5, 1.61, 0, RODS},
    {"overlap of 49 % at the start", OVERLAPPING("02551"), NULL, {NULL}, NULL,
     "parting speed, m/s", parting_speed, 2.5, 7.9, 0, RODS},
    /* the law goes on beyond a radius, until shafts meet */
    {"overlap of 51 % at the start", OVERLAPPING("02449"), NULL, {NULL}, NULL,
     "parting speed, m/s", parting_speed, 2.6, 8.21, 0, RODS},
    /* one contact in the middle carries no rod straight: rounding makes it jump to an end and
     * back; two contacts do. In float a hundred shafts may each turn by a rounding, 1.2e-7
     * diameters at its ends */
    {"column of 100 rods lying flat: single", COLUMN("99")
     ROD("5", "0, 0, 0.4975", "0, 1, 0", "0, 0, 0"), NULL, {GRAVITY, "time.duration=0.5"}, NULL,
     "lean, diameters", lean, 0, 0.3, 0, RODS},
    {"column of 100 rods lying flat: line", COLUMN("100"), NULL, {GRAVITY, LINE,
     "time.duration=0.5"}, NULL, "lean, diameters", lean, 0, 1e-6, 1.2e-5, RODS},
    /* in float the shaft's direction jumps by a rounding, 6e-8 rad: its ends by 1.2e-7 diameters,
     * and at 5.7e3 1/s, the swing of a rod on its ends, that is 3.4e-4 rad/s */
    {"rod at rest for 1e6 steps: place", LYING, NULL, {GRAVITY, "time.duration=20"},
     "time.duration=0.5", "way, diameters", unrest, 0, 1e-9, 5e-7, RODS},
    {"rod at rest for 1e6 steps: spin", LYING, NULL, {GRAVITY, "time.duration=20"},
     "time.duration=0.5", "spin, rad/s", spin_rate, 0, 1e-9, 3.4e-4, RODS},
    {"speed above a diameter per step", ROD("4", "0, 0, 0.1", "1, 0, 0", "1000, 0, 0") ROD("5",
     "0, 0, 0.2", "1, 0, 0", "0, 0, 0"), NULL, {NULL}, NULL, NULL, NULL, 0, 0, 0, RODS},
    {"restitution 0", CROSSED, NULL, {"contact.restitution=0"}, NULL, "restitution", restitution,
     0, 0.02, 0, RODS},
    {"restitution 1", CROSSED, NULL, {"contact.restitution=1"}, NULL, "restitution", restitution,
     0.999, 1.001, 0, RODS},
    {"friction 0", ROD("4", "0, 0, 2.5e-3", "0, 1, 0", "0.1, 0, 0"),
     FLOOR("friction: 0"), {GRAVITY, LINE, "time.duration=0.1"}, NULL,
     "speed kept", speed_kept, 0.9999, 1.0001,
     0, RODS},
    /* 5/7 of the speed when it rolls */
    {"friction 1000", ROD("0", "0, 0, 2.5e-3", "0, 1, 0", "0.1, 0, 0") COMPANION, NULL, {GRAVITY,
     "contact.friction=1000", "time.duration=0.1"}, NULL, "speed kept", speed_kept, 0.70, 0.73, 0,
     RODS},
    {"zero grains", "  - {kind: random, diameter: 5e-3, count: 0}\n", NULL, {LINE}, NULL, "grains",
     count, 0, 0, 0, RODS},
    {"one grain", ROD("4", "0, 0, 0.1", "1, 0, 0", "0, 0, 0"), NULL, {GRAVITY, LINE,
     "time.duration=0.1"}, NULL, "fall over g t^2 / 2", fall, 0.9995, 1.0005, 0, RODS},
    {"17 grains: in no group's size",
     "  - {kind: random, diameter: 5e-3, aspect: [1, 3], count: 17}\n",
     SHAKEN("frequency: 30, acceleration_ratio: 2"), {GRAVITY, "time.duration=0.5"},
     "time.duration=0.2", "clearance, diameters", clearance, -0.1, 3, 0, RODS},
    {"1000 diameters from the origin", ROD("4", "5, 0, 0.1", "1, 0, 0", "0, 0, 0") ROD("5",
     "5, 0, 0.105011", "0, 1, 0", "0, 0, -0.1"), WIDE, {NULL}, NULL, RESTITUTION, RODS},
    {"slanted rod wedged in a cylinder", ROD("4", "0, 0, 15e-3", "1, 0, 1", "0, 0, 0")
     GRAIN("1e-3", "0", "0, 9e-3, 0.5e-3", "0, 0, 1", "0, 0, 0", ""),
     SHAKEN("frequency: 30, acceleration_ratio: 0"), {GRAVITY, "time.duration=1"},
     "time.duration=0.3", "spin, rad/s", spin_rate, 0, 0.05, 0, RODS},
    {"floor amplitude longer than a rod", HEAP, SHAKEN("frequency: 5, amplitude: 0.05"), {GRAVITY,
     "time.duration=1.05"}, "time.duration=0.25", "clearance, diameters", clearance, -0.3, 100, 0,
     RODS},
    {"Gamma 50", HEAP, SHAKEN("frequency: 50, acceleration_ratio: 50"), {GRAVITY,
     "time.duration=1"}, "time.duration=0.2", "clearance, diameters", clearance, -0.5, 2000, 0,
     RODS},
    {"floor period of 10 steps", HEAP, SHAKEN("frequency: 5000, acceleration_ratio: 50"), {GRAVITY,
     "time.duration=1"}, "time.duration=0.2", "clearance, diameters", clearance, -0.1, 10, 0, RODS},
    /* roundings of 1e7 steps as a random walk: 3e3 of 6e-8 */
    {"free rotation for 1e7 steps", GRAIN("5e-3", "4", "0, 0, 0.1", "0, 0, 1", "0, 0, 0",
     ", spin: [200, 0, 300]"), NULL, {LINE, "time.duration=200"}, "time.duration=0.5",
     "energy drift, as a share", energy_drift, -2e-4, 2e-4, 0, RODS},
    {"undamped bouncing for 1e7 steps: energy",
     ROD("0", "0, 0, 6e-3", "0, 0, 1", "0, 0, 0") COMPANION, NULL,
     {GRAVITY, "contact.restitution=1", "time.duration=200"}, "time.duration=2",
     "energy drift, as a share", energy_drift, -0.05, 0.05, 0, RODS},
    {NULL, NULL, NULL, {NULL}, NULL, NULL, NULL, 0, 0, 0, RODS},
};
/* clang-format on */

const OzExtremeSuite oz_report_extreme_cases_suite = {
    .common = "model: rods\n"
              "time: {step: 2e-5, duration: 5e-3}\n"
              "integrator: velocity-verlet\n"
              "gravity: [0, 0, 0]\n"
              "contact: {contact_time: 1e-3, restitution: 0.5, friction: 0.3}\n",
    .walls = "  - {kind: plane, " STILL "}\n" BORE,
    .rows = rows,
};
