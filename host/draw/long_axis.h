/* The direction in which a flat grain is longest. */
#pragma once

#include "model/snapshot.h"

/* rad, from 0 to pi counter-clockwise from x: the principal axis of the grain's area as it lies
 * now, about which its second moment is least. *strength receives how far that axis stands out,
 * (a^2 - b^2) / (a^2 + b^2) of an ellipse of the same moments: 0 of discs, squares and regular
 * polygons, 0.6 of a grain twice as long as wide. */
double oz_long_axis_find(const OzSnapshot *snapshot, int64_t grain, double *strength);
