/* What host and device agree on: parameters, sizes, control words and where words lie in records. A
 * device kernel writes the sizes of these structs at start and the host compares them with its own.
 */
#pragma once

#include "kernels/contact.h"
#include "kernels/head.h"
#include "kernels/wall_shape.h"

enum { OZ_WALLS_MAX = 31 }; /* the most sides of walls: OzParameters has an entry for each */

/* A wall as kernels see it. They come in the order of their kinds. */
typedef struct OzWallParameters {
    OzWallShape shape;   /* its point in units of length_unit (double: m) */
    scalar direction[3]; /* unit vector: along which it moves */
    scalar axis[3];      /* unit vector: about which it turns */
    OzLawConstants law;
} OzWallParameters;

/* A fluid that flows by grains (drag.h). */
typedef struct OzDragConstants {
    scalar linear;  /* kg/(m s): 3 pi eta          */
    scalar square;  /* kg/m^3: pi/8 rho C_d        */
    scalar wind[3]; /* m/s, of the fluid           */
} OzDragConstants;

enum { OZ_SERVOS_MAX = 6 }; /* the most servo walls: the sides of a box */

/* A servo wall (servo_move.h). Forces count along its normal, into the bed. */
typedef struct OzServoConstants {
    scalar wall;          /* the kernels' number of it                               */
    scalar mass, damping; /* kg, kg/s                                                */
    scalar force;         /* N, its weight included                                  */
    scalar pressure;      /* Pa, over the area that it closes:                       */
    scalar gap[2];        /* m, its sides; of a round one any that give the area ... */
    scalar bound[4];      /* ... as built: the servos that stand at both ends of each, and
                             make it less; -1: none does                             */
} OzServoConstants;

/* The numbers of a scene that kernels read, and what follows from them. They can change without a
 * new kernel program. All are scalars: the host fills the struct in double, and the
 * single-precision one is made by converting it number by number. On the host the numbers are in SI
 * units; a device's are counted in `units`, as is everything that kernels read. */
typedef struct OzParameters {
    OZ_PARAMETERS_HEAD
    scalar length_unit;  /* m per count of a place; 1 in double                              */
    scalar inverse_unit; /* 1/m                                                              */
    scalar domain;       /* units: a grain beyond this distance from the origin has escaped  */
    scalar period[3], period_rest[3]; /* units after which space repeats itself (space.h) ...   */
    scalar inverse_period[3];         /* ... and the inverse; 0: it does not                    */
    scalar gravity[3]; /* m/s^2                                                            */
    scalar deep_look, deep_warn, deep_stop; /* depths (depth.h) looked at, counted, stopped at */
    OzLawConstants law; /* between grains                                                   */
    OzDragConstants fluid;
    OZ_PARAMETERS_LISTS
    scalar radius_count; /* units: the radius in a place's units                             */
    scalar radius, half_length, mass; /* of every grain of an equal population                */
    scalar inverse_mass, inverse_inertia, inverse_inertia_axis;
    OzWallParameters wall[OZ_WALLS_MAX];
    OzServoConstants servo[OZ_SERVOS_MAX];
} OzParameters;

/* Sizes and strides; the same for every member of one launch. */
typedef struct OzSizes {
    OZ_SIZES_HEAD
    int count;                              /* grains */
    int mesh_faces, mesh_cells, mesh_items; /* triangles of all meshes; cells of their grids, and
                                               one more for each; triangles listed in them */
} OzSizes;

/* Reasons to stop, as bits. */
enum {
    OZ_STOP_NAN = 1,
    OZ_STOP_ESCAPED = 2,
    OZ_STOP_DEEP = 4,
    OZ_STOP_FAST = 8,
    OZ_STOP_MET = 16,
    OZ_STOP_CROWDED = 32,
    OZ_STOP_SERVO = 64
};

/* The device's own words, one set a member. */
typedef struct OzControl {
    OZ_CONTROL_HEAD
} OzControl;

/* Words of a record: what a contact needs of a grain, one record a slot, OZ_RECORD scalars. */
enum {
    OZ_R_POSITION = 0,
    OZ_R_RADIUS = 3,
    OZ_R_SHAFT = 4,
    OZ_R_MASS = 7,
    OZ_R_VELOCITY = 8,
    OZ_R_SKIN = 11,
    OZ_R_RATE = 12,
    OZ_R_INVERSE_MASS_TURN = 15, /* inverse inertia across the shaft; with OZ_AT_CONTACT only */
    OZ_RECORD = 16
};

/* Words of a fine record: what the record leaves of the grain's place and turn (fine.h), with
 * OZ_FINE only, each vector with one word to spare. */
enum { OZ_N_REST = 0, OZ_N_TURN = 4, OZ_N_TURN_REST = 8, OZ_FINE_RECORD = 12 };

/* Words of a pair's result. Force and torque on b stand together, each with one word to spare; the
 * torque on a is in an array of its own. So the gather of b, which comes to these words in no order
 * of memory, reads one cache line. */
enum { OZ_F_FORCE = 0, OZ_F_TORQUE = 4, OZ_PAIR_FORCE = 8, OZ_PAIR_TORQUE = 4 };

/* Words of a row of constants of a law, a few to spare. Rows: of each two materials of grains, then
 * of each wall and each material (material.h). */
enum { OZ_LAW_ROW = 12 };

/* Words of a pair's tangential or rolling spring, one to spare. */
enum { OZ_SPRING = 4 };

/* Words of a wall's motion at one step: displacement and velocity along its direction; the
 * displacement in units, whole ones and the rest; the rate at which it turns; bits that say whether
 * the wall is there. */
enum { OZ_M_OFFSET, OZ_M_SPEED, OZ_M_RISE, OZ_M_RISE_REST, OZ_M_RATE, OZ_M_GATE, OZ_MOTION };

/* Words of how a wall stands at one step that changes its place when it turns, with OZ_SWUNG only:
 * those of an OzWallSwing (wall_swing.h). */
enum { OZ_W_FRAME = 0, OZ_W_AWAY = 9, OZ_W_LEAD = 12, OZ_W_HOME = 15, OZ_SWING = 18 };

/* Words of how a sheared cell stands at one step, with OZ_SHEAR only: its tilt, in two numbers, and
 * rate (space.h); by how many times its length over its width the tilt became less with this step.
 */
enum { OZ_H_TILT, OZ_H_TILT_REST, OZ_H_RATE, OZ_H_TURNS, OZ_SHEAR_WORDS };

/* A wall is not there at a step, was not there at the one before, will not be at the next. */
enum { OZ_GATE_GONE = 1, OZ_GATE_COMES = 2, OZ_GATE_GOES = 4 };

/* Words of a grain's impulse at a wall: of force, then of torque. */
enum { OZ_IMPULSE_WORDS = 6 };

/* Words of a servo wall's state: those of an OzServoState. */
enum {
    OZ_SERVO_PLACE,
    OZ_SERVO_SPEED,
    OZ_SERVO_ACCELERATION,
    OZ_SERVO_SEEN,
    OZ_SERVO_PUSH,
    OZ_SERVO
};

/* Words of a mesh's grid: where it begins (m, from the wall's point), 1/m, cells along each axis,
 * their beginning in mesh_first, and that of its triangles; whether grains touch both sides; the
 * largest skin of a grain, m, for which cells' lists hold all that it may touch. */
enum {
    OZ_G_LOW = 0,
    OZ_G_INVERSE = 3,
    OZ_G_CELLS = 4,
    OZ_G_FIRST = 7,
    OZ_G_CORNER,
    OZ_G_TWO_SIDED,
    OZ_G_SKIN,
    OZ_MESH_GRID
};

/* Words of a triangle's record: its first corner's place, one to spare, and both edges from there.
 */
enum { OZ_MESH_R_CORNER = 0, OZ_MESH_R_ONE = 4, OZ_MESH_R_OTHER = 7, OZ_MESH_RECORD = 12 };

/* Words of a block's lists of triangles at one mesh, each a real with one lane per grain: place and
 * half-shaft when they were made, m, on the mesh as built; skin, m, 0: there is none; number of
 * triangles, stored or not (mesh_list.h). */
enum {
    OZ_MESH_L_FROM = 0,
    OZ_MESH_L_SHAFT = 3,
    OZ_MESH_L_SKIN = 6,
    OZ_MESH_L_NUMBER,
    OZ_MESH_LIST
};

/* Words of a grain's touch of a mesh: place along the shaft, normal, distance, push (mesh.h). */
enum { OZ_MESH_TOUCH = 6 };

/* Words of a slot's load, and of what pushes a grain from outside (by id): force and torque, each
 * with one word to spare. */
enum { OZ_LOAD = 8 };

/* Words of a block's state, each a real with one lane per grain. */
enum {
    OZ_S_POSITION = 0,
    OZ_S_REST = 3,
    OZ_S_VELOCITY = 6,
    OZ_S_SPIN = 9,
    OZ_S_TURN = 12,
    OZ_S_TURN_REST = 16,
    OZ_S_ACCELERATION = 20, /* with OZ_MOVES_BEFORE only */
    OZ_S_TORQUE = 23,
    OZ_STATE = 26
};

/* Words of a block's shapes, for populations that are not all equal; the count is the radius in a
 * place's units. */
enum {
    OZ_B_RADIUS,
    OZ_B_HALF_LENGTH,
    OZ_B_MASS,
    OZ_B_INVERSE_INERTIA,
    OZ_B_INVERSE_AXIS,
    OZ_B_COUNT,
    OZ_SHAPE
};

/* Words of a block's reference: place and half-shaft when a list was made, and the grain's skin in
 * that list: how far it may move before the list must be made again; with OZ_SHEAR the cell's tilt
 * then. */
enum { OZ_REFERENCE_SKIN = 6, OZ_REFERENCE_PLAIN = 7, OZ_REFERENCE_TILT = 7 };
#define OZ_REFERENCE (OZ_REFERENCE_PLAIN + OZ_SHEAR)
