/* Where shafts touch walls with edges between their ends. Caps alone would let a rod fall through
 * an edge that it lies across. Two points of a shaft can touch, besides its ends: the deepest one
 * ahead of its middle and the deepest one behind, as a shaft across a narrow wall or a mouth lies
 * on two edges; the middle is where it is nearest to the wall's own. At a body that is convex
 * towards grains there is one such point, and two across its rim.
 *
 * The ends and these points share one elastic response: a push at a place of the shaft takes away
 * overlap there by as much as the law says, and at other places in proportion to how near they are,
 * none at the far end of the shaft. The pushes a >= 0 are those with sum_j K_ij a_j >= e_i, and
 * equal to it where a_i > 0, of overlaps e_i at places s_i, where K_ij = 1 - |s_i - s_j| / 2. So
 * ends do as they would alone where a shaft lies flat or in a round wall, one contact counts once
 * wherever points meet, nothing jumps as a point comes to an end, and with a linear law forces have
 * a potential: max over a of a.e - a.K.a / 2 (K is a triangle's, which is positive definite). */
#ifndef OZ_KERNELS_WALL_SHAFT_H
#define OZ_KERNELS_WALL_SHAFT_H

#include "kernels/wall_joint.h"

/* What of a grain touches a wall. A sphere has the first end alone. */
enum { OZ_WALL_TIP, OZ_WALL_TAIL, OZ_WALL_AHEAD, OZ_WALL_BEHIND, OZ_WALL_PARTS };

enum { OZ_WALL_SHAFT_PARTS = OZ_WALL_PARTS - OZ_WALL_AHEAD };

/* Halvings until the deepest point is known. Overlap is stationary there: an error of 1e-5 or 1e-8
 * of the shaft leaves it right to every digit. */
#if defined(OZ_HOST) || defined(OZ_DOUBLE)
enum { OZ_WALL_SHAFT_HALVINGS = 26 };
#else
enum { OZ_WALL_SHAFT_HALVINGS = 16 };
#endif

/* Rounds in which the two points' pushes are fitted to each other. They are right from the start
 * unless both points and an end touch, which happens in passing alone. */
enum { OZ_WALL_SHAFT_ROUNDS = 4 };

/* In radii: points less deep do not touch, so that rounding makes no contacts where a shaft lies
 * flat; far below what grains rest at. */
#define OZ_WALL_SHAFT_LEAST 1e-6

/* How many walls there are, and of what kinds: those with edges are the last ones, after meshes. */
typedef struct OzWallNumbers {
    int ends; /* of a grain: 1 when all are spheres, else 2 */
    int walls, meshes, edged;
} OzWallNumbers;

/* Contacts with walls are numbered: ends at each wall, then points of shafts at each of those with
 * edges (of spheres there are none), then the slots of each mesh. The first slot of all. */
OZ_INLINE int oz_wall_shaft_slots(OzWallNumbers n)
{
    return n.ends * n.walls + (n.ends == 2 ? OZ_WALL_SHAFT_PARTS * n.edged : 0);
}

/* The wall and the part of one of them; OZ_WALL_PARTS and on: slots. */
OZ_INLINE int oz_wall_shaft_wall(int index, OzWallNumbers n)
{
    int at_shaft = index - n.ends * n.walls, slot = index - oz_wall_shaft_slots(n);
    int wall = at_shaft < 0 ? index / n.ends : n.walls - n.edged + at_shaft / OZ_WALL_SHAFT_PARTS;
    return slot < 0 ? wall : n.walls - n.edged - n.meshes + slot / OZ_MESH_SLOTS;
}

OZ_INLINE int oz_wall_shaft_part(int index, OzWallNumbers n)
{
    int at_shaft = index - n.ends * n.walls, slot = index - oz_wall_shaft_slots(n);
    int part = at_shaft < 0 ? index % n.ends : OZ_WALL_AHEAD + at_shaft % OZ_WALL_SHAFT_PARTS;
    return slot < 0 ? part : OZ_WALL_PARTS + slot % OZ_MESH_SLOTS;
}

/* A shaft before one wall. */
typedef struct OzWallRod {
    OzVec3 from; /* m, the grain's centre minus the wall's point, the wall's motion included */
    OzVec3 half_shaft; /* m                                                                */
    real radius;       /* m                                                                */
    real tip, tail;    /* m, the largest overlap of the end along half_shaft, and of the other one,
                          with any wall with edges: on two that join a shaft lies as on one  */
} OzWallRod;

/* One of its two points. */
typedef struct OzWallPoint {
    real at;             /* half shafts from the grain's centre                           */
    OzWallDistance wall; /* where that point stands                                       */
    real overlap;        /* m, of that point; not positive: it does not touch              */
    real push;           /* m, its part of the response: an overlap to the law             */
} OzWallPoint;

/* Where a shaft's overlap exceeds a line of that slope (m a half shaft) most lies between low and
 * low
 * + width, where it ceases to grow faster: the beginning of that half. */
OZ_INLINE real oz_wall_shaft_narrow(OzWallRod rod, OzWallShape wall, real low, real width,
                                    real slope)
{
    real between = low + REAL(0.5) * width;
    OzVec3 normal = oz_wall_distance(oz_along(rod.from, between, rod.half_shaft), wall).normal;
    return -oz_dot(normal, rod.half_shaft) > slope ? between : low;
}

/* The point at a place of the shaft, without its push. */
OZ_INLINE OzWallPoint oz_wall_shaft_point(OzWallRod rod, OzWallShape wall, real at)
{
    OzWallPoint point;
    point.at = at;
    point.wall = oz_wall_distance(oz_along(rod.from, at, rod.half_shaft), wall);
    point.overlap = rod.radius * REAL(1 - OZ_WALL_SHAFT_LEAST) - point.wall.distance;
    point.push = REAL(0.0);
    return point;
}

/* Both points at a sheet. The line leads from the end to the middle. */
OZ_INLINE void oz_wall_shaft_sheet(OzWallRod rod, OzWallShape wall, OzWallPoint *points)
{
    real none = REAL(0.0), low[2], width[2], slope[2];
    real tip = oz_larger(rod.tip, none), tail = oz_larger(rod.tail, none);
    real middle = oz_clamp_unit(oz_wall_middle(rod.from, rod.half_shaft, wall));
    OzVec3 place = oz_along(rod.from, middle, rod.half_shaft);
    real line = REAL(0.5) * (tip + tail + middle * (tip - tail));
    real top = oz_larger(rod.radius - oz_wall_distance(place, wall).distance, line);
    low[0] = middle;
    low[1] = REAL(-1.0);
    width[0] = REAL(1.0) - middle;
    width[1] = REAL(1.0) + middle;
    slope[0] = (tip - top) / oz_larger(width[0], REAL(OZ_TINY));
    slope[1] = (top - tail) / oz_larger(width[1], REAL(OZ_TINY));
    for (int i = 0; i < OZ_WALL_SHAFT_HALVINGS; i++) {
        for (int part = 0; part < OZ_WALL_SHAFT_PARTS; part++) {
            low[part] = oz_wall_shaft_narrow(rod, wall, low[part], width[part], slope[part]);
            width[part] = REAL(0.5) * width[part];
        }
    }
    for (int part = 0; part < OZ_WALL_SHAFT_PARTS; part++) {
        points[part] = oz_wall_shaft_point(rod, wall, low[part] + REAL(0.5) * width[part]);
    }
}

/* The push at a place of the shaft of an overlap, beside both ends: the least that does with
 * neither of them, with one or with both, as what they take over grows with their overlap (tip,
 * tail) less what this push takes away there. */
OZ_INLINE real oz_wall_shaft_alone(real overlap, real tip, real tail, real at)
{
    real least = REAL(OZ_TINY);
    real ahead = REAL(0.5) + REAL(0.5) * at, behind = REAL(0.5) - REAL(0.5) * at;
    real with_tip = (overlap - ahead * tip) / oz_larger(REAL(1.0) - ahead * ahead, least);
    real with_tail = (overlap - behind * tail) / oz_larger(REAL(1.0) - behind * behind, least);
    real with_both =
        (overlap - ahead * tip - behind * tail) / oz_larger(REAL(2.0) * ahead * behind, least);
    real push = oz_smaller(oz_smaller(overlap, with_tip), oz_smaller(with_tail, with_both));
    return oz_larger(push, REAL(0.0));
}

/* Half of what the overlap at the tip exceeds that at the tail by, of what a point's push leaves
 * there. The response has the largest potential where the overlap's slope is that. */
OZ_INLINE real oz_wall_shaft_lean(OzWallRod rod, OzWallPoint point)
{
    real push = oz_wall_shaft_alone(point.overlap, rod.tip, rod.tail, point.at), none = REAL(0.0);
    real ahead = REAL(0.5) + REAL(0.5) * point.at, behind = REAL(0.5) - REAL(0.5) * point.at;
    return REAL(0.5) *
           (oz_larger(rod.tip - ahead * push, none) - oz_larger(rod.tail - behind * push, none));
}

/* One point at a convex body, and none: overlap is concave along the shaft. Where no end touches it
 * is the deepest one, so that it is the contact of two capsules. */
OZ_INLINE void oz_wall_shaft_single(OzWallRod rod, OzWallShape wall, int is_obstacle,
                                    OzWallPoint *points)
{
    real middle = oz_clamp_unit(oz_wall_middle(rod.from, rod.half_shaft, wall));
    mask is_known = oz_larger(rod.tip, rod.tail) <= REAL(0.0);
    if (is_obstacle == 0 || OZ_ANY(oz_larger(rod.tip, rod.tail) > REAL(0.0))) {
        real low = REAL(-1.0), width = REAL(2.0);
        for (int i = 0; i < OZ_WALL_SHAFT_HALVINGS; i++) {
            OzWallPoint between = oz_wall_shaft_point(rod, wall, low + REAL(0.5) * width);
            real lean = oz_wall_shaft_lean(rod, between);
            low = oz_wall_shaft_narrow(rod, wall, low, width, lean);
            width = REAL(0.5) * width;
        }
        low = low + REAL(0.5) * width;
        middle = is_obstacle ? (is_known ? middle : low) : low;
    }
    points[0] = points[1] = oz_wall_shaft_point(rod, wall, middle);
    points[1].overlap = -rod.radius;
}

/* Whether a shaft lies over an end of a solid and beyond its rim on both sides. */
OZ_INLINE mask oz_wall_shaft_spans(OzWallRod rod, OzWallShape wall)
{
    real middle = oz_clamp_unit(oz_wall_middle(rod.from, rod.half_shaft, wall));
    real over = oz_wall_flush(oz_along(rod.from, middle, rod.half_shaft), wall);
    real tip = oz_wall_flush(oz_add(rod.from, rod.half_shaft), wall);
    real tail = oz_wall_flush(oz_minus(rod.from, rod.half_shaft), wall);
    return (over != REAL(0.0)) & (over * tip <= REAL(0.0)) & (over * tail <= REAL(0.0));
}

/* At a solid: one point, but one on either side of its rim where the shaft lies across that. */
OZ_INLINE void oz_wall_shaft_solid(OzWallRod rod, OzWallShape wall, OzWallPoint *points)
{
    mask spans = oz_wall_shaft_spans(rod, wall);
    oz_wall_shaft_single(rod, wall, 0, points);
    if (OZ_ANY(spans)) {
        OzWallPoint both[OZ_WALL_SHAFT_PARTS];
        oz_wall_shaft_sheet(rod, wall, both);
        for (int part = 0; part < OZ_WALL_SHAFT_PARTS; part++) {
            OzWallPoint *to = &points[part];
            to->at = spans ? both[part].at : to->at;
            to->wall.normal = oz_choose(spans, both[part].wall.normal, to->wall.normal);
            to->wall.distance = spans ? both[part].wall.distance : to->wall.distance;
            to->overlap = spans ? both[part].overlap : to->overlap;
        }
    }
}

/* Both points without their pushes: [0] ahead, [1] behind. */
OZ_INLINE void oz_wall_shaft_points(OzWallRod rod, OzWallShape wall, OzWallPoint *points)
{
    if (OZ_WALL_COUNT_OF(OBSTACLE) > 0 && wall.kind == OZ_WALL_OBSTACLE) {
        oz_wall_shaft_single(rod, wall, 1, points);
    } else if (OZ_WALL_COUNT_OF(SOLID) > 0 && wall.kind == OZ_WALL_SOLID) {
        oz_wall_shaft_solid(rod, wall, points);
    } else {
        oz_wall_shaft_sheet(rod, wall, points);
    }
}

/* Whether that point lies on another wall, which comes first and bears the shaft there. from: the
 * point minus the other wall's. */
OZ_INLINE mask oz_wall_shaft_hides(OzVec3 from, OzWallShape other, OzWallPoint point, real radius)
{
    OzVec3 nearest = oz_along(from, -point.wall.distance, point.wall.normal);
    return oz_wall_distance(nearest, other).distance < REAL(OZ_WALL_JOINT) * radius;
}

/* How much of a push at a place of the shaft takes overlap away at another one. */
OZ_INLINE real oz_wall_shaft_reach(real at, real other)
{
    return REAL(1.0) - REAL(0.5) * oz_magnitude(at - other);
}

/* Fills in the pushes of both points. */
OZ_INLINE void oz_wall_shaft_push(OzWallRod rod, OzWallPoint *points)
{
    OzWallPoint *ahead = &points[0], *behind = &points[1];
    real k = oz_wall_shaft_reach(ahead->at, behind->at), none = REAL(0.0);
    real tip_of = oz_wall_shaft_reach(ahead->at, REAL(1.0)), tail_of = REAL(1.0) - tip_of;
    real tip_by = oz_wall_shaft_reach(behind->at, REAL(1.0)), tail_by = REAL(1.0) - tip_by;
    real both =
        (ahead->overlap - k * behind->overlap) / oz_larger(REAL(1.0) - k * k, REAL(OZ_TINY));
    real one = oz_larger(oz_smaller(ahead->overlap, both), none);
    real other = oz_larger(behind->overlap - k * one, none);
    for (int i = 0; i < OZ_WALL_SHAFT_ROUNDS; i++) {
        one = oz_wall_shaft_alone(ahead->overlap - k * other, rod.tip - tip_by * other,
                                  rod.tail - tail_by * other, ahead->at);
        other = oz_wall_shaft_alone(behind->overlap - k * one, rod.tip - tip_of * one,
                                    rod.tail - tail_of * one, behind->at);
    }
    mask is_long = oz_dot(rod.half_shaft, rod.half_shaft) > none;
    ahead->push = is_long ? one : none;
    behind->push = is_long ? other : none;
}

#endif
