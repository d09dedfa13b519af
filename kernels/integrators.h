/* THE list of integrators. Scene choices, `-D OZ_INTEGRATOR_ID`, the kernels' and the reference's moves and the
 * host's predictions are made of it: a row whose functions do not exist does not compile. Names alone: host/scene
 * reads it too. */
#pragma once

/* X(NAME, name, choice, choice of trigrains, share, first), a row each:
 *   choice  in a scene of rods; that of trigrains, which have moves of their own, is "" where they have none
 *   share   of the step by which tangential springs are advanced before the force, the rest after it
 *   first   1: places move before the forces, and acceleration and torque are kept from step to step
 * kernels/integrate_<name>.h has oz_<name>_after(body, shape, load, dt, inverse_unit), with first 1 also _before,
 * _seen_velocity and _seen_spin, and is included by integrate.h; host/model/predict.c its map of a 1-D contact (step_, polynomial_, limit_<name>),
 * host/model/calibrate.c that map turned round (invert_<name>). */
#define OZ_INTEGRATORS(X)                                                                          \
    X(EULER, euler, "euler", "", 0.0, 0)                                                           \
    X(SYMPLECTIC_EULER, symplectic_euler, "symplectic-euler", "", 1.0, 0)                          \
    X(VELOCITY_VERLET, velocity_verlet, "velocity-verlet", "velocity-verlet", 0.5, 1)

/* X(NAME, choice): of trigrains alone. gear4 is a predictor-corrector of fourth order; rk4 is on the host alone. */
#define OZ_TRIGRAINS_INTEGRATORS(X)                                                                \
    X(GEAR4, "gear4")                                                                              \
    X(RK4, "rk4")

#define OZ_INTEGRATORS_ID(NAME, name, choice, flat_choice, share, first) OZ_INTEGRATOR_##NAME,
#define OZ_INTEGRATORS_FLAT_ID(NAME, choice)                             OZ_INTEGRATOR_##NAME,
typedef enum OzIntegrator {
    OZ_INTEGRATORS(OZ_INTEGRATORS_ID) OZ_TRIGRAINS_INTEGRATORS(OZ_INTEGRATORS_FLAT_ID)
    OZ_INTEGRATORS_END
} OzIntegrator;
