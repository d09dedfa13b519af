/* Energy that a launch's steps add up, by mechanism: in lanes while a step runs, then into the member's ledger.
 * OpenCL C only. */
#ifndef OZ_KERNELS_PIECE_SUMS_H
#define OZ_KERNELS_PIECE_SUMS_H

#include "kernels/piece_work.h"

/* Power, W, of one step. */
typedef struct OzPieceSums {
    real word[OZ_PIECE_LEDGER];
} OzPieceSums;

OZ_INLINE void oz_piece_sums_clear(OzPieceSums *sums)
{
    for (int k = 0; k < OZ_PIECE_LEDGER; k++) {
        sums->word[k] = REAL(0.0);
    }
}

#if OZ_LEDGER
/* Adds a step's work to the work-item's own row: the mean of the powers at its ends. */
OZ_INLINE void oz_piece_sums_add(OzPieceWork *w, const OzPieceSums *sums)
{
    global double *row = w->ledger + w->item * OZ_PIECE_LEDGER_WORDS, *last = row + OZ_PIECE_LEDGER;
    for (int k = 0; k < OZ_PIECE_LEDGER; k++) {
        scalar lane[OZ_LANES];
        double sum = 0;
        OZ_LANES_STORE(sums->word[k], lane);
        for (int l = 0; l < OZ_LANES; l++) {
            sum += lane[l];
        }
        row[k] += 0.5 * w->parameters->dt * (last[k] + sum);
        last[k] = sum;
    }
}
#endif

#endif
