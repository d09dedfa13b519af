/* The distance of any wall. Switch OZ_WALL_KINDS: a bit (1 << OZ_WALL_...) for each kind that the scene has, a constant
 * on a device; the others are left out there. */
#ifndef OZ_KERNELS_WALL_H
#define OZ_KERNELS_WALL_H

#include "kernels/wall_cylinder.h"
#include "kernels/wall_plane.h"
#include "kernels/walls.h"

/* Whether a wall is of a kind; no question where the scene has one kind alone. */
#define OZ_WALL_IS(NAME, wall)                                                                     \
    (OZ_WALL_KINDS == 1 << OZ_WALL_##NAME ||                                                       \
     ((OZ_WALL_KINDS >> OZ_WALL_##NAME & 1) && (wall).kind == OZ_WALL_##NAME))

/* from: cap centre minus the wall's point, the wall's motion included. */
OZ_INLINE OzWallDistance oz_wall_distance(OzVec3 from, OzWallShape wall)
{
    OzWallDistance at;
    at.normal = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0));
    at.distance = REAL(0.0);
#define OZ_WALL_ROW(NAME, name, choice, fine)                                                      \
    if (OZ_WALL_IS(NAME, wall)) {                                                                  \
        at = oz_wall_##name(from, wall);                                                           \
    }
    OZ_WALLS(OZ_WALL_ROW)
#undef OZ_WALL_ROW
    return at;
}

#if OZ_FINE
/* The overlap of an end with all its digits, as oz_wall_plane_fine. */
OZ_INLINE real oz_wall_overlap(OzFineVec3 end, OzWallShape wall, OzFine rise, real radius, scalar counts)
{
    real overlap = REAL(0.0);
#define OZ_WALL_FINE_0(name) REAL(0.0) /* such a scene is not counted so finely */
#define OZ_WALL_FINE_1(name) oz_wall_##name##_fine(end, wall, rise, radius, counts)
#define OZ_WALL_ROW(NAME, name, choice, fine)                                                      \
    if (OZ_WALL_IS(NAME, wall)) {                                                                  \
        overlap = OZ_WALL_FINE_##fine(name);                                                       \
    }
    OZ_WALLS(OZ_WALL_ROW)
#undef OZ_WALL_ROW
    return overlap;
}
#endif

#endif
