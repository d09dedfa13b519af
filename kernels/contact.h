/* What two touching bodies know of their contact, what a law answers, and how the tangential spring
 * is carried along. Vectors point from body a to body b; a wall is always body a. */
#pragma once

#include "kernels/vec3.h"

/* Constants of a contact law. With `law: hooke` stiffnesses and dampings are per unit of effective
 * mass, so that one set serves every pair of grains (and one each wall); the other laws' headers
 * say what theirs are. */
#define OZ_LAW_CONSTANTS(number)                                                                   \
    number stiffness;            /* k_n / m*, 1/s^2                                        */      \
    number damping;              /* c_n / m*, 1/s                                          */      \
    number tangential_stiffness; /* k_t / m*, 1/s^2                                        */      \
    number tangential_damping;   /* c_t / m*, 1/s                                          */      \
    number friction;             /* Coulomb coefficient                                    */      \
    number rolling_friction,                                                                       \
        twisting_friction;  /* couple over normal force and radius (contact_rolling.h) */          \
    number adhesion;        /* N/m: a contact pulls with this times its radius; all laws' */       \
    number rolling_damping; /* of the rolling spring, over critical damping           */

typedef struct OzLawConstants {
    OZ_LAW_CONSTANTS(scalar)
} OzLawConstants;

/* Those of a block of contacts: of grains of several materials each lane has its own (material.h).
 */
#if OZ_MATERIALS > 1
typedef struct OzLawOfLanes {
    OZ_LAW_CONSTANTS(real)
} OzLawOfLanes;
#define OZ_LAW        OzLawOfLanes
#define OZ_LAW_NUMBER real
#else
#define OZ_LAW        OzLawConstants
#define OZ_LAW_NUMBER scalar
#endif

typedef struct OzContact {
    OzVec3 normal;   /* unit vector                                                        */
    real overlap;    /* m, > 0 while touching                                              */
    real rate;       /* m/s, d(overlap)/dt                                                 */
    OzVec3 velocity; /* m/s, of b relative to a at the contact                             */
    real mass;       /* kg, effective: 1/mass = 1/mass_a + 1/mass_b; of the grain at a wall */
    real radius;     /* m, effective: 1/radius = 1/radius_a + 1/radius_b; of the grain at a wall */
    real share;      /* of a contact that several points share; for adhesion               */
    real lightness;  /* root of (mass that the contact feels, rotation included, / mass)   */
    OzVec3 turning;  /* rad/s, of b relative to a; this and the next with OZ_ROLLING only  */
    real inertia;    /* kg m^2: 1/inertia = 1/(mass_a radius_a^2) + 1/(mass_b radius_b^2)  */
    mask touching;
} OzContact;

/* What a contact remembers between steps, zero before first touch. */
typedef struct OzMemory {
    OzVec3 stretch; /* m, the tangential spring; with OZ_HISTORY only                      */
    OzVec3 turned;  /* rad, by which the rolling spring is turned; with OZ_ROLLING_SPRING  */
} OzMemory;

/* What a contact does against rotation: couples on b, N m; a feels the opposite. */
typedef struct OzCouple {
    OzVec3 spring, dashpot; /* constant couples are the spring's part                      */
    real stiffness;         /* N m, of the spring                                          */
} OzCouple;

/* What a law answers to overlap and rate. */
typedef struct OzResponse {
    real spring, dashpot;      /* N, normal force of each, pushing                          */
    real energy;               /* J, in the normal spring                                   */
    real tangential_stiffness; /* N/m                                                       */
    real tangential_damping;   /* kg/s                                                      */
    real adhesion;             /* N, pulling, beside the spring                             */
} OzResponse;

/* What friction does, and whether it is all that it can: a contact without friction slips. */
typedef struct OzFriction {
    OzVec3 force, dashpot; /* N, on b; the dashpot's part of it, none while slipping            */
    mask slips;
} OzFriction;

/* What a contact does. Only `force` enters the motion; the rest is for the energy ledger and for
 * lists of contacts, and costs nothing when nobody asks. */
typedef struct OzContactForce {
    OzVec3 force;              /* N, on b                                                   */
    real press;                /* N, spring and dashpot: what friction is limited by        */
    OzVec3 spring;             /* N, on b: the tangential spring's part                     */
    OzVec3 dashpot;            /* N, on b: the dashpots' part; tangential none while sliding */
    real energy;               /* J, in the normal spring                                   */
    real tangential_stiffness; /* N/m                                                       */
    OzCouple couple;           /* with OZ_ROLLING only                                      */
    mask slips;
} OzContactForce;

OZ_INLINE OzCouple oz_contact_no_couple(void)
{
    OzVec3 none = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0));
    OzCouple couple = {none, none, REAL(0.0)};
    return couple;
}

/* The stored spring turned with the normal as the pair turns (Pournin et al. 2005 take the normal
 * as constant; real contacts roll): projected on the new tangent plane, its length kept to fourth
 * order of the turn. */
OZ_INLINE OzVec3 oz_contact_turn(OzVec3 stretch, OzVec3 normal)
{
    real length2 = oz_dot(stretch, stretch), off = oz_dot(stretch, normal);
    real grow = REAL(1.0) + REAL(0.5) * off * off / oz_larger(length2, REAL(OZ_TINY * OZ_TINY));
    return oz_scale(oz_along(stretch, -off, normal), grow);
}
