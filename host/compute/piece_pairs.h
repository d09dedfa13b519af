/* Which pieces are near each other while they move: a list of pairs that reaches a skin beyond
 * their circles, made anew only when a piece has used up its half of the skin. On the host. */
#pragma once

#include "model/pieces.h"

typedef struct OzPiecePair {
    int a, b; /* pieces of different bodies, a < b; a is of a grain */
} OzPiecePair;

/* Zeroed is valid: nothing listed yet. Owns its arrays. */
typedef struct OzPiecePairs {
    int64_t count, capacity;
    OzPiecePair *pair; /* by a, then b                        */
    double skin;       /* m                                   */
    double *position;  /* 2 x, when the list was made; or NULL */
} OzPiecePairs;

/* Makes the list hold for pieces at position (2 x count). The caller frees with
 * oz_piece_pairs_free. */
OzStatus oz_piece_pairs_renew(OzPiecePairs *pairs, const OzPieces *pieces, const double *position);

void oz_piece_pairs_free(OzPiecePairs *pairs);
