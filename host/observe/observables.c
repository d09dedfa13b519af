/* THE list of observables and the function of each. Knows nothing of files and of tap means, which
 * it is handed. */
#include "observe/observables.h"

#include <math.h>

static bool step(const OzObservation *o, double *value)
{
    *value = (double)o->snapshot->step;
    return true;
}

static bool time_now(const OzObservation *o, double *value)
{
    *value = o->snapshot->time;
    return true;
}

static bool tap(const OzObservation *o, double *value)
{
    double period = o->snapshot->scene->period;
    *value = period > 0 ? o->snapshot->time / period : 0;
    return period > 0;
}

static bool density(const OzObservation *o, double *value)
{
    return oz_measure_density(o->measure, o->snapshot, value);
}

static bool density_all(const OzObservation *o, double *value)
{
    return oz_measure_density_all(o->measure, o->snapshot, value);
}

static bool density_tap_mean(const OzObservation *o, double *value)
{
    *value = o->density_mean;
    return o->has_density_mean;
}

static bool density_com(const OzObservation *o, double *value)
{
    return oz_measure_density_com(o->measure, o->snapshot, value);
}

static bool density_slab(const OzObservation *o, double *value)
{
    return oz_measure_density_slab(o->measure, o->snapshot, value);
}

static bool angle(const OzObservation *o, double *value)
{
    return oz_measure_angle(o->snapshot, value);
}

static bool angle_tap_mean(const OzObservation *o, double *value)
{
    *value = o->angle_mean;
    return o->has_angle_mean;
}

static bool angle_layer(const OzObservation *o, double *value)
{
    const OzLayer *layer = &o->layers[o->index];
    *value = layer->rod_count > 0 ? layer->angle_sum / (double)layer->rod_count : 0;
    return layer->rod_count > 0;
}

static bool count_layer(const OzObservation *o, double *value)
{
    *value = (double)o->layers[o->index].count;
    return true;
}

static bool nematic(const OzObservation *o, double *value)
{
    return oz_measure_nematic(o->snapshot, value);
}

static bool contact_count(const OzObservation *o, double *value)
{
    *value = (double)o->snapshot->contacts.pair_count;
    return o->snapshot->has_contacts;
}

static bool overlap_max(const OzObservation *o, double *value)
{
    *value = o->snapshot->contacts.overlap_max;
    return o->snapshot->has_contacts;
}

static bool overlap_mean(const OzObservation *o, double *value)
{
    const OzContactSums *sums = &o->snapshot->contacts;
    int64_t count = sums->pair_count + sums->wall_count;
    *value = count > 0 ? sums->overlap_sum / (double)count : 0;
    return o->snapshot->has_contacts;
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool speed_max(const OzObservation *o, double *value)
{
    double square = 0;
    for (int64_t i = 0; i < o->snapshot->count; i++) {
        double next = dot(&o->snapshot->velocity[3 * i], &o->snapshot->velocity[3 * i]);
        square = next <= square || isnan(square) ? square : next; /* a NaN is taken and kept */
    }
    *value = sqrt(square);
    return true;
}

static double kinetic_energy(const OzSnapshot *s)
{
    double sum = 0;
    for (int64_t i = 0; i < s->count; i++) {
        sum += s->grains->mass[i] / 2 * dot(&s->velocity[3 * i], &s->velocity[3 * i]);
    }
    return sum;
}

static double rotational_energy(const OzSnapshot *s)
{
    double sum = 0;
    for (int64_t i = 0; i < s->count; i++) {
        const double *w = &s->spin[3 * i];
        double along = dot(w, &s->axis[3 * i]);
        double across = dot(w, w) - along * along;
        sum += (s->grains->inertia[i] * across + s->grains->inertia_axis[i] * along * along) / 2;
    }
    return sum;
}

static double potential_energy(const OzSnapshot *s)
{
    double sum = 0;
    for (int64_t i = 0; i < s->count; i++) {
        sum -= s->grains->mass[i] * dot(s->scene->gravity, &s->position[3 * i]);
    }
    return sum;
}

double oz_observables_energy(const OzSnapshot *snapshot)
{
    const OzLedger *ledger = &snapshot->ledger;
    return kinetic_energy(snapshot) + rotational_energy(snapshot) + potential_energy(snapshot) +
           ledger->elastic + ledger->dissipated + ledger->friction - ledger->work_walls;
}

static bool kinetic(const OzObservation *o, double *value)
{
    *value = kinetic_energy(o->snapshot);
    return true;
}

static bool rotational(const OzObservation *o, double *value)
{
    *value = rotational_energy(o->snapshot);
    return true;
}

static bool potential(const OzObservation *o, double *value)
{
    *value = potential_energy(o->snapshot);
    return true;
}

enum { ELASTIC, DISSIPATED, FRICTION, WORK_WALLS };

static bool ledger_entry(const OzObservation *o, double *value)
{
    const OzLedger *l = &o->snapshot->ledger;
    double entries[] = {l->elastic, l->dissipated, l->friction, l->work_walls};
    *value = entries[o->index];
    return o->snapshot->has_ledger;
}

static bool residual(const OzObservation *o, double *value)
{
    *value = o->has_start ? oz_observables_energy(o->snapshot) - o->energy_start : 0;
    return o->snapshot->has_ledger;
}

#define ALWAYS OZ_COLUMN_ALWAYS
#define LEDGER OZ_COLUMN_LEDGER

/* clang-format off */
static const OzColumn list[] = {
    {"step", "1", "steps since the settled bed", ALWAYS, true, step, 0},
    {"time", "s", "time since the settled bed", ALWAYS, false, time_now, 0},
    {"tap", "1", "time / period of the first moving wall; empty without one", ALWAYS, false, tap, 0},
    {"density", "1", "0.95 V/(area H): H above the moving floor, without the top 5 % of the volume; "
     "this and every density is empty without cylinder or floor", ALWAYS, false, density, 0},
    {"density_all", "1", "V/(area H), the same H", ALWAYS, false, density_all, 0},
    {"density_tap_mean", "1", "mean of density over the samples of the last two periods", ALWAYS,
     false, density_tap_mean, 0},
    {"density_com", "1", "V/(area x twice the centre of mass's height above the moving floor)",
     ALWAYS, false, density_com, 0},
    {"density_slab", "1", "share of the cylinder filled from 2 to 10 mm above the moving floor",
     ALWAYS, false, density_slab, 0},
    {"angle", "degrees", "mean angle between shaft and floor, rods only: 0 flat, 90 upright", ALWAYS,
     false, angle, 0},
    {"angle_tap_mean", "degrees", "mean of angle over the samples of the last two periods", ALWAYS,
     false, angle_tap_mean, 0},
    {"angle_layer1", "degrees", "angle in the layer on the floor's place at rest, by grain centre; "
     "empty without rods", ALWAYS, false, angle_layer, 0},
    {"angle_layer2", "degrees", "the same in the second layer", ALWAYS, false, angle_layer, 1},
    {"angle_layer3", "degrees", "the same in the third layer", ALWAYS, false, angle_layer, 2},
    {"angle_layer4", "degrees", "the same in the fourth layer", ALWAYS, false, angle_layer, 3},
    {"count_layer1", "1", "grains whose centre lies in the first layer", ALWAYS, true, count_layer, 0},
    {"count_layer2", "1", "the same in the second layer", ALWAYS, true, count_layer, 1},
    {"count_layer3", "1", "the same in the third layer", ALWAYS, true, count_layer, 2},
    {"count_layer4", "1", "the same in the fourth layer", ALWAYS, true, count_layer, 3},
    {"nematic_s", "1", "largest eigenvalue of <3uu - 1>/2, rods only: 1 aligned, 0 isotropic", ALWAYS,
     false, nematic, 0},
    {"contact_count", "1", "touching pairs of grains", ALWAYS, true, contact_count, 0},
    {"overlap_max", "m", "deepest overlap of pairs and walls", ALWAYS, false, overlap_max, 0},
    {"overlap_mean", "m", "mean overlap of pairs and walls; 0 when nothing touches", ALWAYS, false,
     overlap_mean, 0},
    {"speed_max", "m/s", "speed of the fastest centre", ALWAYS, false, speed_max, 0},
    {"kinetic", "J", "kinetic energy of the centres", ALWAYS, false, kinetic, 0},
    {"rotational", "J", "kinetic energy of the spins", ALWAYS, false, rotational, 0},
    {"energy_potential", "J", "in gravity, from the origin", LEDGER, false, potential, 0},
    {"energy_elastic", "J", "stored in contacts now", LEDGER, false, ledger_entry, ELASTIC},
    {"energy_dissipated", "J", "lost in dashpots so far", LEDGER, false, ledger_entry, DISSIPATED},
    {"energy_friction", "J", "lost by sliding so far", LEDGER, false, ledger_entry, FRICTION},
    {"work_walls", "J", "put in by moving walls so far", LEDGER, false, ledger_entry, WORK_WALLS},
    {"energy_residual", "J", "change of (kinetic + rotational + potential + elastic) + dissipated + "
     "friction - work_walls since the first row; 0 but for the integrator's error", LEDGER, false,
     residual, 0},
    {0},
};
/* clang-format on */

const OzColumn *oz_observables_list(void)
{
    return list;
}
