/* The contact of two triangles (Poeschel and Buchholtz 1995, section 3): from their overlap to what
 * they feel. The force is a stiffness times the overlap's area along a direction that depends on
 * the kind of contact, and the kind on how their edges cross:
 *   i    one edge of one of them holds both crossings: along that edge's normal
 *   ii   two crossings on different edges of both: across the line between them
 *   iii  four crossings on two edges of both: half along the normal of each one's entry edge, that
 *        from which the other has the shortest way out
 *   iv, v, vi  along the normals of edges with two crossings, in shares of the lengths between
 *        them: of the triangle that has two such edges (iv), of all six (v), of one each (vi)
 * The push does not jump where kinds change from none to i, i to ii and i to iv.
 * Under OZ_FORCE_POINT 0 the force acts at the overlap's centroid, which for kind i makes it the
 * gradient of the integral of depth; under 1 in the middle between crossings, as in the paper. */
#pragma once

#include "kernels/vec2.h"

#ifndef OZ_FORCE_POINT
#error "define OZ_FORCE_POINT before including kernels/triangle.h"
#endif

/* Counter-clockwise; coordinates about any origin common to two that meet, best a near one. */
typedef struct OzTriangle {
    OzVec2 corner[3];
} OzTriangle;

/* Times the stiffness Y: force, moment and energy. */
typedef struct OzOverlap {
    OzVec2 push;     /* m^2, on b; a feels the opposite                                          */
    real moment;     /* m^3: sum of point x push about the origin; b's torque about its centre c is
                        Y (moment - c x push), a's is -Y (moment - c x push)                     */
    real area;       /* m^2, also of a swallowed triangle                                        */
    real energy;     /* m^3, integral of depth: kind i's potential, an estimate for others       */
    real kind;       /* 0 none, 1..6 for kinds i..vi                                             */
    real share;      /* the largest part of one of them that is inside the other; 0 apart        */
    OzVec2 centroid; /* of the overlap, m                                                        */
    mask deep;       /* more than half of one of them is inside the other                        */
    mask swallowed;  /* one of them is inside the other, and feels nothing                       */
} OzOverlap;

/* One triangle's edges cut by the other: edge k runs from corner k to the next. */
typedef struct OzTriangleElements {
    OzVec2 from[3], to[3]; /* the part of each edge inside the other; alike when there is none  */
    real crossings[3];     /* of each edge with the other's outline: 0, 1, 2                    */
    real doubles;          /* edges with two of them                                            */
} OzTriangleElements;

/* Twice the area over the edge k of t and point p: > 0 inside. */
OZ_INLINE real oz_triangle_side(const OzTriangle *t, int k, OzVec2 p)
{
    OzVec2 start = t->corner[k];
    return oz_cross2(oz_minus2(t->corner[(k + 1) % 3], start), oz_minus2(p, start));
}

/* sides[k][c]: where corner c of other stands against edge k of t. */
OZ_INLINE void oz_triangle_sides(const OzTriangle *t, const OzTriangle *other, real sides[3][3])
{
    OZ_UNROLL
    for (int k = 0; k < 3; k++) {
        OZ_UNROLL
        for (int c = 0; c < 3; c++) {
            sides[k][c] = oz_triangle_side(t, k, other->corner[c]);
        }
    }
}

/* False only when an edge of one of them has the other farther than margin (m) outside. */
OZ_INLINE mask oz_triangle_near(const OzTriangle *a, const OzTriangle *b, real margin)
{
    mask near = margin >= margin;
    OZ_UNROLL
    for (int k = 0; k < 6; k++) {
        const OzTriangle *t = k < 3 ? a : b, *other = k < 3 ? b : a;
        int edge = k % 3;
        OzVec2 along = oz_minus2(t->corner[(edge + 1) % 3], t->corner[edge]);
        real first = oz_triangle_side(t, edge, other->corner[0]);
        real second = oz_triangle_side(t, edge, other->corner[1]);
        real third = oz_triangle_side(t, edge, other->corner[2]);
        real closest = oz_larger(first, oz_larger(second, third));
        near = near & (closest >= -margin * oz_length2(along));
    }
    return near;
}

/* Edge k of t, clipped to what is inside the other. mine: the corners of t against the other's
 * edges; theirs: the other's corners against the edges of t. Adds crossing points to *sum. */
OZ_INLINE void oz_triangle_clip(const OzTriangle *t, int k, real mine[3][3], real theirs[3][3],
                                OzTriangleElements *elements, OzVec2 *sum)
{
    OzVec2 start = t->corner[k], along = oz_minus2(t->corner[(k + 1) % 3], start);
    real low = REAL(0.0), high = REAL(1.0), crossings = REAL(0.0);
    OZ_UNROLL
    for (int j = 0; j < 3; j++) {
        real d0 = mine[j][k], d1 = mine[j][(k + 1) % 3];
        mask in0 = d0 >= REAL(0.0), in1 = d1 >= REAL(0.0), changes = in0 ^ in1;
        real at = d0 / (changes ? d0 - d1 : REAL(1.0));
        low = (changes & in1) ? oz_larger(low, at) : low;
        high = (changes & in0) ? oz_smaller(high, at) : high;
        high = (in0 | in1) ? high : REAL(-1.0);
        mask meets =
            changes & ((theirs[k][j] >= REAL(0.0)) ^ (theirs[k][(j + 1) % 3] >= REAL(0.0)));
        crossings += meets ? REAL(1.0) : REAL(0.0);
        *sum = oz_choose2(meets, oz_add2(*sum, oz_along2(start, at, along)), *sum);
    }
    mask inside = high > low;
    elements->from[k] = oz_along2(start, inside ? low : REAL(0.0), along);
    elements->to[k] = oz_along2(start, inside ? high : REAL(0.0), along);
    elements->crossings[k] = crossings;
    elements->doubles += crossings > REAL(1.5) ? REAL(1.0) : REAL(0.0);
}

/* Twice the area and six times the first moment, about the origin, of what lies between the origin
 * and the elements; *along is the elements' sum. */
OZ_INLINE real oz_triangle_sweep(const OzTriangleElements *elements, OzVec2 origin, OzVec2 *moment,
                                 OzVec2 *along)
{
    real area = REAL(0.0);
    *moment = *along = oz_vec2(REAL(0.0), REAL(0.0));
    OZ_UNROLL
    for (int k = 0; k < 3; k++) {
        OzVec2 from = oz_minus2(elements->from[k], origin), to = oz_minus2(elements->to[k], origin);
        real part = oz_cross2(from, to);
        area += part;
        *moment = oz_along2(*moment, part, oz_add2(from, to));
        *along = oz_add2(*along, oz_minus2(to, from));
    }
    return area;
}

/* One of two triangles, and what is known of its edges. */
typedef struct OzTriangleEdges {
    const OzTriangle *triangle;
    const OzTriangleElements *elements;
    real (*theirs)[3]; /* m^2: the other's corners beside each of its edges, oz_triangle_sides */
} OzTriangleEdges;

/* Sums over the edges that share the push of kinds iii to vi. */
typedef struct OzTriangleShare {
    OzVec2 push; /* weight x normal, towards b    */
    real moment; /* weight x middle x normal      */
    real depth;  /* weight x depth of the centroid */
    real weight;
} OzTriangleShare;

/* How far (m) the other must go out along the normal of edge k, whose length is given. */
OZ_INLINE real oz_triangle_way_out(real theirs[3][3], int k, real length)
{
    return oz_larger(theirs[k][0], oz_larger(theirs[k][1], theirs[k][2])) / length;
}

/* Adds edges whose push on b has this sign; taken: they count at all; equal: of two
 * edges only that with the shortest way out, else each with its length. */
OZ_INLINE void oz_triangle_share(OzTriangleEdges edges, real sign, mask taken, mask equal,
                                 OzVec2 centroid, OzTriangleShare *share)
{
    const OzTriangle *t = edges.triangle;
    const OzTriangleElements *elements = edges.elements;
    real shortest = REAL(1e30);
    for (int k = 0; k < 3; k++) {
        real length = oz_length2(oz_minus2(t->corner[(k + 1) % 3], t->corner[k]));
        real way = oz_triangle_way_out(edges.theirs, k, length);
        shortest = elements->crossings[k] > REAL(1.5) ? oz_smaller(shortest, way) : shortest;
    }
    for (int k = 0; k < 3; k++) {
        OzVec2 edge = oz_minus2(t->corner[(k + 1) % 3], t->corner[k]);
        real length = oz_length2(edge);
        OzVec2 normal = oz_scale2(oz_right2(edge), REAL(1.0) / length);
        OzVec2 middle = oz_scale2(oz_add2(elements->from[k], elements->to[k]), REAL(0.5));
        mask entry = oz_triangle_way_out(edges.theirs, k, length) <= shortest;
        real weight = oz_length2(oz_minus2(elements->to[k], elements->from[k]));
        weight = equal ? (entry ? REAL(1.0) : REAL(0.0)) : weight;
        weight = (taken & (elements->crossings[k] > REAL(1.5))) ? weight : REAL(0.0);
        share->push = oz_along2(share->push, sign * weight, normal);
        share->moment += sign * weight * oz_cross2(middle, normal);
        share->depth += weight * oz_dot2(normal, oz_minus2(t->corner[k], centroid));
        share->weight += weight;
    }
}

/* Two crossings. middle lies between them; moments are first moments about it. */
OZ_INLINE void oz_triangle_two(OzOverlap *o, OzVec2 along_a, OzVec2 middle, OzVec2 moment_a,
                               OzVec2 moment_b)
{
    real length = oz_larger(oz_length2(along_a), REAL(OZ_TINY));
    OzVec2 normal = oz_scale2(oz_right2(along_a), REAL(1.0) / length);
    o->push = oz_scale2(normal, o->area);
    o->moment = oz_cross2(middle, o->push);
    o->energy = oz_magnitude(oz_dot2(normal, moment_a)) + oz_magnitude(oz_dot2(normal, moment_b));
}

/* Four crossings and more, or two edges with two. */
OZ_INLINE void oz_triangle_many(OzOverlap *o, mask many, OzTriangleEdges a, OzTriangleEdges b,
                                OzVec2 centroid)
{
    OzTriangleShare share = {{REAL(0.0), REAL(0.0)}, REAL(0.0), REAL(0.0), REAL(0.0)};
    real doubles_a = a.elements->doubles, doubles_b = b.elements->doubles;
    mask equal = (doubles_a > REAL(1.5)) & (doubles_a < REAL(2.5)) & (doubles_a == doubles_b);
    oz_triangle_share(a, REAL(1.0), doubles_a >= doubles_b, equal, centroid, &share);
    oz_triangle_share(b, REAL(-1.0), doubles_b >= doubles_a, equal, centroid, &share);
    real scale = o->area / oz_larger(share.weight, REAL(OZ_TINY));
    o->push = oz_choose2(many, oz_scale2(share.push, scale), o->push);
    o->moment = many ? share.moment * scale : o->moment;
    o->energy = many ? share.depth * scale : o->energy;
}

/* 1..6 from the number of edges with two crossings: kind ii has none, i one, vi two, iv three, iii
 * four, v six. */
OZ_INLINE real oz_triangle_kind(real doubles)
{
    real few = doubles > REAL(0.5) ? REAL(1.0) : REAL(2.0);
    real some = doubles > REAL(2.5) ? REAL(4.0) : REAL(6.0);
    real more = doubles > REAL(4.5) ? REAL(5.0) : REAL(3.0);
    return doubles > REAL(3.5) ? more : (doubles > REAL(1.5) ? some : few);
}

OZ_INLINE real oz_triangle_area(const OzTriangle *t)
{
    return REAL(0.5) * oz_triangle_side(t, 0, t->corner[2]);
}

/* What a does to b. Touching without crossing edges (one inside the other) pushes nothing. */
OZ_INLINE OzOverlap oz_triangle_overlap(const OzTriangle *a, const OzTriangle *b)
{
    OzOverlap o;
    OzTriangleElements of_a, of_b;
    OzVec2 middle = {REAL(0.0), REAL(0.0)}, unused = middle, moment_a, moment_b, along_a, along_b;
    real sides_a[3][3], sides_b[3][3];
    of_a.doubles = of_b.doubles = REAL(0.0);
    oz_triangle_sides(a, b, sides_a);
    oz_triangle_sides(b, a, sides_b);
    OZ_UNROLL
    for (int k = 0; k < 3; k++) {
        oz_triangle_clip(a, k, sides_b, sides_a, &of_a, &middle);
        oz_triangle_clip(b, k, sides_a, sides_b, &of_b, &unused);
    }
    real crossings = of_a.crossings[0] + of_a.crossings[1] + of_a.crossings[2];
    mask crosses = crossings > REAL(0.5);
    middle = oz_scale2(middle, REAL(1.0) / oz_larger(crossings, REAL(1.0)));
    real part_a = REAL(0.5) * oz_triangle_sweep(&of_a, middle, &moment_a, &along_a);
    real part_b = REAL(0.5) * oz_triangle_sweep(&of_b, middle, &moment_b, &along_b);
    real area_a = oz_triangle_area(a), area_b = oz_triangle_area(b);
    moment_a = oz_scale2(moment_a, REAL(1.0 / 6));
    moment_b = oz_scale2(moment_b, REAL(1.0 / 6));
    o.area = oz_larger(part_a + part_b, REAL(0.0));
    OzVec2 centroid = oz_along2(middle, REAL(1.0) / oz_larger(o.area, REAL(OZ_TINY)),
                                oz_add2(moment_a, moment_b));
    oz_triangle_two(&o, along_a, middle, moment_a, moment_b);
    real doubles = of_a.doubles + of_b.doubles;
    mask many = doubles > REAL(1.5);
    if (OZ_ANY(many)) {
        OzTriangleEdges edges_a = {a, &of_a, sides_a}, edges_b = {b, &of_b, sides_b};
        oz_triangle_many(&o, many, edges_a, edges_b, centroid);
    }
    o.centroid = centroid;
    o.moment = OZ_FORCE_POINT ? o.moment : oz_cross2(centroid, o.push);
    o.kind = crosses ? oz_triangle_kind(doubles) : REAL(0.0);
    /* all of the smaller one; edges that coincide leave some rounding's area */
    o.swallowed = (crossings < REAL(0.5)) & (REAL(2.0) * o.area > oz_smaller(area_a, area_b));
    real most_a = many ? o.area : part_a, most_b = many ? o.area : part_b;
    real areas = oz_larger(area_a * area_b, REAL(OZ_TINY));
    real share = oz_larger(most_a * area_b, most_b * area_a) / areas;
    o.share = crosses | o.swallowed ? share : REAL(0.0);
    o.deep = crosses & ((REAL(2.0) * most_a > area_a) | (REAL(2.0) * most_b > area_b));
    o.push = oz_choose2(crosses, o.push, oz_vec2(REAL(0.0), REAL(0.0)));
    o.moment = crosses ? o.moment : REAL(0.0);
    o.energy = crosses ? o.energy : REAL(0.0);
    return o;
}
