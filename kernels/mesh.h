/* Where grains touch walls of triangles. Each triangle offers the ends of a shaft, and up to two
 * points between them, with their true distance from it: of its face, an edge or a corner. Of all
 * that are offered those push that together free the grain (wall_shaft.h): the pushes a >= 0 with
 * sum_j K_ij a_j >= e_i, and equal to it where a_i > 0, of overlaps e_i at places s_i with normals
 * n_i, where K_ij = (1 - |s_i - s_j| / 2) max(0, n_i . n_j). A push takes overlap away beside it,
 * too: of triangles that join in a plane, or nearly so, the deepest one alone touches, at their
 * common edges one of them does, and walls across each other push as they would alone. A sphere is
 * pushed along the shortest way that frees it. Nothing need be known of who is whose neighbour.
 *
 * On a device lanes are triangles before one grain; `scalar` is what is the same for all. */
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

/* The grain, the same in every lane. */
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

/* The best that is offered, a triangle a lane. */
typedef struct OzMeshBest {
    real left; /* m, of the overlap, with all pushes so far; < 0: nothing that counts */
    real key, place, distance;
    OzVec3 normal;
} OzMeshBest;

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

/* How much of a push takes away of an overlap elsewhere. */
OZ_INLINE real oz_mesh_reach(real place, OzVec3 normal, const OzMeshTouch *touch)
{
    OzVec3 other = oz_vec3(REAL(touch->normal[0]), REAL(touch->normal[1]), REAL(touch->normal[2]));
    return oz_wall_shaft_reach(place, REAL(touch->place)) *
           oz_larger(REAL(0.0), oz_dot(normal, other));
}

/* One more place of every lane's triangle; beyond: what it must exceed, besides. */
OZ_INLINE void oz_mesh_offer(OzMeshBest *best, const OzMeshTouches *touches, real key, real place,
                             OzWallDistance at, real beyond)
{
    real overlap = REAL(touches->radius) - at.distance, left = overlap;
    for (int k = 0; k < touches->count; k++) {
        left -= touches->at[k].push * oz_mesh_reach(place, at.normal, &touches->at[k]);
    }
    mask better = (left > REAL(OZ_MESH_SHARE) * overlap) & (overlap > REAL(0.0)) &
                  (overlap > beyond) & (left > best->left);
    best->left = better ? left : best->left;
    best->key = better ? key : best->key;
    best->place = better ? place : best->place;
    best->distance = better ? at.distance : best->distance;
    best->normal = oz_choose(better, at.normal, best->normal);
}

/* Whether an end touches a triangle. */
OZ_INLINE mask oz_mesh_may(OzMeshFace face, OzMeshGrain grain, int ends)
{
    OzWallDistance at =
        oz_mesh_distance(oz_add(face.from, grain.half_shaft), face, grain.two_sided);
    real least = at.distance;
    if (ends > 1) {
        at = oz_mesh_distance(oz_minus(face.from, grain.half_shaft), face, grain.two_sided);
        least = oz_smaller(least, at.distance);
    }
    return least < grain.radius;
}

/* Both ends, or a sphere's centre. */
OZ_INLINE void oz_mesh_offer_ends(OzMeshBest *best, const OzMeshTouches *touches, OzMeshFace face,
                                  OzMeshGrain grain, int ends)
{
    for (int end = 0; end < ends; end++) {
        real place = REAL(end ? -1.0 : 1.0);
        OzWallDistance at =
            oz_mesh_distance(oz_along(face.from, place, grain.half_shaft), face, grain.two_sided);
        oz_mesh_offer(best, touches, face.key + REAL(end), place, at, REAL(-1.0) * grain.radius);
    }
}

/* How far the plane of a triangle allows a shaft's overlap to exceed the line between its ends'
 * overlaps; nowhere more than at an end. */
OZ_INLINE real oz_mesh_excess(const OzMeshTouches *touches, OzMeshFace face, OzMeshGrain grain)
{
    OzVec3 across = oz_cross(face.one, face.other);
    real inverse = oz_inverse_root(oz_dot(across, across));
    real middle = inverse * oz_dot(face.from, across);
    real rise = inverse * oz_dot(grain.half_shaft, across);
    real tip = oz_magnitude(middle + rise), tail = oz_magnitude(middle - rise);
    mask crosses = oz_magnitude(middle) < oz_magnitude(rise);
    real ahead = grain.radius - tip - REAL(touches->tip);
    real behind = grain.radius - tail - REAL(touches->tail);
    return crosses ? grain.radius : oz_larger(ahead, behind);
}

/* Where the shaft's overlap exceeds the line from its end to its middle most, ahead of the middle
 * (part 0) and behind it: as oz_wall_shaft_points. */
OZ_INLINE real oz_mesh_deepest(const OzMeshTouches *touches, OzMeshFace face, OzMeshGrain grain,
                               real middle, real line, int part)
{
    OzWallDistance at = oz_mesh_distance(oz_along(face.from, middle, grain.half_shaft), face, 1);
    real top = oz_larger(grain.radius - at.distance, line), least = REAL(OZ_TINY);
    real low = part ? REAL(-1.0) : middle, width = part ? REAL(1.0) + middle : REAL(1.0) - middle;
    real slope = part ? (top - REAL(touches->tail)) / oz_larger(width, least)
                      : (REAL(touches->tip) - top) / oz_larger(width, least);
    for (int i = 0; i < OZ_WALL_SHAFT_HALVINGS; i++) {
        width = REAL(0.5) * width;
        at = oz_mesh_distance(oz_along(face.from, low + width, grain.half_shaft), face, 1);
        low = -oz_dot(at.normal, grain.half_shaft) > slope ? low + width : low;
    }
    return low + REAL(0.5) * width;
}

/* Where a shaft is nearest to the middle of a triangle, and whether it may touch that between its
 * ends and deeper than they do. */
OZ_INLINE real oz_mesh_middle(OzMeshFace face, OzMeshGrain grain)
{
    OzVec3 aside = oz_minus(face.from, oz_scale(oz_add(face.one, face.other), REAL(1.0 / 3)));
    real half2 = oz_dot(grain.half_shaft, grain.half_shaft);
    return oz_clamp_unit(-oz_dot(aside, grain.half_shaft) /
                         oz_larger(half2, REAL(OZ_TINY * OZ_TINY)));
}

OZ_INLINE mask oz_mesh_may_between(const OzMeshTouches *touches, OzMeshFace face, OzMeshGrain grain)
{
    OzVec3 aside = oz_minus(face.from, oz_scale(oz_add(face.one, face.other), REAL(1.0 / 3)));
    OzVec3 far = oz_along(aside, oz_mesh_middle(face, grain), grain.half_shaft);
    real size2 = oz_larger(oz_dot(face.one, face.one), oz_dot(face.other, face.other));
    real reach = grain.radius + sqrt(size2);
    return (oz_mesh_excess(touches, face, grain) > REAL(OZ_WALL_SHAFT_LEAST) * grain.radius) &
           (oz_dot(far, far) < reach * reach);
}

/* The points of shafts between their ends, where the triangle lets there be any. */
OZ_INLINE void oz_mesh_offer_shaft(OzMeshBest *best, const OzMeshTouches *touches, OzMeshFace face,
                                   OzMeshGrain grain)
{
    mask may = oz_mesh_may_between(touches, face, grain);
    if (!OZ_ANY(may)) {
        return;
    }
    real middle = oz_mesh_middle(face, grain);
    real line =
        REAL(0.5) * (touches->tip + touches->tail + middle * (touches->tip - touches->tail));
    for (int part = 0; part < OZ_WALL_SHAFT_PARTS; part++) {
        real place = oz_mesh_deepest(touches, face, grain, middle, line, part);
        OzWallDistance at =
            oz_mesh_distance(oz_along(face.from, place, grain.half_shaft), face, grain.two_sided);
        real beyond =
            REAL(0.5) * (touches->tip + touches->tail + place * (touches->tip - touches->tail)) +
            REAL(OZ_WALL_SHAFT_LEAST) * grain.radius;
        beyond = may ? beyond : grain.radius;
        oz_mesh_offer(best, touches, face.key + REAL(OZ_WALL_AHEAD + part), place, at, beyond);
    }
}

OZ_INLINE OzMeshBest oz_mesh_look(const OzMeshTouches *touches, OzMeshFace face, OzMeshGrain grain,
                                  int ends, int between)
{
    OzMeshBest best = {REAL(-1.0), REAL(0.0), REAL(0.0), REAL(0.0), face.one};
    oz_mesh_offer_ends(&best, touches, face, grain, ends);
    if (between) {
        oz_mesh_offer_shaft(&best, touches, face, grain);
    }
    return best;
}

#endif
