/* The energy ledger of the host reference: the work of contacts, added up step by step as in
 * kernels/ledger.h. */
#pragma once

#include "sim/constants.h"

/* J, since the start. Zeroed is empty. */
typedef struct OzWork {
    double dissipated; /* by dashpots                                                     */
    double spring;     /* given to tangential springs; what they do not hold is friction  */
    double walls;      /* put in by moving walls                                          */
} OzWork;

/* Adds one touching contact over a step of dt: each power is taken with the mean of
 * contact.velocity, which the force saw, and `after`, the relative velocity of the same points at
 * the step's end. */
void oz_ledger_note(OzWork *work, OzContact contact, OzContactForce parts, OzVec3 after, double dt);

/* Adds the work of a couple over a step of dt; turning and after: rad/s, as the velocities above.
 */
void oz_ledger_note_couple(OzWork *work, OzVec3 couple, OzVec3 turning, OzVec3 after, double dt);

/* Adds the work of a wall that moved with a mean velocity while it pushed a grain with force. */
void oz_ledger_push(OzWork *work, OzVec3 force, OzVec3 velocity, double dt);
