/* Where grains touch walls of triangles. Each triangle offers the ends of a shaft, and up to two
 * points between them, with their true distance from it: of its face, an edge or a corner. Of all
 * that are offered those push that together free the grain (wall_shaft.h): the pushes a >= 0 with
 * sum_j K_ij a_j >= e_i, and equal to it where a_i > 0, of overlaps e_i at places s_i with normals
 * n_i, where K_ij = (1 - |s_i - s_j| / 2) max(0, n_i . n_j). A push takes overlap away beside it,
 * too: of triangles that join in a plane, or nearly so, the deepest one alone touches, at their
 * common edges one of them does, and walls across each other push as they would alone. A sphere is
 * pushed along the shortest way that frees it. Nothing need be known of who is whose neighbour.
 *
 * On a device each lane is a grain with a triangle of its own before it; touches of one grain are
 * `scalar`. */
#ifndef OZ_KERNELS_MESH_H
#define OZ_KERNELS_MESH_H

#include "kernels/wall_shaft.h"

/* What is left of an overlap counts as a touch of its own from this share of it on: far below what
 * anyone sees, far above the rounding of single precision. */
#define OZ_MESH_SHARE 1e-3

/* One triangle seen from one grain, at both ends of its shaft or between them. */
typedef struct OzMeshFace {
    OzVec3 from; /* m, the grain's centre minus the first corner, the wall's motion included */
    OzVec3 one, other; /* m, the edges from there                                                */
    real key;          /* of its tip (OZ_MESH_KEY)                                               */
} OzMeshFace;

typedef struct OzMeshGrain {
    OzVec3 half_shaft; /* m */
    real radius;       /* m */
    int two_sided;     /* of the mesh */
} OzMeshGrain;

/* A triangle and what of a grain touches it, OZ_WALL_TIP ...: one number, from 1 on. */
#define OZ_MESH_KEY(face, part) (1 + OZ_WALL_PARTS * (face) + (part))

/* One touch. */
typedef struct OzMeshTouch {
    scalar key;
    scalar place;     /* half shafts from the grain's centre */
    scalar normal[3]; /* unit vector from the wall           */
    scalar distance;  /* m                                   */
    scalar push;      /* m, its part of the response         */
} OzMeshTouch;

typedef struct OzMeshTouches {
    int count;
    scalar radius;    /* m                                                         */
    scalar tip, tail; /* m, the largest overlaps of both ends, 0 where there is none */
    OzMeshTouch at[OZ_MESH_SLOTS];
} OzMeshTouches;

/* A place of a shaft that a triangle offers. */
typedef struct OzMeshOffer {
    real key, place;   /* as in OzMeshTouch                               */
    OzWallDistance at; /* of the place                                    */
    mask counts;       /* it is overlapped, and more than what rules here */
} OzMeshOffer;

/* The largest overlaps of a shaft's ends, m, 0 where there is none. */
typedef struct OzMeshEnds {
    real tip, tail;
} OzMeshEnds;

/* The way from the nearest point of an edge. */
OZ_INLINE OzVec3 oz_mesh_from_edge(OzVec3 from, OzVec3 edge)
{
    real share = oz_dot(from, edge) / oz_dot(edge, edge);
    share = oz_larger(REAL(0.0), oz_smaller(REAL(1.0), share));
    return oz_along(from, -share, edge);
}

OZ_INLINE OzVec3 oz_mesh_shorter(OzVec3 a, OzVec3 b)
{
    return oz_choose(oz_dot(a, a) <= oz_dot(b, b), a, b);
}

/* from: a point minus the first corner. Behind a one-sided triangle it is out of reach. */
OZ_INLINE OzWallDistance oz_mesh_distance(OzVec3 from, OzMeshFace face, int two_sided)
{
    OzVec3 third = oz_minus(face.other, face.one), across = oz_cross(face.one, face.other);
    OzVec3 beyond = oz_minus(from, face.one);
    real inverse = oz_inverse_root(oz_dot(across, across));
    OzVec3 front = oz_scale(across, inverse);
    real height = oz_dot(from, front);
    mask within = (oz_dot(oz_cross(front, face.one), from) >= REAL(0.0)) &
                  (oz_dot(oz_cross(front, face.other), from) <= REAL(0.0)) &
                  (oz_dot(oz_cross(front, third), beyond) >= REAL(0.0));
    OzVec3 away =
        oz_mesh_shorter(oz_mesh_from_edge(from, face.one), oz_mesh_from_edge(from, face.other));
    away = oz_mesh_shorter(away, oz_mesh_from_edge(beyond, third));
    OzWallDistance at = oz_wall_shape_sheet(away);
    real side = height < REAL(0.0) ? REAL(-1.0) : REAL(1.0);
    at.normal = oz_choose(within, oz_scale(front, side), at.normal);
    at.distance = within ? side * height : at.distance;
    if (!two_sided) {
        at.distance = height > REAL(0.0) ? at.distance : REAL(OZ_WALL_FAR);
    }
    return at;
}

/* A place where a triangle is at a distance; beyond: what its overlap must exceed. */
OZ_INLINE OzMeshOffer oz_mesh_offer(OzMeshGrain grain, real key, real place, OzWallDistance at,
                                    real beyond)
{
    real overlap = grain.radius - at.distance;
    OzMeshOffer offer = {key, place, at, (overlap > REAL(0.0)) & (overlap > beyond)};
    return offer;
}

/* An end, 0 or 1; a sphere has the first one alone, its centre. */
OZ_INLINE OzMeshOffer oz_mesh_offer_end(OzMeshFace face, OzMeshGrain grain, int end)
{
    real place = REAL(end ? -1.0 : 1.0);
    OzWallDistance at =
        oz_mesh_distance(oz_along(face.from, place, grain.half_shaft), face, grain.two_sided);
    OzMeshOffer offer = oz_mesh_offer(grain, face.key + REAL(end), place, at, REAL(0.0));
    if (end) {
        offer.counts = offer.counts & (oz_dot(grain.half_shaft, grain.half_shaft) > REAL(0.0));
    }
    return offer;
}

/* How far the plane of a triangle allows a shaft's overlap to exceed the line between its ends'
 * overlaps; nowhere more than at an end. */
OZ_INLINE real oz_mesh_excess(OzMeshEnds ends, OzMeshFace face, OzMeshGrain grain)
{
    OzVec3 across = oz_cross(face.one, face.other);
    real inverse = oz_inverse_root(oz_dot(across, across));
    real middle = inverse * oz_dot(face.from, across);
    real rise = inverse * oz_dot(grain.half_shaft, across);
    real tip = oz_magnitude(middle + rise), tail = oz_magnitude(middle - rise);
    mask crosses = oz_magnitude(middle) < oz_magnitude(rise);
    real ahead = grain.radius - tip - ends.tip;
    real behind = grain.radius - tail - ends.tail;
    return crosses ? grain.radius : oz_larger(ahead, behind);
}

/* Where the shaft's overlap exceeds the line from its end to its middle most, ahead of the middle
 * (part 0) and behind it: as oz_wall_shaft_points. */
OZ_INLINE real oz_mesh_deepest(OzMeshEnds ends, OzMeshFace face, OzMeshGrain grain, real middle,
                               real line, int part)
{
    OzWallDistance at = oz_mesh_distance(oz_along(face.from, middle, grain.half_shaft), face, 1);
    real top = oz_larger(grain.radius - at.distance, line), least = REAL(OZ_TINY);
    real low = part ? REAL(-1.0) : middle, width = part ? REAL(1.0) + middle : REAL(1.0) - middle;
    real slope = part ? (top - ends.tail) / oz_larger(width, least)
                      : (ends.tip - top) / oz_larger(width, least);
    for (int i = 0; i < OZ_WALL_SHAFT_HALVINGS; i++) {
        width = REAL(0.5) * width;
        at = oz_mesh_distance(oz_along(face.from, low + width, grain.half_shaft), face, 1);
        low = -oz_dot(at.normal, grain.half_shaft) > slope ? low + width : low;
    }
    return low + REAL(0.5) * width;
}

/* The way from a triangle's middle. */
OZ_INLINE OzVec3 oz_mesh_aside(OzMeshFace face)
{
    return oz_minus(face.from, oz_scale(oz_add(face.one, face.other), REAL(1.0 / 3)));
}

/* How far its corners are from there at most, m. */
OZ_INLINE real oz_mesh_size(OzMeshFace face)
{
    return sqrt(oz_larger(oz_dot(face.one, face.one), oz_dot(face.other, face.other)));
}

/* Where a shaft is nearest to the middle of a triangle; the square of how near, m^2. */
OZ_INLINE real oz_mesh_middle(OzMeshFace face, OzMeshGrain grain)
{
    real half2 = oz_dot(grain.half_shaft, grain.half_shaft);
    return oz_clamp_unit(-oz_dot(oz_mesh_aside(face), grain.half_shaft) /
                         oz_larger(half2, REAL(OZ_TINY * OZ_TINY)));
}

OZ_INLINE real oz_mesh_aside2(OzMeshFace face, OzMeshGrain grain)
{
    OzVec3 far = oz_along(oz_mesh_aside(face), oz_mesh_middle(face, grain), grain.half_shaft);
    return oz_dot(far, far);
}

/* Whether a shaft may touch a triangle between its ends and deeper than they do. */
OZ_INLINE mask oz_mesh_may_between(OzMeshEnds ends, OzMeshFace face, OzMeshGrain grain)
{
    real reach = grain.radius + oz_mesh_size(face);
    return (oz_mesh_excess(ends, face, grain) > REAL(OZ_WALL_SHAFT_LEAST) * grain.radius) &
           (oz_mesh_aside2(face, grain) < reach * reach);
}

/* The points of shafts between their ends that a triangle offers: ahead of its middle, part 0, and
 * behind it. */
OZ_INLINE OzMeshOffer oz_mesh_offer_shaft(OzMeshEnds ends, OzMeshFace face, OzMeshGrain grain,
                                          int part)
{
    real middle = oz_mesh_middle(face, grain);
    real line = REAL(0.5) * (ends.tip + ends.tail + middle * (ends.tip - ends.tail));
    real place = oz_mesh_deepest(ends, face, grain, middle, line, part);
    OzWallDistance at =
        oz_mesh_distance(oz_along(face.from, place, grain.half_shaft), face, grain.two_sided);
    real beyond = REAL(0.5) * (ends.tip + ends.tail + place * (ends.tip - ends.tail)) +
                  REAL(OZ_WALL_SHAFT_LEAST) * grain.radius;
    OzMeshOffer offer =
        oz_mesh_offer(grain, face.key + REAL(OZ_WALL_AHEAD + part), place, at, beyond);
    offer.counts = offer.counts & oz_mesh_may_between(ends, face, grain);
    return offer;
}

#endif
