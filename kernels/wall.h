/* The distance of any wall. Switches OZ_WALL_KINDS and OZ_WALL_KINDS_MORE: how many walls of each
 * kind the scene has, five bits a kind, six kinds each; constants on a device: kinds that the scene
 * lacks are left out there. */
#pragma once

#include "kernels/wall_band.h"
#include "kernels/wall_cylinder.h"
#include "kernels/wall_mesh.h"
#include "kernels/wall_obstacle.h"
#include "kernels/wall_plane.h"
#include "kernels/wall_rectangle.h"
#include "kernels/wall_solid.h"
#include "kernels/wall_sphere.h"
#include "kernels/wall_tube.h"
#include "kernels/walls.h"

#define OZ_WALL_ALL_KINDS        ((long)OZ_WALL_KINDS | (long)OZ_WALL_KINDS_MORE << 30)
#define OZ_WALL_COUNT_OF(NAME)   ((int)(OZ_WALL_ALL_KINDS >> 5 * OZ_WALL_##NAME & 31))
#define OZ_WALL_NONE_AFTER(NAME) (OZ_WALL_ALL_KINDS >> 5 * OZ_WALL_##NAME >> 5 == 0)

/* Whether a wall is of a kind; no question where the scene has none of the kinds behind it in the
 * list, as it is asked in the list's order. */
#define OZ_WALL_IS(NAME, wall)                                                                     \
    (OZ_WALL_COUNT_OF(NAME) > 0 && (OZ_WALL_NONE_AFTER(NAME) || (wall).kind == OZ_WALL_##NAME))

/* The kind of a kernel's wall, which come kind by kind. Not read from the wall: a compiler that
 * unrolls a loop over walls then knows it. */
OZ_INLINE int oz_wall_kind(int wall)
{
    int kind = 0, first = 0;
#define OZ_WALL_ROW(NAME, name, choice, fine, edged)                                               \
    kind = OZ_WALL_COUNT_OF(NAME) > 0 && wall >= first ? OZ_WALL_##NAME : kind;                    \
    first += OZ_WALL_COUNT_OF(NAME);
    OZ_WALLS(OZ_WALL_ROW)
#undef OZ_WALL_ROW
    (void)first;
    return kind;
}

/* from: cap centre minus the wall's point, the wall's motion included. A wall that is not there is
 * farther than anything reaches. */
OZ_INLINE OzWallDistance oz_wall_distance(OzVec3 from, OzWallShape wall)
{
    OzWallDistance far = {oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0)), REAL(OZ_WALL_FAR)};
    if (OZ_GATED && wall.gone != 0) {
        return far;
    }
#define OZ_WALL_ROW(NAME, name, choice, fine, edged)                                               \
    if (OZ_WALL_IS(NAME, wall)) {                                                                  \
        return oz_wall_##name(from, wall);                                                         \
    }
    OZ_WALLS(OZ_WALL_ROW)
#undef OZ_WALL_ROW
    OzWallDistance none = {oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0)), REAL(0.0)};
    return none;
}

/* Where the shaft from `from` - half_shaft to `from` + half_shaft is nearest to the middle of a
 * wall with edges, in half shafts, and beyond its ends too; from: the grain's centre minus the
 * wall's point. */
OZ_INLINE real oz_wall_middle(OzVec3 from, OzVec3 half_shaft, OzWallShape wall)
{
#define OZ_WALL_MIDDLE_0(name) REAL(0.0)
#define OZ_WALL_MIDDLE_1(name) oz_wall_##name##_middle(from, half_shaft, wall)
#define OZ_WALL_MIDDLE_2(name) OZ_WALL_MIDDLE_1(name)
#define OZ_WALL_ROW(NAME, name, choice, fine, edged)                                               \
    if (OZ_WALL_IS(NAME, wall)) {                                                                  \
        return OZ_WALL_MIDDLE_##edged(name);                                                       \
    }
    OZ_WALLS(OZ_WALL_ROW)
#undef OZ_WALL_ROW
    return REAL(0.0);
}

/* Not zero for a cap whose nearest point lies within the edges of such a wall. Where it has the
 * same sign at both ends, the shaft between is no nearer than they are. */
OZ_INLINE real oz_wall_flush(OzVec3 from, OzWallShape wall)
{
#define OZ_WALL_FLUSH_0(name) REAL(0.0)
#define OZ_WALL_FLUSH_1(name) oz_wall_##name##_flush(from, wall)
#define OZ_WALL_FLUSH_2(name) OZ_WALL_FLUSH_1(name)
#define OZ_WALL_ROW(NAME, name, choice, fine, edged)                                               \
    if (OZ_WALL_IS(NAME, wall)) {                                                                  \
        return OZ_WALL_FLUSH_##edged(name);                                                        \
    }
    OZ_WALLS(OZ_WALL_ROW)
#undef OZ_WALL_ROW
    return REAL(0.0);
}

#if OZ_FINE
/* The overlap of an end with all its digits, as oz_wall_plane_fine. */
OZ_INLINE real oz_wall_overlap(OzFineVec3 end, OzWallShape wall, OzFine rise, real radius,
                               scalar counts)
{
#define OZ_WALL_FINE_0(name) REAL(0.0) /* such a scene is not counted so finely */
#define OZ_WALL_FINE_1(name) oz_wall_##name##_fine(end, wall, rise, radius, counts)
#define OZ_WALL_ROW(NAME, name, choice, fine, edged)                                               \
    if (OZ_WALL_IS(NAME, wall)) {                                                                  \
        return OZ_WALL_FINE_##fine(name);                                                          \
    }
    OZ_WALLS(OZ_WALL_ROW)
#undef OZ_WALL_ROW
    return REAL(0.0);
}
#endif
