/* Energy that a launch's steps add up, by mechanism: in lanes while a step runs, then into the
 * member's ledger. OpenCL C only. */
#pragma once

#include "kernels/element_work.h"

/* Power, W, of one step. */
typedef struct OzElementSums {
    real word[OZ_ELEMENT_LEDGER];
} OzElementSums;

OZ_INLINE void oz_element_sums_clear(OzElementSums *sums)
{
    for (int k = 0; k < OZ_ELEMENT_LEDGER; k++) {
        sums->word[k] = REAL(0.0);
    }
}

#if OZ_LEDGER
/* One word over all lanes. */
OZ_INLINE double oz_element_sums_of(const OzElementSums *sums, int word)
{
    scalar lane[OZ_LANES];
    double sum = 0;
    OZ_LANES_STORE(sums->word[word], lane);
    for (int l = 0; l < OZ_LANES; l++) {
        sum += lane[l];
    }
    return sum;
}

/* Adds a step's work to the work-item's own row: the mean of the powers at its ends. */
OZ_INLINE void oz_element_sums_add(OzWork *w, const OzElementSums *sums)
{
    global double *row = w->ledger + w->item * OZ_ELEMENT_LEDGER_WORDS,
                  *last = row + OZ_ELEMENT_LEDGER;
    for (int k = 0; w->item < w->z.regions && k < OZ_ELEMENT_LEDGER; k++) {
        double sum = oz_element_sums_of(sums, k);
        row[k] += 0.5 * w->parameters->dt * (last[k] + sum);
        last[k] = sum;
    }
}

/* Adds the work of a part of a step, at the power of its end. */
OZ_INLINE void oz_element_sums_add_part(OzWork *w, const OzElementSums *sums, scalar part)
{
    global double *row = w->ledger + w->item * OZ_ELEMENT_LEDGER_WORDS;
    for (int k = 0; k < OZ_ELEMENT_LEDGER; k++) {
        row[k] += oz_element_sums_of(sums, k) * w->parameters->dt * part;
    }
}
#endif
