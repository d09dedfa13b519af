/* Which elements are near each other while they move: a list of pairs that reaches a skin beyond
 * their circles, made anew only when an element has used up its half of the skin. On the host. */
#pragma once

#include "model/elements.h"

typedef struct OzElementPair {
    int a, b; /* elements of different bodies, a < b; a is of a grain */
} OzElementPair;

/* Zeroed is valid: nothing listed yet. Owns its arrays. */
typedef struct OzElementPairs {
    int64_t count, capacity;
    OzElementPair *pair; /* by a, then b                        */
    double skin;         /* m                                   */
    double *position;    /* 2 x, when the list was made; or NULL */
} OzElementPairs;

/* Makes the list hold for elements at position (2 x count). The caller frees with
 * oz_element_pairs_free. */
OzStatus oz_element_pairs_renew(OzElementPairs *pairs, const OzElements *elements,
                                const double *position);

void oz_element_pairs_free(OzElementPairs *pairs);
