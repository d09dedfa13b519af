/* Comparing energies of rows. */
#include "observe/surplus.h"

#include "observe/observables.h"

#include <math.h>

static bool is_known(const OzSnapshot *snapshot)
{
    for (int w = 0; w < snapshot->scene->wall_count && !snapshot->has_ledger; w++) {
        if (snapshot->scene->walls[w].motion.present) {
            return false;
        }
    }
    return snapshot->has_contacts;
}

/* Kinetic, rotational, potential and stored energy, less the work of the walls. */
static double mechanical(const OzSnapshot *snapshot)
{
    return oz_observables_energy(snapshot) - oz_observables_lost(snapshot);
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

OzStatus oz_surplus_check(OzSurplus *surplus, const OzSnapshot *snapshot)
{
    if (!is_known(snapshot)) {
        return OZ_OK;
    }
    double energy = mechanical(snapshot);
    if (!surplus->has_start) {
        surplus->has_start = true;
        surplus->start = energy;
        surplus->scale =
            energy - potential(snapshot) + fall_of_a_diameter(snapshot, snapshot->scene->gravity);
        return OZ_OK;
    }
    double gain = energy - surplus->start;
    if (!(gain > surplus->scale) || !(gain > 0)) {
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
