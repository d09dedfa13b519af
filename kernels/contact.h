/* What two touching bodies know of their contact, and how the tangential spring is carried along.
 * Vectors point from body a to body b; a wall is always body a. */
#ifndef OZ_KERNELS_CONTACT_H
#define OZ_KERNELS_CONTACT_H

#include "kernels/vec3.h"

/* Constants of a contact law, per unit of effective mass, so that one set serves every pair of grains
 * (and one each wall). */
typedef struct OzLawConstants {
    scalar stiffness;            /* k_n / m*, 1/s^2                                        */
    scalar damping;              /* c_n / m*, 1/s                                          */
    scalar tangential_stiffness; /* k_t / m*, 1/s^2                                        */
    scalar tangential_damping;   /* c_t / m*, 1/s                                          */
    scalar friction;             /* Coulomb coefficient                                    */
} OzLawConstants;

typedef struct OzContact {
    OzVec3 normal;   /* unit vector                                                        */
    real overlap;    /* m, > 0 while touching                                              */
    OzVec3 velocity; /* m/s, of b relative to a at the contact                             */
    real mass;       /* kg, effective: 1/mass = 1/mass_a + 1/mass_b; of the grain at a wall */
    mask touching;
} OzContact;

/* What a law gives. Only `force` enters the motion; the rest is for the energy ledger and costs nothing
 * when that is off. */
typedef struct OzContactForce {
    OzVec3 force;      /* N, on b                                                           */
    OzVec3 stretch;    /* m, tangential spring at this time level                           */
    OzVec3 stretched;  /* m, the same before sliding cut it back                            */
    real dashpot;      /* N, normal force of the dashpot                                    */
    OzVec3 dashpot_tangential; /* N, none while sliding                                     */
} OzContactForce;

/* The stored spring turned with the normal as the pair turns (Pournin et al. 2005 take the normal as
 * constant; real contacts roll): projected on the new tangent plane, its length kept to fourth order of
 * the turn. */
OZ_INLINE OzVec3 oz_contact_turn(OzVec3 stretch, OzVec3 normal)
{
    real length2 = oz_dot(stretch, stretch), off = oz_dot(stretch, normal);
    real grow = REAL(1.0) + REAL(0.5) * off * off / oz_larger(length2, REAL(OZ_TINY * OZ_TINY));
    return oz_scale(oz_along(stretch, -off, normal), grow);
}

#endif
