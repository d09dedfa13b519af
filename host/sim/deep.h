/* Deep contacts (scene key guards.overlap.warn): counted member by member, and the first one said
 * in the log. */
#pragma once

#include "sim/batch.h"

/* What one launch met. */
typedef struct OzDeepFound {
    int64_t count; /* deep contacts, each counted once a step; 0: none, and the rest is unset   */
    int64_t step;  /* that the first one was met in, counted from 1 as a member's steps are     */
    double time;   /* s, of that step                                                           */
    int grain;     /* the lowest id in that step, a pair's first grain                          */
    double depth;  /* the greatest in that step: over the smaller radius; trigrains: a share    */
    bool at_wall;  /* rods: it was at a wall                                                    */
} OzDeepFound;

/* Adds to the member's count; a line in the log when it is the first since time 0. */
void oz_deep_note(OzBatch *batch, int member, const OzDeepFound *found);

/* That line, for a simulation without a batch. */
void oz_deep_say(const OzScene *scene, const OzDeepFound *found, bool settling);
