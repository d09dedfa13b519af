/* A guard against energy from nowhere: what grains and springs hold may shrink, and grow by what
 * walls put in, by nothing else. Sees the rows that are written anyway, so it costs one sum over
 * the grains a row. */
#ifndef OZ_OBSERVE_SURPLUS_H
#define OZ_OBSERVE_SURPLUS_H

#include "observe/snapshot.h"

/* Zeroed is valid: nothing seen yet. */
typedef struct OzSurplus {
    bool has_start;
    double start; /* J, mechanical energy at first sight, work of the walls subtracted */
    double scale; /* J, the gain that is too much                                      */
} OzSurplus;

/* Fails with OZ_ERR_BLOWUP, naming step and time, when the mechanical energy has grown by more than
 * the grains and springs held at first sight, m g d of every grain, and what rounding may hold in
 * contacts and beams: integrators that gain a little are left alone, a bed that heats up is not,
 * nor one whose energy is no number. What friction gives back with `slip: scale`, the law's doing
 * and not the step's, is left out. Silent for snapshots without contacts (their springs are
 * unknown), and without a ledger where walls move or with `slip: scale`. */
OzStatus oz_surplus_check(OzSurplus *surplus, const OzSnapshot *snapshot);

#endif
