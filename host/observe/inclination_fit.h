/* A bed's inclination against the speed of its drum, over the values of a sweep: a constant and a
 * power of the speed (Poeschel and Buchholtz 1995 fit a square to it, their Fig. 18). */
#pragma once

#include "base/status.h"

#include <stdbool.h>

/* Zeroed is valid: no point yet. */
typedef struct OzInclinationFit {
    double *speed, *inclination; /* rad/s without sign, degrees */
    int count, capacity;
} OzInclinationFit;

/* Whether what is swept (keys, with commas between) is the speed at which a wall turns, and no
 * more. */
bool oz_inclination_fit_applies(const char *key);

/* Adds a point: rad/s (its sign is dropped) and degrees. */
OzStatus oz_inclination_fit_add(OzInclinationFit *fit, double speed, double inclination);

/* Says Theta_c, b and p of Theta_c + b speed^p in one line of the log and writes them to
 * folder/inclination_fit.csv; with too few speeds the line says so and nothing is written. Silent
 * without any point. */
OzStatus oz_inclination_fit_write(const OzInclinationFit *fit, const char *folder);

/* Frees what fit owns and zeroes it. */
void oz_inclination_fit_free(OzInclinationFit *fit);
