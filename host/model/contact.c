/* The linear contact's constants, solved for the restitution asked. Knows nothing of steps. */
#include "model/contact.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* Time until the force of a contact that may not pull ends, times sqrt(kappa). The acceleration is
 * zero where tan(w t / 2) = w / b, with b the damping ratio and w^2 = 1 - b^2; beyond b = 1 the
 * hyperbolic form of the same. Near b = 1 both are 0/0, and 2 (1 + (1 - b) 4/3 ...) is 2 to
 * rounding's root. */
static double clamped_duration(double b)
{
    double w2 = 1 - b * b;
    if (fabs(w2) < 1e-9) {
        return 2;
    }
    double w = sqrt(fabs(w2));
    return w2 > 0 ? 2 * atan2(w, b) / w : 2 * atanh(w / b) / w;
}

double oz_contact_clamped_restitution(double damping_ratio)
{
    return exp(-damping_ratio * clamped_duration(damping_ratio));
}

/* Bisection: restitution falls steadily from 1 at no damping to 0.0099 at a ratio of 5.03, just
 * below the least restitution asked. */
static double clamped_damping_ratio(double restitution)
{
    double low = 0, high = 8;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        if (oz_contact_clamped_restitution(middle) > restitution) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return restitution < 1 ? 0.5 * (low + high) : 0;
}

OzContactConstants oz_contact_constants(const OzContactValues *values)
{
    OzContactConstants constants;
    double time = values->contact_time;
    double e = fmax(values->restitution, OZ_CONTACT_RESTITUTION_LEAST);
    double log_inverse = log(1 / e); /* not -log(e): that is -0 for e = 1 */
    constants.restitution = e;
    constants.stiffness = (pi * pi + log_inverse * log_inverse) / (time * time);
    constants.damping = 2 * log_inverse / time;
    constants.duration = time;
    if (values->attraction == OZ_ATTRACTION_CLAMP) {
        double rate = sqrt(constants.stiffness);
        double ratio = clamped_damping_ratio(e);
        constants.damping = 2 * ratio * rate;
        constants.duration = clamped_duration(ratio) / rate;
    }
    constants.tangential_stiffness = values->tangential_stiffness * constants.stiffness;
    constants.tangential_damping = values->tangential_damping * constants.damping;
    return constants;
}
