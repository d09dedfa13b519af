/* The integrator of this program (OZ_INTEGRATOR_ID, its row in the list), a constant on a device: the others' moves
 * are left out there. OZ_MOVES_BEFORE: places move before the forces. */
#pragma once

#include "kernels/integrate_euler.h"
#include "kernels/integrate_symplectic_euler.h"
#include "kernels/integrate_velocity_verlet.h"
#include "kernels/integrators.h"

#define OZ_INTEGRATE_IS(NAME) (OZ_INTEGRATOR_ID == OZ_INTEGRATOR_##NAME)

/* What a row without moves before the forces has not. */
#define OZ_INTEGRATE_FIRST_0(NAME, move)
#define OZ_INTEGRATE_FIRST_1(NAME, move)                                                           \
    if (OZ_INTEGRATE_IS(NAME)) {                                                                   \
        move;                                                                                      \
    }

OZ_INLINE void oz_integrate_before(OzBody *body, OzShape shape, real dt, scalar inverse_unit)
{
    (void)body, (void)shape, (void)dt, (void)inverse_unit;
#define OZ_INTEGRATE_ROW(NAME, name, choice, flat_choice, share, first)                            \
    OZ_INTEGRATE_FIRST_##first(NAME, oz_##name##_before(body, shape, dt, inverse_unit))
    OZ_INTEGRATORS(OZ_INTEGRATE_ROW)
#undef OZ_INTEGRATE_ROW
}

OZ_INLINE OzVec3 oz_integrate_seen_velocity(OzBody body, real dt)
{
    OzVec3 velocity = body.velocity;
    (void)dt;
#define OZ_INTEGRATE_ROW(NAME, name, choice, flat_choice, share, first)                            \
    OZ_INTEGRATE_FIRST_##first(NAME, velocity = oz_##name##_seen_velocity(body, dt))
    OZ_INTEGRATORS(OZ_INTEGRATE_ROW)
#undef OZ_INTEGRATE_ROW
    return velocity;
}

OZ_INLINE OzVec3 oz_integrate_seen_spin(OzBody body, OzShape shape, real dt)
{
    OzVec3 spin = body.spin;
    (void)shape, (void)dt;
#define OZ_INTEGRATE_ROW(NAME, name, choice, flat_choice, share, first)                            \
    OZ_INTEGRATE_FIRST_##first(NAME, spin = oz_##name##_seen_spin(body, shape, dt))
    OZ_INTEGRATORS(OZ_INTEGRATE_ROW)
#undef OZ_INTEGRATE_ROW
    return spin;
}

OZ_INLINE void oz_integrate_after(OzBody *body, OzShape shape, OzLoad load, real dt, scalar inverse_unit)
{
#define OZ_INTEGRATE_ROW(NAME, name, choice, flat_choice, share, first)                            \
    if (OZ_INTEGRATE_IS(NAME)) {                                                                   \
        oz_##name##_after(body, shape, load, dt, inverse_unit);                                    \
    }
    OZ_INTEGRATORS(OZ_INTEGRATE_ROW)
#undef OZ_INTEGRATE_ROW
}

/* The share of the step by which tangential springs are advanced before the force. */
OZ_INLINE scalar oz_integrate_share(void)
{
#define OZ_INTEGRATE_ROW(NAME, name, choice, flat_choice, share, first)                            \
    OZ_INTEGRATE_IS(NAME) ? (scalar)(share) :
    return OZ_INTEGRATORS(OZ_INTEGRATE_ROW) 0;
#undef OZ_INTEGRATE_ROW
}
