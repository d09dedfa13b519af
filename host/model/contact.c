/* Constants of contact laws, solved for the restitution asked. */
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

/* With x the overlap times w, x = rho sin(phi) and dx/dt = w rho cos(phi), the smooth dashpot gives
 *   d(ln rho)/d(phi) = -2 zeta cos^2 sin / u,  w dt/d(phi) = 1 / u,  u = 1 + 2 zeta cos sin^2,
 * integrated by Simpson's rule from phi = 0 to pi or to where the force becomes a pull, 1 + 2 zeta
 * cos = 0; u stays above 0 for zeta < 3 sqrt(3) / 4, but falls steeply to 1 / (2 zeta)^2 where a
 * strongly damped pull would begin: phi = end (1 - y^2) puts the panels there. 4000 of them leave
 * 1e-9 for e > 0.01. *duration receives the hit's, times sqrt(kappa). */
static double smooth_restitution(double damping_ratio, OzAttraction attraction, double *duration)
{
    enum { PANELS = 4000 };
    double zeta = damping_ratio, end = pi, loss = 0, time = 0;
    if (attraction == OZ_ATTRACTION_CLAMP && zeta > 0.5) {
        end = acos(-1 / (2 * zeta));
    }
    for (int i = 0; i <= PANELS; i++) {
        double weight = i == 0 || i == PANELS ? 1 : i % 2 ? 4 : 2;
        double y = (double)i / PANELS, phi = end * (1 - y * y);
        double c = cos(phi), s = sin(phi);
        double u = 1 + 2 * zeta * c * s * s;
        loss += weight * 2 * y * 2 * zeta * c * c * s / u;
        time += weight * 2 * y / u;
    }
    *duration = time * end / PANELS / 3;
    return exp(-loss * end / PANELS / 3) * fabs(cos(end));
}

static void solve_smooth(OzContactConstants *constants, const OzContactValues *values)
{
    bool clamp = values->attraction == OZ_ATTRACTION_CLAMP;
    double low = 0, high = clamp ? 100 : 0.75 * sqrt(3), time = 0;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        double e = smooth_restitution(middle, values->attraction, &time);
        *(e > constants->restitution ? &low : &high) = middle;
    }
    low = constants->restitution < 1 ? low : 0;
    smooth_restitution(low, values->attraction, &time);
    double rate = time / values->contact_time;
    constants->stiffness = rate * rate;
    constants->damping = 2 * low * rate;
    constants->duration = values->contact_time;
    constants->smooth = true;
}

static double restitution_used(const OzContactValues *values)
{
    return fmax(values->restitution, OZ_CONTACT_RESTITUTION_LEAST);
}

OzContactConstants oz_contact_constants(const OzContactValues *values)
{
    OzContactConstants constants = {.restitution = restitution_used(values)};
    double time = values->contact_time;
    double e = constants.restitution;
    double log_inverse = log(1 / e); /* not -log(e): that is -0 for e = 1 */
    constants.stiffness = (pi * pi + log_inverse * log_inverse) / (time * time);
    constants.damping = 2 * log_inverse / time;
    constants.duration = time;
    if (values->damping == OZ_DAMPING_SMOOTH) {
        solve_smooth(&constants, values);
    } else if (values->attraction == OZ_ATTRACTION_CLAMP) {
        double rate = sqrt(constants.stiffness);
        double ratio = clamped_damping_ratio(e);
        constants.damping = 2 * ratio * rate;
        constants.duration = clamped_duration(ratio) / rate;
    }
    constants.tangential_stiffness = values->tangential_stiffness * constants.stiffness;
    constants.tangential_damping = values->tangential_damping * constants.damping;
    return constants;
}

/* Restitution of x'' = -x^(3/2) - alpha x^(1/4) x' that starts at x' = 1, until it may not pull any
 * more: Runge and Kutta's fourth order in steps of a 2000th of the free hit, the last one cut by
 * its force. */
static double clamped_hertz_restitution(double alpha)
{
    double h = 2.94 * pow(1.25, 0.4) / 2000, x = 0, v = 1;
    for (int n = 0; n < 1000000; n++) {
        double k[4], w[4], step[4] = {0, 0.5 * h, 0.5 * h, h};
        for (int i = 0; i < 4; i++) {
            double y = fmax(x + (i ? step[i] * w[i - 1] : 0), 0);
            w[i] = v + (i ? step[i] * k[i - 1] : 0);
            k[i] = -y * sqrt(y) - alpha * sqrt(sqrt(y)) * w[i];
        }
        if (v < 0 && (k[0] >= 0 || x <= 0)) {
            break;
        }
        x += h * (w[0] + 2 * w[1] + 2 * w[2] + w[3]) / 6;
        v += h * (k[0] + 2 * k[1] + 2 * k[2] + k[3]) / 6;
    }
    return -v;
}

/* alpha of the Hertzian dashpot: -sqrt(5) ln e / sqrt(ln^2 e + pi^2) (Antypov & Elliott 2011), or
 * what a contact that may not pull needs. */
static double hertz_damping(double e, OzAttraction attraction)
{
    double low = 0, high = 20;
    if (attraction == OZ_ATTRACTION_ALLOW || e >= 1) {
        return sqrt(5) * log(1 / e) / sqrt(log(e) * log(e) + pi * pi);
    }
    for (int i = 0; i < 40; i++) {
        double middle = 0.5 * (low + high);
        *(clamped_hertz_restitution(middle) > e ? &low : &high) = middle;
    }
    return low;
}

/* 1/E* and 1/G* are the sums of both bodies' (1 - nu^2)/E and (2 - nu)/G. */
static OzContactConstants constants_hertz_mindlin(const OzContactValues *one,
                                                  const OzContactValues *other)
{
    bool told = one->other_modulus > 0;
    const double moduli[2] = {one->youngs_modulus,
                              told ? one->other_modulus : other->youngs_modulus};
    const double ratios[2] = {one->poisson_ratio, told ? one->other_ratio : other->poisson_ratio};
    double compliance = 0, shear_compliance = 0;
    for (int i = 0; i < 2; i++) {
        double modulus = moduli[i], nu = ratios[i];
        compliance += (1 - nu * nu) / modulus;
        shear_compliance += (2 - nu) * 2 * (1 + nu) / modulus;
    }
    OzContactConstants constants = {.restitution = restitution_used(one)};
    constants.stiffness = 4 / (3 * compliance);
    constants.tangential_stiffness = 8 / shear_compliance;
    constants.damping = hertz_damping(constants.restitution, one->attraction);
    constants.tangential_damping = one->tangential_damping;
    return constants;
}

static OzContactConstants constants_hertz(const OzContactValues *one, const OzContactValues *other)
{
    (void)other; /* they are of the contact, not of its bodies */
    return (OzContactConstants){.stiffness = one->hertz_stiffness,
                                .damping = one->normal_damping_rate,
                                .tangential_damping = one->tangential_damping_rate};
}

static OzContactConstants constants_hooke(const OzContactValues *one, const OzContactValues *other)
{
    (void)other;
    return oz_contact_constants(one);
}

#define ROW(NAME, name, choice, linear, stiffness, damping) [OZ_LAW_##NAME] = constants_##name,
static OzContactConstants (*const constants_of[])(const OzContactValues *one,
                                                  const OzContactValues *other) = {OZ_LAWS(ROW)};
#undef ROW

#define ROW(NAME, name, choice, linear, stiffness, damping) [OZ_LAW_##NAME] = linear,
static const bool is_linear[] = {OZ_LAWS(ROW)};
#undef ROW

OzContactConstants oz_contact_constants_of(const OzContactValues *values,
                                           const OzContactValues *grains)
{
    OzContactConstants constants = constants_of[values->law](values, grains);
    constants.law = values->law;
    return constants;
}

bool oz_contact_is_linear(OzLaw law)
{
    return is_linear[law];
}
