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

static OzPrediction predict_kind(const OzScene *scene, const OzContactValues *values, int wall,
                                 const OzGrains *grains)
{
    bool linear = oz_contact_is_linear(values->law);
    OzPrediction row = {.wall = wall, .values = *values, .closed_form = NAN};
    double step = scene->step;
    if (linear) {
        row.constants = oz_calibrate_contact(scene, values);
        row.hits = oz_predict_hits(scene->integrator, step, &row.constants, values->attraction);
    } else {
        OzHertzHit hertz = oz_hertz_hit(scene, values, wall, grains);
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

/* Effective masses: half a grain's between two like ones, the grain's own against a wall. */
static void set_masses(OzPrediction *row, const OzGrains *grains)
{
    double low = INFINITY, high = 0;
    for (int64_t i = 0; i < grains->count; i++) {
        low = fmin(low, grains->mass[i]);
        high = fmax(high, grains->mass[i]);
    }
    double share = row->wall < 0 ? 0.5 : 1;
    row->mass_low = grains->count ? share * low : 0;
    row->mass_high = share * high;
}

OzStatus oz_prediction_rows(OzPrediction **rows, int *count, const OzScene *scene,
                            const OzGrains *grains)
{
    OZ_PASS(OZ_NEW(rows, scene->wall_count + 1));
    *count = scene->wall_count + 1;
    for (int i = 0; i < *count; i++) {
        const OzContactValues *values = i ? &scene->walls[i - 1].contact : &scene->contact;
        (*rows)[i] = predict_kind(scene, values, i - 1, grains);
        set_masses(&(*rows)[i], grains);
    }
    return OZ_OK;
}
