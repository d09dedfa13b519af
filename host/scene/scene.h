/* A scene: what a person wrote, checked, with every default filled in, in SI units. An immutable
 * value once loaded; a live reload makes a second one and compares.
 *
 * Loading reports every error of the file at once as `file:line: what is wrong; what was expected`
 * (one per line, in file order) and fails with OZ_ERR_INPUT. It never asserts on what a file says. */
#ifndef OZ_SCENE_SCENE_H
#define OZ_SCENE_SCENE_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef enum OzModelKind { OZ_MODEL_RODS } OzModelKind;
typedef enum OzIntegrator {
    OZ_INTEGRATOR_EULER,
    OZ_INTEGRATOR_SYMPLECTIC_EULER,
    OZ_INTEGRATOR_VELOCITY_VERLET
} OzIntegrator;
typedef enum OzPrecision { OZ_PRECISION_FLOAT, OZ_PRECISION_DOUBLE } OzPrecision;
typedef enum OzBroadphase {
    OZ_BROADPHASE_HASH,      /* hashed uniform grid on the device             */
    OZ_BROADPHASE_ALL_PAIRS, /* every pair, on the device: to test with       */
    OZ_BROADPHASE_SORT_AXIS  /* P's sort by highest point, on the host        */
} OzBroadphase;
typedef enum OzLaw { OZ_LAW_HOOKE, OZ_LAW_HERTZ, OZ_LAW_HERTZ_MINDLIN } OzLaw;
typedef enum OzSlip { OZ_SLIP_CUT, OZ_SLIP_SCALE } OzSlip;
typedef enum OzAttraction { OZ_ATTRACTION_ALLOW, OZ_ATTRACTION_CLAMP } OzAttraction;
typedef enum OzDamping { OZ_DAMPING_CONSTANT, OZ_DAMPING_SMOOTH } OzDamping;
typedef enum OzParallel { OZ_PARALLEL_SINGLE, OZ_PARALLEL_LINE } OzParallel;
typedef enum OzContactPoint { OZ_POINT_MIDPOINT, OZ_POINT_SURFACES } OzContactPoint;
typedef enum OzRestitutionAt { OZ_RESTITUTION_CENTRE, OZ_RESTITUTION_CONTACT } OzRestitutionAt;
typedef enum OzCalibration { OZ_CALIBRATION_NONE, OZ_CALIBRATION_DISCRETE } OzCalibration;

/* What two touching bodies do to each other. */
typedef struct OzContactValues {
    OzLaw law;
    double contact_time;          /* s, of a free binary hit of two centres                   */
    double restitution;           /* 0..1 as written; below 0.01 the physics uses 0.01        */
    double friction;              /* Coulomb coefficient                                      */
    double tangential_stiffness;  /* k_t / k_n                                                */
    double tangential_damping;    /* c_t / c_n; defaults to tangential_stiffness              */
    OzSlip slip;
    OzAttraction attraction;
    OzDamping damping;            /* hooke: how the dashpot begins                            */
    OzParallel parallel;
    OzContactPoint contact_point;
    OzRestitutionAt restitution_at;
    OzCalibration restitution_calibration; /* hooke: whether the step's errors are made up for */
    double hertz_stiffness;         /* N/m^(3/2), hertz                                       */
    double normal_damping_rate;     /* 1/s, hertz                                             */
    double tangential_damping_rate; /* 1/s, hertz                                             */
    double youngs_modulus;          /* Pa, hertz-mindlin: of the grains, or of the wall       */
    double poisson_ratio;           /* hertz-mindlin                                          */
} OzContactValues;

/* Sinusoidal motion along z: offset A sin(2 pi f t), 0 at time 0 and upwards first. */
typedef struct OzMotion {
    bool present;
    double frequency;          /* Hz                                                           */
    double acceleration_ratio; /* A (2 pi f)^2 / |gravity|; both are filled in, whichever was   */
    double amplitude;          /* m                                                      written */
    double written_amplitude;  /* m; 0 when the acceleration ratio was written                  */
} OzMotion;

typedef enum OzWallKind { OZ_WALL_PLANE, OZ_WALL_CYLINDER } OzWallKind;

typedef struct OzWall {
    OzWallKind kind;
    double point[3], normal[3]; /* plane: normal is a unit vector into the free side       */
    double diameter;            /* cylinder: side wall only, axis z through the origin     */
    OzMotion motion;
    OzContactValues contact;    /* the scene's, with this wall's own values put over them  */
    int line;
} OzWall;

/* A number, or [low, high] for a uniform spread. */
typedef struct OzRange {
    double low, high;
} OzRange;

typedef enum OzPopulationKind {
    OZ_GRAINS_RANDOM,  /* without overlap, directions uniform on the sphere, in the container's column */
    OZ_GRAINS_LATTICE, /* cells[0] x cells[1] x cells[2] grains, spacing apart, the first at position  */
    OZ_GRAINS_SINGLE,
    OZ_GRAINS_FILE     /* every grain of a final.csv, with its position, velocity and size             */
} OzPopulationKind;

typedef struct OzPopulation {
    OzPopulationKind kind;
    int64_t count;              /* random: as written; lattice: product of cells; single: 1; file: -1 */
    OzRange diameter;           /* m                                                       */
    OzRange aspect;             /* shaft length / diameter; 0 = sphere                     */
    double density;             /* kg/m^3                                                  */
    double fill;                /* volume fraction of the random start column              */
    int64_t cells[3];           /* lattice                                                 */
    double spacing[3];          /* m, lattice                                              */
    double position[3], axis[3], velocity[3], spin[3]; /* single, lattice; axis is a unit vector;
                                                          spin in the world frame, rad/s   */
    char *path;                 /* file: absolute, or relative to the working folder       */
    int line;
} OzPopulation;

typedef struct OzSettle {
    bool present;
    double drag;      /* 1/s                                                                */
    double threshold; /* kinetic energy below threshold x N m g d counts as settled         */
    double rest_time; /* s without drag afterwards (default 0.2)                            */
    double time_max;  /* s, of the part with drag                                           */
} OzSettle;

typedef struct OzObserve {
    double interval;        /* s between rows of series.csv; interval_taps x period is put here */
    double interval_taps;   /* as written; 0: interval was, or neither                         */
    int64_t samples_per_tap; /* for the tap means                                          */
    double layer_thickness; /* m; default 4e-3                                             */
    bool ledger;            /* energy columns                                              */
} OzObserve;

typedef enum OzView { OZ_VIEW_LATERAL, OZ_VIEW_CUT } OzView;
typedef enum OzColour {
    OZ_COLOUR_ANGLE,   /* angle to the floor, viridis, 0..90 degrees                       */
    OZ_COLOUR_AZIMUTH, /* cyclic, on twice the angle                                       */
    OZ_COLOUR_SPEED,   /* viridis, 0 to the scene's typical speed                          */
    OZ_COLOUR_TYPE     /* one colour for each population                                   */
} OzColour;

typedef struct OzMovieSettings {
    bool present;
    int width, height;  /* pixels, even */
    double fps;
    OzView views[2];
    int view_count;     /* 1 or 2, side by side */
    OzColour colour;
    double speed;       /* shown seconds per real second of simulated time; 0: length is used */
    double length;      /* s of movie; 0: speed is used                                        */
} OzMovieSettings;

typedef struct OzSnapshotSettings {
    double *times; /* s, ascending, each once; taps are converted; those after the end never come */
    int count;
    double *taps;  /* as written, ascending, or NULL */
    int tap_count;
} OzSnapshotSettings;

/* One key that takes several values in turn: the scene then stands for several. */
typedef struct OzSweep {
    char *key;     /* "contact.friction"; NULL without a sweep */
    char **values; /* as written                               */
    int count;
} OzSweep;

typedef struct OzScene {
    char *path;  /* as given, for messages */
    char *name;  /* file name without folder and .yaml: the run folder's name */
    char *title;
    OzModelKind model;
    uint64_t seed;
    double gravity[3]; /* m/s^2 */
    double step;       /* s     */
    double written_step; /* s, before restitution_calibration fitted it to the contact time */
    double duration;   /* s; taps x period is put here */
    double taps;       /* as written; 0: duration was */
    double period;     /* s, of the first moving wall; 0 without one: `tap` is then empty */
    OzIntegrator integrator;
    OzPrecision precision;
    OzBroadphase broadphase;
    double skin;       /* m, neighbour list's reach beyond contact; 0: chosen by orzo */
    bool gyroscopic;
    OzContactValues contact;
    OzPopulation *populations;
    int population_count;
    OzWall *walls;
    int wall_count;
    OzSettle settle;
    OzObserve observe;
    OzMovieSettings movie;
    OzSnapshotSettings snapshots;
    OzSweep sweep;
} OzScene;

/* Loads path, then applies the settings ("key.path=value", in order), then checks everything.
 * On success the caller frees with oz_scene_free; on failure *scene is zeroed. */
OzStatus oz_scene_load(OzScene *scene, const char *path, char *const *settings, int setting_count);

/* The same from a text in memory; path serves for messages and for finding other files. */
OzStatus oz_scene_parse(OzScene *scene, const char *path, const char *text, char *const *settings,
                        int setting_count);

/* Writes the scene with every default filled in, as a file that loads to the same scene. */
OzStatus oz_scene_write(const OzScene *scene, FILE *file);

/* Frees what scene owns and zeroes it; a zeroed scene is fine. */
void oz_scene_free(OzScene *scene);

#endif
