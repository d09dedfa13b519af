/* How steep the bed in a drum lies. Angles in rad against the horizontal (across gravity), positive
 * when the surface rises to where the drum's turning carries the grains (to the right for a drum at
 * rest or turning counter-clockwise). */
#pragma once

#include "model/snapshot.h"

/* Whether there is a drum, flat grains and gravity: without, the others give false. */
bool oz_inclination_applies(const OzScene *scene);

/* Slope of a straight line fitted (least squares) to the surface over the middle half of the drum's
 * width, where it is straightest: the surface is the upper envelope of the grains' bounding
 * circles, taken at OZ_INCLINATION_COLUMNS places. False when less than half of them are covered.
 */
enum { OZ_INCLINATION_COLUMNS = 64 };
bool oz_inclination_surface(const OzSnapshot *snapshot, double *angle);

/* Direction from the drum's axis to the grains' centre of mass, against the vertical: exactly the
 * inclination of an even bed with a straight surface, and far less noisy, since every grain counts.
 * False for grains about the axis itself. */
bool oz_inclination_centre(const OzSnapshot *snapshot, double *angle);
