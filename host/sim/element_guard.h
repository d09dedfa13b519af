/* What trigrains' guards say. */
#pragma once

#include "sim/model.h"

/* For the model's row (sim/model.h). */
enum { OZ_ELEMENT_GUARD_STOPS = 7 };
extern const OzStop oz_element_guard_stops[OZ_ELEMENT_GUARD_STOPS];
int oz_element_guard_grain(const OzGrains *grains, int slot);
void oz_element_guard_advise(char *text, size_t size, const OzControlHead *control,
                             const OzSnapshot *now);
