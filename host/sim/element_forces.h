/* All forces between elements at one state, in double on the host: contacts of triangles and discs
 * with grains and walls, beams, gravity. Serves the reference simulation, and the contacts and
 * beams of snapshots wherever they come from. */
#pragma once

#include "model/snapshot.h"
#include "sim/element_bear_types.h"
#include "sim/element_pairs.h"

/* All elements, walls' included; borrowed arrays as in OzElements. */
typedef struct OzElementState {
    const double *position, *angle, *velocity, *angular_velocity;
    double time;  /* s: tells which walls are still there */
    bool at_rest; /* settling: all are                    */
} OzElementState;

/* What must not be in a state, and the first element in which it is. */
typedef enum OzElementFault {
    OZ_ELEMENT_SOUND,
    OZ_ELEMENT_NAN,       /* a force is no number                                            */
    OZ_ELEMENT_SWALLOWED, /* a triangle is inside another, and feels nothing                 */
    OZ_ELEMENT_DEEP,      /* more than half a triangle, or a disc's centre, is inside another */
    OZ_ELEMENT_STRETCHED, /* a beam's length left OZ_BEAM_STRETCH_LEAST..MOST of that at rest */
    OZ_ELEMENT_FAST,      /* an element moves more than half its reach in a step                */
    OZ_ELEMENT_BENT       /* a beam's end turned by more than OZ_BEAM_BEND_MOST              */
} OzElementFault;

typedef struct OzElementForces {
    const OzScene *scene;       /* borrowed */
    const OzElements *elements; /* borrowed, or those of pieces */
    OzGrains *pieces;           /* owned, or NULL: what is left of grains (sim/element_part.h) */
    OzElementBear bear;
    OzDiscLaw disc;       /* between grains                                   */
    OzDiscLaw *disc_wall; /* wall_count                                       */
    OzElementPairs pairs;
    double *turned;        /* 6 x count: m, corners about the centre of mass   */
    double *force;         /* 2 x free_count: N, of the last evaluation        */
    double *torque;        /* free_count: N m                                  */
    OzContactList *list;   /* borrowed: receives the contacts of each evaluation; NULL: none */
    OzBeamSums beams;      /* of the last evaluation                           */
    OzElementLedger power; /* W: how fast each entry of the ledger grows       */
    int64_t deep_count;    /* of the last evaluation: contacts beyond guards.overlap.warn */
    OzElementFault fault;  /* the first found                                  */
    int fault_a, fault_b;  /* its elements; a beam's ends                        */
} OzElementForces;

/* Frees with oz_element_forces_free (zeroed is fine). grains must have elements. */
OzStatus oz_element_forces_create(OzElementForces *forces, const OzScene *scene,
                                  const OzGrains *grains);
void oz_element_forces_free(OzElementForces *forces);

/* What acts on a state: contacts, beams and gravity. */
OzStatus oz_element_forces_evaluate(OzElementForces *forces, const OzElementState *state);

/* Contacts alone, or beams and gravity alone: for steps that part them. */
OzStatus oz_element_forces_touch(OzElementForces *forces, const OzElementState *state);
OzStatus oz_element_forces_hold(OzElementForces *forces, const OzElementState *state);

/* Notes a fault of elements that are too fast for this step (s). */
void oz_element_forces_watch(OzElementForces *forces, const OzElementState *state, double step);

/* Fails with OZ_ERR_BLOWUP when the last evaluation found a fault, naming it, the grains, step and
 * time. */
OzStatus oz_element_forces_check(const OzElementForces *forces, int64_t step, double time);

/* Fills the snapshot's contacts and beams from its state, and has_contacts. */
OzStatus oz_element_forces_contacts(OzSnapshot *snapshot);
