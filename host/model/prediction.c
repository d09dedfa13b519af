/* Each kind of contact of a scene: its constants, and what the integrator makes of them. */
#include "model/prediction.h"

#include "base/memory.h"
#include "model/calibrate.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* The effective mass along a sticking contact is smaller than across it, because the grains turn:
 * 2/7 for a sphere, less at a rod's end. Explicit Euler does not care, and never carries an
 * undamped spring; the others see the spring stiffer by this much. */
static bool sticking_is_stable(const OzScene *scene, const OzContactValues *values,
                               const OzContactConstants *constants)
{
    if (!(values->friction > 0) || !(constants->tangential_stiffness > 0)) {
        return true;
    }
    const double lighter = 3.5;
    return scene->step < oz_predict_largest_step(scene->integrator,
                                                 lighter * constants->tangential_stiffness,
                                                 lighter * constants->tangential_damping);
}

static OzPrediction predict_kind(const OzScene *scene, const OzMixed *mixed, const OzGrains *grains)
{
    const OzContactValues *values = &mixed->values;
    bool linear = oz_contact_is_linear(values->law);
    OzPrediction row = {.wall = mixed->wall,
                        .one = mixed->one,
                        .other = mixed->other,
                        .values = *values,
                        .closed_form = NAN};
    double step = scene->step;
    if (linear) {
        row.constants = oz_calibrate_contact(scene, values);
        row.hits = oz_predict_hits(scene->integrator, step, &row.constants, values->attraction);
    } else {
        OzHertzHit hertz = oz_hertz_hit(scene, mixed, grains);
        row.constants = hertz.linear;
        row.speed = hertz.speed;
        row.hits = oz_predict_hertz_hits(scene, values, &hertz);
    }
    OzContactConstants c = row.constants;
    row.steps = c.duration / step;
    OzEigenvalues eigenvalues =
        oz_predict_eigenvalues(scene->integrator, c.stiffness * step * step, c.damping * step);
    row.radius = eigenvalues.radius;
    if (values->law == OZ_LAW_HOOKE && values->attraction == OZ_ATTRACTION_ALLOW && !c.smooth &&
        eigenvalues.theta > 0) {
        row.closed_form = pow(eigenvalues.rho, pi / eigenvalues.theta);
    }
    row.largest_step = oz_predict_largest_step(scene->integrator, c.stiffness, c.damping);
    row.margin = row.largest_step / step;
    row.stable = row.margin > 1;
    row.tangential_stable = sticking_is_stable(scene, values, &c);
    return row;
}

/* Least and greatest mass of a kind's grains; false: there are none. */
static bool find_masses(double *low, double *high, const OzScene *scene, const OzGrains *grains,
                        int kind)
{
    bool all = oz_mixing_count(scene) == 1;
    *low = INFINITY;
    *high = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        if (all || oz_mixing_kind(scene, grains->population[i]) == kind) {
            *low = fmin(*low, grains->mass[i]);
            *high = fmax(*high, grains->mass[i]);
        }
    }
    return *high > 0;
}

/* Effective masses: half a grain's between two like ones, the grain's own against a wall. */
static void set_masses(OzPrediction *row, const OzScene *scene, const OzGrains *grains)
{
    double low, high, other_low, other_high;
    bool any = find_masses(&low, &high, scene, grains, row->one);
    if (row->wall < 0 && row->one != row->other) {
        any &= find_masses(&other_low, &other_high, scene, grains, row->other);
        row->mass_low = any ? low * other_low / (low + other_low) : 0;
        row->mass_high = any ? high * other_high / (high + other_high) : 0;
        return;
    }
    double share = row->wall < 0 ? 0.5 : 1;
    row->mass_low = any ? share * low : 0;
    row->mass_high = share * high;
}

OzStatus oz_prediction_rows(OzPrediction **rows, int *count, const OzScene *scene,
                            const OzGrains *grains)
{
    *count = oz_mixing_contacts(scene);
    OZ_PASS(OZ_NEW(rows, *count));
    for (int i = 0; i < *count; i++) {
        OzMixed mixed;
        oz_mixing_contact(&mixed, scene, i);
        (*rows)[i] = predict_kind(scene, &mixed, grains);
        set_masses(&(*rows)[i], scene, grains);
    }
    return OZ_OK;
}
