/* Differences of places, in a space that may repeat itself along some axes (a periodic cell,
 * centred on the origin): the nearest image counts. Places in it are kept within half a cell of the
 * origin. Switches: OZ_PERIODIC: a bit for each axis along which space repeats itself; OZ_SHEAR:
 * the cell is sheared, and places are those of its lattice (shear.h). */
#pragma once

#include "kernels/vec3.h"

/* The host knows at run time. */
#if defined(OZ_HOST)
#define OZ_SPACE_TILTS 1
#else
#define OZ_SPACE_TILTS OZ_SHEAR
#endif

typedef struct OzSpace {
    scalar unit;              /* m per count of a place                                     */
    scalar period[3];         /* counts after which space repeats itself, where it does ... */
    scalar period_rest[3];    /* ... but for these; in single precision both are whole      */
    scalar inverse_period[3]; /* the inverse of their sum                                   */
#if OZ_SPACE_TILTS
    scalar tilt, tilt_rest; /* of a sheared cell: x = x' + tilt y, in two numbers */
    scalar rate;            /* 1/s, d(tilt)/dt                                    */
#endif
} OzSpace;

/* How many cells a coordinate, or a difference of two, lies away from the origin's. */
OZ_INLINE real oz_space_cells(fixed_position counts, OzSpace space, int axis)
{
    return rint(oz_fixed_position_to_real(counts) * REAL(space.inverse_period[axis]));
}

/* So many cells less. */
OZ_INLINE fixed_position oz_space_back(fixed_position counts, real cells, OzSpace space, int axis)
{
    return counts - oz_fixed_position_from_real(cells * REAL(space.period[axis])) -
           oz_fixed_position_from_real(cells * REAL(space.period_rest[axis]));
}

/* A coordinate, or a difference of two, brought to within half a cell. */
OZ_INLINE fixed_position oz_space_nearest(fixed_position counts, OzSpace space, int axis)
{
    if (!(OZ_PERIODIC >> axis & 1)) {
        return counts;
    }
    return oz_space_back(counts, oz_space_cells(counts, space, axis), space, axis);
}

#if OZ_SPACE_TILTS
/* A difference along x of the lattice, y away along y, such that the true one is within half a
 * cell. */
OZ_INLINE fixed_position oz_space_nearest_tilted(fixed_position counts, fixed_position y,
                                                 OzSpace space)
{
    real x = oz_fixed_position_to_real(counts) + space.tilt * oz_fixed_position_to_real(y);
    return oz_space_back(counts, rint(x * REAL(space.inverse_period[0])), space, 0);
}
#endif

/* a - b in metres. */
OZ_INLINE OzVec3 oz_space_minus(OzFixedPosition a, OzFixedPosition b, OzSpace space)
{
#if OZ_SPACE_TILTS
    if (OZ_SHEAR) {
        fixed_position y = oz_space_nearest(a.y - b.y, space, 1);
        fixed_position x = oz_space_nearest_tilted(a.x - b.x, y, space);
        real true_x = oz_fixed_position_to_real(x) + space.tilt * oz_fixed_position_to_real(y);
        return oz_vec3(true_x * space.unit, oz_fixed_position_to_real(y) * space.unit,
                       oz_fixed_position_to_real(oz_space_nearest(a.z - b.z, space, 2)) *
                           space.unit);
    }
#endif
    return oz_vec3(oz_fixed_position_to_real(oz_space_nearest(a.x - b.x, space, 0)) * space.unit,
                   oz_fixed_position_to_real(oz_space_nearest(a.y - b.y, space, 1)) * space.unit,
                   oz_fixed_position_to_real(oz_space_nearest(a.z - b.z, space, 2)) * space.unit);
}
