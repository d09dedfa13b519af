/* What two pieces of trigrains do to each other at the start of a run, one pair at a time. For .c
 * files of compute/ that look at starts (start.h, part.h). */
#pragma once

#include "compute/piece_laws.h"
#include "model/grains.h"

#include <stdbool.h>

typedef struct OzPieceMeeting {
    double force, energy; /* N, J                                                             */
    double depth;         /* m: of triangles twice their energy over their force, how far two
                             flat edges have gone into each other; of a corner two thirds     */
    double push[2];       /* the direction of the force on b; zeroes where there is none      */
    bool broken;          /* beyond what contacts can tell                                    */
} OzPieceMeeting;

/* Of pieces a and b where grains->pieces has them; zeroes where they do not touch. */
OzPieceMeeting oz_piece_meet_pair(const OzScene *scene, const OzGrains *grains, int a, int b);

/* The corners of a wall's or grain's piece in the world (x y each). */
void oz_piece_meet_corners(const OzPieces *pieces, int i, double corners[6]);
