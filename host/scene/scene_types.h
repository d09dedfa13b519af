/* A scene: what a person wrote, checked, with every default filled in, in SI units. An immutable
 * value once loaded (scene/scene.h); a live reload makes a second one and compares. */
#pragma once

#include "base/status.h"
#include "kernels/integrators.h"
#include "kernels/walls.h"
#include "scene/beam_types.h"
#include "scene/boundary_types.h"
#include "scene/material.h"
#include "scene/servo_types.h"
#include "scene/tables.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum OzModelKind { OZ_MODEL_RODS, OZ_MODEL_TRIGRAINS } OzModelKind;
typedef enum OzPrecision { OZ_PRECISION_FLOAT, OZ_PRECISION_DOUBLE } OzPrecision;
typedef enum OzBroadphase {
    OZ_BROADPHASE_HASH,      /* hashed uniform grid on the device             */
    OZ_BROADPHASE_ALL_PAIRS, /* every pair, on the device: to test with       */
    OZ_BROADPHASE_SORT_AXIS  /* P's sort by highest point, on the host        */
} OzBroadphase;

typedef enum OzForcePoint { OZ_FORCE_CENTROID, OZ_FORCE_MIDPOINT } OzForcePoint;
typedef enum OzOverlapForce { OZ_OVERLAP_KINDS, OZ_OVERLAP_FIELD } OzOverlapForce;

/* trigrains: what two overlapping triangles do to each other. */
typedef struct OzTriangleValues {
    double stiffness; /* Y, N/m^2: force over overlap area                            */
    OzOverlapForce overlap;
    OzForcePoint force_point; /* of kinds                                             */
} OzTriangleValues;

/* A stretch of shaking: offset (-1)^halves A sin(2 pi f (t - since) + phase) - base. */
typedef struct OzShake {
    double since;                /* s: motion.from, then where the sine crosses zero             */
    double halves;               /* whole: half periods of the sine before that                  */
    double phase;                /* rad: motion.phase, then 0                                    */
    double base;                 /* m: taken off, so that the wall starts where it was built     */
    double taps;                 /* periods of the wall from time 0 to `since`                   */
    double amplitude, frequency; /* m, Hz */
} OzShake;

/* What a trace holds against time. */
typedef enum OzMeasured { OZ_MEASURED_OFFSET, OZ_MEASURED_ACCELERATION } OzMeasured;

typedef struct OzTrace OzTrace; /* scene/trace.h */

/* Sinusoidal motion along a direction: offset A (sin(2 pi f (t - from) + phase) - sin phase),
 * unless it took over from another motion (model/motion.h); or a steady one, or a trace. Beside
 * them it may turn. */
typedef struct OzMotion {
    bool present;
    double frequency;          /* Hz                                                           */
    double acceleration_ratio; /* A (2 pi f)^2 / |gravity|; both are filled in, whichever was   */
    double amplitude;          /* m                                                      written */
    double written_amplitude;  /* m; 0 when the acceleration ratio was written                  */
    bool has_ratio, has_amplitude, has_turning; /* whether these were written, also as 0        */
    double phase;            /* degrees, where the sine starts                                */
    double angular_velocity; /* rad/s: trigrains about the wall's point; rods about its axis  */
    double direction[3];     /* rods: a unit vector, along which it is shaken; zero: upwards   */
    double axis[3];          /* rods: a unit vector along the axis, through the wall's point ...  */
    double point[3];         /* ... or, of meshes, rectangles and discs, this one, m              */
    bool has_axis;           /* disc, plane: axis was written, and is not its normal              */
    bool has_point;          /* point was written                                                 */
    double velocity[3];      /* rods, m/s: it goes on so; then direction is along it            */
    double from, until;      /* s: when it starts to be shaken, to turn, to go on or to follow its
                              * trace, and when it stops; until 0: for ever                    */
    char *file, *column;     /* of a trace; NULL: none; NULL: the only one         */
    OzMeasured measured;
    bool closed;    /* accelerations: it ends where it began */
    double scale;   /* SI over what the file has                                                */
    OzTrace *trace; /* shared with the scene's copies; NULL: none                               */
    OzShake shake;  /* since when it is shaken so (amplitude and frequency are those above);
                     * in a scene as loaded since the start                                     */
    OzShake before; /* how it is shaken until then                                              */
    double turned, turned_since; /* rad, s: its angle at a time, and that time; zero as loaded  */
    bool is_driven;              /* from outside (sim/push.h), instead of all offsets above     */
    double driven[3];            /* s, m, m/s: since when, its offset then, its speed since     */
} OzMotion;

typedef enum OzWallEnds { OZ_ENDS_OPEN, OZ_ENDS_CLOSED } OzWallEnds;

typedef enum OzWallSideChoice { OZ_SIDE_INSIDE, OZ_SIDE_OUTSIDE } OzWallSideChoice;

typedef struct OzWallMesh OzWallMesh; /* scene/wall_mesh.h */

typedef struct OzWall {
    OzWallKind kind;
    double point[3], normal[3]; /* plane: normal is a unit vector into the free side; rectangle,
                                   disc: across it                                          */
    double diameter;            /* m, cylinder, sphere, disc, drum                            */
    double diameters[2];        /* m, cone: at its point, and at the far end                  */
    double axis[3];  /* cylinder, cone: a unit vector along its axis, through point; zero: z */
    double length;   /* m, cylinder, cone: from point along axis; 0: endless       */
    OzWallEnds ends; /* cylinder with a length                                     */
    OzWallSideChoice side; /* cylinder, cone, sphere: where grains are                   */
    double size[3];        /* m, box: its bottom's middle is point; rectangle: two sides */
    double edge[3];        /* rectangle: a unit vector along its first side              */
    double from[2], to[2]; /* m, segment: the free side lies to the left on the way      */
    double width, height;  /* m, floor, hopper (inner, at the top), vessel (inner)       */
    double opening;        /* m, hopper                                                  */
    double slope;          /* rad from the horizontal, hopper                            */
    int64_t tooth_count;   /* floor, hopper's slopes, drum; 0: smooth                    */
    double tooth_depth;    /* m                                                          */
    double thickness;      /* m, of what walls of triangles are made; 0: chosen by orzo  */
    char *path;            /* mesh: of its triangles                                     */
    double scale;          /* mesh: m of a unit of its file                              */
    bool two_sided;        /* mesh: grains touch it from behind, too                     */
    OzWallMesh *mesh;      /* those triangles, held; NULL of other walls                 */
    bool meets_rods;       /* no key: some grain has a shaft, or a file may hold such ones */
    double since;          /* s, key `from` of rods' walls: it is there from this time on */
    double until;          /* s: the wall is gone from this time on; 0: never            */
    OzMotion motion;
    OzServo servo;           /* rods: planes, rectangles, discs                         */
    char *material;          /* NULL: none                                              */
    int material_number;     /* no key: its place in materials, from 1; 0: none         */
    OzContactValues told;    /* as written: the scene's, with this wall's own over them */
    OzContactValues contact; /* those, or of its material against the grains' (mixing.h) */
    int line;
} OzWall;

/* A number, or [low, high] for a uniform spread. */
typedef struct OzRange {
    double low, high;
} OzRange;

typedef enum OzPopulationKind {
    OZ_GRAINS_RANDOM,  /* without overlap, directions uniform on the sphere, in the container's
                          column */
    OZ_GRAINS_LATTICE, /* cells[0] x cells[1] x cells[2] grains, spacing apart, the first at
                          position  */
    OZ_GRAINS_SINGLE,
    OZ_GRAINS_FILE /* every grain of a final.csv, with its position, velocity and size */
} OzPopulationKind;

/* Corners of one grain's outline, or points of a star: cutting takes their number cubed. */
enum { OZ_CORNERS_MAX = 300 };

/* THE list of trigrains' shapes, X(NAME, name, choice): four triangles about the middle; a triangle
 * on each edge about the middle, irregular if asked for; corners in and out in turn; any simple
 * polygon; a disc. host/model/shape.c makes each (make_<name>). The keys that a shape reads name it
 * under `.shapes` in host/scene/rows.c. */
#define OZ_SHAPES(X)                                                                               \
    X(SQUARE, square, "square")                                                                    \
    X(POLYGON, polygon, "polygon")                                                                 \
    X(STAR, star, "star")                                                                          \
    X(VERTICES, vertices, "vertices")                                                              \
    X(DISC, disc, "disc")

#define OZ_SHAPES_ID(NAME, name, choice) OZ_SHAPE_##NAME,
typedef enum OzShapeKind { OZ_SHAPES(OZ_SHAPES_ID) OZ_SHAPES_END } OzShapeKind;

typedef struct OzPopulation {
    OzPopulationKind kind;
    int64_t count;          /* random: as written; lattice: product of cells; single: 1; file: -1 */
    OzRange diameter;       /* m                                                       */
    OzRange aspect;         /* shaft length / diameter; 0 = sphere                     */
    char *material;         /* NULL: none                                              */
    int material_number;    /* no key: its place in materials, from 1; 0: none         */
    double density;         /* kg/m^3                                                  */
    double fill;            /* volume fraction of the random start column              */
    double velocity_spread; /* m/s, random: standard deviation of each component       */
    int64_t cells[3];       /* lattice                                                 */
    double spacing[3];      /* m, lattice                                              */
    double position[3], axis[3], velocity[3],
        angular_velocity[3]; /* single, lattice; axis is a unit vector;
                    spin in the world frame, rad/s   */
    char *path;              /* file: absolute, or relative to the working folder       */
    OzShapeKind shape;       /* trigrains, with what follows; two-dimensional vectors have
                                z = 0, spin is spin[2], density is kg/m^2               */
    OzRange edge;            /* m, square                                               */
    OzRange radius;          /* m, polygon and star (to the outer corners), disc        */
    OzRange corners;         /* whole numbers: of a polygon, points of a star           */
    double irregularity;     /* 0..1: how far polygons' corners are moved at random     */
    double depth;            /* star: inner over outer radius                           */
    double *vertices;        /* m: x and y of vertex 0, then of vertex 1, ...           */
    int vertex_count;        /* numbers in vertices: two for each vertex                */
    double angle;            /* rad, single and lattice                                 */
    int line;
} OzPopulation;

/* Rods and spheres: what a fluid does to each grain (kernels/drag.h). */
typedef struct OzDrag {
    double viscosity;   /* Pa s                            */
    double coefficient; /* C_d of the sphere of its volume */
    double density;     /* kg/m^3, of the fluid            */
    double wind[3];     /* m/s, its velocity               */
} OzDrag;

typedef enum OzOverlaps {
    OZ_OVERLAPS_KEEP,  /* grains start where they are told to                    */
    OZ_OVERLAPS_REMOVE /* they are moved apart first, without forces (part.h)     */
} OzOverlaps;

typedef struct OzSettle {
    bool present;
    OzOverlaps overlaps;
    double drag;      /* 1/s                                                                */
    double threshold; /* kinetic energy below threshold x N m g d counts as settled         */
    double rest_time; /* s without drag afterwards (default 0.2)                            */
    double time_max;  /* s, of the part with drag                                           */
} OzSettle;

/* What overlaps a run is told of, and which end it. Rods: in units of the smaller radius, at a wall
 * of half the radius (kernels/depth.h). trigrains: part of a triangle inside another, or of a
 * disc's diameter. */
typedef struct OzGuards {
    double overlap_warn; /* deeper contacts are counted, the first one is said */
    double overlap_stop; /* a deeper contact ends the run                      */
} OzGuards;

/* Phases of the first moving wall, whose offset is A sin(2 pi f t). */
typedef enum OzObserveAt {
    OZ_OBSERVE_MEAN,  /* tap means run over all phases; rows begin at time 0                   */
    OZ_OBSERVE_TOP,   /* offset A, a quarter of a period after 0: rows and tap means           */
    OZ_OBSERVE_BOTTOM /* offset -A, three quarters                                             */
} OzObserveAt;

/* Columns of the force on each wall. */
typedef enum OzObserveWalls {
    OZ_OBSERVE_WALLS_NONE,
    OZ_OBSERVE_WALLS_MEAN,   /* over the time since the row before */
    OZ_OBSERVE_WALLS_INSTANT /* at the row's moment                */
} OzObserveWalls;

typedef struct OzObserve {
    double interval;         /* s between rows of series.csv; interval_taps x period is put here */
    double interval_taps;    /* as written; 0: interval was, or neither                         */
    int64_t samples_per_tap; /* for the tap means over all phases                          */
    OzObserveAt at;          /* when rows are written, and of which phase tap means are     */
    double layer_thickness;  /* m; default 4e-3                                             */
    bool ledger;             /* energy columns                                              */
    OzObserveWalls walls;
    bool order;    /* columns of rods' order                                      */
    double outlet; /* m, trigrains: grains below this height have flowed out      */
    bool has_outlet;
} OzObserve;

typedef enum OzView {
    OZ_VIEW_LATERAL, /* from the front, a little above the horizon */
    OZ_VIEW_CUT,     /* the same without what stands before the middle */
    OZ_VIEW_TOP,     /* from above                                    */
    OZ_VIEW_FREE     /* from the movie's azimuth and elevation         */
} OzView;
typedef enum OzStyle {
    OZ_STYLE_SCREEN,
    OZ_STYLE_PAPER /* no text, on white */
} OzStyle;
typedef enum OzColour {
    OZ_COLOUR_ANGLE,        /* to the floor, viridis, 0..90 degrees; of trigrains the long axis'
                               direction, cyclic, 0..180 degrees                                */
    OZ_COLOUR_AZIMUTH,      /* cyclic, on twice the angle                                       */
    OZ_COLOUR_SPEED,        /* viridis, 0 to the scene's typical speed                          */
    OZ_COLOUR_TYPE,         /* one colour for each population                                   */
    OZ_COLOUR_GREY,         /* speed in greys: the faster, the lighter                          */
    OZ_COLOUR_TURNED,       /* trigrains: how far since the start, cyclic, 0..360 degrees       */
    OZ_COLOUR_ORDER,        /* rods: local order (model/local_order.h), viridis, 0..1           */
    OZ_COLOUR_FORCE,        /* sum of what contacts push it with, viridis, 0 to the bed's scale */
    OZ_COLOUR_COORDINATION, /* grains and walls that it touches, viridis, 0..12             */
    OZ_COLOUR_MATERIAL      /* rods: one colour for each material                           */
} OzColour;

/* THE list of formats that a run's frames are exported to, X(NAME, name, choice):
 * host/export/export_<name>.c defines oz_export_<name>_format. */
#define OZ_EXPORTS(X)                                                                              \
    X(VTK, vtk, "vtk")                                                                             \
    X(XYZ, xyz, "xyz")                                                                             \
    X(H5MD, h5md, "h5md")                                                                          \
    X(CSV, csv, "csv")

#define OZ_EXPORTS_ID(NAME, name, choice) OZ_EXPORT_##NAME,
typedef enum OzExportKind { OZ_EXPORTS(OZ_EXPORTS_ID) OZ_EXPORTS_END } OzExportKind;

/* Pixels a side of any picture or movie: below, its parts cannot be told apart; above, MPEG-4 has
 * no bits for it (13) and H.264 and GL are not sure to hold it. */
enum { OZ_PICTURE_SIDE_MIN = 64, OZ_PICTURE_SIDE_MAX = 8190 };

typedef struct OzMovieSettings {
    bool present;
    int width, height; /* pixels, even */
    double fps;
    OzView views[2];
    int view_count; /* 1 or 2, side by side */
    OzColour colour;
    double speed;      /* shown seconds per real second of simulated time; 0: length is used */
    double length;     /* s of movie; 0: speed is used                                        */
    bool cut_outlines; /* cut view: grains before the plane are drawn as faint outlines      */
    bool outlines;     /* trigrains: grains' outlines are drawn                               */
    bool beams;        /* trigrains: beams are drawn                                          */
    bool settle;       /* settling is shown before the run                                   */
    bool captions;     /* what is changed while it runs is shown for two seconds             */
    double azimuth;    /* rad, of OZ_VIEW_FREE: where the eye stands, from the front (-y) on,
                        * counterclockwise as seen from above                               */
    double elevation;  /* rad, of OZ_VIEW_FREE: above the horizon                           */
    bool has_azimuth, has_elevation; /* else orzo's own */
    double zoom;      /* times as large as what fits                                       */
    double target[3]; /* m: what is in the middle of the picture                           */
    bool has_target;
    int64_t follow; /* number of the grain that is there instead */
    bool has_follow;
    OzStyle style;
    double background[3]; /* red, green, blue, 0 to 1 */
    bool has_background;
    bool legend;        /* what the colours mean       */
    double force_scale; /* N, at the top of colours by force; 0: by the bed's weight */
    double speed_scale; /* m/s, at the top of colours by speed; 0: by walls or the bed        */
    bool chains;        /* forces are drawn as lines between grains, the wider the larger */
    char *title;        /* over the pictures; NULL: the scene's */
} OzMovieSettings;

typedef struct OzSnapshotSettings {
    double *times; /* s, ascending, each once; taps are converted; those after the end never come */
    int count;
    double *taps; /* as written, ascending, or NULL */
    int tap_count;
    double strobe;     /* s between the states laid over each other in one picture; 0: none */
    int width, height; /* pixels; this and what follows is the movie's unless written */
    OzView views[2];
    int view_count;
    OzColour colour;
} OzSnapshotSettings;

/* When a run's state is put into a file. */
typedef struct OzCheckpoints {
    double every; /* s of wall time between states that replace each other, and at each ending; 0:
                     none */
    double interval_taps; /* periods between states that are kept; 0: none          */
    double *taps;         /* of states that are kept, as written, ascending, or NULL */
    int tap_count;
    double *times; /* s, of states that are kept, ascending; taps are converted */
    int count;
} OzCheckpoints;

/* One key that takes several values. */
typedef struct OzSweepKey {
    char *path;    /* "contact.friction"               */
    char *place;   /* "scene.yaml:12", for messages    */
    char **values; /* as written                       */
    int count;
} OzSweepKey;

/* Keys that take several values in turn: the scene then stands for several, its combinations. */
typedef struct OzSweep {
    OzSweepKey *keys;
    int key_count;
    bool zip;      /* values go in step; else every value meets every other, the last key's
                      values changing fastest                                              */
    char *key;     /* all keys with commas between, as a table's head; NULL without a sweep */
    char **values; /* of each combination, in the order of keys, with commas between        */
    int count;     /* combinations                                                          */
} OzSweep;

typedef struct OzScene {
    char *path; /* as given, for messages */
    char *base; /* path of the scene that it extends; NULL: none */
    char *name; /* file name without folder and .yaml: the run folder's name */
    char *title;
    OzModelKind model;
    uint64_t seed;
    double gravity[3];   /* m/s^2 */
    double step;         /* s     */
    double written_step; /* s, before restitution_calibration fitted it to the contact time */
    double duration;     /* s; taps x period is put here; INFINITY: until it is stopped */
    double taps;         /* as written; 0: duration was */
    double period;       /* s, of the first moving wall; 0 without one: `tap` is then empty */
    OzIntegrator integrator;
    OzPrecision precision;
    OzBroadphase broadphase;
    double skin; /* m, neighbour list's reach beyond contact; 0: chosen by orzo */
    bool gyroscopic;
    OzContactValues told;    /* contact, as written                             */
    OzContactValues contact; /* that, or of the first material of grains, with its like */
    OzMaterial *materials;
    int material_count;
    OzMaterialPair *pairs;
    int pair_count;
    OzDrag drag;
    OzTriangleValues triangles;
    OzBeamValues beams;
    OzPopulation *populations;
    int population_count;
    OzWall *walls;
    int wall_count;
    OzBoundary boundary;
    OzSettle settle;
    struct OzPhase *phases; /* scene/phases.h */
    int phase_count;
    int64_t cycles; /* of all phases */
    OzGuards guards;
    OzObserve observe;
    OzContactTable contacts;
    OzFieldTable fields;
    OzMovieSettings movie;
    OzSnapshotSettings snapshots;
    OzCheckpoints checkpoint;
    OzExportKind exports[OZ_EXPORTS_END]; /* formats that frames are exported to at the end   */
    int export_count;
    double export_interval; /* s between such frames; 0: the movie's, else rows of series.csv */
    OzSweep sweep;
    bool is_pushed; /* no key: grains are pushed from outside too (sim/push.h) */
} OzScene;
