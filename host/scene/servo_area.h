/* The area that a servo wall closes: what its pressure is over. */
#pragma once

#include "scene/scene_types.h"

/* Two sides, m, whose product is the area; of a round one any that give it. bound: the scene's
 * walls at both ends of each, of which servos make it less as they go; -1: none is there. */
typedef struct OzServoArea {
    double side[2];
    int bound[2][2];
} OzServoArea;

/* A rectangle's and a disc's own. A plane's: across the narrowest cylinder along its normal, else
 * between the nearest walls that face each other across it along two directions at right angles,
 * planes or a box's sides, or from one border of a periodic cell to the other. As built. Returns
 * false where it closes none. */
bool oz_servo_area_find(OzServoArea *area, const OzScene *scene, int wall);

/* The same now, m^2, when the scene's walls have gone by these offsets. */
double oz_servo_area_now(const OzServoArea *area, const OzScene *scene, const double *offsets);
