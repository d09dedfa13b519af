/* `parallel: line` (switch OZ_LINE): a contact of two grains whose force and torque are continuous in the
 * angle between their shafts. The single contact of the closest points swings from one end of the common span
 * to the other as the angle of nearly parallel shafts passes zero; here the stored energy is
 *     U = w E(xi_0) + (1 - w) (E(xi_u) + E(xi_l)) / 2,
 * E(xi) the law's energy, xi_0 the overlap at the closest points, xi_u and xi_l those at the upper and lower
 * end of the common span, w = x (2 - x) with x = min(1, sin^2(angle) / sin^2(angle_0)). Parallel shafts touch
 * at the two ends with half the stiffness each, skew ones (beyond angle_0) at the closest points with all of
 * it, and the whole is continuous and, being the gradient of U (with the couple -dU/dw grad w), conservative.
 * angle_0: its ends stand 0.2 (r_a + r_b) aside, at most 45 degrees. Narrower, the torque rises more steeply
 * through zero; wider, rods that cross are held at two points where they touch in one. For aspect -> 0 all
 * points coincide and U is the spheres' E(xi).
 * Either end of the span is an end of a shaft against the nearest point of the other shaft: the pair of the
 * two candidates (a's end, b's end) with the larger overlap, the choice softened over OZ_LINE_SOFT of the
 * smaller half-shaft (or of r_a + r_b) so that the force glides from one to the other.
 * Each point has its own dashpot. The tangential spring is one for the pair, at the overlap-weighted mean of
 * the points: a spring at each would be carried from one material point to another as ends change places and
 * weights come and go, and would need three times the memory; what is lost is friction's couple against
 * turning about the normal. */
#pragma once

#include "kernels/grain.h"

/* Staggered shafts touch deeper than aligned ones by a quarter of this: far below any overlap that matters. */
#define OZ_LINE_SOFT 0.002
#define OZ_LINE_ASIDE 0.2

/* What the points of a pair add up to. */
typedef struct OzLine {
    OzVec3 force, torque_a, torque_b;              /* N on b; N m about each centre            */
    OzVec3 dashpot;                                /* N on b                                   */
    OzVec3 dashpot_a, dashpot_b;                   /* N m, the dashpots' torques                */
    OzVec3 normal, arm_a, arm_b;                   /* overlap-weighted sums                     */
    real overlap;                                  /* m, weighted sum                           */
    real push, spring, energy;                     /* N, the spring's part of it, J             */
    real tangential_stiffness, tangential_damping; /* N/m, kg/s                                 */
} OzLine;

/* N, of spring, dashpot and adhesion. */
OZ_INLINE real oz_line_net(OzResponse response)
{
    real press = response.spring + response.dashpot;
    return OZ_ADHESION ? press - response.adhesion : press;
}

/* Adds what the law answers at a spring of overlap and rate as in `whole`, acting through one point of it with
 * the given share. */
OZ_INLINE void oz_line_add(OzLine *sum, OzContact at, OzVec3 arm_a, OzVec3 arm_b, OzResponse response,
                           real overlap, real share)
{
    OzVec3 force = oz_scale(at.normal, share * oz_line_net(response));
    OzVec3 dashpot = oz_scale(at.normal, share * response.dashpot);
    real depth = share * overlap;
    sum->force = oz_add(sum->force, force);
    sum->torque_a = oz_add(sum->torque_a, oz_cross(force, arm_a));
    sum->torque_b = oz_add(sum->torque_b, oz_cross(arm_b, force));
    sum->dashpot = oz_add(sum->dashpot, dashpot);
    sum->dashpot_a = oz_add(sum->dashpot_a, oz_cross(dashpot, arm_a));
    sum->dashpot_b = oz_add(sum->dashpot_b, oz_cross(arm_b, dashpot));
    sum->normal = oz_along(sum->normal, depth, at.normal);
    sum->arm_a = oz_along(sum->arm_a, depth, arm_a);
    sum->arm_b = oz_along(sum->arm_b, depth, arm_b);
    sum->overlap += depth;
    sum->push += share * (response.spring + response.dashpot);
    sum->spring += share * response.spring;
    sum->energy += share * response.energy;
    sum->tangential_stiffness += share * response.tangential_stiffness;
    sum->tangential_damping += share * response.tangential_damping;
}

/* The answer of a law to a contact, nothing where it does not touch. */
OZ_INLINE OzResponse oz_line_response(OzContact c, OZ_LAW law)
{
    mask touching = c.overlap > REAL(0.0);
    OzResponse r = oz_contact_response(c, law);
    r.spring = touching ? r.spring : REAL(0.0);
    r.dashpot = touching ? r.dashpot : REAL(0.0);
    r.adhesion = touching ? r.adhesion : REAL(0.0);
    r.energy = touching ? r.energy : REAL(0.0);
    r.tangential_stiffness = touching ? r.tangential_stiffness : REAL(0.0);
    r.tangential_damping = touching ? r.tangential_damping : REAL(0.0);
    return r;
}

/* One end of the span: the closest points to an end of a and to an end of b. */
typedef struct OzLineEnd {
    OzClosest of_a, of_b;
    real soft;  /* m: over which the choice between the two is softened */
    real share; /* of the whole contact                                 */
} OzLineEnd;

/* Adds one end of the span; gives the energy of its spring. */
OZ_INLINE real oz_line_end(OzLine *sum, OzGrain a, OzGrain b, OzVec3 apart, OZ_LAW law,
                           OzLineEnd at)
{
    OzVec3 arm_a[2], arm_b[2];
    mask crossed;
    OzContact one = oz_grain_contact(a, b, apart, at.of_a, &arm_a[0], &arm_b[0], &crossed);
    OzContact two = oz_grain_contact(a, b, apart, at.of_b, &arm_a[1], &arm_b[1], &crossed);
    real lead = oz_clamp_unit((one.overlap - two.overlap) / at.soft);
    real first = REAL(0.5) * (REAL(1.0) + lead), second = REAL(0.5) * (REAL(1.0) - lead);
    OzContact end = one;
    /* the larger of both, less a quarter of soft once they differ by more than soft */
    end.overlap = first * one.overlap + second * two.overlap - REAL(0.25) * at.soft * lead * lead;
    end.rate = first * one.rate + second * two.rate;
    end.lightness = first * one.lightness + second * two.lightness;
    OzResponse response = oz_line_response(end, law);
    real overlap = oz_larger(end.overlap, REAL(0.0));
    oz_line_add(sum, one, arm_a[0], arm_b[0], response, overlap, at.share * first);
    oz_line_add(sum, two, arm_a[1], arm_b[1], response, overlap, at.share * second);
    return response.energy;
}

/* Both ends of the span share what the skewness (w) leaves; gives the mean energy of their springs. */
OZ_INLINE real oz_line_ends(OzLine *sum, OzGrain a, OzGrain b, OzVec3 apart, OZ_LAW law, real skew)
{
    OzVec3 a1 = a.half_shaft, a2 = b.half_shaft;
    real aa = oz_dot(a1, a1), ab = oz_dot(a1, a2), bb = oz_dot(a2, a2);
    real inverse_aa = REAL(1.0) / oz_larger(aa, REAL(OZ_TINY * OZ_TINY));
    real inverse_bb = REAL(1.0) / oz_larger(bb, REAL(OZ_TINY * OZ_TINY));
    real along_a = oz_dot(a1, apart), along_b = oz_dot(a2, apart);
    real shorter = sqrt(oz_smaller(aa, bb)), share = REAL(0.5) * (REAL(1.0) - skew);
    real soft = REAL(OZ_LINE_SOFT) * oz_smaller(shorter, a.radius + b.radius);
    soft = oz_larger(soft, REAL(OZ_TINY));
    real sense = ab < REAL(0.0) ? REAL(-1.0) : REAL(1.0), energy = REAL(0.0);
    for (int end = 0; end < 2; end++) {
        real s = REAL(end ? -1.0 : 1.0), t = s * sense;
        OzLineEnd at = {{s, oz_clamp_unit((ab * s + along_b) * inverse_bb)},
                        {oz_clamp_unit((ab * t - along_a) * inverse_aa), t},
                        soft,
                        share};
        energy += REAL(0.5) * oz_line_end(sum, a, b, apart, law, at);
    }
    return energy;
}

/* All points of a pair but for friction; c is the contact at the closest points. */
OZ_INLINE OzLine oz_line_sum(OzGrain a, OzGrain b, OzVec3 apart, OZ_LAW law, OzContact c,
                             OzVec3 arm_a, OzVec3 arm_b)
{
    OzVec3 none = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0)), a1 = a.half_shaft, a2 = b.half_shaft;
    real zero = REAL(0.0), aa = oz_dot(a1, a1), bb = oz_dot(a2, a2), reach = a.radius + b.radius;
    OzLine sum = {none, none, none, none, none, none, none, none,
                  none, zero, zero, zero, zero, zero, zero};
    OzVec3 across = oz_cross(a1, a2);
    real aabb = oz_larger(aa * bb, REAL(OZ_TINY * OZ_TINY));
    real widest = REAL(OZ_LINE_ASIDE * OZ_LINE_ASIDE) * reach * reach /
                  oz_larger(oz_smaller(aa, bb), REAL(OZ_TINY * OZ_TINY));
    real inverse_widest = REAL(1.0) / oz_smaller(widest, REAL(0.5));
    real x = oz_smaller(oz_dot(across, across) / aabb * inverse_widest, REAL(1.0));
    real skew = x * (REAL(2.0) - x);
    real ends = oz_line_ends(&sum, a, b, apart, law, skew);
    OzResponse response = oz_line_response(c, law);
    oz_line_add(&sum, c, arm_a, arm_b, response, oz_larger(c.overlap, zero), skew);
    /* the couple -dU/dw grad w, w's slope in sin^2(angle) being 2 (1 - x) / sin^2(angle_0) */
    real slope = REAL(2.0) * (REAL(1.0) - x) * inverse_widest;
    real couple = REAL(2.0) * slope * (response.energy - ends) * oz_dot(a1, a2) / aabb;
    sum.torque_a = oz_along(sum.torque_a, couple, across);
    sum.torque_b = oz_along(sum.torque_b, -couple, across);
    return sum;
}
