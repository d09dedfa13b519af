/* Comparing energies of rows. */
#include "observe/surplus.h"

#include "model/hertz.h"
#include "observe/observables.h"

#include <math.h>

/* Whether friction may give energy back, which is the law's doing and not the step's. */
static bool returns_energy(const OzScene *scene)
{
    return scene->model == OZ_MODEL_RODS && scene->contact.slip == OZ_SLIP_SCALE;
}

static bool is_known(const OzSnapshot *snapshot)
{
    if (returns_energy(snapshot->scene) && !snapshot->has_ledger) {
        return false;
    }
    if (snapshot->scene->is_pushed) { /* from outside, whose work nobody counts */
        return false;
    }
    if (snapshot->scene->boundary.shear_rate != 0 && !snapshot->has_ledger) {
        return false;
    }
    const double *wind = snapshot->scene->drag.wind;
    if ((wind[0] != 0 || wind[1] != 0 || wind[2] != 0) && !snapshot->has_ledger) {
        return false;
    }
    for (int w = 0; w < snapshot->scene->wall_count && !snapshot->has_ledger; w++) {
        const OzWall *wall = &snapshot->scene->walls[w];
        if (wall->motion.present || wall->servo.present || wall->since > 0) {
            return false;
        }
    }
    return snapshot->has_contacts;
}

/* Kinetic, rotational, potential and stored energy, less the work of the walls and what friction
 * has given back. */
static double mechanical(const OzSnapshot *snapshot)
{
    double back = returns_energy(snapshot->scene) ? fmax(-snapshot->ledger.friction, 0) : 0;
    return oz_observables_energy(snapshot) - oz_observables_lost(snapshot) - back;
}

static double fall_of_a_diameter(const OzSnapshot *snapshot, const double *gravity)
{
    double size = sqrt(gravity[0] * gravity[0] + gravity[1] * gravity[1] + gravity[2] * gravity[2]);
    double sum = 0;
    for (int64_t i = 0; i < snapshot->count; i++) {
        sum += snapshot->grains->mass[i] * size * snapshot->grains->diameter[i];
    }
    return sum;
}

static double potential(const OzSnapshot *snapshot)
{
    const double *g = snapshot->scene->gravity, *x = snapshot->position;
    double sum = 0;
    for (int64_t i = 0; i < snapshot->count; i++, x += 3) {
        sum -= snapshot->grains->mass[i] * (g[0] * x[0] + g[1] * x[1] + g[2] * x[2]);
    }
    return sum;
}

/* The stiffest contact of two grains, per mass. */
static double linear_of(const OzScene *scene)
{
    double stiffest = oz_contact_constants_of(&scene->contact, &scene->contact).stiffness;
    for (int i = 1; i < oz_mixing_contacts(scene) - scene->wall_count * oz_mixing_count(scene);
         i++) {
        OzMixed mixed;
        oz_mixing_contact(&mixed, scene, i);
        stiffest =
            fmax(stiffest, oz_contact_constants_of(&mixed.values, &scene->contact).stiffness);
    }
    return stiffest;
}

static double hertz_of(const OzScene *scene, const OzGrains *grains)
{
    double stiffest = 0;
    for (int i = 0; i < oz_mixing_contacts(scene); i++) {
        OzMixed mixed;
        oz_mixing_contact(&mixed, scene, i);
        if (mixed.wall < 0) {
            stiffest = fmax(stiffest, oz_hertz_hit(scene, &mixed, grains).stiffness);
        }
    }
    return stiffest;
}

/* Energy of rounding: what contacts and beams hold when lengths are wrong by so small a share. A
 * percent of overlap and, of its energy, 1e-12 comes to 1e-8 of lengths; places in float are kept
 * to 2^-22 of the smallest diameter (constants.c), of which some sixteen may come together. */
static double rounding(const OzSnapshot *snapshot)
{
    const OzScene *scene = snapshot->scene;
    const OzGrains *g = snapshot->grains;
    double share = scene->precision == OZ_PRECISION_FLOAT ? 4e-6 : 1e-8, sum = 0;
    bool is_linear = oz_contact_is_linear(scene->contact.law);
    double linear = linear_of(scene);
    linear = isfinite(linear) ? linear : 0; /* without discs no contact time is given */
    double hertz = is_linear ? 0 : hertz_of(scene, g);
    for (int64_t i = 0; i < snapshot->count; i++) {
        double way = share * g->diameter[i];
        sum += is_linear ? 0.5 * g->mass[i] * linear * way * way
                         : 0.4 * g->mass[i] * hertz * way * way * sqrt(way);
        sum += g->elements ? 0.5 * scene->triangles.stiffness * g->diameter[i] * way * way : 0;
    }
    for (int64_t k = 0; g->elements && k < g->elements->beam_count; k++) {
        double length = g->elements->beam_length[k], way = share * length;
        sum += 0.5 * scene->beams.stiffness * way * way;
        sum += length > 0 ? 2 * scene->beams.stiffness * scene->beams.second_moment / length *
                                share * share
                          : 0;
    }
    return sum;
}

OzStatus oz_surplus_check(OzSurplus *surplus, const OzSnapshot *snapshot)
{
    if (!is_known(snapshot)) {
        return OZ_OK;
    }
    double energy = mechanical(snapshot);
    if (!surplus->has_start) {
        surplus->has_start = true;
        surplus->start = energy;
        surplus->scale = energy - potential(snapshot) + rounding(snapshot) +
                         fall_of_a_diameter(snapshot, snapshot->scene->gravity);
        return OZ_OK;
    }
    double gain = energy - surplus->start;
    if (gain <= surplus->scale || gain <= 0) { /* NaN is neither */
        return OZ_OK;
    }
    return oz_status_fail(
        OZ_ERR_BLOWUP,
        "%s: stopped at step %lld, time %.9g s: grains and springs have gained "
        "%.3g J without input, %.3g times what they held; try a smaller time.step "
        "(`orzo check` says what is stable)",
        snapshot->scene->path, (long long)snapshot->step, snapshot->time, gain,
        gain / surplus->scale);
}

OzStatus oz_surplus_state(OzSurplus *surplus, OzStateVisit *visit)
{
    OZ_PASS(oz_state_enter(visit, "surplus", 1));
    OZ_PASS(oz_state_bool(visit, "has_start", &surplus->has_start));
    OZ_PASS(oz_state_double(visit, "start", "J", &surplus->start, 1));
    OZ_PASS(oz_state_double(visit, "scale", "J", &surplus->scale, 1));
    oz_state_leave(visit);
    return OZ_OK;
}
