/* Sums over contacts, by the same physics that moves the grains. Knows nothing of lists. */
#include "sim/touch.h"

#include "sim/dialect.h"

#include <string.h>

OzStatus oz_touch_begin(OzTouch *touch, const OzSnapshot *snapshot)
{
    memset(touch, 0, sizeof *touch);
    touch->snapshot = snapshot;
    return oz_physics_derive(&touch->physics, snapshot->scene, snapshot->grains);
}

static OzGrain grain_of(const OzSnapshot *snapshot, int64_t id)
{
    const double *at = &snapshot->position[3 * id];
    OzGrain grain = {.position = {at[0], at[1], at[2]},
                     .velocity = oz_dialect_load3(&snapshot->velocity[3 * id]),
                     .rate = oz_dialect_load3(&snapshot->angular_velocity[3 * id]),
                     .radius = snapshot->grains->diameter[id] / 2,
                     .mass = snapshot->grains->mass[id],
                     .inverse_inertia = 1 / snapshot->grains->inertia[id]};
    grain.half_shaft =
        oz_scale(oz_dialect_load3(&snapshot->axis[3 * id]), snapshot->grains->length[id] / 2);
    return grain;
}

/* Energy of a contact's tangential spring, J: what it would give back at its normal force now. With
 * `slip: scale` a spring grows beyond what friction lets it push with: at most the limit's force
 * times the way back. */
static double tangential_energy(const OzTouch *touch, OzContact contact, OzContactForce parts,
                                double friction, const double history[3])
{
    if (!OZ_HISTORY || !history) {
        return 0;
    }
    OzVec3 sliding = oz_scale(oz_along(contact.velocity, contact.rate, contact.normal), -1);
    OzVec3 stretch = oz_along(oz_contact_turn(oz_dialect_load3(history), contact.normal),
                              touch->physics.share * touch->physics.parameters.dt, sliding);
    double length = sqrt(oz_dot(stretch, stretch)), full = parts.tangential_stiffness * length;
    double limit = friction * fabs(oz_dot(parts.force, contact.normal));
    double force = OZ_SLIP_SCALE ? fmin(full, limit) : full;
    return full > 0 ? force * (length - 0.5 * length * force / full) : 0;
}

static void add(OzTouch *touch, OzContact contact, OzContactForce parts, double friction,
                const double history[3])
{
    double tangential = tangential_energy(touch, contact, parts, friction, history);
    touch->contacts.overlap_sum += contact.overlap;
    touch->contacts.overlap_max = oz_larger(touch->contacts.overlap_max, contact.overlap);
    touch->tangential += tangential;
    touch->elastic += tangential + parts.energy;
    touch->last = (OzTouchLast){contact.overlap, contact.rate, contact.mass, parts.energy};
}

void oz_touch_pair(OzTouch *touch, int64_t a, int64_t b, const double history[3])
{
    OzVec3 spring = {0};
    dialect = touch->physics.switches;
    OzPairForce pair =
        oz_rods_pair(grain_of(touch->snapshot, a), grain_of(touch->snapshot, b), 1,
                     touch->physics.parameters.law, &spring, 0, touch->physics.share);
    if (pair.contact.touching) {
        touch->contacts.pair_count++;
        add(touch, pair.contact, pair.parts, touch->physics.parameters.law.friction, history);
    }
}

void oz_touch_wall(OzTouch *touch, int64_t grain, int wall, int end, const double history[3])
{
    const OzSnapshot *snapshot = touch->snapshot;
    int scene_wall = touch->physics.wall_order[wall];
    OzVec3 spring = {0}, arm;
    OzContact contact;
    dialect = touch->physics.switches;
    OzContactForce parts = oz_dialect_touch_wall(
        &touch->physics, wall, end, grain_of(snapshot, grain), snapshot->wall_offset[scene_wall],
        snapshot->wall_velocity[scene_wall], 0, &spring, &contact, &arm);
    if (contact.touching) {
        touch->contacts.wall_count++;
        add(touch, contact, parts, touch->physics.parameters.wall[wall].law.friction, history);
    }
}
