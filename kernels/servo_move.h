/* A servo wall, or piston: a plane that goes along its normal by Newton's law, under a set force or
 * pressure, the grains' force on it, its weight if it has one, and a dashpot (Cundall & Strack 1979
 * and Thornton & Antony 1998 hold stresses by walls that move; here they have inertia, so that
 * energy is accounted for). All in double, also where grains are in float: a piston goes on by less
 * than a float's digit of its place in a step. Places and forces count along the normal, into the
 * bed. */
#ifndef OZ_KERNELS_SERVO_MOVE_H
#define OZ_KERNELS_SERVO_MOVE_H

#include "kernels/layout.h"

typedef struct OzServoState {
    double place, speed; /* m, m/s: since the start, from where it was built          */
    double acceleration; /* m/s^2, of the step before                                 */
    double seen;         /* m/s, as forces see it; after a step, the speed            */
    double push;         /* N, of grains on it in the last step: pushed back, below 0 */
} OzServoState;

/* The energy that a step brings, J: by what drives the piston, and taken by its dashpot. */
typedef struct OzServoWork {
    double given, lost;
} OzServoWork;

/* The area that it closes, m^2, where all servos stand at these places. */
OZ_INLINE double oz_servo_area(OzServoConstants servo, const double *places)
{
    double area = 1;
    for (int k = 0; k < 2; k++) {
        double gap = servo.gap[k];
        for (int side = 0; side < 2; side++) {
            int bound = (int)servo.bound[2 * k + side];
            gap -= bound < 0 ? 0 : places[bound];
        }
        area *= gap;
    }
    return area;
}

/* What drives it, N. */
OZ_INLINE double oz_servo_drive(OzServoConstants servo, const double *places)
{
    return servo.force + servo.pressure * oz_servo_area(servo, places);
}

/* Velocity Verlet's first part, where grains are moved so (integrate_velocity_verlet.h). */
OZ_INLINE void oz_servo_before(OzServoState *state, double dt)
{
    state->place += dt * (state->speed + 0.5 * dt * state->acceleration);
    state->seen = state->speed + dt * state->acceleration;
}

/* The end of a step: velocity Verlet's, or all of symplectic Euler, also where grains move by
 * explicit Euler, which would give the piston energy. */
OZ_INLINE OzServoWork oz_servo_after(OzServoState *state, OzServoConstants servo, double drive,
                                     double dt)
{
    double acceleration = (drive + state->push - servo.damping * state->seen) / servo.mass;
    double mean = OZ_MOVES_BEFORE ? 0.5 * (state->acceleration + acceleration) : acceleration;
    double seen = state->seen;
    OzServoWork work;
    state->speed += dt * mean;
    state->place += OZ_MOVES_BEFORE ? 0 : dt * state->speed;
    work.given = dt * drive * 0.5 * (seen + state->speed);
    work.lost = dt * servo.damping * seen * 0.5 * (seen + state->speed);
    state->seen = state->speed;
    state->acceleration = acceleration;
    return work;
}

/* While grains settle, and while the wall is not there, it stands, ready to go. */
OZ_INLINE void oz_servo_stand(OzServoState *state, OzServoConstants servo, double drive)
{
    state->speed = 0;
    state->seen = 0;
    state->acceleration = (drive + state->push) / servo.mass;
}

#endif
