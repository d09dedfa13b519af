/* A contact of two triangles that has a potential in every kind (after Munjiza's potential contact,
 * The Combined Finite-Discrete Element Method, 2004, section 2.3, with a field measured from the
 * outside of a grain). The depth of a point of a triangle is its distance (m) from the nearest of
 * the triangle's outer edges, those on the outside of its grain or wall. Times the stiffness Y, the
 * potential of triangles a and b is
 *   U = weight_a (integral of a's depth over the overlap) + weight_b (integral of b's depth),
 * and what they feel is its exact gradient: pieces of b's edges in a, weighted by a's depth there,
 * push b, and pieces of a's edges in b, by b's depth, push a. A piece without length adds nothing,
 * so no kind of crossing is told from another, and a triangle inside another is pushed out too.
 * The depth is linear over a facet, the part of a triangle that is nearest to one outer edge; a
 * triangle of one outer edge is one facet. In a triangle without an outer edge the depth is its
 * inradius everywhere. Where depth jumps across an edge inside a grain the force jumps, and the
 * potential does not. */
#pragma once

#include "kernels/triangle.h"

/* depth(x) = rise . (x - corner) + offset, m */
typedef struct OzFieldFacet {
    OzVec2 rise, corner;
    real offset;
    mask present;
} OzFieldFacet;

/* One of two triangles as its field tells. */
typedef struct OzFieldSide {
    OzFieldFacet facet[3]; /* by edge */
} OzFieldSide;

/* A part of an edge, from its start at low to high, of 0..1; empty unless high > low. */
typedef struct OzFieldSpan {
    real low, high;
} OzFieldSpan;

OZ_INLINE real oz_field_depth(const OzFieldFacet *facet, OzVec2 point)
{
    return oz_dot2(facet->rise, oz_minus2(point, facet->corner)) + facet->offset;
}

/* The radius of the circle inside, m. */
OZ_INLINE real oz_field_inradius(const OzTriangle *t)
{
    real around = REAL(0.0);
    OZ_UNROLL
    for (int k = 0; k < 3; k++) {
        around += oz_length2(oz_minus2(t->corner[(k + 1) % 3], t->corner[k]));
    }
    return REAL(2.0) * oz_triangle_area(t) / around;
}

/* outer[k]: edge k is an outer one. A facet that is not there is deeper than every other. */
OZ_INLINE OzFieldSide oz_field_side(const OzTriangle *t, const mask outer[3])
{
    OzFieldSide side;
    OzVec2 nothing = {REAL(0.0), REAL(0.0)};
    mask none = !(outer[0] | outer[1] | outer[2]);
    OZ_UNROLL
    for (int k = 0; k < 3; k++) {
        OzFieldFacet *facet = &side.facet[k];
        facet->present = outer[k];
        facet->corner = t->corner[k];
        facet->rise = nothing;
        facet->offset = outer[k] ? REAL(0.0) : REAL(OZ_HUGE);
        if (OZ_ANY(outer[k])) {
            OzVec2 inward = oz_left2(oz_minus2(t->corner[(k + 1) % 3], t->corner[k]));
            inward = oz_scale2(inward, REAL(1.0) / oz_length2(inward));
            facet->rise = oz_choose2(outer[k], inward, nothing);
        }
    }
    if (OZ_ANY(none)) {
        side.facet[0].offset = none ? oz_field_inradius(t) : side.facet[0].offset;
        side.facet[0].present = side.facet[0].present | none;
    }
    return side;
}

/* Cuts off where a number that is `start` at 0 and `end` at 1 is not above 0; inside_start and
 * inside_end say where it is. */
OZ_INLINE void oz_field_cut(OzFieldSpan *span, real start, real end, mask inside_start,
                            mask inside_end)
{
    mask changes = inside_start ^ inside_end;
    real at = start / (changes ? start - end : REAL(1.0));
    span->low = (changes & inside_end) ? oz_larger(span->low, at) : span->low;
    span->high = (changes & inside_start) ? oz_smaller(span->high, at) : span->high;
    span->high = (inside_start | inside_end) ? span->high : REAL(-1.0);
}

/* Cuts off of an edge what is nearer to facet j's outer edge than to facet k's. What is as near to
 * both belongs to the first. */
OZ_INLINE void oz_field_part(const OzFieldSide *side, int k, int j, OzVec2 from, OzVec2 to,
                             OzFieldSpan *span)
{
    const OzFieldFacet *facet = &side->facet[k], *other = &side->facet[j];
    if (OZ_ANY(other->present)) {
        real start = oz_field_depth(other, from) - oz_field_depth(facet, from);
        real end = oz_field_depth(other, to) - oz_field_depth(facet, to);
        mask in_start = j > k ? start >= REAL(0.0) : start > REAL(0.0);
        mask in_end = j > k ? end >= REAL(0.0) : end > REAL(0.0);
        oz_field_cut(span, start, end, in_start, in_end);
    }
}

/* A piece of an edge in one facet, and the facet's depth at its ends. */
typedef struct OzFieldPiece {
    OzVec2 start, along;
    real first, last;
} OzFieldPiece;

OZ_INLINE OzFieldPiece oz_field_cut_out(const OzFieldFacet *facet, OzFieldSpan span, mask some,
                                        OzVec2 from, OzVec2 to)
{
    OzFieldPiece piece;
    OzVec2 along = oz_minus2(to, from);
    some = some & (span.high > span.low);
    piece.start = oz_along2(from, some ? span.low : REAL(0.0), along);
    piece.along = oz_scale2(along, some ? span.high - span.low : REAL(0.0));
    piece.first = some ? oz_field_depth(facet, piece.start) : REAL(0.0);
    piece.last = piece.first + oz_dot2(facet->rise, piece.along);
    return piece;
}

/* What of an edge inside the triangle is in its facet k. */
OZ_INLINE OzFieldPiece oz_field_piece(const OzFieldSide *side, int k, OzVec2 from, OzVec2 to)
{
    OzFieldSpan span = {REAL(0.0), REAL(1.0)};
    oz_field_part(side, k, (k + 1) % 3, from, to, &span);
    oz_field_part(side, k, (k + 2) % 3, from, to, &span);
    return oz_field_cut_out(&side->facet[k], span, side->facet[k].present, from, to);
}

/* The facet of a triangle that has one outer edge. */
OZ_INLINE OzFieldFacet oz_field_only(const OzTriangle *t, const mask outer[3])
{
    OzFieldFacet only;
    OzVec2 end = oz_choose2(outer[1], t->corner[2], t->corner[1]);
    end = oz_choose2(outer[2], t->corner[0], end);
    only.corner = oz_choose2(outer[1], t->corner[1], t->corner[0]);
    only.corner = oz_choose2(outer[2], t->corner[2], only.corner);
    OzVec2 inward = oz_left2(oz_minus2(end, only.corner));
    only.rise = oz_scale2(inward, REAL(1.0) / oz_length2(inward));
    only.offset = REAL(0.0);
    only.present = outer[0] | outer[1] | outer[2];
    return only;
}

/* Adds the push of a field on a piece of an edge. */
OZ_INLINE void oz_field_press(OzFieldPiece p, real weight, OzOverlap *o)
{
    real mean = REAL(0.5) * (p.first + p.last);
    real bend = p.first * REAL(1.0 / 6) + p.last * REAL(1.0 / 3);
    o->push = oz_along2(o->push, -weight * mean, oz_right2(p.along));
    o->moment += weight * (mean * oz_dot2(p.start, p.along) + bend * oz_dot2(p.along, p.along));
}

/* Adds what the field of triangle t does to the other, whose edges in t are given: times `weight`,
 * which is negative when the field is b's and the edges are a's. */
OZ_INLINE void oz_field_push(const OzTriangle *t, const mask outer[3],
                             const OzTriangleElements *edges, real weight, OzOverlap *o)
{
    mask odd = outer[0] ^ outer[1] ^ outer[2], all = outer[0] & outer[1] & outer[2];
    if (OZ_ANY(all | !odd)) { /* not one outer edge */
        OzFieldSide side = oz_field_side(t, outer);
        OZ_UNROLL
        for (int i = 0; i < 9; i++) {
            int k = i / 3, e = i % 3;
            oz_field_press(oz_field_piece(&side, k, edges->from[e], edges->to[e]), weight, o);
        }
    } else {
        OzFieldFacet only = oz_field_only(t, outer);
        OZ_UNROLL
        for (int e = 0; e < 3; e++) {
            OzFieldPiece p;
            p.start = edges->from[e];
            p.along = oz_minus2(edges->to[e], edges->from[e]);
            p.first = oz_field_depth(&only, p.start);
            p.last = p.first + oz_dot2(only.rise, p.along);
            oz_field_press(p, weight, o);
        }
    }
}

/* The edges of a and b inside the other. */
OZ_INLINE void oz_field_edges(const OzTriangle *a, const OzTriangle *b, OzTriangleElements *of_a,
                              OzTriangleElements *of_b)
{
    OzVec2 unused = {REAL(0.0), REAL(0.0)};
    real sides_a[3][3], sides_b[3][3];
    of_a->doubles = of_b->doubles = REAL(0.0);
    oz_triangle_sides(a, b, sides_a);
    oz_triangle_sides(b, a, sides_b);
    OZ_UNROLL
    for (int k = 0; k < 3; k++) {
        oz_triangle_clip(a, k, sides_b, sides_a, of_a, &unused);
        oz_triangle_clip(b, k, sides_a, sides_b, of_b, &unused);
    }
}

/* The field of a pair: which edges of each are outer ones, and how much each one's depth counts. */
typedef struct OzFieldPair {
    mask outer_a[3], outer_b[3];
    real weight_a, weight_b; /* a half each among grains; against walls b's does not count */
} OzFieldPair;

OZ_INLINE void oz_field_weigh(OzFieldPair *pair, mask b_is_wall)
{
    pair->weight_a = b_is_wall ? REAL(1.0) : REAL(0.5);
    pair->weight_b = b_is_wall ? REAL(0.0) : REAL(0.5);
}

/* What a does to b: push, moment, area and share. Nothing is too deep for it: the masks are false.
 */
OZ_INLINE OzOverlap oz_field_overlap(const OzTriangle *a, const OzTriangle *b,
                                     const OzFieldPair *pair)
{
    OzOverlap o;
    OzTriangleElements of_a, of_b;
    OzVec2 origin = {REAL(0.0), REAL(0.0)}, moment, along;
    oz_field_edges(a, b, &of_a, &of_b);
    o.push = origin;
    o.moment = REAL(0.0);
    oz_field_push(a, pair->outer_a, &of_b, pair->weight_a, &o);
    oz_field_push(b, pair->outer_b, &of_a, -pair->weight_b, &o);
    o.area = REAL(0.5) * (oz_triangle_sweep(&of_a, origin, &moment, &along) +
                          oz_triangle_sweep(&of_b, origin, &moment, &along));
    o.area = oz_larger(o.area, REAL(0.0));
    real smaller = oz_smaller(oz_triangle_area(a), oz_triangle_area(b));
    o.share = o.area / oz_larger(smaller, REAL(OZ_TINY));
    o.deep = o.swallowed = o.share < REAL(0.0);
    return o;
}

/* A piece's part of the integral of depth over what its outline encloses (m^3), by the divergence
 * theorem: outline of the overlap, the overlap on the left. */
OZ_INLINE real oz_field_enclosed(const OzFieldFacet *facet, OzFieldPiece p)
{
    real square = p.first * p.first + p.first * p.last + p.last * p.last;
    real sloped = oz_dot2(facet->rise, oz_right2(p.along)) * square * REAL(1.0 / 6);
    real flat = REAL(0.5) * oz_cross2(p.start, p.along) * p.first;
    mask is_flat = oz_dot2(facet->rise, facet->rise) < REAL(0.5);
    return is_flat ? flat : sloped;
}

/* The border between facets k and the next, as far as it lies in b, facet k on its left: along the
 * bisector of the corner between their edges to the opposite edge. */
OZ_INLINE OzFieldPiece oz_field_border(const OzTriangle *t, const OzFieldSide *side, int k,
                                       const OzTriangle *b)
{
    OzVec2 before = t->corner[k], from = t->corner[(k + 1) % 3], after = t->corner[(k + 2) % 3];
    real to_before = oz_length2(oz_minus2(before, from));
    real to_after = oz_length2(oz_minus2(after, from));
    OzVec2 to = oz_along2(before, to_before / (to_before + to_after), oz_minus2(after, before));
    OzFieldSpan span = {REAL(0.0), REAL(1.0)};
    for (int e = 0; e < 3; e++) {
        real start = oz_triangle_side(b, e, from), end = oz_triangle_side(b, e, to);
        oz_field_cut(&span, start, end, start >= REAL(0.0), end >= REAL(0.0));
    }
    oz_field_part(side, k, (k + 2) % 3, from, to, &span);
    mask both = side->facet[k].present & side->facet[(k + 1) % 3].present;
    return oz_field_cut_out(&side->facet[k], span, both, from, to);
}

/* The integral of a triangle's depth over its overlap with b, m^3; edges: of both in the other. */
OZ_INLINE real oz_field_integral(const OzTriangle *t, const OzFieldSide *side, const OzTriangle *b,
                                 const OzTriangleElements *own, const OzTriangleElements *edges)
{
    real sum = REAL(0.0);
    for (int k = 0; k < 3; k++) {
        const OzFieldFacet *facet = &side->facet[k];
        OzFieldPiece border = oz_field_border(t, side, k, b);
        sum += oz_field_enclosed(facet, border);
        sum -= oz_field_enclosed(&side->facet[(k + 1) % 3], border);
        for (int e = 0; e < 3; e++) {
            OzFieldPiece mine = oz_field_piece(side, k, own->from[e], own->to[e]);
            OzFieldPiece other = oz_field_piece(side, k, edges->from[e], edges->to[e]);
            sum += oz_field_enclosed(facet, mine) + oz_field_enclosed(facet, other);
        }
    }
    return sum;
}

/* The potential, m^3: times the stiffness, J for each metre of depth. */
OZ_INLINE real oz_field_energy(const OzTriangle *a, const OzTriangle *b, const OzFieldPair *pair)
{
    OzTriangleElements of_a, of_b;
    oz_field_edges(a, b, &of_a, &of_b);
    OzFieldSide side_a = oz_field_side(a, pair->outer_a);
    OzFieldSide side_b = oz_field_side(b, pair->outer_b);
    return pair->weight_a * oz_field_integral(a, &side_a, b, &of_a, &of_b) +
           pair->weight_b * oz_field_integral(b, &side_b, a, &of_b, &of_a);
}
