/* The overlap of two elements' triangles, by the contact that the scene asks for. For .c files that
 * have entered the scene's switches (sim/host_switches.h). */
#pragma once

#include "model/elements.h"
#include "sim/element_dialect.h"

static inline OzFieldPair oz_element_overlap_field(const OzElements *elements, int a, int b)
{
    OzFieldPair pair;
    int edges_a = oz_elements_outer_edges(elements, a);
    int edges_b = oz_elements_outer_edges(elements, b);
    for (int k = 0; k < 3; k++) {
        pair.outer_a[k] = edges_a >> k & 1;
        pair.outer_b[k] = edges_b >> k & 1;
    }
    oz_field_weigh(&pair, b >= elements->free_count);
    return pair;
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
