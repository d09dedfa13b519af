/* The integrators, and on a device the one of this program (OZ_INTEGRATOR_ID, its row in the list). */
#ifndef OZ_KERNELS_INTEGRATE_H
#define OZ_KERNELS_INTEGRATE_H

#include "kernels/body.h"

#if defined(OZ_HOST) || OZ_INTEGRATOR_ID == 0
#include "kernels/integrate_euler.h"
#endif
#if defined(OZ_HOST) || OZ_INTEGRATOR_ID == 1
#include "kernels/integrate_symplectic_euler.h"
#endif
#if defined(OZ_HOST) || OZ_INTEGRATOR_ID == 2
#include "kernels/integrate_velocity_verlet.h"
#endif

#if !defined(OZ_HOST)
#if OZ_INTEGRATOR_ID == 0
#define oz_integrate_after oz_euler_after
#define OZ_HISTORY_SHARE   OZ_EULER_SHARE
#elif OZ_INTEGRATOR_ID == 1
#define oz_integrate_after oz_symplectic_euler_after
#define OZ_HISTORY_SHARE   OZ_SYMPLECTIC_EULER_SHARE
#else
#define oz_integrate_before        oz_velocity_verlet_before
#define oz_integrate_after         oz_velocity_verlet_after
#define oz_integrate_seen_velocity oz_velocity_verlet_seen_velocity
#define oz_integrate_seen_spin     oz_velocity_verlet_seen_spin
#define OZ_HISTORY_SHARE           OZ_VELOCITY_VERLET_SHARE
#define OZ_MOVES_BEFORE /* places move before the forces */
#endif
#if !defined(OZ_MOVES_BEFORE)
#define oz_integrate_seen_velocity(body, dt)    ((body).velocity)
#define oz_integrate_seen_spin(body, shape, dt) ((body).spin)
#endif
#endif

#endif
