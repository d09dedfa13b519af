/* A line about numbers that lie between two. */
#pragma once

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "scene/scene_types.h"

/* `name low ... high unit`, or one number where both are written alike. */
void oz_inspect_range_print(FILE *file, const char *name, double low, double high,
                            const char *unit);

/* The same of count values; nothing is printed without any. radius: NULL, or one a value, of which
 * those above 0 are left out (discs, where triangles are meant). */
void oz_inspect_range_print_all(FILE *file, const char *name, const double *values,
                                const double *radius, int64_t count, const char *unit);

/* The size of a periodic cell and, where it is periodic in x, y and z, what share of it the grains'
 * volume (m^3) is; when a sheared one is sheared by 1. */
void oz_inspect_range_print_cell(FILE *file, const OzScene *scene, double volume);

/* `x low ... high m` and the same of y and, unless flat, of z: of count places of three numbers. */
void oz_inspect_range_print_places(FILE *file, const double *places, int64_t count, bool is_flat);
