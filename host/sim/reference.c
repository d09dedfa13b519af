/* The host reference: bodies, a pair list with skin, forces and motion, all in double. */
#include "sim/reference_guard.h"
#include "sim/reference_ledger.h"
#include "sim/reference_servo.h"

#include "base/memory.h"
#include "scene/boundary.h"
#include "sim/contacts.h"
#include "sim/gates.h"
#include "sim/swings.h"

#include <stdlib.h>
#include <string.h>

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
        OzBody body = {.position = {x[0] - r->cell.strain * x[1], x[1], x[2]},
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
        oz_dialect_store3(&position[3 * (int64_t)i],
                          oz_vec3(at.x + r->cell.strain * at.y, at.y, at.z));
        oz_dialect_store3(&axis[3 * (int64_t)i], oz_reference_axis(r, i));
    }
}

static OzStatus renew_list(OzReference *r)
{
    bool renewed;
    write_places(r, r->position, r->axis);
    OZ_PASS(oz_pair_list_renew(&r->near, &renewed, r->grains, r->position, r->axis, &r->cell));
    if (renewed) {
        free(r->pair_force);
        OZ_PASS(OZ_NEW(&r->pair_force, r->near.pairs.count));
    }
    return OZ_OK;
}

/* The cell as it stands when bodies have moved by a step, of which the forces come after or before
 * that. */
static void shear_cell(OzReference *r, double dt)
{
    double time = oz_step_clock_time(&r->clock, r->step + (dt > 0));
    r->cell = oz_boundary_at(&r->scene->boundary, time, false);
}

/* What a sheared cell does to a body that has moved. */
static void follow(OzReference *r, int i, OzBody from)
{
    if (OZ_SHEAR) {
        OzBody *body = &r->body[i];
        double less = oz_shear_follow(body, from.position, from.rest, oz_reference_space(r), 1);
        r->work.walls += oz_shear_gain(r->shape[i].mass, less, body->velocity.x);
    }
}

static void move_before(OzReference *r, double dt)
{
    double force_time = oz_step_clock_time(&r->clock, r->step) + (OZ_MOVES_BEFORE ? dt : 0);
    if (OZ_MOVES_BEFORE) {
        shear_cell(r, dt);
    }
    for (int i = 0; i < r->count; i++) {
        OzBody *body = &r->body[i], from = *body;
        oz_integrate_before(body, r->shape[i], dt, 1);
        if (OZ_MOVES_BEFORE) {
            follow(r, i, from);
        }
        r->seen[i] = oz_reference_grain(r, i, oz_integrate_seen_velocity(*body, dt),
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
    OzSpace space = oz_reference_space(r);
    for (int64_t p = 0; p < r->near.pairs.count; p++) {
        OzPair pair = r->near.pairs.pair[p];
        OzGrain a = r->seen[pair.a], b = r->seen[pair.b];
        r->pair_force[p] =
            oz_rods_pair(a, b, space, oz_dialect_pair_law(&r->physics, pair.a, pair.b),
                         &r->near.memory[p], dt, r->physics.share);
        if (OZ_SHEAR) {
            double apart = oz_space_minus(a.position, b.position, space).y;
            r->work.walls += dt * oz_shear_power(r->pair_force[p].force, apart, space);
        }
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
    if (!OZ_MOVES_BEFORE) {
        shear_cell(r, dt);
    }
    for (int i = 0; i < r->count; i++) {
        OzLoad load = r->load[i];
        OzBody from = r->body[i];
        load.force = oz_along(load.force, r->shape[i].mass, gravity);
        OzLoad drag = oz_drag_load(r->physics.parameters.fluid, r->shape[i], r->seen[i].velocity,
                                   r->seen[i].rate);
        load.force = oz_add(load.force, drag.force);
        load.torque = oz_add(load.torque, drag.torque);
        oz_integrate_after(&r->body[i], r->shape[i], load, dt, 1);
        OzGrain now = oz_reference_now(r, i);
        OzVec3 way = oz_scale(oz_add(r->seen[i].velocity, now.velocity), 0.5 * dt);
        OzVec3 turn = oz_scale(oz_add(r->seen[i].rate, now.rate), 0.5 * dt);
        r->work.dissipated -= oz_dot(drag.force, way) + oz_dot(drag.torque, turn);
        if (!OZ_MOVES_BEFORE) {
            follow(r, i, from);
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
        oz_reference_ledger_note(r, dt);
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
        oz_dialect_store3(&s->angular_velocity[3 * (int64_t)i], oz_reference_now(r, i).rate);
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
    shear_cell(r, 0);
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
