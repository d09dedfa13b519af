/* The rows. What is a constant of the physics rather than a choice of the person is not here.
 * Ranges are wider than any sense, and narrow enough that products of a few values stay finite in
 * double. */
#include "scene/keys.h"

#include "scene/describe.h"
#include "scene/scene.h"

#include <stdint.h>
#include <string.h>

/* Named choices, in the order of their enums. */
static const char *const MODELS[] = {[OZ_MODEL_RODS] = "rods", NULL};
static const char *const INTEGRATORS[] = {[OZ_INTEGRATOR_EULER] = "euler",
                                          [OZ_INTEGRATOR_SYMPLECTIC_EULER] = "symplectic-euler",
                                          [OZ_INTEGRATOR_VELOCITY_VERLET] = "velocity-verlet",
                                          NULL};
static const char *const PRECISIONS[] = {
    [OZ_PRECISION_FLOAT] = "float", [OZ_PRECISION_DOUBLE] = "double", NULL};
static const char *const BROADPHASES[] = {[OZ_BROADPHASE_HASH] = "hash",
                                          [OZ_BROADPHASE_ALL_PAIRS] = "all_pairs",
                                          [OZ_BROADPHASE_SORT_AXIS] = "sort_axis",
                                          NULL};
static const char *const LAWS[] = {[OZ_LAW_HOOKE] = "hooke",
                                   [OZ_LAW_HERTZ] = "hertz",
                                   [OZ_LAW_HERTZ_MINDLIN] = "hertz-mindlin",
                                   NULL};
static const char *const SLIPS[] = {[OZ_SLIP_CUT] = "cut", [OZ_SLIP_SCALE] = "scale", NULL};
static const char *const ATTRACTIONS[] = {
    [OZ_ATTRACTION_ALLOW] = "allow", [OZ_ATTRACTION_CLAMP] = "clamp", NULL};
static const char *const DAMPINGS[] = {
    [OZ_DAMPING_CONSTANT] = "constant", [OZ_DAMPING_SMOOTH] = "smooth", NULL};
static const char *const PARALLELS[] = {
    [OZ_PARALLEL_SINGLE] = "single", [OZ_PARALLEL_LINE] = "line", NULL};
static const char *const CONTACT_POINTS[] = {
    [OZ_POINT_MIDPOINT] = "midpoint", [OZ_POINT_SURFACES] = "surfaces", NULL};
static const char *const RESTITUTIONS_AT[] = {
    [OZ_RESTITUTION_CENTRE] = "centre", [OZ_RESTITUTION_CONTACT] = "contact", NULL};
static const char *const CALIBRATIONS[] = {
    [OZ_CALIBRATION_NONE] = "none", [OZ_CALIBRATION_DISCRETE] = "discrete", NULL};
static const char *const WALL_KINDS[] = {
    [OZ_WALL_PLANE] = "plane", [OZ_WALL_CYLINDER] = "cylinder", NULL};
static const char *const GRAIN_KINDS[] = {[OZ_GRAINS_RANDOM] = "random",
                                          [OZ_GRAINS_LATTICE] = "lattice",
                                          [OZ_GRAINS_SINGLE] = "single",
                                          [OZ_GRAINS_FILE] = "file",
                                          NULL};
static const char *const VIEWS[] = {[OZ_VIEW_LATERAL] = "lateral", [OZ_VIEW_CUT] = "cut", NULL};
static const char *const COLOURS[] = {[OZ_COLOUR_ANGLE] = "angle",
                                      [OZ_COLOUR_AZIMUTH] = "azimuth",
                                      [OZ_COLOUR_SPEED] = "speed",
                                      [OZ_COLOUR_TYPE] = "type",
                                      NULL};

enum {
    RANDOM = 1 << OZ_GRAINS_RANDOM,
    LATTICE = 1 << OZ_GRAINS_LATTICE,
    SINGLE = 1 << OZ_GRAINS_SINGLE,
    FROM_FILE = 1 << OZ_GRAINS_FILE,
    MADE = RANDOM | LATTICE | SINGLE,
    PLANE = 1 << OZ_WALL_PLANE,
    CYLINDER = 1 << OZ_WALL_CYLINDER,
    HOOKE = 1 << OZ_LAW_HOOKE,
    HERTZ = 1 << OZ_LAW_HERTZ,
    MINDLIN = 1 << OZ_LAW_HERTZ_MINDLIN
};

#define REFUSE  OZ_RELOAD_REFUSE
#define APPLY   OZ_RELOAD_APPLY
#define REBUILD OZ_RELOAD_REBUILD

/* The first columns of a row: path, reload class, type with its limits, place, help. */
#define NUMBER(low_, high_, unit_) .type = OZ_KEY_NUMBER, .low = low_, .high = high_, .unit = unit_
#define INTEGER(low_, high_)       .type = OZ_KEY_INTEGER, .low = low_, .high = high_, .unit = ""
#define RANGE(low_, high_, unit_)  .type = OZ_KEY_RANGE, .low = low_, .high = high_, .unit = unit_
#define VECTOR(limit, unit_)                                                                       \
    .type = OZ_KEY_VECTOR, .width = 3, .low = -(limit), .high = limit, .unit = unit_
#define CHOICE(names) .type = OZ_KEY_CHOICE, .choices = names, .unit = ""
#define OF(type_)     .unit = "", .type = OZ_KEY_##type_
#define AT(field)     .offset = offsetof(OzScene, field)
#define GRAIN(field)  .offset = offsetof(OzPopulation, field)
#define WALL(field)   .offset = offsetof(OzWall, field)

/* A contact key twice: of the scene, and of a wall that may have its own. */
#define CONTACT(name, reload_, spec, fallback_, help_)                                             \
    {                                                                                              \
        "contact." #name, .reload = reload_, spec, AT(contact.name), fallback_, .help = help_      \
    }
#define WALL_CONTACT(name, reload_, spec, help_)                                                   \
    {                                                                                              \
        "walls[].contact." #name, .reload = reload_, spec, WALL(contact.name),                     \
                                  .inherits = "contact." #name, .help = help_ " (this wall)"       \
    }

/* A choice that the kernels make once for all bodies. */
#define WALL_SHARED(name, choices_)                                                                \
    {                                                                                              \
        "walls[].contact." #name, CHOICE(choices_), WALL(contact.name),                            \
                                  .inherits = "contact." #name, .shared = true,                    \
                                  .help = "the whole scene's"                                      \
    }

/* Arguments with commas in them. */
#define CONTACT_TIME  NUMBER(1e-12, 100, "s")
#define MODULUS       NUMBER(1, 1e18, "Pa")
#define POISSON       NUMBER(0, 0.5, "")
#define DAMPING_RATE  NUMBER(0, 1e15, "1/s")
#define FRACTION      NUMBER(0, 1, "")
#define COEFFICIENT   NUMBER(0, 1e6, "")
#define RATIO         NUMBER(0, 100, "")
#define REQUIRED      .required = true
#define DEFAULT(text) .fallback = text

/* clang-format off: a row is a sentence of two or three lines. */
static const OzKey KEYS[] = {
    {"extends", OF(EXTENDS),
     .help = "another scene file, whose keys hold where this one is silent"},
    {"title", OF(TEXT), AT(title), .reload = APPLY, .help = "shown in the movie's metadata",
     .write = OZ_WRITE_NONZERO},
    {"model", CHOICE(MODELS), AT(model), REQUIRED, .help = "what grains are"},
    {"seed", INTEGER(0, 9.2e18), AT(seed), DEFAULT("1"), .help = "of every random number"},
    {"gravity", VECTOR(1e6, "m/s^2"), AT(gravity), .reload = APPLY, DEFAULT("[0, 0, -9.81]"),
     .help = "acceleration of free fall"},
    {"time.step", NUMBER(1e-12, 1, "s"), AT(step), .reload = APPLY, REQUIRED,
     .help = "time step of the simulation"},
    {"time.duration", NUMBER(0, 1e9, "s"), AT(duration), .reload = APPLY, REQUIRED, .rival = "taps",
     .write = OZ_WRITE_UNLESS_RIVAL, .help = "simulated time after settling"},
    {"time.taps", NUMBER(0, 1e9, "periods"), AT(taps), .reload = APPLY, .rival = "duration",
     .write = OZ_WRITE_NONZERO, .help = "the same in periods of the first moving wall"},
    {"integrator", CHOICE(INTEGRATORS), AT(integrator), .reload = REBUILD,
     DEFAULT("symplectic-euler"), .help = "how a step is made"},
    {"precision", CHOICE(PRECISIONS), AT(precision), DEFAULT("float"),
     .help = "of numbers on the device"},
    {"broadphase", CHOICE(BROADPHASES), AT(broadphase), DEFAULT("hash"),
     .help = "how near pairs are found; all but hash are for tests and comparison"},
    {"skin", NUMBER(0, 1e3, "m"), AT(skin), .reload = REBUILD, .write = OZ_WRITE_NONZERO,
     .fallback_help = "chosen by orzo", .help = "reach of the neighbour lists beyond contact"},
    {"gyroscopic", OF(BOOL), AT(gyroscopic), .reload = REBUILD, DEFAULT("true"),
     .help = "full Euler equations; false drops the gyroscopic term"},

    CONTACT(law, REBUILD, CHOICE(LAWS), DEFAULT("hooke"), "normal force from overlap"),
    {"contact.contact_time", CONTACT_TIME, AT(contact.contact_time), .reload = APPLY, REQUIRED,
     .laws = HOOKE, .help = "duration of a free binary hit of two centres"},
    {"contact.restitution", FRACTION, AT(contact.restitution), .reload = APPLY, REQUIRED,
     .laws = HOOKE | MINDLIN, .help = "speed after over speed before a central hit"},
    {"contact.youngs_modulus", MODULUS, AT(contact.youngs_modulus), .reload = APPLY, REQUIRED,
     .laws = MINDLIN, .help = "of the grains' material"},
    {"contact.poisson_ratio", POISSON, AT(contact.poisson_ratio), .reload = APPLY, REQUIRED,
     .laws = MINDLIN, .help = "of the grains' material"},
    {"contact.hertz_stiffness", NUMBER(1e-12, 1e30, "N/m^1.5"), AT(contact.hertz_stiffness),
     .reload = APPLY, REQUIRED, .laws = HERTZ, .help = "force over overlap^1.5"},
    {"contact.normal_damping_rate", DAMPING_RATE, AT(contact.normal_damping_rate), .reload = APPLY,
     REQUIRED, .laws = HERTZ, .help = "damping force over effective mass and rate of overlap"},
    {"contact.tangential_damping_rate", DAMPING_RATE, AT(contact.tangential_damping_rate),
     .reload = APPLY, REQUIRED, .laws = HERTZ,
     .help = "the same for sliding, below Coulomb's limit"},
    CONTACT(friction, APPLY, COEFFICIENT, DEFAULT("0.3"), "Coulomb's coefficient"),
    CONTACT(tangential_stiffness, APPLY, RATIO, DEFAULT("2/7"),
            "tangential over normal stiffness (hertz-mindlin has Mindlin's)"),
    CONTACT(tangential_damping, APPLY, RATIO, .inherits = "contact.tangential_stiffness",
            "tangential over normal damping"),
    CONTACT(slip, REBUILD, CHOICE(SLIPS), DEFAULT("cut"),
            "a sliding contact cuts its tangential spring back, or only scales its force"),
    CONTACT(attraction, REBUILD, CHOICE(ATTRACTIONS), DEFAULT("allow"),
            "whether damping may pull at the end of a contact"),
    CONTACT(damping, REBUILD, CHOICE(DAMPINGS), DEFAULT("constant"),
            "whether damping acts at once or grows from nothing at first touch (hooke)"),
    CONTACT(parallel, REBUILD, CHOICE(PARALLELS), DEFAULT("single"),
            "nearly parallel shafts touch at one point, or at both ends of their common span"),
    CONTACT(contact_point, REBUILD, CHOICE(CONTACT_POINTS), DEFAULT("midpoint"),
            "where forces act: the overlap's middle, or each grain's own surface"),
    CONTACT(restitution_at, REBUILD, CHOICE(RESTITUTIONS_AT), DEFAULT("centre"),
            "hits of two centres, or hits wherever they are, give the restitution asked for"),
    CONTACT(restitution_calibration, REBUILD, CHOICE(CALIBRATIONS), DEFAULT("none"),
            "discrete: makes up for the step's errors and fits the step to the contact time (hooke)"),

    {"grains", OF(ITEMS), AT(populations), .count_offset = offsetof(OzScene, population_count),
     .item_size = sizeof(OzPopulation), .line_offset = offsetof(OzPopulation, line), REQUIRED,
     .help = "populations, in any mixture"},
    {"grains[].kind", CHOICE(GRAIN_KINDS), GRAIN(kind), REQUIRED, .help = "how they are placed"},
    {"grains[].count", INTEGER(0, 1e18), GRAIN(count), .kinds = RANDOM, REQUIRED,
     .help = "how many"},
    {"grains[].diameter", RANGE(1e-9, 1e3, "m"), GRAIN(diameter), .kinds = MADE, REQUIRED,
     .help = "of the caps and the shaft's mantle"},
    {"grains[].aspect", RANGE(0, 1e6, ""), GRAIN(aspect), .kinds = MADE, DEFAULT("0"),
     .help = "shaft length over diameter; 0 is a sphere"},
    {"grains[].density", NUMBER(1e-6, 1e9, "kg/m^3"), GRAIN(density), .kinds = MADE,
     DEFAULT("2500"), .help = "of the material"},
    {"grains[].fill", NUMBER(1e-6, 0.6, ""), GRAIN(fill), .kinds = RANDOM, DEFAULT("0.15"),
     .help = "volume fraction of the column in which they start"},
    {"grains[].cells", .type = OZ_KEY_COUNTS, .width = 3, .low = 0, .high = 1e9, .unit = "",
     GRAIN(cells), .kinds = LATTICE, REQUIRED, .help = "grains along x, y and z"},
    {"grains[].spacing", VECTOR(1e6, "m"), GRAIN(spacing), .kinds = LATTICE, REQUIRED,
     .help = "from one to the next along x, y and z"},
    {"grains[].position", VECTOR(1e6, "m"), GRAIN(position), .kinds = SINGLE | LATTICE, REQUIRED,
     .help = "centre of the (first) grain"},
    {"grains[].axis", VECTOR(1e6, ""), GRAIN(axis), .kinds = SINGLE | LATTICE, DEFAULT("[0, 0, 1]"),
     .help = "direction of the shaft, of any length but zero"},
    {"grains[].velocity", VECTOR(1e6, "m/s"), GRAIN(velocity), .kinds = SINGLE | LATTICE,
     DEFAULT("[0, 0, 0]"), .help = "at the start"},
    {"grains[].spin", VECTOR(1e9, "rad/s"), GRAIN(spin), .kinds = SINGLE | LATTICE,
     DEFAULT("[0, 0, 0]"), .help = "angular velocity at the start, world frame"},
    {"grains[].path", OF(FILE), GRAIN(path), .kinds = FROM_FILE, REQUIRED,
     .write = OZ_WRITE_NONZERO, .help = "a final.csv, relative to the scene file"},

    {"walls", OF(ITEMS), AT(walls), .count_offset = offsetof(OzScene, wall_count),
     .item_size = sizeof(OzWall), .line_offset = offsetof(OzWall, line), .fallback_help = "none",
     .help = "what holds the grains"},
    {"walls[].kind", CHOICE(WALL_KINDS), WALL(kind), REQUIRED,
     .help = "a plane, or the inside of an upright cylinder about the origin"},
    {"walls[].point", VECTOR(1e6, "m"), WALL(point), .reload = APPLY, .kinds = PLANE,
     DEFAULT("[0, 0, 0]"), .help = "any point of the plane"},
    {"walls[].normal", VECTOR(1e6, ""), WALL(normal), .reload = APPLY, .kinds = PLANE,
     DEFAULT("[0, 0, 1]"), .help = "into the free side, of any length but zero"},
    {"walls[].diameter", NUMBER(1e-9, 1e6, "m"), WALL(diameter), .reload = APPLY, .kinds = CYLINDER,
     REQUIRED, .help = "inner diameter"},
    {"walls[].motion", OF(SECTION), WALL(motion.present), .fallback_help = "at rest",
     .help = "offset along z: amplitude x sin(2 pi frequency time)"},
    {"walls[].motion.frequency", NUMBER(1e-9, 1e9, "Hz"), WALL(motion.frequency), .reload = APPLY,
     REQUIRED, .help = "periods in a second"},
    {"walls[].motion.acceleration_ratio", NUMBER(0, 1e6, ""), WALL(motion.acceleration_ratio),
     .reload = APPLY, REQUIRED, .rival = "amplitude", .write = OZ_WRITE_UNLESS_RIVAL,
     .help = "greatest acceleration over gravity"},
    {"walls[].motion.amplitude", NUMBER(0, 1e6, "m"), WALL(motion.written_amplitude),
     .reload = APPLY, .rival = "acceleration_ratio", .write = OZ_WRITE_NONZERO,
     .help = "greatest offset"},
    WALL_SHARED(law, LAWS),
    WALL_CONTACT(contact_time, APPLY, CONTACT_TIME, "duration of a free hit"),
    WALL_CONTACT(restitution, APPLY, FRACTION, "speed after over speed before"),
    WALL_CONTACT(youngs_modulus, APPLY, MODULUS, "of the wall's material"),
    WALL_CONTACT(poisson_ratio, APPLY, POISSON, "of the wall's material"),
    WALL_CONTACT(hertz_stiffness, APPLY, NUMBER(1e-12, 1e30, "N/m^1.5"), "force over overlap^1.5"),
    WALL_CONTACT(normal_damping_rate, APPLY, DAMPING_RATE, "damping over mass and rate"),
    WALL_CONTACT(tangential_damping_rate, APPLY, DAMPING_RATE, "the same for sliding"),
    WALL_CONTACT(friction, APPLY, COEFFICIENT, "Coulomb's coefficient"),
    WALL_CONTACT(tangential_stiffness, APPLY, RATIO, "tangential over normal stiffness"),
    WALL_CONTACT(tangential_damping, APPLY, RATIO, "tangential over normal damping"),
    WALL_SHARED(slip, SLIPS),
    WALL_SHARED(attraction, ATTRACTIONS),
    WALL_SHARED(damping, DAMPINGS),
    WALL_SHARED(parallel, PARALLELS),
    WALL_SHARED(contact_point, CONTACT_POINTS),
    WALL_SHARED(restitution_at, RESTITUTIONS_AT),
    WALL_SHARED(restitution_calibration, CALIBRATIONS),

    {"settle", OF(SECTION), AT(settle.present), .fallback_help = "no settling",
     .help = "rest before time 0"},
    {"settle.drag", NUMBER(0, 1e9, "1/s"), AT(settle.drag), REQUIRED,
     .help = "slows every grain: force = -drag x mass x velocity"},
    {"settle.threshold", NUMBER(0, 1e9, ""), AT(settle.threshold), DEFAULT("1e-3"),
     .help = "settled once the kinetic energy is below this times N m g d"},
    {"settle.rest_time", NUMBER(0, 1e9, "s"), AT(settle.rest_time), DEFAULT("0.2"),
     .help = "without drag afterwards"},
    {"settle.time_max", NUMBER(0, 1e9, "s"), AT(settle.time_max), DEFAULT("2"),
     .help = "longest time with drag"},

    {"observe.interval", NUMBER(1e-12, 1e9, "s"), AT(observe.interval), .reload = APPLY,
     .rival = "interval_taps", .write = OZ_WRITE_UNLESS_RIVAL,
     .fallback_help = "a period of the first moving wall, else a hundredth of the duration",
     .help = "between rows of series.csv"},
    {"observe.interval_taps", NUMBER(1e-9, 1e9, "periods"), AT(observe.interval_taps),
     .reload = APPLY, .rival = "interval", .write = OZ_WRITE_NONZERO,
     .help = "the same in periods of the first moving wall"},
    {"observe.samples_per_tap", INTEGER(1, 1e4), AT(observe.samples_per_tap), .reload = APPLY,
     DEFAULT("16"), .help = "of the means over taps"},
    {"observe.layer_thickness", NUMBER(1e-9, 1e6, "m"), AT(observe.layer_thickness),
     .reload = APPLY, DEFAULT("0.004"), .help = "of the layers counted from the floor"},
    {"observe.ledger", OF(BOOL), AT(observe.ledger), .reload = REBUILD, DEFAULT("false"),
     .help = "energy columns"},

    {"movie", OF(SECTION), AT(movie.present), .fallback_help = "no movie",
     .help = "movie.mp4 of the run"},
    {"movie.size", .type = OZ_KEY_SIZE, .low = 16, .high = 1e9, .unit = "pixels", AT(movie.width),
     .width = 2, DEFAULT("[1280, 720]"), .help = "width and height, both even"},
    {"movie.fps", NUMBER(0.1, 1000, "1/s"), AT(movie.fps), DEFAULT("25"),
     .help = "pictures in a second"},
    {"movie.views", .type = OZ_KEY_CHOICES, .choices = VIEWS, .unit = "", .width = 2,
     AT(movie.views), .count_offset = offsetof(OzScene, movie.view_count),
     DEFAULT("[lateral, cut]"), .help = "side by side"},
    {"movie.colour", CHOICE(COLOURS), AT(movie.colour), DEFAULT("angle"),
     .help = "what a grain's colour shows"},
    {"movie.speed", NUMBER(1e-9, 1e9, ""), AT(movie.speed), .rival = "length",
     .write = OZ_WRITE_NONZERO, .fallback_help = "1",
     .help = "shown over real time: simulated seconds in a second of movie"},
    {"movie.length", NUMBER(1e-3, 1e6, "s"), AT(movie.length), .rival = "speed",
     .write = OZ_WRITE_NONZERO, .help = "of the movie: its pictures are spread over the run"},

    {"snapshots.taps", .type = OZ_KEY_NUMBERS, .low = 0, .high = 1e9, .unit = "periods",
     AT(snapshots.taps), .count_offset = offsetof(OzScene, snapshots.tap_count), .reload = APPLY,
     .rival = "times", .write = OZ_WRITE_NONZERO,
     .help = "pictures at these periods of the first moving wall"},
    {"snapshots.times", .type = OZ_KEY_NUMBERS, .low = 0, .high = 1e9, .unit = "s",
     AT(snapshots.times), .count_offset = offsetof(OzScene, snapshots.count), .reload = APPLY,
     .rival = "taps", .write = OZ_WRITE_UNLESS_RIVAL, .help = "pictures at these times"},
    {"sweep", OF(SWEEP), AT(sweep), .write = OZ_WRITE_NONZERO,
     .help = "a run for each value of a key, as in {contact.friction: [0.1, 0.2]}"},
    {NULL, OF(TEXT)},
};
/* clang-format on */

const OzKey *oz_keys_all(void)
{
    return KEYS;
}

const OzKey *oz_keys_find(const char *path)
{
    for (const OzKey *key = KEYS; key->path; key++) {
        if (strcmp(key->path, path) == 0) {
            return key;
        }
    }
    return NULL;
}

bool oz_keys_is_group(const char *path)
{
    size_t length = strlen(path);
    for (const OzKey *key = KEYS; key->path; key++) {
        if (strncmp(key->path, path, length) == 0 && key->path[length] == '.') {
            return true;
        }
    }
    return false;
}

const char *oz_keys_choice_name(const char *path, int value)
{
    const OzKey *key = oz_keys_find(path);
    int count = 0;
    while (key && key->choices && key->choices[count]) {
        count++;
    }
    return value >= 0 && value < count ? key->choices[value] : "?";
}

size_t oz_keys_size(const OzKey *key)
{
    switch (key->type) {
    case OZ_KEY_NUMBER:
    case OZ_KEY_INTEGER:
        return sizeof(double);
    case OZ_KEY_BOOL:
    case OZ_KEY_SECTION:
        return sizeof(bool);
    case OZ_KEY_CHOICE:
        return sizeof(int);
    case OZ_KEY_CHOICES:
    case OZ_KEY_SIZE:
        return (size_t)key->width * sizeof(int);
    case OZ_KEY_VECTOR:
    case OZ_KEY_COUNTS:
        return (size_t)key->width * sizeof(double);
    case OZ_KEY_RANGE:
        return sizeof(OzRange);
    case OZ_KEY_SWEEP:
        return sizeof(OzSweep);
    case OZ_KEY_EXTENDS:
        return 0;
    default:
        return sizeof(void *);
    }
}

_Static_assert(sizeof(OzIntegrator) == sizeof(int) && sizeof(int64_t) == sizeof(double),
               "enums are stored as int, integers and numbers in eight bytes");

static void print_default(const OzKey *key, FILE *file)
{
    if (key->required) {
        fprintf(file, "required%s%s", key->rival ? ", or " : "", key->rival ? key->rival : "");
    } else if (key->fallback || key->fallback_help) {
        fprintf(file, "default %s", key->fallback ? key->fallback : key->fallback_help);
    } else if (key->inherits) {
        fprintf(file, "%s: %s", key->shared ? "always" : "default", key->inherits);
    } else {
        fprintf(file, "optional%s%s", key->rival ? ", in place of " : "",
                key->rival ? key->rival : "");
    }
}

static void print_kinds(const OzKey *key, FILE *file)
{
    const char *const *names = strncmp(key->path, "walls", 5) == 0 ? WALL_KINDS : GRAIN_KINDS;
    const char *lead = "; kind ";
    for (int i = 0; key->kinds && names[i]; i++) {
        if (key->kinds & 1u << i) {
            fprintf(file, "%s%s", lead, names[i]);
            lead = " or ";
        }
    }
}

void oz_keys_print(FILE *file)
{
    for (const OzKey *key = KEYS; key->path; key++) {
        char expected[256];
        oz_describe_expected(key, expected, sizeof expected);
        fprintf(file, "%s\n    %s\n    %s; ", key->path, key->help, expected);
        print_default(key, file);
        print_kinds(key, file);
        fputc('\n', file);
    }
}
