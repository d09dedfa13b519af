/* Resistance against rolling and twisting: a couple on both bodies, against their rotation relative
 * to each other. Switches: OZ_ROLLING 1: there is any; OZ_ROLLING_SPRING 1: against rolling there
 * is a spring. Without a spring rolling meets the constant couple mu_r R* |f_n| (model A of Ai,
 * Chen, Rotter & Ooi 2011, Powder Technology 206, 269). With it (their model C) an elastic-plastic
 * spring with a dashpot: the stiffness is k_r = 2.25 k_n mu_r^2 R*^2, k_n the normal spring's force
 * over overlap; at mu_r R* |f_n| it yields, and the dashpot, a share of critical damping 2 sqrt(I_r
 * k_r), is off. 1/I_r is the sum of both bodies' 1/(7/5 m r^2): spheres that roll on their contact.
 * Rotation about the normal always meets a constant couple, mu_t R* |f_n|. Constant couples fade
 * below the rate that they would end in OZ_ROLLING_STEPS steps: else they would turn what rests to
 * and fro. */
#pragma once

#include "kernels/contact.h"

/* With fewer a grain of several contacts, of which each ends the rotation, would swing. */
#define OZ_ROLLING_STEPS 8

/* The couple `limit` (N m) against a rotation. */
OZ_INLINE OzVec3 oz_rolling_constant(OzVec3 turning, real limit, real inertia, scalar dt)
{
    real rate = sqrt(oz_dot(turning, turning));
    real fade = limit * REAL(dt * OZ_ROLLING_STEPS) / (REAL(0.4) * inertia);
    real least = oz_larger(rate, fade);
    return oz_scale(turning, -limit / oz_larger(least, REAL(OZ_TINY)));
}

/* The spring's and the dashpot's couple; the spring yields at `limit`. */
OZ_INLINE OzCouple oz_rolling_spring(OzContact c, OZ_LAW law, OzVec3 rolling, real limit,
                                     real stiffness, OzMemory *memory, scalar dt, scalar share)
{
    OzCouple couple;
    OzVec3 none = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0));
    OzVec3 turned = oz_along(oz_contact_turn(memory->turned, c.normal), REAL(share * dt), rolling);
    OzVec3 whole = oz_scale(turned, stiffness);
    real size2 = oz_dot(whole, whole);
    mask yields = size2 > limit * limit;
    real cut =
        yields ? limit * oz_inverse_root(oz_larger(size2, REAL(OZ_TINY * OZ_TINY))) : REAL(1.0);
    real damping = REAL(2.0) * law.rolling_damping * sqrt(REAL(1.4) * c.inertia * stiffness);
    turned = oz_scale(turned, cut);
    couple.spring = oz_scale(whole, -cut);
    couple.dashpot = oz_choose(yields, none, oz_scale(rolling, -damping));
    couple.stiffness = stiffness;
    memory->turned = oz_where(c.touching, oz_along(turned, REAL((1 - share) * dt), rolling));
    return couple;
}

/* What a contact pressed by normal_force, whose normal spring has the stiffness k_n, does against
 * rotation. */
OZ_INLINE OzCouple oz_contact_rolling(OzContact c, OZ_LAW law, real normal_force, real stiffness,
                                      OzMemory *memory, scalar dt, scalar share)
{
    OzCouple couple = oz_contact_no_couple();
    if (OZ_ROLLING) {
        real lever = law.rolling_friction * c.radius, pressed = oz_magnitude(normal_force);
        OzVec3 twisting = oz_scale(c.normal, oz_dot(c.turning, c.normal));
        OzVec3 rolling = oz_minus(c.turning, twisting);
        if (OZ_ROLLING_SPRING) {
            couple = oz_rolling_spring(c, law, rolling, lever * pressed,
                                       REAL(2.25) * stiffness * lever * lever, memory, dt, share);
        } else {
            couple.spring = oz_rolling_constant(rolling, lever * pressed, c.inertia, dt);
        }
        real twist = law.twisting_friction * c.radius * pressed;
        couple.spring = oz_add(couple.spring, oz_rolling_constant(twisting, twist, c.inertia, dt));
        couple.spring = oz_where(c.touching, couple.spring);
        couple.dashpot = oz_where(c.touching, couple.dashpot);
    }
    return couple;
}
