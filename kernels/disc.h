/* The contact of a disc with another or with a triangle's closest point: a spring (linear, or of
 * the power 3/2) and a dashpot along the normal, and a tangential dashpot without memory, limited
 * by Coulomb friction (Poeschel and Buchholtz 1995, eqs. 9-13, after Haff and Werner 1986).
 * Damping is per kg of effective mass; so is the linear spring. */
#pragma once

#include "kernels/element_law.h"
#include "kernels/triangle.h"

/* Where two elements meet; the normal points from a to b, the point is the middle of the overlap.
 */
typedef struct OzDiscPlace {
    OzVec2 normal, point;
    real overlap; /* m, > 0 while touching */
} OzDiscPlace;

typedef struct OzDiscForce {
    OzVec2 force;          /* N, on b at the place's point; a feels the opposite */
    real energy;           /* J, stored                                          */
    real power_normal;     /* W, dissipated along the normal                     */
    real power_tangential; /* W, dissipated across it                            */
    mask touching;
    mask slips; /* the drag is all that friction lets it be                      */
} OzDiscForce;

OZ_INLINE OzDiscPlace oz_disc_meet(OzVec2 a, real radius_a, OzVec2 b, real radius_b)
{
    OzDiscPlace place;
    OzVec2 apart = oz_minus2(b, a);
    real distance = oz_larger(oz_length2(apart), REAL(OZ_TINY));
    place.normal = oz_scale2(apart, REAL(1.0) / distance);
    place.overlap = radius_a + radius_b - distance;
    place.point = oz_along2(a, radius_a - REAL(0.5) * place.overlap, place.normal);
    return place;
}

/* The point of t's outline that is closest to p. */
OZ_INLINE OzVec2 oz_disc_closest(const OzTriangle *t, OzVec2 p)
{
    OzVec2 closest = t->corner[0];
    real least = REAL(1e30);
    for (int k = 0; k < 3; k++) {
        OzVec2 start = t->corner[k], edge = oz_minus2(t->corner[(k + 1) % 3], start);
        real along = oz_dot2(oz_minus2(p, start), edge) / oz_dot2(edge, edge);
        along = oz_larger(REAL(0.0), oz_smaller(REAL(1.0), along));
        OzVec2 point = oz_along2(start, along, edge), apart = oz_minus2(p, point);
        real distance2 = oz_dot2(apart, apart);
        closest = oz_choose2(distance2 < least, point, closest);
        least = oz_smaller(least, distance2);
    }
    return closest;
}

/* A triangle a and a disc b; a disc whose centre is inside is sent out by the closest edge. */
OZ_INLINE OzDiscPlace oz_disc_meet_triangle(const OzTriangle *a, OzVec2 b, real radius)
{
    OzDiscPlace place;
    OzVec2 closest = oz_disc_closest(a, b), apart = oz_minus2(b, closest);
    real first = oz_triangle_side(a, 0, b), second = oz_triangle_side(a, 1, b);
    real innermost = oz_smaller(oz_smaller(first, second), oz_triangle_side(a, 2, b));
    mask inside = innermost > REAL(0.0);
    real distance = oz_larger(oz_length2(apart), REAL(OZ_TINY));
    real away = inside ? -distance : distance;
    place.normal = oz_scale2(apart, REAL(1.0) / away);
    place.overlap = radius - away;
    place.point = oz_along2(closest, -REAL(0.5) * place.overlap, place.normal);
    return place;
}

/* velocity: of b's point against a's; mass: effective, kg. */
OZ_INLINE OzDiscForce oz_disc_force(OzDiscPlace place, OzVec2 velocity, real mass, OzDiscLaw law)
{
    OzDiscForce f;
    OzVec2 across = oz_left2(place.normal);
    real overlap = oz_larger(place.overlap, REAL(0.0));
    real leaving = oz_dot2(velocity, place.normal), sliding = oz_dot2(velocity, across);
    real linear = mass * law.stiffness * overlap, power = law.stiffness * overlap * sqrt(overlap);
    real spring = law.hertz > 0 ? power : linear;
    real dashpot = -mass * law.damping * leaving;
    dashpot = law.clamp > 0 ? oz_larger(dashpot, -spring) : dashpot;
    real most = law.friction * oz_magnitude(spring + dashpot);
    real drag = mass * law.tangential_damping * sliding;
    f.slips = oz_magnitude(drag) >= most;
    drag = oz_larger(-most, oz_smaller(most, drag));
    f.touching = place.overlap > REAL(0.0);
    f.force = oz_along2(oz_scale2(place.normal, spring + dashpot), -drag, across);
    f.force = oz_choose2(f.touching, f.force, oz_vec2(REAL(0.0), REAL(0.0)));
    f.energy = spring * overlap * (law.hertz > 0 ? REAL(0.4) : REAL(0.5));
    f.power_normal = f.touching ? -dashpot * leaving : REAL(0.0);
    f.power_tangential = f.touching ? drag * sliding : REAL(0.0);
    return f;
}
