/* Vectors of two lanes-wide numbers, in the plane of grains made of triangles. */
#pragma once

#include "kernels/real.h"

typedef struct OzVec2 {
    real x, y;
} OzVec2;

OZ_INLINE OzVec2 oz_vec2(real x, real y)
{
    OzVec2 v = {x, y};
    return v;
}

OZ_INLINE OzVec2 oz_add2(OzVec2 a, OzVec2 b)
{
    return oz_vec2(a.x + b.x, a.y + b.y);
}

OZ_INLINE OzVec2 oz_minus2(OzVec2 a, OzVec2 b)
{
    return oz_vec2(a.x - b.x, a.y - b.y);
}

OZ_INLINE OzVec2 oz_scale2(OzVec2 a, real s)
{
    return oz_vec2(a.x * s, a.y * s);
}

/* a + s b */
OZ_INLINE OzVec2 oz_along2(OzVec2 a, real s, OzVec2 b)
{
    return oz_vec2(a.x + s * b.x, a.y + s * b.y);
}

OZ_INLINE real oz_dot2(OzVec2 a, OzVec2 b)
{
    return a.x * b.x + a.y * b.y;
}

/* The z component of the cross product: > 0 when b lies counter-clockwise of a. */
OZ_INLINE real oz_cross2(OzVec2 a, OzVec2 b)
{
    return a.x * b.y - a.y * b.x;
}

/* a turned by a right angle counter-clockwise; turned clockwise it is the outward normal of a
 * counter-clockwise outline's edge. */
OZ_INLINE OzVec2 oz_left2(OzVec2 a)
{
    return oz_vec2(-a.y, a.x);
}

OZ_INLINE OzVec2 oz_right2(OzVec2 a)
{
    return oz_vec2(a.y, -a.x);
}

/* a where the condition holds, else b. */
OZ_INLINE OzVec2 oz_choose2(mask condition, OzVec2 a, OzVec2 b)
{
    return oz_vec2(condition ? a.x : b.x, condition ? a.y : b.y);
}

OZ_INLINE real oz_length2(OzVec2 a)
{
    return sqrt(oz_dot2(a, a));
}
