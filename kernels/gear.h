/* Gear's predictor-corrector with five values (Gear 1966), of fourth order for forces that depend on
 * velocity: for one coordinate x the values are d^k x / dt^k  dt^k / k!, k = 0..4. The start must
 * hold correct third and fourth derivatives: zeros make it second order. */
#pragma once

#include "kernels/real.h"

typedef struct OzGear {
    real value[5];
} OzGear;

/* The Taylor series of every value, dt ahead. */
OZ_INLINE OzGear oz_gear_predict(OzGear gear)
{
    const real *v = gear.value;
    OzGear ahead = {{v[0] + v[1] + v[2] + v[3] + v[4],
                     v[1] + REAL(2.0) * v[2] + REAL(3.0) * v[3] + REAL(4.0) * v[4],
                     v[2] + REAL(3.0) * v[3] + REAL(6.0) * v[4], v[3] + REAL(4.0) * v[4], v[4]}};
    return ahead;
}

/* The prediction put right by the acceleration found there; half_step2 = dt^2 / 2. */
OZ_INLINE OzGear oz_gear_correct(OzGear ahead, real acceleration, real half_step2)
{
    real error = acceleration * half_step2 - ahead.value[2];
    ahead.value[0] += REAL(19.0 / 90) * error;
    ahead.value[1] += REAL(3.0 / 4) * error;
    ahead.value[2] += error;
    ahead.value[3] += REAL(1.0 / 2) * error;
    ahead.value[4] += REAL(1.0 / 12) * error;
    return ahead;
}

/* From position and derivatives 1 to 4. */
OZ_INLINE OzGear oz_gear_start(real position, real velocity, real acceleration, real third,
                               real fourth, real dt)
{
    OzGear gear = {{position, velocity * dt, acceleration * dt * dt * REAL(1.0 / 2),
                    third * dt * dt * dt * REAL(1.0 / 6),
                    fourth * dt * dt * dt * dt * REAL(1.0 / 24)}};
    return gear;
}
