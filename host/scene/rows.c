/* THE list of scene keys: name, unit, range, default and one line of help; of a member of OzScene
 * that scene_types.h has. What is a constant of the physics rather than a choice of the person is
 * not here. Ranges are wider than any sense, and narrow enough that products of a few values stay
 * finite in double. */
#include "scene/rows.h"

#include "scene/choices.h"
#include "scene/fixed.h"
#include "scene/phases.h"
#include "scene/scene_types.h"

enum {
    RANDOM = 1 << OZ_GRAINS_RANDOM,
    LATTICE = 1 << OZ_GRAINS_LATTICE,
    SINGLE = 1 << OZ_GRAINS_SINGLE,
    FROM_FILE = 1 << OZ_GRAINS_FILE,
    MADE = RANDOM | LATTICE | SINGLE
};

/* A bit for each shape, wall and law, of its name. */
#define SHAPE_BIT(NAME, name, choice) SHAPE_##NAME = 1 << OZ_SHAPE_##NAME,
enum { OZ_SHAPES(SHAPE_BIT) };
#undef SHAPE_BIT
#define WALL_BIT(NAME, name, choice, fine, edged) NAME = 1 << OZ_WALL_##NAME,
#define COMPOUND_BIT(NAME, name, choice)          NAME = 1 << OZ_WALL_##NAME,
#define FLAT_BIT(NAME, name, choice, rank)        NAME = 1 << OZ_WALL_##NAME,
enum {
    OZ_WALLS(WALL_BIT) OZ_COMPOUND_WALLS(COMPOUND_BIT) OZ_TRIGRAINS_WALLS(FLAT_BIT) TOOTHED =
        FLOOR | HOPPER | DRUM,
    NORMAL = PLANE | RECTANGLE | DISC,
    AXIAL = CYLINDER | CONE
};
#undef WALL_BIT
#undef FLAT_BIT
#define LAW_BIT(NAME, name, choice, linear, stiffness, damping) NAME = 1 << OZ_LAW_##NAME,
enum { OZ_LAWS(LAW_BIT) };
#undef LAW_BIT

/* The models a row belongs to; without one of these it belongs to all. */
#define SOLID .models = 1 << OZ_MODEL_RODS
#define FLAT  .models = 1 << OZ_MODEL_TRIGRAINS

/* Written in degrees, kept in radians. */
#define DEGREES .scale = 3.14159265358979323846 / 180

/* The first columns of a row: path, type with its limits, place, help. */
#define NUMBER(low_, high_, unit_) .type = OZ_KEY_NUMBER, .low = low_, .high = high_, .unit = unit_
#define INTEGER(low_, high_)       .type = OZ_KEY_INTEGER, .low = low_, .high = high_, .unit = ""
#define RANGE(low_, high_, unit_)  .type = OZ_KEY_RANGE, .low = low_, .high = high_, .unit = unit_
#define VECTOR(limit, unit_)                                                                       \
    .type = OZ_KEY_VECTOR, .width = 3, .low = -(limit), .high = limit, .unit = unit_
#define PAIR(limit, unit_)                                                                         \
    .type = OZ_KEY_VECTOR, .width = 2, .low = -(limit), .high = limit, .unit = unit_
#define TWO(low_)     .type = OZ_KEY_VECTOR, .width = 2, .low = low_, .high = 1e6, .unit = "m"
#define CHOICE(names) .type = OZ_KEY_CHOICE, .choices = names, .unit = ""
#define OF(type_)     .unit = "", .type = OZ_KEY_##type_
#define AT(field)     .offset = offsetof(OzScene, field)
#define GRAIN(field)  .offset = offsetof(OzPopulation, field), GRAINS_MADE
#define WALL(field)   .offset = offsetof(OzWall, field)
#define PHASE(field)  .offset = offsetof(OzPhase, field), FIXED("the run has begun with them")
#define MATERIAL(field) .offset = offsetof(OzMaterial, field)

/* A contact key twice: of the scene, and of a wall that may have its own. */
#define CONTACT(name, spec, fallback_, help_)                                                      \
    {                                                                                              \
        "contact." #name, spec, AT(told.name), fallback_, SOLID, .help = help_                  \
    }
#define WALL_CONTACT(name, spec, help_)                                                            \
    {                                                                                              \
        "walls[].contact." #name, spec, WALL(told.name), .inherits = "contact." #name, SOLID,   \
                                                            .help = help_ " (this wall)"           \
    }

/* A choice that the kernels make once for all bodies. */
#define WALL_SHARED(name, choices_)                                                                \
    {                                                                                              \
        "walls[].contact." #name, CHOICE(choices_), WALL(told.name),                            \
            .inherits = "contact." #name, .shared = true, SOLID, .help = "the whole scene's"       \
    }

/* Arguments with commas in them. */
#define PICTURE_SIZE                                                                               \
    .type = OZ_KEY_SIZE, .low = OZ_PICTURE_SIDE_MIN, .high = OZ_PICTURE_SIDE_MAX,                  \
    .unit = "pixels", .width = 2
#define CONTACT_TIME NUMBER(1e-12, 100, "s")
#define MODULUS      NUMBER(1, 1e18, "Pa")
#define POISSON      NUMBER(0, 0.5, "")
#define DAMPING_RATE NUMBER(0, 1e15, "1/s")
#define FRACTION     NUMBER(0, 1, "")
#define COEFFICIENT  NUMBER(0, 1e6, "")
#define RATIO        NUMBER(0, 100, "")
#define RANGE_OF(axis)                                                                             \
    .count_offset = offsetof(OzScene, fields.has_range[axis]), .write = OZ_WRITE_MARKED,           \
    .fallback_help = "the container's inside, else what grains take up at the first moment, and "  \
                     "the width beyond"
#define REQUIRED      .required = true
#define DEFAULT(text) .fallback = text

/* clang-format off: a row is a sentence of two or three lines. */
static const OzKey KEYS[] = {
    {"extends", OF(EXTENDS),
     .help = "another scene file, whose keys hold where this one is silent"},
    {"title", OF(TEXT), AT(title), .help = "shown in the movie's metadata",
     .write = OZ_WRITE_NONZERO},
    {"model", CHOICE(MODELS), AT(model), REQUIRED, FIXED("grains stay what they are"),
     .help = "what grains are"},
    {"seed", INTEGER(0, 9.2e18), AT(seed), DEFAULT("1"), FIXED("its numbers have been drawn"),
     .help = "of every random number"},
    {"gravity", VECTOR(1e6, "m/s^2"), AT(gravity), DEFAULT("[0, 0, -9.81]"), SOLID,
     .help = "acceleration of free fall"},
    {"gravity", PAIR(1e6, "m/s^2"), AT(gravity), DEFAULT("[0, -9.81]"), FLAT,
     .help = "acceleration of free fall"},
#include "scene/rows_fluid.h"
    {"time.step", NUMBER(1e-12, 1, "s"), AT(step), REQUIRED, .help = "time step of the simulation"},
    {"time.duration", NUMBER(0, 1e9, "s"), .infinite = "endless", AT(duration), REQUIRED,
     .rival = "taps", .write = OZ_WRITE_UNLESS_RIVAL,
     .help = "simulated time after settling; endless: until it is stopped"},
    {"time.taps", NUMBER(0, 1e9, "periods"), AT(taps), .rival = "duration",
     .write = OZ_WRITE_NONZERO, .help = "the same in periods of the first moving wall"},
    {"integrator", CHOICE(INTEGRATORS), AT(integrator), DEFAULT("symplectic-euler"), SOLID,
     .help = "how a step is made"},
    {"integrator", CHOICE(FLAT_INTEGRATORS), AT(integrator), DEFAULT("gear4"), FLAT,
     .help = "how a step is made; rk4 is for comparison, on the host alone"},
    {"precision", CHOICE(PRECISIONS), AT(precision), DEFAULT("float"), SOLID,
     FIXED("the grains' state is kept in it"), .help = "of numbers on the device"},
    {"precision", CHOICE(PRECISIONS), AT(precision), DEFAULT("double"), FLAT,
     FIXED("the grains' state is kept in it"),
     .help = "of numbers on the device: a float cannot hold what slow grains move in a step"},
    {"broadphase", CHOICE(BROADPHASES), AT(broadphase), DEFAULT("hash"), SOLID,
     FIXED("all but hash are for tests and comparison"),
     .help = "how near pairs are found; all but hash are for tests and comparison"},
    {"broadphase", CHOICE(FLAT_BROADPHASES), AT(broadphase), DEFAULT("hash"), FLAT,
     FIXED("all but hash are for tests and comparison"),
     .help = "how near pairs are found; all_pairs is for tests"},
    {"skin", NUMBER(0, 1e3, "m"), AT(skin), .write = OZ_WRITE_NONZERO,
     .fallback_help = "chosen by orzo", .help = "reach of the neighbour lists beyond contact"},
    {"gyroscopic", OF(BOOL), AT(gyroscopic), DEFAULT("true"), SOLID,
     .help = "full Euler equations; false drops the gyroscopic term"},
    {"triangles.stiffness", NUMBER(1e-6, 1e15, "N/m^2"), AT(triangles.stiffness), DEFAULT("2e6"),
     FLAT, .help = "Y: force over overlap area"},
    {"triangles.overlap", CHOICE(OVERLAP_FORCES), AT(triangles.overlap), DEFAULT("kinds"), FLAT,
     .help = "force by how edges cross (Poeschel), or of a potential: the field of depths"},
    {"triangles.force_point", CHOICE(FORCE_POINTS), AT(triangles.force_point), DEFAULT("centroid"),
     FLAT, .help = "where it acts: the overlap's centroid (conservative), or its chord's midpoint"},
#include "scene/rows_beams.h"
    CONTACT(law, CHOICE(LAWS), DEFAULT("hooke"), "normal force from overlap"),
    {"contact.law", CHOICE(FLAT_LAWS), AT(told.law), DEFAULT("hooke"), FLAT,
     .help = "normal force of discs from overlap"},
    {"contact.contact_time", CONTACT_TIME, AT(told.contact_time), REQUIRED, .laws = HOOKE,
     .help = "duration of a free binary hit of two centres"},
    {"contact.restitution", FRACTION, AT(told.restitution), REQUIRED,
     .laws = HOOKE | HERTZ_MINDLIN, .help = "speed after over speed before a central hit"},
    {"contact.youngs_modulus", MODULUS, AT(told.youngs_modulus), REQUIRED, .laws = HERTZ_MINDLIN,
     SOLID, .help = "of the grains' material"},
    {"contact.poisson_ratio", POISSON, AT(told.poisson_ratio), REQUIRED, .laws = HERTZ_MINDLIN,
     SOLID, .help = "of the grains' material"},
    {"contact.hertz_stiffness", NUMBER(1e-12, 1e30, "N/m^1.5"), AT(told.hertz_stiffness),
     REQUIRED, .laws = HERTZ, .help = "force over overlap^1.5"},
    {"contact.normal_damping_rate", DAMPING_RATE, AT(told.normal_damping_rate), REQUIRED,
     .laws = HERTZ, .help = "damping force over effective mass and rate of overlap"},
    {"contact.tangential_damping_rate", DAMPING_RATE, AT(told.tangential_damping_rate), REQUIRED,
     .laws = HERTZ, .help = "the same for sliding, below Coulomb's limit"},
    {"contact.friction", COEFFICIENT, AT(told.friction), DEFAULT("0.3"),
     .help = "Coulomb's coefficient"},
    CONTACT(tangential_stiffness, RATIO, DEFAULT("2/7"),
            "tangential over normal stiffness (hertz-mindlin has Mindlin's)"),
    CONTACT(tangential_damping, RATIO, .inherits = "contact.tangential_stiffness",
            "tangential over normal damping"),
    {"contact.tangential_damping", RATIO, AT(told.tangential_damping), DEFAULT("1"), FLAT,
     .help = "of discs, over normal damping (hooke)"},
    CONTACT(surface_energy, NUMBER(0, 1e9, "J/m^2"), DEFAULT("0"),
            "w, work of adhesion: bodies that overlap pull each other with 2 pi w R"),
    CONTACT(rolling, CHOICE(ROLLINGS), DEFAULT("spring"),
            "against rolling: a spring that yields, with a dashpot; or a constant couple"),
    CONTACT(rolling_friction, COEFFICIENT, DEFAULT("0"), "couple over normal force and radius"),
    CONTACT(rolling_damping, RATIO, DEFAULT("0.3"), "of the rolling spring, over critical"),
    CONTACT(twisting_friction, COEFFICIENT, DEFAULT("0"), "the same about the normal"),
    CONTACT(slip, CHOICE(SLIPS), DEFAULT("cut"),
            "a sliding contact cuts its tangential spring back, or only scales its force"),
    CONTACT(attraction, CHOICE(ATTRACTIONS), DEFAULT("allow"),
            "whether damping may pull at the end of a contact"),
    CONTACT(damping, CHOICE(DAMPINGS), DEFAULT("constant"),
            "whether damping acts at once or grows from nothing at first touch (hooke)"),
    CONTACT(parallel, CHOICE(PARALLELS), DEFAULT("single"),
            "nearly parallel shafts touch at one point, or at both ends of their common span"),
    CONTACT(contact_point, CHOICE(CONTACT_POINTS), DEFAULT("midpoint"),
            "where forces act: the overlap's middle, or each grain's own surface"),
    CONTACT(restitution_at, CHOICE(RESTITUTIONS_AT), DEFAULT("centre"),
            "hits of two centres, or hits wherever they are, give the restitution asked for"),
    CONTACT(
        restitution_calibration, CHOICE(CALIBRATIONS), DEFAULT("none"),
        "discrete: makes up for the step's errors and fits the step to the contact time (hooke)"),
#include "scene/rows_materials.h"
    {"grains", OF(ITEMS), AT(populations), .count_offset = offsetof(OzScene, population_count),
     .item_size = sizeof(OzPopulation), .line_offset = offsetof(OzPopulation, line), REQUIRED,
     GRAINS_MADE, .help = "populations, in any mixture"},
    {"grains[].kind", CHOICE(GRAIN_KINDS), GRAIN(kind), REQUIRED, SOLID,
     .help = "how they are placed"},
    {"grains[].kind", CHOICE(FLAT_GRAIN_KINDS), GRAIN(kind), REQUIRED, FLAT,
     .help = "how they are placed"},
    {"grains[].shape", CHOICE(SHAPES), GRAIN(shape), .kinds = MADE, REQUIRED, FLAT,
     .help = "what triangles they are made of; a polygon has one on each edge about the middle"},
    {"grains[].count", INTEGER(0, 1e18), GRAIN(count), .kinds = RANDOM, REQUIRED,
     .help = "how many"},
    {"grains[].edge", RANGE(1e-9, 1e3, "m"), GRAIN(edge), .kinds = MADE, .shapes = SHAPE_SQUARE,
     REQUIRED, FLAT, .help = "of the square: four triangles about the middle"},
    {"grains[].radius", RANGE(1e-9, 1e3, "m"), GRAIN(radius), .kinds = MADE,
     .shapes = SHAPE_POLYGON | SHAPE_STAR | SHAPE_DISC, REQUIRED, FLAT,
     .help = "of the disc, or to the outer corners"},
    {"grains[].corners", RANGE(3, OZ_CORNERS_MAX, ""), GRAIN(corners), .kinds = MADE,
     .shapes = SHAPE_POLYGON | SHAPE_STAR, REQUIRED, FLAT,
     .help = "of the polygon, points of the star; whole numbers"},
    {"grains[].irregularity", FRACTION, GRAIN(irregularity), .kinds = MADE, .shapes = SHAPE_POLYGON,
     DEFAULT("0"), FLAT, .help = "how far corners are moved at random; 0 is a regular polygon"},
    {"grains[].depth", NUMBER(0.05, 0.95, ""), GRAIN(depth), .kinds = MADE, .shapes = SHAPE_STAR,
     DEFAULT("0.5"), FLAT, .help = "inner over outer radius"},
    {"grains[].vertices", .type = OZ_KEY_NUMBERS, .low = -1e6, .high = 1e6, .unit = "m",
     GRAIN(vertices), .count_offset = offsetof(OzPopulation, vertex_count), .kinds = MADE,
     .shapes = SHAPE_VERTICES, REQUIRED, FLAT, .help = "x and y of each corner on the way round"},
    {"grains[].angle", NUMBER(-360, 360, "degrees"), GRAIN(angle), DEGREES,
     .kinds = SINGLE | LATTICE, DEFAULT("0"), FLAT, .help = "turned by, counter-clockwise"},
    {"grains[].diameter", RANGE(1e-9, 1e3, "m"), GRAIN(diameter), .kinds = MADE, REQUIRED, SOLID,
     .help = "of the caps and the shaft's mantle"},
    {"grains[].aspect", RANGE(0, 1e6, ""), GRAIN(aspect), .kinds = MADE, DEFAULT("0"), SOLID,
     .help = "shaft length over diameter; 0 is a sphere"},
    {"grains[].material", OF(TEXT), GRAIN(material), .write = OZ_WRITE_NONZERO, SOLID,
     .fallback_help = "none", .help = "a name of materials"},
    {"grains[].density", NUMBER(1e-6, 1e9, "kg/m^3"), GRAIN(density), .kinds = MADE,
     DEFAULT("2500"), SOLID, .help = "of the grains, if it is not their material's"},
    {"grains[].density", NUMBER(1e-6, 1e9, "kg/m^2"), GRAIN(density), .kinds = MADE, DEFAULT("4"),
     FLAT, .help = "mass over area"},
    {"grains[].fill", NUMBER(1e-6, 0.6, ""), GRAIN(fill), .kinds = RANDOM, DEFAULT("0.15"), SOLID,
     .help = "volume fraction of the column in which they start"},
    {"grains[].fill", NUMBER(1e-6, 0.6, ""), GRAIN(fill), .kinds = RANDOM, DEFAULT("0.4"), FLAT,
     .help = "fraction of the column in which they start that circles around them cover"},
    {"grains[].cells", .type = OZ_KEY_COUNTS, .width = 3, .low = 0, .high = 1e9, .unit = "",
     GRAIN(cells), .kinds = LATTICE, REQUIRED, SOLID, .help = "grains along x, y and z"},
    {"grains[].cells", .type = OZ_KEY_COUNTS, .width = 2, .low = 0, .high = 1e9, .unit = "",
     GRAIN(cells), .kinds = LATTICE, REQUIRED, FLAT, .help = "grains along x and y"},
    {"grains[].spacing", VECTOR(1e6, "m"), GRAIN(spacing), .kinds = LATTICE, REQUIRED, SOLID,
     .help = "from one to the next along x, y and z"},
    {"grains[].spacing", PAIR(1e6, "m"), GRAIN(spacing), .kinds = LATTICE, REQUIRED, FLAT,
     .help = "from one to the next along x and y"},
    {"grains[].position", VECTOR(1e6, "m"), GRAIN(position), .kinds = SINGLE | LATTICE, REQUIRED,
     SOLID, .help = "centre of the (first) grain"},
    {"grains[].position", PAIR(1e6, "m"), GRAIN(position), .kinds = SINGLE | LATTICE, REQUIRED,
     FLAT, .help = "centre of mass of the (first) grain"},
    {"grains[].axis", VECTOR(1e6, ""), GRAIN(axis), .kinds = SINGLE | LATTICE, DEFAULT("[0, 0, 1]"),
     SOLID, .help = "direction of the shaft, of any length but zero"},
    {"grains[].velocity", VECTOR(1e6, "m/s"), GRAIN(velocity), .kinds = SINGLE | LATTICE,
     DEFAULT("[0, 0, 0]"), SOLID, .help = "at the start"},
    {"grains[].velocity", PAIR(1e6, "m/s"), GRAIN(velocity), .kinds = SINGLE | LATTICE,
     DEFAULT("[0, 0]"), FLAT, .help = "at the start"},
    {"grains[].velocity_spread", NUMBER(0, 1e6, "m/s"), GRAIN(velocity_spread), .kinds = RANDOM,
     .write = OZ_WRITE_NONZERO, .fallback_help = "0: at rest", SOLID,
     .help = "standard deviation of each component at the start, normal; all together have no "
             "momentum"},
    {"grains[].spin", VECTOR(1e9, "rad/s"), GRAIN(angular_velocity), .kinds = SINGLE | LATTICE,
     DEFAULT("[0, 0, 0]"), SOLID, .help = "angular velocity at the start, world frame"},
    {"grains[].spin", NUMBER(-1e9, 1e9, "rad/s"), GRAIN(angular_velocity[2]),
     .kinds = SINGLE | LATTICE, DEFAULT("0"), FLAT,
     .help = "angular velocity at the start, counter-clockwise"},
    {"grains[].path", OF(FILE), GRAIN(path), .kinds = FROM_FILE, REQUIRED, SOLID,
     .write = OZ_WRITE_NONZERO, .help = "a final.csv, relative to the scene file"},
#include "scene/rows_walls.h"
    {"boundary", OF(SECTION), AT(boundary.present), GRAINS_MADE, SOLID, .fallback_help = "open",
     .help = "what leaves a cell about the origin comes in on the other side"},
    {"boundary.x", CHOICE(BOUNDARIES), AT(boundary.along[0]), GRAINS_MADE, DEFAULT("open"), SOLID,
     .help = "periodic: what is at x is at x + size, too"},
    {"boundary.y", CHOICE(BOUNDARIES), AT(boundary.along[1]), GRAINS_MADE, DEFAULT("open"), SOLID,
     .help = "the same along y"},
    {"boundary.z", CHOICE(BOUNDARIES), AT(boundary.along[2]), GRAINS_MADE, DEFAULT("open"), SOLID,
     .help = "the same along z"},
    {"boundary.size", VECTOR(1e6, "m"), AT(boundary.size), GRAINS_MADE, REQUIRED, SOLID,
     .help = "of the cell; of open directions not looked at"},
    {"boundary.shear_rate", NUMBER(-1e9, 1e9, "1/s"), AT(boundary.shear_rate),
     .count_offset = offsetof(OzScene, boundary.is_sheared), .write = OZ_WRITE_MARKED, SOLID,
     .fallback_help = "no shear",
     .help = "of a cell periodic in x and y: it is sheared from time 0 on, the flow is rate x y along "
             "x, and all velocities are about it; 0 stops, and may be changed again"},
    {"settle", OF(SECTION), AT(settle.present), SETTLED, .fallback_help = "no settling",
     .help = "rest before time 0"},
    {"settle.drag", NUMBER(0, 1e9, "1/s"), AT(settle.drag), SETTLED, REQUIRED,
     .help = "slows every grain: force = -drag x mass x velocity"},
    {"settle.threshold", NUMBER(0, 1e9, ""), AT(settle.threshold), SETTLED, DEFAULT("1e-3"),
     .help = "settled once the kinetic energy is below this times N m g d"},
    {"settle.rest_time", NUMBER(0, 1e9, "s"), AT(settle.rest_time), SETTLED, DEFAULT("0.2"),
     .help = "without drag afterwards"},
    {"settle.time_max", NUMBER(0, 1e9, "s"), AT(settle.time_max), SETTLED, DEFAULT("2"),
     .help = "longest time with drag"},
    {"settle.overlaps", CHOICE(OVERLAPS), AT(settle.overlaps), SETTLED, DEFAULT("keep"),
     .help = "remove: grains that overlap at the start are moved apart first, without forces"},
    {"guards.overlap.warn", NUMBER(1e-6, 2, "radii"), AT(guards.overlap_warn), DEFAULT("1"), SOLID,
     .help = "overlaps beyond this times the smaller radius, at a wall half of it, are counted in "
             "deep_count, and the first is said"},
    {"guards.overlap.stop", NUMBER(1e-6, 2, "radii"), AT(guards.overlap_stop), DEFAULT("2"), SOLID,
     .help =
         "an overlap beyond this ends the run, as do shafts that meet and centres behind walls, "
         "where a contact has no direction any more"},
    {"guards.overlap.warn", NUMBER(1e-6, 0.5, ""), AT(guards.overlap_warn), DEFAULT("0.25"), FLAT,
     .help = "contacts with more than this part of a triangle inside another, or of a disc's "
             "diameter, are counted in deep_count, and the first is said"},
    {"guards.overlap.stop", NUMBER(1e-6, 0.5, ""), AT(guards.overlap_stop), DEFAULT("0.5"), FLAT,
     .help =
         "more than this ends the run; beyond a half the law does not know inside from outside"},
    {"observe.interval", NUMBER(1e-12, 1e9, "s"), AT(observe.interval), .rival = "interval_taps",
     .write = OZ_WRITE_UNLESS_RIVAL,
     .fallback_help = "a period of the first moving wall, else a hundredth of the duration, or of "
                      "an endless one what the movie shows in 0.1 s",
     .help = "between rows of series.csv"},
    {"observe.interval_taps", NUMBER(1e-9, 1e9, "periods"), AT(observe.interval_taps),
     .rival = "interval", .write = OZ_WRITE_NONZERO,
     .help = "the same in periods of the first moving wall"},
    {"observe.samples_per_tap", INTEGER(1, 1e4), AT(observe.samples_per_tap), TAP_MEANS,
     DEFAULT("16"), .help = "of the means over taps"},
    {"observe.at", CHOICE(OBSERVE_AT), AT(observe.at), TAP_MEANS, DEFAULT("mean"),
     .help = "top, bottom: rows and tap means only where the first moving wall is highest, lowest; "
             "mean: means over all its phases"},
    {"observe.layer_thickness", NUMBER(1e-9, 1e6, "m"), AT(observe.layer_thickness),
     DEFAULT("0.004"), SOLID, .help = "of the layers counted from the floor"},
    {"observe.ledger", OF(BOOL), AT(observe.ledger), DEFAULT("false"), .help = "energy columns"},
    {"observe.walls", CHOICE(OBSERVE_WALLS), AT(observe.walls), DEFAULT("false"), .truth = "mean",
     .help = "force on each wall: mean (or true) over the time since the row before; instant"},
    {"observe.order", OF(BOOL), AT(observe.order), SOLID, DEFAULT("false"),
     .help = "columns of rods' order"},
    {"observe.outlet", NUMBER(-1e6, 1e6, "m"), AT(observe.outlet), FLAT,
     .count_offset = offsetof(OzScene, observe.has_outlet), .write = OZ_WRITE_MARKED,
     .fallback_help = "no outlet", .help = "grains below this height have flowed out"},
#include "scene/rows_pictures.h"
    {"checkpoint.every", NUMBER(0, 1e9, "s"), AT(checkpoint.every), DEFAULT("60"),
     .help = "of wall time, between states to resume from; one more at the end; 0: none"},
    {"checkpoint.interval_taps", NUMBER(1e-9, 1e9, "periods"), AT(checkpoint.interval_taps),
     .write = OZ_WRITE_NONZERO,
     .help = "between states that are kept, in checkpoints/, to begin other runs from"},
    {"checkpoint.taps", .type = OZ_KEY_NUMBERS, .low = 0, .high = 1e9, .unit = "periods",
     AT(checkpoint.taps), .count_offset = offsetof(OzScene, checkpoint.tap_count), .rival = "times",
     .write = OZ_WRITE_NONZERO,
     .help = "states are kept at these periods of the first moving wall"},
    {"checkpoint.times", .type = OZ_KEY_NUMBERS, .low = 0, .high = 1e9, .unit = "s",
     AT(checkpoint.times), .count_offset = offsetof(OzScene, checkpoint.count), .rival = "taps",
     .write = OZ_WRITE_UNLESS_RIVAL, .help = "states are kept at these times"},
#include "scene/rows_tables.h"
    {"export", .type = OZ_KEY_CHOICES, .choices = EXPORTS, .unit = "", .width = OZ_EXPORTS_END,
     AT(exports), .count_offset = offsetof(OzScene, export_count), .write = OZ_WRITE_NONZERO,
     FIXED("frames are kept for it from the start"), .fallback_help = "none",
     .help = "formats for other programs, written into export/ frame by frame"},
    {"export_interval", NUMBER(1e-12, 1e9, "s"), AT(export_interval), .write = OZ_WRITE_NONZERO,
     .fallback_help = "the movie's frames, without a movie the rows of series.csv",
     .help = "between exported frames"},
    {"phases", OF(ITEMS), AT(phases), .count_offset = offsetof(OzScene, phase_count),
     .item_size = sizeof(OzPhase), .line_offset = offsetof(OzPhase, line), .fallback_help = "none",
     FIXED("the run has begun with them"),
     .help = "parts of the run, one after the other; each may change keys as it begins"},
    {"phases[].name", OF(TEXT), PHASE(name), .write = OZ_WRITE_NONZERO, .help = "for messages"},
    {"phases[].time", NUMBER(1e-12, 1e9, "s"), PHASE(time), .rival = "taps",
     .write = OZ_WRITE_NONZERO, .fallback_help = "of the last one: to the end",
     .help = "how long it lasts"},
    {"phases[].taps", NUMBER(1e-9, 1e9, "periods"), PHASE(taps), .rival = "time",
     .write = OZ_WRITE_NONZERO, .help = "the same in periods of the first moving wall"},
    {"phases[].set", OF(TEXT), PHASE(set), .write = OZ_WRITE_NONZERO,
     .help = "keys that change as it begins, as in contact.friction=0.2; gravity=[0, 0, -1]"},
    {"cycles", INTEGER(1, 1e5), AT(cycles), DEFAULT("1"), FIXED("the run has begun with them"),
     .help = "how often the phases are gone through"},
    {"sweep", OF(SWEEP), AT(sweep), FIXED("members have been made of it"),
     .write = OZ_WRITE_NONZERO,
     .help = "a run for each value of a key, as in {contact.friction: [0.1, 0.2]}; of several keys "
             "for every combination, or with zip: true for those that stand in the same place"},
    {NULL, OF(TEXT)},
};
/* clang-format on */

const OzKey *oz_rows_all(void)
{
    return KEYS;
}
