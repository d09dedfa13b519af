/* A wall as its distance reads it, and what the distance answers. A wall touches the cap at an end
 * of a shaft (Pournin et al. 2005, sec. 3.2): two contacts for a rod lying flat, one for a sphere.
 */
#pragma once

#include "kernels/vec3.h"
#if OZ_FINE
#include "kernels/fine.h"
#endif

/* What normal and radius mean is the kind's. */
typedef struct OzWallShape {
    scalar kind;     /* OZ_WALL_...                                                */
    scalar point[3]; /* where distances are measured from; on a device in a place's units, else m */
    scalar normal[3]; /* a unit vector: of a plane into the free side, of a tube along its axis */
    scalar across[3]; /* a unit vector across normal: along a rectangle's first side        */
    scalar radius;    /* m; of a band at its point                                  */
    scalar extent[2]; /* m: half a rectangle's sides; of a band the radius at its far end, its
                         length */
    scalar side;      /* 1: grains are inside a tube or sphere; -1: outside         */
    scalar gone;      /* not 0 while the wall is not there; with OZ_GATED only        */
} OzWallShape;

/* Where a cap's centre stands against a wall. */
typedef struct OzWallDistance {
    OzVec3 normal; /* unit vector into the free side        */
    real distance; /* m, of the cap's centre from the wall  */
#if OZ_FINE
    real overlap; /* m, of the cap and the wall */
#endif
} OzWallDistance;

/* Places at which one grain can touch one mesh (mesh.h) at a time: a sphere in the tip of a pyramid
 * has four walls around it, a rod in a corner three at each end. A run in which there are more is
 * stopped. What is remembered of each: 0 or the key, the normal, the place along the shaft. */
enum { OZ_MESH_SLOTS = 8 };
enum { OZ_MESH_M_KEY, OZ_MESH_M_NORMAL, OZ_MESH_M_PLACE = 4, OZ_MESH_MEMORY };

/* m: the distance of a wall that is not there. Its square is still a number, whatever the unit. */
#define OZ_WALL_FAR 1e12

/* The distance from a sheet's nearest point, which the cap's centre is so far away from. */
OZ_INLINE OzWallDistance oz_wall_shape_sheet(OzVec3 away)
{
    OzWallDistance at;
    real r2 = oz_dot(away, away);
    real inverse = oz_inverse_root(oz_larger(r2, REAL(OZ_TINY * OZ_TINY)));
    at.normal = oz_scale(away, inverse);
    at.distance = r2 * inverse;
    return at;
}
