/* All forces between pieces at one state, in double on the host: contacts of triangles and discs
 * with grains and walls, beams, gravity. Serves the reference simulation, and the sums and energies
 * of snapshots wherever they come from. */
#ifndef OZ_COMPUTE_PIECE_FORCES_H
#define OZ_COMPUTE_PIECE_FORCES_H

#include "compute/piece_laws.h"
#include "compute/piece_pairs.h"
#include "observe/snapshot.h"

/* All pieces, walls' included; borrowed arrays as in OzPieces. */
typedef struct OzPieceState {
    const double *position, *angle, *velocity, *spin;
    double time;  /* s: tells which walls are still there */
    bool at_rest; /* settling: all are                    */
} OzPieceState;

/* What must not be in a state, and the first piece in which it is. */
typedef enum OzPieceFault {
    OZ_PIECE_SOUND,
    OZ_PIECE_NAN,       /* a force is no number                                            */
    OZ_PIECE_SWALLOWED, /* a triangle is inside another, and feels nothing                 */
    OZ_PIECE_DEEP,      /* more than half a triangle, or a disc's centre, is inside another */
    OZ_PIECE_STRETCHED, /* a beam's length left OZ_BEAM_STRETCH_LEAST..MOST of that at rest */
    OZ_PIECE_FAST,      /* a piece moves more than half its reach in a step                */
    OZ_PIECE_BENT       /* a beam's end turned by more than OZ_BEAM_BEND_MOST              */
} OzPieceFault;

typedef struct OzPieceForces {
    const OzScene *scene;   /* borrowed */
    const OzPieces *pieces; /* borrowed */
    OzBeamConstants beam;
    OzDiscLaw disc;       /* between grains                                   */
    OzDiscLaw *disc_wall; /* wall_count                                       */
    OzPiecePairs pairs;
    double *turned;       /* 6 x count: m, corners about the centre of mass   */
    int64_t *met;         /* bodies: the last one that each was seen touching */
    double *force;        /* 2 x free_count: N, of the last evaluation        */
    double *torque;       /* free_count: N m                                  */
    OzPieceSums sums;     /* of the last evaluation                           */
    OzPieceLedger power;  /* W: how fast each entry of the ledger grows       */
    int64_t deep_count;   /* of the last evaluation: contacts beyond guards.overlap.warn */
    OzPieceFault fault;   /* the first found                                  */
    int fault_a, fault_b; /* its pieces; a beam's ends                        */
} OzPieceForces;

/* Frees with oz_piece_forces_free (zeroed is fine). grains must have pieces. */
OzStatus oz_piece_forces_create(OzPieceForces *forces, const OzScene *scene,
                                const OzGrains *grains);
void oz_piece_forces_free(OzPieceForces *forces);

/* What acts on a state: contacts, beams and gravity. */
OzStatus oz_piece_forces_evaluate(OzPieceForces *forces, const OzPieceState *state);

/* Contacts alone, or beams and gravity alone: for steps that part them. */
OzStatus oz_piece_forces_touch(OzPieceForces *forces, const OzPieceState *state);
OzStatus oz_piece_forces_hold(OzPieceForces *forces, const OzPieceState *state);

/* Notes a fault of pieces that are too fast for this step (s). */
void oz_piece_forces_watch(OzPieceForces *forces, const OzPieceState *state, double step);

/* Fails with OZ_ERR_BLOWUP when the last evaluation found a fault, naming it, the grains, step and
 * time. */
OzStatus oz_piece_forces_check(const OzPieceForces *forces, int64_t step, double time);

/* Fills snapshot->pieces from the snapshot's state, and has_contacts. */
OzStatus oz_piece_forces_sums(OzSnapshot *snapshot);

#endif
