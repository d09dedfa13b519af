/* Which pairs of elements may touch: a cheap test that is never wrong about pairs that do. OpenCL C
 * only. */
#ifndef OZ_KERNELS_ELEMENT_NEAR_H
#define OZ_KERNELS_ELEMENT_NEAR_H

#include "kernels/element_work.h"

OZ_INLINE real oz_element_pair_list_radius(const OzElementWork *w, const int *slots)
{
    scalar radius[OZ_LANES];
    for (int l = 0; l < OZ_LANES; l++) {
        radius[l] = w->record[(size_t)slots[l] * OZ_ELEMENT_RECORD + OZ_PR_RADIUS];
    }
    return OZ_LANES_LOAD(radius);
}

/* False only for pairs farther apart than margin. slots: of b. A disc is a triangle of no size with
 * a radius, whose edges separate nothing: of two discs the distance decides. */
OZ_INLINE mask oz_element_pair_list_pair(const OzElementWork *w, const OzElement *a, real radius_a,
                                         const OzElement *b, const int *slots, real margin)
{
#if OZ_DISCS
    real radius_b = oz_element_pair_list_radius(w, slots), all = margin + radius_a + radius_b;
    OzVec2 apart = oz_minus2(b->position, a->position);
    mask discs = (radius_a > REAL(0.0)) & (radius_b > REAL(0.0));
    mask apart_discs = discs & (oz_dot2(apart, apart) > all * all);
    return oz_triangle_near(&a->triangle, &b->triangle, all) & !apart_discs;
#else
    return oz_triangle_near(&a->triangle, &b->triangle, margin);
#endif
}

OZ_INLINE mask oz_element_pair_list_slots(const OzElementWork *w, const int *a, const int *b,
                                          real margin)
{
    OzElement first = oz_element_work_element(w, a), second = oz_element_work_element(w, b);
    real radius = OZ_DISCS ? oz_element_pair_list_radius(w, a) : REAL(0.0);
    return oz_element_pair_list_pair(w, &first, radius, &second, b, margin);
}

#endif
