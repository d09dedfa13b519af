/* The law of the scene, Coulomb friction, and both put together: from a contact to what it does.
 * Switches (constant on a device): OZ_LAW_ID (the law's row in laws.h), OZ_ATTRACTION_CLAMP (f_n >=
 * 0), OZ_ADHESION (any law: while bodies overlap they pull with 2 pi w R*, w the work of adhesion,
 * as Derjaguin, Muller & Toporov 1975 find for hard spheres; friction goes by what presses without
 * it), OZ_FRICTION, OZ_HISTORY (a tangential spring exists), OZ_SLIP_SCALE (P: the force alone is
 * limited and the spring grows on; otherwise the spring is cut back to what the sliding contact
 * carries). */
#pragma once

#include "kernels/contact_hertz.h"
#include "kernels/contact_hertz_mindlin.h"
#include "kernels/contact_hooke.h"
#include "kernels/contact_rolling.h"
#include "kernels/laws.h"

OZ_INLINE OzResponse oz_contact_response(OzContact c, OZ_LAW law)
{
    OzResponse response = {REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0)};
#define OZ_CONTACT_LAW_ROW(NAME, name, choice, linear, stiffness, damping)                         \
    if (OZ_LAW_ID == OZ_LAW_##NAME) {                                                              \
        response = oz_contact_##name(c, law);                                                      \
    }
    OZ_LAWS(OZ_CONTACT_LAW_ROW)
#undef OZ_CONTACT_LAW_ROW
    if (OZ_ATTRACTION_CLAMP) {
        response.dashpot = oz_larger(response.dashpot, -response.spring);
    }
    response.adhesion = REAL(0.0);
    if (OZ_ADHESION) {
        response.adhesion = law.adhesion * c.radius * c.share;
        response.energy -= response.adhesion * oz_larger(c.overlap, REAL(0.0));
    }
    return response;
}

/* Cuts the tangential force to the Coulomb limit and the spring to what the sliding contact
 * carries. The dashpot is none then: what sliding takes is friction's, or the ledger would count a
 * dashpot that the limit never let act, and friction as negative. */
OZ_INLINE void oz_contact_limit(OzFriction *f, real limit, real stiffness, OzVec3 *stretch)
{
    real size2 = oz_dot(f->force, f->force);
    f->slips = size2 > limit * limit;
    real cut =
        f->slips ? limit * oz_inverse_root(oz_larger(size2, REAL(OZ_TINY * OZ_TINY))) : REAL(1.0);
    f->force = oz_scale(f->force, cut);
    if (OZ_HISTORY & !OZ_SLIP_SCALE) {
        /* a contact without a spring, in a scene where others have one, carries nothing */
        real compliance = stiffness > REAL(0.0) ? oz_inverse(stiffness) : REAL(0.0);
        OzVec3 carried = oz_scale(oz_minus(f->force, f->dashpot), compliance);
        *stretch = oz_choose(f->slips, carried, *stretch);
    }
    f->dashpot = oz_choose(f->slips, oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0)), f->dashpot);
}

/* The tangential force, limited by friction times |normal_force|. *memory is what is stored between
 * steps; its stretch is replaced. The share of the step by which
 * it is advanced before the force (the rest after it) is the integrator's: 0 explicit, 1/2 second
 * order, 1 symplectic. */
OZ_INLINE OzFriction oz_contact_friction(OzContact c, OzResponse response, real normal_force,
                                         OZ_LAW_NUMBER friction, OzMemory *memory, scalar dt,
                                         scalar share)
{
    OzVec3 none = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0)), stretch = none;
    OzFriction f = {none, none, c.touching};
    if (OZ_FRICTION) {
        /* d(xi_t)/dt, against the relative velocity (P eq. 6) */
        OzVec3 sliding = oz_scale(oz_along(c.velocity, c.rate, c.normal), REAL(-1.0));
        f.dashpot = oz_scale(sliding, response.tangential_damping);
        f.force = f.dashpot;
        if (OZ_HISTORY) {
            OzVec3 turned = oz_contact_turn(memory->stretch, c.normal);
            stretch = oz_along(turned, REAL(share * dt), sliding);
            f.force = oz_along(f.force, response.tangential_stiffness, stretch);
        }
        oz_contact_limit(&f, friction * oz_magnitude(normal_force), response.tangential_stiffness,
                         &stretch);
        if (OZ_HISTORY) {
            OzVec3 next = oz_along(stretch, REAL((1 - share) * dt), sliding);
            memory->stretch = oz_where(c.touching, next);
        }
    }
    return f;
}

/* The overlap, or what may be divided by. */
OZ_INLINE real oz_contact_depth(OzContact c)
{
    return c.touching ? c.overlap : REAL(1.0);
}

OZ_INLINE OzContactForce oz_contact_force(OzContact c, OZ_LAW law, OzMemory *memory, scalar dt,
                                          scalar share)
{
    OzContactForce out;
    OzResponse response = oz_contact_response(c, law);
    real normal_force = response.spring + response.dashpot;
    OzFriction f = oz_contact_friction(c, response, normal_force, law.friction, memory, dt, share);
    real net = OZ_ADHESION ? normal_force - response.adhesion : normal_force;
    out.force = oz_where(c.touching, oz_along(f.force, net, c.normal));
    out.press = normal_force;
    out.spring = oz_where(c.touching, oz_minus(f.force, f.dashpot));
    out.dashpot = oz_where(c.touching, oz_along(f.dashpot, response.dashpot, c.normal));
    out.slips = f.slips;
    out.energy = c.touching ? response.energy : REAL(0.0);
    out.tangential_stiffness = response.tangential_stiffness;
    out.couple = oz_contact_rolling(c, law, normal_force, response.spring / oz_contact_depth(c),
                                    memory, dt, share);
    return out;
}
