/* Which grains are near each other while they move: a pair list that reaches a skin beyond contact,
 * made anew only when a grain has used up its half of the skin, and that keeps what each
 * pair remembers when it is. On the host, for the reference simulation. */
#pragma once

#include "sim/physics.h"
#include "sim/sort_axis.h"

/* Zeroed is valid: nothing listed yet. Owns its arrays. */
typedef struct OzPairList {
    double skin;             /* m                                                       */
    OzPairs pairs;           /* sorted by a, then b                                     */
    OzMemory *memory;        /* of each pair; zero for a pair that was not listed       */
    double *position, *axis; /* 3 x count each, when the list was made          */
    double strain;           /* of a sheared cell, then                         */
} OzPairList;

/* Makes the list hold for grains at position with axes (3 x count each) in a cell as it stands now.
 * *renewed tells whether
 * pairs are other ones than before. The caller frees with oz_pair_list_free. */
OzStatus oz_pair_list_renew(OzPairList *near, bool *renewed, const OzGrains *grains,
                            const double *position, const double *axis, const OzBoundary *boundary);

void oz_pair_list_free(OzPairList *near);
