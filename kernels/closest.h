/* The closest points of two shafts (Pournin et al. 2005, sec. 3.1), with every degenerate case: spheres
 * (half-shaft zero), parallel, anti-parallel and collinear shafts, crossing shafts.
 * The paper's D = ac - b^2 and bd - ae are taken as products of cross products (Lagrange's identity):
 * the same numbers, but without the cancellation that ruins them for nearly parallel shafts. */
#pragma once

#include "kernels/vec3.h"

/* Positions along the shafts, in -1..1: y1 = x1 + s a1, y2 = x2 + t a2. */
typedef struct OzClosest {
    real s, t;
} OzClosest;

/* Where a parallel pair touches along shaft 2: the middle of the common span, or the nearest end. b, c
 * and e as in the paper. */
OZ_INLINE real oz_closest_parallel(real b, real e, real inverse_c)
{
    real one = (-e - b) * inverse_c, other = (-e + b) * inverse_c;
    real low = oz_larger(REAL(-1.0), oz_smaller(one, other));
    real high = oz_smaller(REAL(1.0), oz_larger(one, other));
    return REAL(0.5) * (low + high);
}

/* apart = x1 - x2; a1, a2 half-shafts. */
OZ_INLINE OzClosest oz_closest(OzVec3 apart, OzVec3 a1, OzVec3 a2)
{
    OzVec3 across = oz_cross(a1, a2);
    real a = oz_dot(a1, a1), b = -oz_dot(a1, a2), c = oz_dot(a2, a2);
    real d = oz_dot(a1, apart), e = -oz_dot(a2, apart);
    real determinant = oz_dot(across, across);
    mask skew = determinant > OZ_PARALLEL * (a * c);
    real inverse_a = oz_inverse(oz_larger(a, REAL(OZ_TINY * OZ_TINY)));
    real inverse_c = oz_inverse(oz_larger(c, REAL(OZ_TINY * OZ_TINY)));
    real general = oz_dot(across, oz_cross(a1, apart)) * oz_inverse(skew ? determinant : REAL(1.0));
    OzClosest at;
    at.t = oz_clamp_unit(skew ? general : oz_closest_parallel(b, e, inverse_c));
    real free_s = (-b * at.t - d) * inverse_a;
    at.s = oz_clamp_unit(free_s);
    at.t = free_s == at.s ? at.t : oz_clamp_unit((-b * at.s - e) * inverse_c);
    return at;
}

/* The same for two spheres costs nothing. */
OZ_INLINE OzClosest oz_closest_spheres(void)
{
    OzClosest at = {REAL(0.0), REAL(0.0)};
    return at;
}
