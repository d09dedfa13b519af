/* How a side of a wall stands that changes its place when it turns: a mesh, a rectangle, a box,
 * whose point may go round with it. The shape's directions are turned with the wall; triangles stay
 * as they were built, and grains are turned into their frame instead. */
#ifndef OZ_KERNELS_WALL_SWING_H
#define OZ_KERNELS_WALL_SWING_H

#include "kernels/wall_shape.h"

typedef struct OzWallSwing {
    scalar frame[9]; /* row by row: what takes a direction on the wall as built to that of now */
    scalar away[3];  /* m, the way that the side's point has gone by turning                   */
    scalar lead[3];  /* m/s, the velocity of that point by turning                             */
    scalar home[3];  /* m, from that point to the wall's own, now: of a box's sides            */
} OzWallSwing;

/* A direction on the wall as built, as it is now. */
OZ_INLINE OzVec3 oz_wall_swing_now(const scalar *frame, OzVec3 v)
{
    return oz_vec3(REAL(frame[0]) * v.x + REAL(frame[1]) * v.y + REAL(frame[2]) * v.z,
                   REAL(frame[3]) * v.x + REAL(frame[4]) * v.y + REAL(frame[5]) * v.z,
                   REAL(frame[6]) * v.x + REAL(frame[7]) * v.y + REAL(frame[8]) * v.z);
}

/* A direction of now, as the wall as built sees it. */
OZ_INLINE OzVec3 oz_wall_swing_back(const scalar *frame, OzVec3 v)
{
    return oz_vec3(REAL(frame[0]) * v.x + REAL(frame[3]) * v.y + REAL(frame[6]) * v.z,
                   REAL(frame[1]) * v.x + REAL(frame[4]) * v.y + REAL(frame[7]) * v.z,
                   REAL(frame[2]) * v.x + REAL(frame[5]) * v.y + REAL(frame[8]) * v.z);
}

/* Three numbers that are the same for all grains. */
OZ_INLINE void oz_wall_swing_turn(const scalar *frame, scalar *v)
{
    scalar turned[3];
    for (int k = 0; k < 3; k++) {
        turned[k] = frame[3 * k] * v[0] + frame[3 * k + 1] * v[1] + frame[3 * k + 2] * v[2];
    }
    for (int k = 0; k < 3; k++) {
        v[k] = turned[k];
    }
}

#endif
