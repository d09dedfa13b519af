/* Sums over grains and contacts. */
#include "observe/stress.h"

#include "scene/boundary.h"

static const int axes[OZ_STRESS_PARTS][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

double oz_stress_volume(const OzBoundary *boundary)
{
    return oz_boundary_period(boundary, 0) * oz_boundary_period(boundary, 1) *
           oz_boundary_period(boundary, 2);
}

static double of_contact(const OzSnapshot *s, const OzContactEntry *e, const OzBoundary *cell,
                         int force, int normal)
{
    double way[3];
    for (int k = 0; k < 3; k++) {
        way[k] = s->position[3 * (int64_t)e->b + k] - s->position[3 * (int64_t)e->a + k];
    }
    oz_boundary_wrap(cell, way);
    return (e->push * e->normal[force] + e->tangential[force]) * way[normal];
}

double oz_stress_part(const OzSnapshot *snapshot, int part)
{
    OzBoundary cell = oz_snapshot_cell(snapshot);
    int force = axes[part][0], normal = axes[part][1];
    double sum = 0;
    for (int64_t i = 0; i < snapshot->count; i++) {
        const double *c = &snapshot->velocity[3 * i];
        sum += snapshot->grains->mass[i] * c[force] * c[normal];
    }
    for (int64_t k = 0; k < snapshot->contacts.count; k++) {
        const OzContactEntry *e = &snapshot->contacts.entry[k];
        sum += e->b >= 0 ? of_contact(snapshot, e, &cell, force, normal) : 0;
    }
    return sum / oz_stress_volume(&cell);
}

bool oz_stress_value(const OzObservation *o, double *value)
{
    *value = oz_stress_part(o->snapshot, o->index);
    return o->snapshot->has_contacts;
}

bool oz_stress_strain(const OzObservation *o, double *value)
{
    *value = oz_snapshot_cell(o->snapshot).strain;
    return true;
}
