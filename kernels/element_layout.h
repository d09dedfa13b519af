/* The structs and word layouts that the kernels of trigrains and the host share. Slots: the free
 * elements by id, padded to whole blocks of lanes, then the elements of walls by id, padded too. */
#pragma once

#include "kernels/element_law.h"
#include "kernels/head.h"
#include "kernels/ledger_entries.h"

enum { OZ_ELEMENT_WALLS_MAX = 16 };

/* The numbers of a scene that kernels read. All are scalars: the host fills the struct in double,
 * and the single-precision one is made by converting it number by number. On the host the numbers
 * are in SI units; a device's are counted in `units`, as is everything that kernels read. */
typedef struct OzElementParameters {
    OZ_PARAMETERS_HEAD
    scalar gravity[2]; /* m/s^2                                                            */
    scalar middle[2];  /* m: an element farther than domain from here has escaped             */
    scalar domain;
    scalar stiffness; /* N/m^2, force of two triangles over their overlap area            */
    scalar deep_warn, deep_stop; /* shares of a triangle inside another, or of a disc's diameter */
    OzBeamConstants beam;
    OzBeamStrength strength, yield;          /* with OZ_STRENGTH only          */
    OzDiscLaw law[OZ_ELEMENT_WALLS_MAX + 1]; /* of discs: with other grains, then with each wall  */
    OZ_PARAMETERS_LISTS /* elements that reach farther are not in the grid, all look at them */
} OzElementParameters;

/* Capacities and strides; the same for every member of one launch. */
typedef struct OzElementSizes {
    OZ_SIZES_HEAD /* slots: of all elements; regions: of the free ones             */
        int free_slots,
        free_blocks; /* of the free elements, padding included                        */
    int beam_blocks; /* of the longest list of beams                                */
    int walls;
    int scars; /* pairs of triangles of one grain; with OZ_STRENGTH only               */
} OzElementSizes;

/* Reasons to stop, as bits, in the order in which they are told. After the last, a beam that broke,
 * the host looks at what grains there are now, and goes on. */
enum {
    OZ_ELEMENT_STOP_NAN = 1,
    OZ_ELEMENT_STOP_ESCAPED = 2,
    OZ_ELEMENT_STOP_SWALLOWED = 4,
    OZ_ELEMENT_STOP_DEEP = 8,
    OZ_ELEMENT_STOP_STRETCHED = 16,
    OZ_ELEMENT_STOP_BENT = 32,
    OZ_ELEMENT_STOP_FAST = 64,
    OZ_ELEMENT_STOP_BROKE = 128
};

/* The device's own words, one set a member. */
typedef struct OzElementControl {
    OZ_CONTROL_HEAD
    int free_count, wall_count, beam_count; /* of this member: elements of grains and of walls */
} OzElementControl;

/* Words of a slot's record, what contacts and beams need of an element: corners in the world,
 * centre of mass, velocity, angle, spin; and what never changes: radius (0 for a triangle), inverse
 * mass; and the skin in the inner list. */
enum {
    OZ_PR_CORNER = 0,
    OZ_PR_POSITION = 6,
    OZ_PR_VELOCITY = 8,
    OZ_PR_ANGLE = 10,
    OZ_PR_ANGULAR_VELOCITY = 11,
    OZ_PR_RADIUS = 12,
    OZ_PR_INVERSE_MASS = 13,
    OZ_PR_SKIN = 14,
    OZ_ELEMENT_RECORD = 16
};

/* Words of a load, of a pair's and of a beam's result: force (on the second of two; the first feels
 * the opposite), torque; of a result: torques on first and second. */
enum { OZ_ELEMENT_LOAD = 4 };

/* Words of a block's shapes, each a real with one lane an element: corners at angle 0. */
enum {
    OZ_PS_CORNER = 0,
    OZ_PS_REACH = 6,
    OZ_PS_RADIUS,
    OZ_PS_INVERSE_MASS,
    OZ_PS_INVERSE_INERTIA,
    OZ_PS_STRIDE_MOST, /* m: more than this in one step is too fast */
    OZ_ELEMENT_SHAPE
};

/* Words of a block's reference: centre and angle when a list was made, and how far an element may
 * move before the list must be made again. */
enum { OZ_PF_X, OZ_PF_Y, OZ_PF_ANGLE, OZ_PF_SKIN, OZ_ELEMENT_REFERENCE };

/* Words of a wall's motion at one step: displacement upwards, cosine and sine of its turn about its
 * point, the turn, that point, velocity upwards, spin. */
enum {
    OZ_PM_OFFSET,
    OZ_PM_COS,
    OZ_PM_SIN,
    OZ_PM_ANGLE,
    OZ_PM_POINT,
    OZ_PM_VELOCITY = 6,
    OZ_PM_ANGULAR_VELOCITY,
    OZ_ELEMENT_MOTION
};

/* Words of an element's impulse at a wall: of force, then of torque. */
enum { OZ_ELEMENT_IMPULSE_WORDS = 3 };

/* A work-item's sums of energy, J, and after them how fast each grew at the last step, W. */
enum { OZ_ELEMENT_LEDGER_WORDS = 2 * OZ_ELEMENT_LEDGER };
