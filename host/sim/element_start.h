/* How trigrains start: the part of sim/start.h that knows triangles. */
#pragma once

#include "sim/start_overlap.h"

/* Adds what there is to say of the start. The depth of two triangles is twice their contact's
 * energy over its force: how far two flat edges have gone into each other; of a corner it is two
 * thirds of that. Two grains are counted once,
 * however many of their elements overlap. */
OzStatus oz_element_start_look(OzStart *start, const OzScene *scene, const OzGrains *grains);

/* The radius of the circle of a grain's area, m. */
double oz_element_start_radius(const OzGrains *grains, int grain);
