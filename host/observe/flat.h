/* The values of flat grains' columns, for THE list in observe/observables.c: each as OzColumn asks.
 * Where one serves several columns, the index of the observation tells them apart. */
#pragma once

#include "observe/column.h"

bool oz_flat_speed_mean(const OzObservation *observation, double *value);
bool oz_flat_spin_mean(const OzObservation *observation, double *value);

/* Spin of the grain with this index; none when there are fewer. */
bool oz_flat_spin(const OzObservation *observation, double *value);

bool oz_flat_wall_touches(const OzObservation *observation, double *value);

/* index: OzContactKind. The share is among contacts of triangles. */
bool oz_flat_touches(const OzObservation *observation, double *value);
bool oz_flat_touch_share(const OzObservation *observation, double *value);

bool oz_flat_overlap_max(const OzObservation *observation, double *value);
bool oz_flat_overlap_mean(const OzObservation *observation, double *value);

/* index: 0 stretch_min, 1 stretch_max, 2 bend_max in degrees. None without beams. */
bool oz_flat_beams(const OzObservation *observation, double *value);

/* index: 0 grains, 1 broken beams, 2 energy lost by them, 3 by yielding ones. */
bool oz_flat_breakage(const OzObservation *observation, double *value);

/* index: 0 in contacts, 1 in beams. */
bool oz_flat_stored(const OzObservation *observation, double *value);

/* index: 0 count, 1 mass, 2 rate. */
bool oz_flat_outflow(const OzObservation *observation, double *value);

/* index: 0 surface, 1 centre, 2 mean, 3 deviation, 4 avalanches, 5 the size of the last. */
bool oz_flat_inclination(const OzObservation *observation, double *value);
