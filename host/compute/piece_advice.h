/* What a person is told to change after a guard stopped trigrains: the step where it is to blame,
 * else beams or contacts that are too soft, and by how much. */
#pragma once

#include "observe/snapshot.h"

typedef enum OzPieceSoft {
    OZ_PIECE_SOFT_BENDING,
    OZ_PIECE_SOFT_STRETCH,
    OZ_PIECE_SOFT_CONTACT
} OzPieceSoft;

/* Writes one clause about a piece that was too soft. A step that is unstable for the scene is named
 * with the one that is stable. Otherwise hits at the fastest grain's speed, or at that of the fall
 * to be expected, are taken: beams by a trial (compute/trial.h); a triangle that lands flat, with
 * the mass of its grain, shall go no deeper than a tenth of its height, a disc than half its
 * radius.
 */
void oz_piece_advice_write(char *text, size_t size, const OzSnapshot *now, int64_t piece,
                           OzPieceSoft soft);
