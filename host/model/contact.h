/* The constants of a contact from what a scene says about it: contact time and restitution in,
 * spring and dashpot out, per kg of effective mass, so that one set serves all grains; for `law:
 * hertz-mindlin`, moduli and restitution in. Knows nothing of steps: see calibrate.h. */
#pragma once

#include "scene/scene.h"

/* Restitution below this is used as this: the stiffness pi^2 + ln^2 e would grow without bound, and
 * no one can tell a hundredth of the speed from none. */
#define OZ_CONTACT_RESTITUTION_LEAST 0.01

typedef struct OzContactConstants {
    double stiffness; /* kappa = k_n / m*, 1/s^2; other laws: as in their kernel headers */
    double damping;   /* gamma = c_n / m*, 1/s                                       */
    double tangential_stiffness; /* k_t / m*, 1/s^2                                             */
    double tangential_damping;   /* c_t / m*, 1/s                                               */
    double restitution;          /* as used: at least OZ_CONTACT_RESTITUTION_LEAST; 0 with hertz */
    double duration;             /* s, of a free binary hit; below contact_time with clamp; 0 where
                                    it depends on speed (hertz, hertz-mindlin)                  */
    bool smooth;                 /* the dashpot grows from nothing: kernels/contact_hooke.h     */
    OzLaw law;
} OzContactConstants;

/* `law: hooke`. `damping: constant`, `attraction: allow`: kappa = (pi^2 + ln^2 e) / t_c^2, gamma =
 * -2 ln(e) / t_c (Pournin et al. 2005, sec. 3.1). `attraction: clamp` keeps kappa and takes the
 * gamma for which a contact that may not pull returns e (Schwager & Poeschel 2007); it then ends
 * before t_c. `damping: smooth`: kappa and gamma solved so that a hit returns e and lasts t_c. */
OzContactConstants oz_contact_constants(const OzContactValues *values);

/* The constants of any law; grains are the scene's contact values, whose material meets that of
 * `values` where these do not say what they meet (the same for two grains, a wall's otherwise). */
OzContactConstants oz_contact_constants_of(const OzContactValues *values,
                                           const OzContactValues *grains);

/* Whether the law's force grows with the overlap itself and not with its power 3/2
 * (kernels/laws.h). */
bool oz_contact_is_linear(OzLaw law);

/* The restitution of a contact that may not pull, for a damping ratio gamma / (2 sqrt(kappa)) >= 0:
 * 1 at 0, falling towards 0 (Schwager & Poeschel 2007). */
double oz_contact_clamped_restitution(double damping_ratio);
