/* THE list of contact laws. Scene choices, `-D OZ_LAW_ID`, the law of kernels and of the reference,
 * constants, units and the predicted hit are made of it: a row whose functions do not exist does
 * not compile. Names alone: host/scene reads it too. */
#pragma once

/* X(NAME, name, choice, linear, stiffness, damping), a row each:
 *   linear     1: the force grows with the overlap itself, and a hit's duration and restitution are
 * the same at every speed; 0: with its power 3/2, as between elastic spheres (Hertz). By it the
 * host estimates hits, stable steps and energies stiffness, damping   units of these constants of
 * OzLawConstants, as host/sim/units.c names them; the tangential ones have the same
 * kernels/contact_<name>.h has oz_contact_<name>(contact, law) and is included by contact_law.h;
 * host/model/contact.c the constants (constants_<name>), host/model/predict.c the force of a 1-D
 * hit (repulsion_<name>). The keys that a law reads name it under `.laws` in host/scene/rows.c. */
#define OZ_LAWS(X)                                                                                 \
    X(HOOKE, hooke, "hooke", 1, PER_TIME2, PER_TIME)                                               \
    X(HERTZ, hertz, "hertz", 0, HERTZIAN, PER_TIME)                                                \
    X(HERTZ_MINDLIN, hertz_mindlin, "hertz-mindlin", 0, PRESSURE, ONE)

#define OZ_LAWS_ID(NAME, name, choice, linear, stiffness, damping) OZ_LAW_##NAME,
typedef enum OzLaw { OZ_LAWS(OZ_LAWS_ID) OZ_LAWS_END } OzLaw;
