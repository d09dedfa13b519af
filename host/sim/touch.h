/* What touches at one moment, and the energy in its springs: sums over the contacts of a snapshot.
 * The caller knows which pairs and wall ends may touch and what tangential springs they carry;
 * those that turn out not to touch add nothing. Serves the device simulation and the host reference
 * alike. */
#ifndef OZ_SIM_TOUCH_H
#define OZ_SIM_TOUCH_H

#include "model/snapshot.h"
#include "sim/physics.h"

/* One contact. */
typedef struct OzTouchLast {
    double overlap, rate; /* m, m/s              */
    double mass;          /* kg, effective       */
    double energy;        /* J, stored along the normal */
} OzTouchLast;

/* Read contacts, elastic and tangential when all contacts were given. */
typedef struct OzTouch {
    OzPhysics physics;          /* its walls are in the order in which `wall` counts below        */
    const OzSnapshot *snapshot; /* borrowed: position, axis, velocity, spin, walls                */
    OzContactSums contacts;
    double elastic; /* J, in normal and tangential springs                                      */
    double tangential; /* J, the part of it in tangential springs */
    OzTouchLast last;  /* the contact that was added last         */
} OzTouch;

/* Starts sums for a snapshot whose state, axes and walls are filled in. Nothing to free. Fails with
 * OZ_ERR_INPUT as oz_constants_fill does. */
OzStatus oz_touch_begin(OzTouch *touch, const OzSnapshot *snapshot);

/* Grains a and b (ids; a is the one whose reach is larger, or the lower id). history is the pair's
 * tangential spring (m) as the integrator keeps it between steps: it is advanced to this moment by
 * the integrator's share of a step. NULL: none. */
void oz_touch_pair(OzTouch *touch, int64_t a, int64_t b, const double history[3]);

/* End 0 (along the axis) or 1 of a grain at a wall, counted in kernel order. */
void oz_touch_wall(OzTouch *touch, int64_t grain, int wall, int end, const double history[3]);

#endif
