/* What rods' guards say. */
#pragma once

#include "sim/model.h"

/* For the model's row (sim/model.h). */
enum { OZ_RODS_GUARD_STOPS = 5 };
extern const OzStop oz_rods_guard_stops[OZ_RODS_GUARD_STOPS];
int oz_rods_guard_grain(const OzGrains *grains, int index);
void oz_rods_guard_advise(char *text, size_t size, const OzControlHead *control,
                          const OzSnapshot *now);
