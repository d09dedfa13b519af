/* The overlap of two elements' triangles, by the contact that the scene asks for. For .c files that
 * have entered the scene's switches (sim/host_switches.h). */
#pragma once

#include "model/elements.h"
#include "sim/element_dialect.h"

/* edges: bits of the outer ones. */
static inline OzFieldPair oz_element_overlap_pair(int edges_a, int edges_b, bool b_is_wall)
{
    OzFieldPair pair;
    for (int k = 0; k < 3; k++) {
        pair.outer_a[k] = edges_a >> k & 1;
        pair.outer_b[k] = edges_b >> k & 1;
    }
    oz_field_weigh(&pair, b_is_wall);
    return pair;
}

static inline OzFieldPair oz_element_overlap_field(const OzElements *elements, int a, int b)
{
    return oz_element_overlap_pair(oz_elements_outer_edges(elements, a),
                                   oz_elements_outer_edges(elements, b), b >= elements->free_count);
}

/* Of elements a and b, which are where the triangles say. With a potential, all but push, moment,
 * share and energy are what they are besides. */
static inline OzOverlap oz_element_overlap_find(const OzElements *elements, int a, int b,
                                                const OzTriangle *one, const OzTriangle *other)
{
    OzOverlap o = oz_triangle_overlap(one, other);
    if (OZ_TRIANGLE_FIELD) {
        OzFieldPair pair = oz_element_overlap_field(elements, a, b);
        OzOverlap felt = oz_field_overlap(one, other, &pair);
        o.push = felt.push;
        o.moment = felt.moment;
        o.share = felt.share;
        o.energy = oz_field_energy(one, other, &pair);
    }
    return o;
}
