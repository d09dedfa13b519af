/* Differences of places, in a space that may repeat itself along some axes (a periodic cell,
 * centred on the origin): the nearest image counts. Places in it are kept within half a cell of the
 * origin. Switch OZ_PERIODIC: a bit for each axis along which space repeats itself. */
#pragma once

#include "kernels/vec3.h"

typedef struct OzSpace {
    scalar unit;              /* m per count of a place                                     */
    scalar period[3];         /* counts after which space repeats itself, where it does ... */
    scalar period_rest[3];    /* ... but for these; in single precision both are whole      */
    scalar inverse_period[3]; /* the inverse of their sum                                   */
} OzSpace;

/* How many cells a coordinate, or a difference of two, lies away from the origin's. */
OZ_INLINE real oz_space_cells(fixed_position counts, OzSpace space, int axis)
{
    return rint(oz_fixed_position_to_real(counts) * REAL(space.inverse_period[axis]));
}

/* A coordinate, or a difference of two, brought to within half a cell. */
OZ_INLINE fixed_position oz_space_nearest(fixed_position counts, OzSpace space, int axis)
{
    if (!(OZ_PERIODIC >> axis & 1)) {
        return counts;
    }
    real cells = oz_space_cells(counts, space, axis);
    return counts - oz_fixed_position_from_real(cells * REAL(space.period[axis])) -
           oz_fixed_position_from_real(cells * REAL(space.period_rest[axis]));
}

/* a - b in metres. */
OZ_INLINE OzVec3 oz_space_minus(OzFixedPosition a, OzFixedPosition b, OzSpace space)
{
    return oz_vec3(oz_fixed_position_to_real(oz_space_nearest(a.x - b.x, space, 0)) * space.unit,
                   oz_fixed_position_to_real(oz_space_nearest(a.y - b.y, space, 1)) * space.unit,
                   oz_fixed_position_to_real(oz_space_nearest(a.z - b.z, space, 2)) * space.unit);
}
