/* What grains that can break are now: triangles that beams still join, directly or by others, are a
 * grain. Its first piece, that with a grain's first triangle, keeps the grain's number; the others
 * follow after all grains in the order of their first triangles. */
#pragma once

#include "model/grains.h"
#include "model/wear.h"

/* The body of each free element (elements->free_count of them) when these beams (model/wear.h) hold
 * and the others do not; *count receives the number of pieces. */
OzStatus oz_pieces_find(int *body, int64_t *count, const OzElements *elements, const double *whole);

/* The pieces as grains, whose elements have their own bodies, members and outlines; of the rest
 * they borrow the grains as they were made. Diameter and inertia are those of the elements'
 * positions (2 x free elements) now, and a piece's start is zero. The caller frees; *pieces is NULL
 * on failure.
 */
OzStatus oz_pieces_make(OzGrains **pieces, const OzGrains *grains, const double *whole,
                        const double *position);
void oz_pieces_free(OzGrains *pieces); /* NULL is fine */
