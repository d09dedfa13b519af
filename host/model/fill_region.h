/* The room in which a scene's grains are placed at random: what its walls leave free, cut off where
 * no wall does so. A box along the axes, inside the cylinder when there is one. */
#pragma once

#include "base/random.h"
#include "model/overlap_grid.h"
#include "scene/scene.h"

#include <stdbool.h>

typedef struct OzFillRegion {
    const OzScene *scene;               /* borrowed, for its walls                               */
    double low[3], high[3];             /* m                                                     */
    bool walled_low[3], walled_high[3]; /* that side is a plane or the cylinder        */
    bool periodic[3]; /* what sticks out of one side comes in on the other                       */
    double radius;    /* m, of the narrowest cylinder; INFINITY without        */
    int vessels; /* cones and open tubes with grains inside, each of which begins where another ends
                  */
    double vessels_low[3], vessels_high[3]; /* m: what they reach                                */
    double open_above; /* m: from here on other walls are the room's sides; INFINITY: none are    */
} OzFillRegion;

/* Planes across an axis and cylinders bound the column, and so do level rectangles and discs that
 * are as wide as it is. Cones and open tubes with grains inside are its room, all together, and
 * what is above them where other walls enclose that. Directions without a wall on both sides are
 * made as long as the wanted volume (m^3) needs, alike for all of them, and never shorter than
 * extent (m): on from the wall when there is one, from z = 0 upwards inside a cylinder without a
 * floor, else about the origin. With walls all round volume has no effect. */
OzFillRegion oz_fill_region_make(const OzScene *scene, double volume, double extent);

/* Makes the column a tenth larger by moving its free sides; false when every side is a wall. */
bool oz_fill_region_raise(OzFillRegion *fill_region);

/* True when a capsule so turned fits somewhere into the empty column (slanted planes aside). */
bool oz_fill_region_admits(const OzFillRegion *fill_region, const OzCapsule *capsule);

/* Draws a centre for the capsule; it may still cross the cylinder or a slanted plane. */
void oz_fill_region_draw(const OzFillRegion *fill_region, OzRandom *random, OzCapsule *capsule);

/* True when the capsule crosses no wall. */
bool oz_fill_region_holds(const OzFillRegion *fill_region, const OzCapsule *capsule);
