/* What two elements of trigrains do to each other at the start of a run, one pair at a time. For .c
 * files of compute/ that look at starts (start.h, part.h). */
#pragma once

#include "model/grains.h"
#include "sim/element_laws.h"

#include <stdbool.h>

typedef struct OzElementMeeting {
    double force, energy; /* N, J                                                             */
    double depth;         /* m: of triangles twice their energy over their force, how far two
                             flat edges have gone into each other; of a corner two thirds     */
    double push[2];       /* the direction of the force on b; zeroes where there is none      */
    bool broken;          /* beyond what contacts can tell                                    */
} OzElementMeeting;

/* Of elements a and b where grains->elements has them; zeroes where they do not touch. */
OzElementMeeting oz_element_meet_pair(const OzScene *scene, const OzGrains *grains, int a, int b);

/* The corners of a wall's or grain's element in the world (x y each). */
void oz_element_meet_corners(const OzElements *elements, int i, double corners[6]);
