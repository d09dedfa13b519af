/* Pieces between the host's arrays by id and the device's words by slot and lane. */
#ifndef OZ_COMPUTE_PIECE_PACK_H
#define OZ_COMPUTE_PIECE_PACK_H

#include "compute/piece_fields.h"
#include "observe/snapshot.h"

/* Derivatives of the free pieces' coordinates at the start: acceleration, third and fourth, each
 * 3 x free_count (x, y, angle). */
typedef struct OzPieceStart {
    double *acceleration, *third, *fourth;
    double *touch;       /* 3 x free_count: N, N, N m of contacts, where beams go in substeps; the
                            acceleration is then that of beams and gravity alone                */
    OzPieceLedger power; /* W: how fast each entry of the ledger grows */
} OzPieceStart;

/* Writes what never changes: shapes, bodies, beams; and the start. Counts in the parameters' units.
 */
OzStatus oz_piece_pack_start(OzArrays *arrays, int member, const OzPieceParameters *parameters,
                             const OzGrains *grains, const OzPieceStart *start);

/* An empty ledger whose entries grow at these rates, W. */
OzStatus oz_piece_pack_ledger(OzArrays *arrays, int member, const OzUnits *units,
                              const OzPieceLedger *power);

OzStatus oz_piece_pack_parameters(OzArrays *arrays, int member,
                                  const OzPieceParameters *parameters);

/* Writes the body of every slot; -1 where there is no piece and for those of walls that are not
 * present (a bit of present for each wall), which are in no list then. */
OzStatus oz_piece_pack_bodies(OzArrays *arrays, int member, const OzGrains *grains,
                              unsigned present);

/* Reads the free pieces' state into snapshot. */
OzStatus oz_piece_pack_state(const OzArrays *arrays, int member,
                             const OzPieceParameters *parameters, OzSnapshot *snapshot);

#endif
