/* Large scenes: a step is a few kernels over all regions, many steps are queued without waiting,
 * and the lists are made anew when the device says so. */
#pragma once

#include "sim/arrays.h"
#include "sim/model.h"

#include <stdbool.h>

typedef struct OzLarge OzLarge;

/* Takes the phases of a program (kernels/advance.h); both are borrowed. */
OzStatus oz_large_create(OzLarge **large, cl_program program, const OzDevice *device);
void oz_large_free(OzLarge *large); /* NULL is fine */

/* Makes steps control->step ... steps of the launch and leaves lists that hold; ends earlier when a
 * guard speaks, a list is full or the host must make one. *control is the state before and after.
 */
OzStatus oz_large_steps(OzLarge *large, OzArrays *arrays, OzControlHead *control, int steps);

/* Springs of pairs to the saved lists; all lists are then made anew. */
OzStatus oz_large_save_springs(OzLarge *large, OzArrays *arrays, OzControlHead *control);

/* The inner lists anew, and first the outer ones and the order of grains if asked, whether they
 * hold or not: for timing. The lists must have been made once. */
OzStatus oz_large_renew(OzLarge *large, OzArrays *arrays, OzControlHead *control, bool outer);
