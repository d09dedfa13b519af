/* Sums over elements. Those of walls have no mass. */
#include "observe/element_energy.h"

double oz_element_energy_translational(const OzSnapshot *snapshot)
{
    const OzElements *elements = snapshot->grains->elements;
    double sum = 0;
    for (int64_t i = 0; i < elements->free_count; i++) {
        const double *v = snapshot->element_velocity + 2 * i;
        sum += elements->mass[i] / 2 * (v[0] * v[0] + v[1] * v[1]);
    }
    return sum;
}

double oz_element_energy_rotational(const OzSnapshot *snapshot)
{
    const OzElements *elements = snapshot->grains->elements;
    double sum = 0;
    for (int64_t i = 0; i < elements->free_count; i++) {
        sum += elements->inertia[i] / 2 * snapshot->element_angular_velocity[i] *
               snapshot->element_angular_velocity[i];
    }
    return sum;
}

double oz_element_energy_potential(const OzSnapshot *snapshot)
{
    const OzElements *elements = snapshot->grains->elements;
    const double *g = snapshot->scene->gravity;
    double sum = 0;
    for (int64_t i = 0; i < elements->free_count; i++) {
        const double *x = snapshot->element_position + 2 * i;
        sum -= elements->mass[i] * (g[0] * x[0] + g[1] * x[1]);
    }
    return sum;
}

double oz_element_energy_stored(const OzSnapshot *snapshot)
{
    return oz_contact_list_sum(&snapshot->contacts).energy + snapshot->beams.energy;
}

double oz_element_energy_lost(const OzSnapshot *snapshot)
{
    const OzElementLedger *ledger = &snapshot->element_ledger;
#define ADD(NAME, member, column, meaning) +ledger->member
    return ledger->beam_broken + ledger->beam_yielded OZ_ELEMENT_LEDGER_LOSSES(ADD);
#undef ADD
}
