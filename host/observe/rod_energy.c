/* Sums over rigid grains. */
#include "observe/rod_energy.h"

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double oz_rod_energy_translational(const OzSnapshot *s)
{
    double sum = 0;
    for (int64_t i = 0; i < s->count; i++) {
        sum += s->grains->mass[i] / 2 * dot(&s->velocity[3 * i], &s->velocity[3 * i]);
    }
    return sum;
}

double oz_rod_energy_rotational(const OzSnapshot *s)
{
    double sum = 0;
    for (int64_t i = 0; i < s->count; i++) {
        const double *w = &s->angular_velocity[3 * i];
        double along = dot(w, &s->axis[3 * i]);
        double across = dot(w, w) - along * along;
        sum += (s->grains->inertia[i] * across + s->grains->inertia_axis[i] * along * along) / 2;
    }
    return sum;
}

double oz_rod_energy_potential(const OzSnapshot *s)
{
    double sum = 0;
    for (int64_t i = 0; i < s->count; i++) {
        sum -= s->grains->mass[i] * dot(s->scene->gravity, &s->position[3 * i]);
    }
    return sum;
}
