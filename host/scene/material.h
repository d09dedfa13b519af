/* What touching bodies do to each other, as a scene says it of all, of a material, of a pair of
 * these. */
#pragma once

#include "kernels/laws.h"

#include <stdbool.h>

typedef enum OzSlip { OZ_SLIP_CUT, OZ_SLIP_SCALE } OzSlip;
typedef enum OzRolling { OZ_ROLLING_RESISTS_BY_SPRING, OZ_ROLLING_RESISTS_CONSTANTLY } OzRolling;
typedef enum OzAttraction { OZ_ATTRACTION_ALLOW, OZ_ATTRACTION_CLAMP } OzAttraction;
typedef enum OzDamping { OZ_DAMPING_CONSTANT, OZ_DAMPING_SMOOTH } OzDamping;
typedef enum OzParallel { OZ_PARALLEL_SINGLE, OZ_PARALLEL_LINE } OzParallel;
typedef enum OzContactPoint { OZ_POINT_MIDPOINT, OZ_POINT_SURFACES } OzContactPoint;
typedef enum OzRestitutionAt { OZ_RESTITUTION_CENTRE, OZ_RESTITUTION_CONTACT } OzRestitutionAt;
typedef enum OzCalibration { OZ_CALIBRATION_NONE, OZ_CALIBRATION_DISCRETE } OzCalibration;

/* What two touching bodies do to each other. */
typedef struct OzContactValues {
    OzLaw law;
    double contact_time;         /* s, of a free binary hit of two centres                   */
    double restitution;          /* 0..1 as written; below 0.01 the physics uses 0.01        */
    double friction;             /* Coulomb coefficient                                      */
    double tangential_stiffness; /* k_t / k_n                                                */
    double tangential_damping;   /* c_t / c_n; defaults to tangential_stiffness              */
    double surface_energy;       /* J/m^2, work of adhesion                                */
    OzRolling rolling;           /* how contacts resist rolling                            */
    double rolling_friction;     /* couple over normal force and radius; 0: none           */
    double rolling_damping;      /* of the rolling spring, over critical damping           */
    double twisting_friction;    /* couple about the normal, likewise                      */
    OzSlip slip;
    OzAttraction attraction;
    OzDamping damping; /* hooke: how the dashpot begins                            */
    OzParallel parallel;
    OzContactPoint contact_point;
    OzRestitutionAt restitution_at;
    OzCalibration restitution_calibration; /* hooke: whether the step's errors are made up for */
    double hertz_stiffness;            /* N/m^(3/2), hertz                                       */
    double normal_damping_rate;        /* 1/s, hertz                                             */
    double tangential_damping_rate;    /* 1/s, hertz                                             */
    double youngs_modulus;             /* Pa, hertz-mindlin: of the grains, or of the wall       */
    double poisson_ratio;              /* hertz-mindlin                                          */
    double other_modulus, other_ratio; /* no keys: of the body that it touches; 0: the grains'  */
} OzContactValues;

/* THE list of what a pair of materials may have of its own, X(name, rule): rule mixes it where it
 * has not (scene/mixing.c has mix_<rule>). The keys are in scene/rows_materials.h. */
#define OZ_MIXED(X)                                                                                \
    X(contact_time, series)                                                                        \
    X(restitution, energy)                                                                         \
    X(hertz_stiffness, harmonic)                                                                   \
    X(normal_damping_rate, mean)                                                                   \
    X(tangential_damping_rate, mean)                                                               \
    X(friction, geometric)                                                                         \
    X(tangential_stiffness, mean)                                                                  \
    X(tangential_damping, mean)                                                                    \
    X(surface_energy, geometric)                                                                   \
    X(rolling_friction, geometric)                                                                 \
    X(rolling_damping, mean)                                                                       \
    X(twisting_friction, geometric)

typedef struct OzMaterial {
    char *name;
    double density;          /* kg/m^3                                                  */
    OzContactValues contact; /* with its like                                           */
    int kind; /* among the materials of grains, in the list's order; -1: of none       */
    int line;
} OzMaterial;

typedef struct OzMaterialPair {
    char *between[2];
    OzContactValues contact; /* of which what is written counts */
#define OZ_MATERIAL_MARK(name, rule) bool has_##name;
    OZ_MIXED(OZ_MATERIAL_MARK)
#undef OZ_MATERIAL_MARK
    int line;
} OzMaterialPair;

/* The most materials of grains; walls may be of others. */
enum { OZ_MATERIALS_MAX = 8 };
