/* What trigrains' guards say. */
#pragma once

#include "compute/model.h"

/* For the model's row (compute/model.h). */
enum { OZ_PIECE_GUARD_STOPS = 7 };
extern const OzStop oz_piece_guard_stops[OZ_PIECE_GUARD_STOPS];
int oz_piece_guard_grain(const OzGrains *grains, int slot);
void oz_piece_guard_advise(char *text, size_t size, const OzControlHead *control,
                           const OzSnapshot *now);
