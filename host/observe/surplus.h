/* A guard against energy from nowhere: what grains and springs hold may shrink, and grow by what
 * walls put in, by nothing else. Sees the rows that are written anyway, so it costs one sum over
 * the grains a row. */
#pragma once

#include "base/state.h"
#include "model/snapshot.h"

/* Zeroed is valid: nothing seen yet. */
typedef struct OzSurplus {
    bool has_start;
    double start; /* J, mechanical energy at first sight, work of the walls subtracted */
    double scale; /* J, the gain that is too much                                      */
} OzSurplus;

/* Fails with OZ_ERR_BLOWUP, naming step and time, when the mechanical energy is no number or has
 * grown too much. Too much is more than the sum of what grains and springs held at first sight, m g
 * d of every grain, and what rounding may hold in contacts and beams: an integrator that gains a
 * little is left alone, a bed that heats up is not. What friction gives back with `slip: scale` is
 * not counted: it is the law's doing and not the step's. Nothing is judged in snapshots without
 * contacts (their springs are unknown), nor without a ledger where walls move or with `slip:
 * scale`. */
OzStatus oz_surplus_check(OzSurplus *surplus, const OzSnapshot *snapshot);

/* Saves or loads it (base/state.h). */
OzStatus oz_surplus_state(OzSurplus *surplus, OzStateVisit *visit);
