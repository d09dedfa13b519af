/* Mechanical energy of rods. */
#include "report/report_energy.h"

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double energy(const OzSnapshot *now, const double *position, const double *quaternion,
                     const double *velocity, const double *angular_velocity)
{
    const OzGrains *g = now->grains;
    double sum = 0, axis[3];
    for (int64_t i = 0; i < now->count;
         i++, position += 3, quaternion += 4, velocity += 3, angular_velocity += 3) {
        oz_grains_axis(quaternion, axis);
        double about = dot(angular_velocity, axis);
        sum += 0.5 * g->mass[i] * dot(velocity, velocity) +
               0.5 * g->inertia[i] * dot(angular_velocity, angular_velocity) +
               0.5 * (g->inertia_axis[i] - g->inertia[i]) * about * about -
               g->mass[i] * dot(now->scene->gravity, position);
    }
    return sum;
}

double oz_report_energy_now(const OzSnapshot *now)
{
    return energy(now, now->position, now->quaternion, now->velocity, now->angular_velocity);
}

double oz_report_energy_start(const OzSnapshot *now)
{
    const OzGrains *g = now->grains;
    return energy(now, g->position, g->quaternion, g->velocity, g->angular_velocity);
}
