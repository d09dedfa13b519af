/* What strength makes of beams and grains on the device: which beams have broken, which triangles
 * are still one grain, and what contacts that began where a grain broke are to forget. Nothing
 * where the scene's beams hold. */
#pragma once

#include "model/wear.h"
#include "sim/element_fields.h"

/* Writes that nothing is broken. */
OzStatus oz_element_wear_start(OzArrays *arrays, int member, const OzElements *elements);

/* Reads what has become of the beams into wear made for the member's grains. */
OzStatus oz_element_wear_read(const OzArrays *arrays, int member, const OzUnits *units,
                              OzWear *wear);

/* Writes it all but shapes at rest, which kernels alone change. */
OzStatus oz_element_wear_write(OzArrays *arrays, int member, const OzUnits *units,
                               const OzWear *wear);

/* The body of each free element, alike for those of one piece; the caller frees, after a failure
 * too.
 */
OzStatus oz_element_wear_bodies(const OzArrays *arrays, int member, const OzElements *elements,
                                int **body);
