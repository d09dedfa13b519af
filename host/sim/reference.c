/* The host reference: bodies, a pair list with skin, forces and motion, all in double. */
#include "sim/reference_guard.h"
#include "sim/reference_servo.h"

#include "base/memory.h"
#include "sim/contacts.h"
#include "sim/gates.h"
#include "sim/swings.h"

#include <stdlib.h>
#include <string.h>

static OzVec3 axis_of(const OzReference *r, int i)
{
    return oz_quaternion_axis(r->body[i].turn);
}

static OzGrain grain_with(const OzReference *r, int i, OzVec3 velocity, OzVec3 spin)
{
    OzVec3 u = axis_of(r, i);
    OzGrain grain = {.position = r->body[i].position,
                     .half_shaft = oz_scale(u, r->shape[i].half_length),
                     .velocity = velocity,
                     .rate = oz_body_rate(spin, u, r->shape[i]),
                     .radius = r->shape[i].radius,
                     .mass = r->shape[i].mass,
                     .inverse_inertia = r->shape[i].inverse_inertia};
    return grain;
}

static OzGrain grain_now(const OzReference *r, int i)
{
    return grain_with(r, i, r->body[i].velocity, r->body[i].spin);
}

static void place_bodies(OzReference *r)
{
    const OzGrains *g = r->grains;
    for (int64_t i = 0; i < r->count; i++) {
        const double *x = &g->position[3 * i], *q = &g->quaternion[4 * i];
        OzShape shape = {.radius = g->diameter[i] / 2,
                         .half_length = g->length[i] / 2,
                         .mass = g->mass[i],
                         .inverse_mass = 1 / g->mass[i],
                         .inverse_inertia = 1 / g->inertia[i],
                         .inverse_inertia_axis = 1 / g->inertia_axis[i]};
        OzBody body = {.position = {x[0], x[1], x[2]},
                       .velocity = oz_dialect_load3(&g->velocity[3 * i]),
                       .spin = oz_dialect_load3(&g->angular_velocity[3 * i]),
                       .turn = {q[1], q[2], q[3], q[0]}};
        if (OZ_GYROSCOPIC) {
            OzVec3 u = oz_quaternion_axis(body.turn);
            double extra = (g->inertia_axis[i] - g->inertia[i]) * oz_dot(body.spin, u);
            body.spin = oz_along(oz_scale(body.spin, g->inertia[i]), extra, u);
        }
        r->shape[i] = shape;
        r->body[i] = body;
    }
}

/* Position and axis of every grain, 3 x count each. */
static void write_places(const OzReference *r, double *position, double *axis)
{
    for (int i = 0; i < r->count; i++) {
        OzFixedPosition at = r->body[i].position;
        oz_dialect_store3(&position[3 * (int64_t)i], oz_vec3(at.x, at.y, at.z));
        oz_dialect_store3(&axis[3 * (int64_t)i], axis_of(r, i));
    }
}

static OzStatus renew_list(OzReference *r)
{
    bool renewed;
    write_places(r, r->position, r->axis);
    OZ_PASS(oz_pair_list_renew(&r->near, &renewed, r->grains, r->position, r->axis,
                               &r->scene->boundary));
    if (renewed) {
        free(r->pair_force);
        OZ_PASS(OZ_NEW(&r->pair_force, r->near.pairs.count));
    }
    return OZ_OK;
}

static void move_before(OzReference *r, double dt)
{
    double force_time = oz_step_clock_time(&r->clock, r->step) + (OZ_MOVES_BEFORE ? dt : 0);
    for (int i = 0; i < r->count; i++) {
        OzBody *body = &r->body[i];
        oz_integrate_before(body, r->shape[i], dt, 1);
        r->seen[i] = grain_with(r, i, oz_integrate_seen_velocity(*body, dt),
                                oz_integrate_seen_spin(*body, r->shape[i], dt));
    }
    for (int w = 0; w < r->physics.wall_count; w++) {
        r->wall_drive[w] = oz_swings_drive_at(&r->physics, r->scene, w, force_time);
    }
    oz_gates_set(&r->physics, r->scene, force_time, false);
    oz_swings_set(&r->physics, r->scene, force_time, false);
    oz_reference_servo_before(r, dt);
}

static void touch_pairs(OzReference *r, double dt)
{
    OzSpace space = oz_dialect_space(&r->physics);
    for (int64_t p = 0; p < r->near.pairs.count; p++) {
        OzPair pair = r->near.pairs.pair[p];
        r->pair_force[p] = oz_rods_pair(r->seen[pair.a], r->seen[pair.b], space,
                                        oz_dialect_pair_law(&r->physics, pair.a, pair.b),
                                        &r->near.memory[p], dt, r->physics.share);
    }
}

/* Two passes over the sorted list give each grain the kernels' order: pairs in which it is the
 * second by the other's id, then its own. */
static void gather_pairs(OzReference *r)
{
    memset(r->load, 0, (size_t)r->count * sizeof *r->load);
    for (int64_t p = 0; p < r->near.pairs.count; p++) {
        OzLoad *load = &r->load[r->near.pairs.pair[p].b];
        load->force = oz_add(load->force, r->pair_force[p].force);
        load->torque = oz_add(load->torque, r->pair_force[p].torque_b);
    }
    for (int64_t p = 0; p < r->near.pairs.count; p++) {
        OzLoad *load = &r->load[r->near.pairs.pair[p].a];
        load->force = oz_minus(load->force, r->pair_force[p].force);
        load->torque = oz_add(load->torque, r->pair_force[p].torque_a);
    }
}

static void touch_wall(OzReference *r, int i, int index, double dt)
{
    int64_t k = (int64_t)i * r->physics.touches + index;
    OzWallForce *f = &r->wall_force[k];
    *f = oz_dialect_touch_wall(&r->physics, index, i, r->seen[i], r->wall_drive, dt,
                               &r->wall_memory[k]);
    r->load[i].force = oz_add(r->load[i].force, f->parts.force);
    r->load[i].torque = oz_add(r->load[i].torque, oz_rods_wall_torque(*f));
}

static bool is_empty(OzVec3 spring)
{
    return oz_dot(spring, spring) == 0;
}

static void hand(OzVec3 *own, OzVec3 *other)
{
    *other = is_empty(*other) ? *own : *other;
    *own = oz_vec3(0, 0, 0);
}

/* As the kernels do where walls join: an end that touches another wall instead takes its springs
 * along. */
static void hand_over(OzReference *r, int i)
{
    int first = r->physics.wall_count - r->physics.edged, ends = r->physics.ends;
    OzMemory *memories = &r->wall_memory[(int64_t)i * r->physics.touches];
    for (int wall = first; wall < r->physics.wall_count; wall++) {
        for (int end = 0; end < ends; end++) {
            OzMemory *own = &memories[wall * ends + end];
            int hider = is_empty(own->stretch) && is_empty(own->turned)
                            ? -1
                            : oz_dialect_hider(&r->physics, wall, end, r->seen[i], r->wall_drive);
            if (hider >= 0) {
                OzMemory *other = &memories[hider * ends + end];
                hand(&own->stretch, &other->stretch);
                hand(&own->turned, &other->turned);
            }
        }
    }
}

/* The slots of kernel wall w, a mesh. */
static void touch_mesh(OzReference *r, int i, int mesh, int w, double dt)
{
    const OzPhysics *physics = &r->physics;
    OzHostMesh found;
    int first = physics->touches - OZ_MESH_SLOTS * (physics->meshes - mesh);
    int64_t at = (int64_t)i * physics->touches + first;
    OzGrain grain = r->seen[i];
    OzVec3 none = oz_vec3(0, 0, 0);
    OzVec3 from = oz_dialect_from(physics, w, grain.position, none, r->wall_drive[w]);
    double *memory = oz_host_mesh_memory(physics, r->mesh_memory, i, mesh);
    if (!oz_host_mesh_find(&found, physics, w, from, grain.half_shaft, grain.radius, memory)) {
        r->crowded = i;
    }
    oz_host_mesh_hand_over(&found, &r->wall_memory[at]);
    for (int k = 0; k < OZ_MESH_SLOTS; k++) {
        OzWallForce *f = &r->wall_force[at + k];
        OzWallEnd end = oz_dialect_mesh_end(&found.at[k], grain);
        *f = oz_dialect_touch_end(physics, w, end, i, grain, r->wall_drive, dt,
                                  &r->wall_memory[at + k]);
        r->load[i].force = oz_add(r->load[i].force, f->parts.force);
        r->load[i].torque = oz_add(r->load[i].torque, oz_rods_wall_torque(*f));
    }
}

static void touch_walls(OzReference *r, double dt)
{
    const OzPhysics *physics = &r->physics;
    int first = physics->wall_count - physics->edged - physics->meshes;
    r->crowded = -1;
    for (int i = 0; i < r->count; i++) {
        hand_over(r, i);
        for (int index = 0; index < physics->touches - OZ_MESH_SLOTS * physics->meshes; index++) {
            touch_wall(r, i, index, dt);
        }
        for (int mesh = 0; mesh < physics->meshes; mesh++) {
            touch_mesh(r, i, mesh, first + mesh, dt);
        }
    }
}

static void move_after(OzReference *r, double dt)
{
    OzVec3 gravity = oz_dialect_load3(r->physics.parameters.gravity);
    for (int i = 0; i < r->count; i++) {
        OzLoad load = r->load[i];
        load.force = oz_along(load.force, r->shape[i].mass, gravity);
        OzLoad drag = oz_drag_load(r->physics.parameters.fluid, r->shape[i], r->seen[i].velocity,
                                   r->seen[i].rate);
        load.force = oz_add(load.force, drag.force);
        load.torque = oz_add(load.torque, drag.torque);
        oz_integrate_after(&r->body[i], r->shape[i], load, dt, 1);
        OzGrain now = grain_now(r, i);
        OzVec3 way = oz_scale(oz_add(r->seen[i].velocity, now.velocity), 0.5 * dt);
        OzVec3 turn = oz_scale(oz_add(r->seen[i].rate, now.rate), 0.5 * dt);
        r->work.dissipated -= oz_dot(drag.force, way) + oz_dot(drag.torque, turn);
    }
}

static void note_rolling(OzReference *r, OzContact contact, OzContactForce parts, OzVec3 after,
                         double dt)
{
    if (OZ_ROLLING) {
        OzVec3 mean = oz_scale(oz_add(contact.turning, after), 0.5);
        r->work.spring -= dt * oz_dot(parts.couple.spring, mean);
        r->work.dissipated -= dt * oz_dot(parts.couple.dashpot, mean);
    }
}

static void note_pairs(OzReference *r, double dt)
{
    for (int64_t p = 0; p < r->near.pairs.count; p++) {
        const OzPairForce *f = &r->pair_force[p];
        if (f->contact.touching) {
            OzGrain a = grain_now(r, r->near.pairs.pair[p].a),
                    b = grain_now(r, r->near.pairs.pair[p].b);
            OzVec3 after =
                oz_minus(oz_grain_velocity_at(b, f->arm_b), oz_grain_velocity_at(a, f->arm_a));
            oz_ledger_note(&r->work, f->contact, f->parts, after, dt);
            if (OZ_LINE) {
                oz_ledger_note_couple(&r->work, f->couple, f->turning, oz_minus(b.rate, a.rate),
                                      dt);
            }
            note_rolling(r, f->contact, f->parts, oz_minus(b.rate, a.rate), dt);
        }
    }
}

/* As kernels/ledger.h. */
static void note_gate(OzReference *r, int wall, const OzWallForce *f, OzVec3 after, double dt)
{
    int64_t step = r->step + (OZ_MOVES_BEFORE && dt > 0);
    double times[3];
    for (int k = 0; k < 3; k++) {
        times[k] = oz_step_clock_time(&r->clock, dt > 0 ? step + k - 1 : step);
    }
    int gate = oz_gates_bits(&r->scene->walls[r->physics.wall_order[wall]], times, false);
    OzVec3 force = oz_minus(f->parts.force, oz_add(f->parts.spring, f->parts.dashpot));
    OzVec3 mean = oz_scale(oz_add(f->contact.velocity, after), 0.5);
    double given = oz_dot(force, mean) * dt * (OZ_MOVES_BEFORE ? 0.5 : 1);
    r->work.walls += gate & OZ_GATE_COMES ? f->parts.energy : 0;
    r->work.walls -= gate & OZ_GATE_GOES ? f->parts.energy - given : 0;
}

static void note_wall(OzReference *r, int i, int index, double dt)
{
    const OzWallForce *f = &r->wall_force[(int64_t)i * r->physics.touches + index];
    int wall, part = oz_dialect_part(&r->physics, index, &wall);
    (void)part;
    if (f->contact.touching) {
        OzGrain now = grain_now(r, i);
        OzWallDrive drive = oz_swings_drive_at(&r->physics, r->scene, wall,
                                               oz_step_clock_time(&r->clock, r->step) + dt);
        bool is_servo = oz_reference_servo_speed(r, wall, &drive.speed);
        OzVec3 before =
            oz_dialect_wall_velocity(&r->physics, wall, now.position, f->arm, r->wall_drive[wall]);
        OzVec3 after = oz_dialect_wall_velocity(&r->physics, wall, now.position, f->arm, drive);
        OzVec3 left = oz_minus(oz_grain_velocity_at(now, f->arm), after);
        oz_ledger_note(&r->work, f->contact, f->parts, left, dt);
        note_gate(r, wall, f, left, dt);
        if (!is_servo) { /* a piston's work on grains stays within what the ledger is of */
            oz_ledger_push(&r->work, f->parts.force, oz_scale(oz_add(before, after), 0.5), dt);
        }
        OzVec3 turning = oz_scale(drive.axis, drive.rate);
        note_rolling(r, f->contact, f->parts, oz_minus(now.rate, turning), dt);
        if (OZ_ROLLING) {
            OzVec3 couple = oz_add(f->parts.couple.spring, f->parts.couple.dashpot);
            oz_ledger_push(&r->work, couple, turning, dt);
        }
    }
}

/* As kernels/ledger.h. */
static void note_ledger(OzReference *r, double dt)
{
    note_pairs(r, dt);
    for (int i = 0; i < r->count; i++) {
        for (int index = 0; index < r->physics.touches; index++) {
            note_wall(r, i, index, dt);
        }
    }
}

static OzStatus make_step(OzReference *r, double dt)
{
    move_before(r, dt);
    OZ_PASS(renew_list(r));
    touch_pairs(r, dt);
    gather_pairs(r);
    touch_walls(r, dt);
    move_after(r, dt);
    oz_reference_servo_after(r, dt);
    if (r->physics.switches.ledger) {
        note_ledger(r, dt);
    }
    return oz_reference_guard_check(r, dt);
}

OzStatus oz_reference_advance(OzReference *reference, int64_t step)
{
    OZ_USE_SWITCHES(oz_host_switches_rods(&reference->physics.switches));
    if (!reference->primed && OZ_MOVES_BEFORE && step > 0) {
        OZ_PASS(make_step(reference, 0));
    }
    reference->primed = true;
    while (reference->step < step) {
        OZ_PASS(make_step(reference, reference->physics.parameters.dt));
        reference->step++;
    }
    return OZ_OK;
}

static void copy_state(const OzReference *r, OzSnapshot *s)
{
    write_places(r, s->position, s->axis);
    for (int i = 0; i < r->count; i++) {
        const OzBody *b = &r->body[i];
        double *q = &s->quaternion[4 * (int64_t)i];
        oz_dialect_store3(&s->velocity[3 * (int64_t)i], b->velocity);
        oz_dialect_store3(&s->angular_velocity[3 * (int64_t)i], grain_now(r, i).rate);
        q[0] = b->turn.w;
        oz_dialect_store3(q + 1, oz_vec3(b->turn.x, b->turn.y, b->turn.z));
    }
    s->step = r->step;
    s->time = oz_step_clock_time(&r->clock, r->step);
    oz_snapshot_move_walls(s);
    oz_reference_servo_write(r, s);
}

static OzStatus find_contacts(const OzReference *r, OzSnapshot *snapshot)
{
    OzContacts contacts;
    snapshot->contacts.count = 0;
    OZ_PASS(oz_contacts_begin(&contacts, snapshot, &snapshot->contacts));
    for (int64_t p = 0; p < r->near.pairs.count; p++) {
        OzPair pair = r->near.pairs.pair[p];
        OZ_PASS(oz_contacts_pair(&contacts, pair.a, pair.b, &r->near.memory[p]));
    }
    int touches = r->physics.touches;
    for (int64_t k = 0; k < (int64_t)r->count * touches; k++) {
        contacts.memory = oz_host_mesh_memory(&r->physics, r->mesh_memory, (int)(k / touches), 0);
        OZ_PASS(oz_contacts_wall(&contacts, k / touches, (int)(k % touches), &r->wall_memory[k]));
    }
    oz_contact_list_sort(&snapshot->contacts);
    return OZ_OK;
}

OzStatus oz_reference_snapshot(const OzReference *reference, OzSnapshot *snapshot)
{
    OZ_USE_SWITCHES(oz_host_switches_rods(&reference->physics.switches));
    copy_state(reference, snapshot);
    OZ_PASS(find_contacts(reference, snapshot));
    OzContactSums sums = oz_contact_list_sum(&snapshot->contacts);
    snapshot->deep_count = reference->deep_count;
    snapshot->has_contacts = true;
    snapshot->has_ledger = reference->scene->observe.ledger;
    snapshot->ledger.elastic = sums.energy;
    snapshot->ledger.dissipated = reference->work.dissipated;
    snapshot->ledger.friction = reference->work.spring - sums.spring_energy;
    snapshot->ledger.work_walls = reference->work.walls;
    return OZ_OK;
}

static OzStatus create_arrays(OzReference *r)
{
    int64_t count = r->count, touches = count * r->physics.touches;
    OZ_PASS(OZ_NEW(&r->shape, count));
    OZ_PASS(OZ_NEW(&r->body, count));
    OZ_PASS(OZ_NEW(&r->seen, count));
    OZ_PASS(OZ_NEW(&r->load, count));
    OZ_PASS(OZ_NEW(&r->position, 3 * count));
    OZ_PASS(OZ_NEW(&r->axis, 3 * count));
    OZ_PASS(OZ_NEW(&r->wall_force, touches));
    OZ_PASS(OZ_NEW(&r->mesh_memory, count * r->physics.meshes * OZ_MESH_SLOTS * OZ_MESH_MEMORY));
    return OZ_NEW(&r->wall_memory, touches);
}

static OzStatus fill(OzReference *r, const OzScene *scene, const OzGrains *grains)
{
    OZ_PASS(oz_physics_derive(&r->physics, scene, grains));
    OZ_USE_SWITCHES(oz_host_switches_rods(&r->physics.switches));
    r->scene = scene;
    r->grains = grains;
    r->clock = oz_step_clock_begin(scene->step);
    r->count = (int)grains->count;
    OZ_PASS(create_arrays(r));
    place_bodies(r);
    return renew_list(r);
}

OzStatus oz_reference_create(OzReference **reference, const OzScene *scene, const OzGrains *grains)
{
    *reference = NULL;
    OZ_PASS(OZ_NEW(reference, 1));
    OzStatus status = fill(*reference, scene, grains);
    if (status != OZ_OK) {
        oz_reference_free(*reference);
        *reference = NULL;
    }
    return status;
}

void oz_reference_free(OzReference *reference)
{
    if (!reference) {
        return;
    }
    oz_pair_list_free(&reference->near);
    free(reference->shape);
    free(reference->body);
    free(reference->seen);
    free(reference->load);
    free(reference->position);
    free(reference->axis);
    free(reference->pair_force);
    free(reference->wall_force);
    free(reference->wall_memory);
    free(reference->mesh_memory);
    free(reference);
}
