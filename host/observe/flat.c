/* One function for each kind of column of flat grains. */
#include "observe/flat.h"

#include <math.h>

static const double DEGREES = 180 / 3.14159265358979323846;

bool oz_flat_speed_mean(const OzObservation *observation, double *value)
{
    const OzSnapshot *s = observation->snapshot;
    double sum = 0;
    for (int64_t g = 0; g < s->count; g++) {
        sum += hypot(s->velocity[3 * g], s->velocity[3 * g + 1]);
    }
    *value = sum / fmax((double)s->count, 1);
    return s->count > 0;
}

bool oz_flat_spin_mean(const OzObservation *observation, double *value)
{
    const OzSnapshot *s = observation->snapshot;
    double sum = 0;
    for (int64_t g = 0; g < s->count; g++) {
        sum += fabs(s->angular_velocity[3 * g + 2]);
    }
    *value = sum / fmax((double)s->count, 1);
    return s->count > 0;
}

bool oz_flat_spin(const OzObservation *observation, double *value)
{
    const OzSnapshot *s = observation->snapshot;
    bool there = observation->index < s->count;
    *value = there ? s->angular_velocity[3 * observation->index + 2] : 0;
    return there;
}

bool oz_flat_wall_touches(const OzObservation *observation, double *value)
{
    *value = (double)observation->contacts.walls;
    return observation->snapshot->has_contacts;
}

bool oz_flat_touches(const OzObservation *observation, double *value)
{
    *value = (double)observation->contacts.kinds[observation->index];
    return observation->snapshot->has_contacts;
}

static double triangle_touches(const OzContactSums *contacts)
{
    int64_t sum = 0;
    for (int k = OZ_CONTACT_I; k <= OZ_CONTACT_VI; k++) {
        sum += contacts->kinds[k];
    }
    return (double)sum;
}

bool oz_flat_touch_share(const OzObservation *observation, double *value)
{
    double all = triangle_touches(&observation->contacts);
    *value = (double)observation->contacts.kinds[observation->index] / fmax(all, 1);
    return observation->snapshot->has_contacts && all > 0;
}

bool oz_flat_overlap_max(const OzObservation *observation, double *value)
{
    *value = observation->contacts.overlap_max;
    return observation->snapshot->has_contacts;
}

bool oz_flat_overlap_mean(const OzObservation *observation, double *value)
{
    const OzContactSums *contacts = &observation->contacts;
    *value = contacts->overlap_sum / fmax(triangle_touches(contacts), 1);
    return observation->snapshot->has_contacts;
}

bool oz_flat_beams(const OzObservation *observation, double *value)
{
    const OzSnapshot *s = observation->snapshot;
    const double values[] = {s->beams.stretch_min, s->beams.stretch_max,
                             DEGREES * s->beams.bend_max};
    *value = values[observation->index];
    return s->has_contacts && s->grains->elements->beam_count > 0;
}

bool oz_flat_breakage(const OzObservation *observation, double *value)
{
    const OzSnapshot *s = observation->snapshot;
    const double values[] = {(double)s->count, (double)oz_wear_broken(&s->wear),
                             s->element_ledger.beam_broken, s->element_ledger.beam_yielded};
    *value = values[observation->index];
    return observation->index < 2 || s->has_ledger;
}

bool oz_flat_stored(const OzObservation *observation, double *value)
{
    const OzSnapshot *s = observation->snapshot;
    *value = observation->index == 0 ? observation->contacts.energy : s->beams.energy;
    return s->has_contacts;
}

bool oz_flat_outflow(const OzObservation *observation, double *value)
{
    const OzFlow *flow = observation->flow;
    const double values[] = {(double)flow->out_count, flow->out_mass, flow->out_rate};
    *value = values[observation->index];
    return observation->index == 2 ? flow->has_rate : flow->has_outlet;
}

bool oz_flat_inclination(const OzObservation *observation, double *value)
{
    const OzFlow *flow = observation->flow;
    bool any = flow->sample_count > 0;
    const double values[] = {flow->surface,
                             flow->centre,
                             flow->mean,
                             flow->deviation,
                             (double)flow->avalanche_count,
                             flow->avalanche_size};
    const bool known[] = {flow->has_surface,        flow->has_centre, any, any, any,
                          flow->avalanche_count > 0};
    *value = values[observation->index];
    return known[observation->index];
}
