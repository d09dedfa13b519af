/* Contacts, by the same physics that moves the grains. Knows nothing of lists of pairs. */
#include "sim/contacts.h"

#include "model/motion.h"
#include "sim/dialect.h"
#include "sim/gates.h"
#include "sim/swings.h"

OzStatus oz_contacts_begin(OzContacts *contacts, const OzSnapshot *snapshot, OzContactList *list)
{
    *contacts = (OzContacts){.snapshot = snapshot, .list = list, .found_grain = -1};
    OZ_PASS(oz_physics_derive(&contacts->physics, snapshot->scene, snapshot->grains));
    oz_gates_set(&contacts->physics, snapshot->scene, snapshot->time, snapshot->settling);
    oz_swings_set(&contacts->physics, snapshot->scene, snapshot->time, snapshot->settling);
    contacts->tilt = oz_snapshot_cell(snapshot).tilt;
    contacts->rate = snapshot->settling ? 0 : snapshot->scene->boundary.shear_rate;
    contacts->share = contacts->physics.share;
    if (contacts->physics.switches.moves_before) {
        contacts->physics.share -=
            1; /* the force was part of the last step, and springs are ahead */
    }
    for (int k = 0; k < contacts->physics.wall_count; k++) {
        int wall = contacts->physics.wall_order[k];
        const OzMotion *motion = &snapshot->scene->walls[wall].motion;
        contacts->drives[k] = oz_dialect_drive(
            &contacts->physics, k, snapshot->wall_offset[wall], snapshot->wall_velocity[wall],
            snapshot->settling ? 0 : oz_motion_rate(motion, snapshot->time));
        oz_swings_drive(&contacts->drives[k], &contacts->physics, snapshot->scene, k,
                        snapshot->time, snapshot->settling);
    }
    return OZ_OK;
}

/* Its place is that in a sheared cell's lattice. */
static OzGrain grain_of(const OzContacts *contacts, int64_t id)
{
    const OzSnapshot *snapshot = contacts->snapshot;
    const double *at = &snapshot->position[3 * id];
    OzGrain grain = {.position = {at[0] - contacts->tilt * at[1], at[1], at[2]},
                     .velocity = oz_dialect_load3(&snapshot->velocity[3 * id]),
                     .rate = oz_dialect_load3(&snapshot->angular_velocity[3 * id]),
                     .radius = snapshot->grains->diameter[id] / 2,
                     .mass = snapshot->grains->mass[id],
                     .inverse_inertia = 1 / snapshot->grains->inertia[id]};
    grain.half_shaft =
        oz_scale(oz_dialect_load3(&snapshot->axis[3 * id]), snapshot->grains->length[id] / 2);
    return grain;
}

/* What the physics found, about to become an entry. */
typedef struct Found {
    OzContact contact;
    OzContactForce parts;
    OzMemory stored;
} Found;

/* Energy of a contact's tangential spring, J, advanced by the integrator's share of a step: what it
 * would give back at its normal force now. With `slip: scale` a spring grows beyond what friction
 * lets it push with: at most the limit's force times the way back. */
static double spring_energy(const OzContacts *contacts, const Found *found, double friction)
{
    const OzContact *c = &found->contact;
    OzVec3 sliding = oz_scale(oz_along(c->velocity, c->rate, c->normal), -1);
    OzVec3 stretch = oz_along(oz_contact_turn(found->stored.stretch, c->normal),
                              contacts->share * contacts->physics.parameters.dt, sliding);
    double length = sqrt(oz_dot(stretch, stretch));
    double full = found->parts.tangential_stiffness * length;
    double limit = friction * fabs(found->parts.press);
    double force = OZ_SLIP_SCALE ? fmin(full, limit) : full;
    return full > 0 ? force * (length - 0.5 * length * force / full) : 0;
}

/* Of its rolling spring. */
static double rolling_energy(const OzContacts *contacts, const Found *found)
{
    const OzContact *c = &found->contact;
    OzVec3 rolling = oz_along(c->turning, -oz_dot(c->turning, c->normal), c->normal);
    OzVec3 turned = oz_along(oz_contact_turn(found->stored.turned, c->normal),
                             contacts->share * contacts->physics.parameters.dt, rolling);
    return 0.5 * found->parts.couple.stiffness * oz_dot(turned, turned);
}

static double springs_energy(const OzContacts *contacts, const Found *found, double friction)
{
    double energy = OZ_HISTORY ? spring_energy(contacts, found, friction) : 0;
    return energy + (OZ_ROLLING_SPRING ? rolling_energy(contacts, found) : 0);
}

static OzVec3 couple_of(const Found *found)
{
    return oz_add(found->parts.couple.spring, found->parts.couple.dashpot);
}

/* turn: 1, or -1 where the kernels' a is the entry's b; at: the centre of the entry's a; arm: from
 * there to where the force acts. */
static void fill(OzContactEntry *entry, const Found *found, double turn, const double *at,
                 OzVec3 arm)
{
    OzVec3 normal = oz_scale(found->contact.normal, turn);
    OzVec3 force = oz_scale(found->parts.force, turn);
    entry->push = oz_dot(force, normal);
    oz_dialect_store3(entry->point, oz_add(oz_dialect_load3(at), arm));
    oz_dialect_store3(entry->normal, normal);
    oz_dialect_store3(entry->tangential, oz_along(force, -entry->push, normal));
    oz_dialect_store3(entry->spring, oz_scale(found->stored.stretch, turn));
    oz_dialect_store3(entry->couple, oz_scale(couple_of(found), turn));
    entry->slips = found->parts.slips;
    entry->overlap = found->contact.overlap;
    entry->rate = found->contact.rate;
    entry->mass = found->contact.mass;
    entry->energy = found->parts.energy;
}

/* What a contact remembers; NULL: nothing. */
static OzMemory stored_of(const OzMemory *memory)
{
    OzVec3 none = oz_vec3(0, 0, 0);
    return memory && OZ_HISTORY ? *memory : (OzMemory){none, none};
}

OzStatus oz_contacts_pair(OzContacts *contacts, int64_t a, int64_t b, const OzMemory *memory)
{
    const OzPhysics *physics = &contacts->physics;
    OzGrain first = grain_of(contacts, a), second = grain_of(contacts, b);
    OzSpace space = oz_dialect_sheared(physics, contacts->tilt, contacts->rate);
    OzLawConstants law = oz_dialect_pair_law(physics, a, b);
    OZ_USE_SWITCHES(oz_host_switches_rods(&physics->switches));
    bool turned = a > b;
    Found found = {.stored = stored_of(memory)};
    OzMemory next = found.stored;
    OzPairForce pair =
        oz_rods_pair(first, second, space, law, &next, physics->parameters.dt, physics->share);
    if (!pair.contact.touching) {
        return OZ_OK;
    }
    OzContactEntry entry = {.a = (int32_t)(turned ? b : a), .b = (int32_t)(turned ? a : b)};
    found.contact = pair.contact;
    found.parts = pair.parts;
    entry.spring_energy = memory ? springs_energy(contacts, &found, law.friction) : 0;
    fill(&entry, &found, turned ? -1 : 1, &contacts->snapshot->position[3 * (turned ? b : a)],
         turned ? pair.arm_b : pair.arm_a);
    return oz_contact_list_add(contacts->list, &entry);
}

/* What kernel wall w, a mesh, does to a grain. */
static OzWallEnd mesh_end(OzContacts *contacts, int64_t id, OzGrain grain, int w, int slot)
{
    const OzPhysics *physics = &contacts->physics;
    if (contacts->found_grain != id || contacts->found_wall != w) {
        double words[OZ_MESH_SLOTS * OZ_MESH_MEMORY] = {0};
        int mesh = w - (physics->wall_count - physics->edged - physics->meshes);
        for (int k = 0; contacts->memory && k < OZ_MESH_SLOTS * OZ_MESH_MEMORY; k++) {
            words[k] = contacts->memory[mesh * OZ_MESH_SLOTS * OZ_MESH_MEMORY + k];
        }
        OzVec3 from =
            oz_dialect_from(physics, w, grain.position, oz_vec3(0, 0, 0), contacts->drives[w]);
        oz_host_mesh_find(&contacts->found, physics, w, from, grain.half_shaft, grain.radius,
                          words);
        contacts->found_grain = id;
        contacts->found_wall = w;
    }
    return oz_dialect_mesh_end(&contacts->found.at[slot], grain);
}

OzStatus oz_contacts_wall(OzContacts *contacts, int64_t grain, int index, const OzMemory *memory)
{
    const OzPhysics *physics = &contacts->physics;
    const OzSnapshot *snapshot = contacts->snapshot;
    OzGrain one = grain_of(contacts, grain);
    int wall, part = oz_dialect_part(physics, index, &wall);
    OZ_USE_SWITCHES(oz_host_switches_rods(&physics->switches));
    Found found = {.stored = stored_of(memory)};
    OzMemory next = found.stored;
    double dt = physics->parameters.dt;
    OzWallForce at =
        part < OZ_WALL_PARTS
            ? oz_dialect_touch_wall(physics, index, grain, one, contacts->drives, dt, &next)
            : oz_dialect_touch_end(physics, wall,
                                   mesh_end(contacts, grain, one, wall, part - OZ_WALL_PARTS),
                                   grain, one, contacts->drives, dt, &next);
    found.parts = at.parts;
    found.contact = at.contact;
    if (!found.contact.touching) {
        return OZ_OK;
    }
    OzContactEntry entry = {
        .a = (int32_t)grain, .b = -1 - physics->wall_order[wall], .part_a = index};
    double friction = oz_dialect_wall_law(physics, wall, grain).friction;
    entry.spring_energy = memory ? springs_energy(contacts, &found, friction) : 0;
    fill(&entry, &found, -1, &snapshot->position[3 * grain], at.arm); /* to kernels a wall is a */
    return oz_contact_list_add(contacts->list, &entry);
}
