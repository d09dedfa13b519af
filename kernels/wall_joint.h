/* Joints of walls with edges: where two meet, or lie so near each other that no grain can tell, a
 * grain touches one of them alone. */
#ifndef OZ_KERNELS_WALL_JOINT_H
#define OZ_KERNELS_WALL_JOINT_H

#include "kernels/wall.h"

/* In radii: a point so near a wall lies on it. Far above the rounding of single precision (1e-5 in
 * a container of a hundred grains), and so little that a grain over such a gap sinks by a millionth
 * of its radius. */
#define OZ_WALL_JOINT 1e-3

/* Whether a cap touches another wall at the place where it would touch this one: this one's nearest
 * point lies on the other one, which is nearer, or as near and comes first. from: cap centre minus
 * the other wall's point; own, other: where the cap stands against this wall and the other one. */
OZ_INLINE mask oz_wall_joint_hides(OzVec3 from, OzWallShape wall, OzWallDistance other,
                                   int comes_first, OzWallDistance own, real radius)
{
    OzVec3 nearest = oz_along(from, -own.distance, own.normal);
    real gap = oz_wall_distance(nearest, wall).distance;
    mask nearer = other.distance < own.distance;
    if (comes_first) {
        nearer = other.distance <= own.distance;
    }
    return nearer & (gap < REAL(OZ_WALL_JOINT) * radius);
}

#endif
