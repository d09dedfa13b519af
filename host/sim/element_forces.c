/* One evaluation after another: pairs that may touch, beams, gravity. */
#include "sim/element_forces.h"

#include "base/memory.h"
#include "model/wall_motion.h"
#include "sim/element_bear.h"
#include "sim/element_overlap.h"

#include <stdlib.h>
#include <string.h>

typedef OzElementForces Forces;

static OzVec2 load2(const double *from)
{
    return oz_vec2(from[0], from[1]);
}

static void note_fault(Forces *f, OzElementFault fault, int a, int b)
{
    if (f->fault == OZ_ELEMENT_SOUND) {
        f->fault = fault;
        f->fault_a = a;
        f->fault_b = b;
    }
}

/* share: as OzOverlap's, or of a disc's diameter. */
static void judge_depth(Forces *f, double share, int a, int b)
{
    f->deep_count += !(share <= f->scene->guards.overlap_warn);
    if (!(share <= f->scene->guards.overlap_stop)) {
        note_fault(f, OZ_ELEMENT_DEEP, a, b);
    }
}

static int wall_of(const OzElements *elements, int i)
{
    return i < elements->free_count ? -1 : elements->body[i] - (int)elements->grain_count;
}

/* force and moment about its centre on element i; a wall's go into the power it gives. */
static void add_load(Forces *f, const OzElementState *state, int i, OzVec2 force, double moment)
{
    if (i < f->elements->free_count) {
        f->force[2 * (int64_t)i] += force.x;
        f->force[2 * (int64_t)i + 1] += force.y;
        f->torque[i] += moment;
    } else {
        f->power.work_walls -= oz_dot2(force, load2(state->velocity + 2 * (int64_t)i));
        f->power.work_walls -= moment * state->angular_velocity[i];
    }
}

static OzTriangle triangle_at(const Forces *f, int i, OzVec2 centre)
{
    const double *corner = f->turned + 6 * (int64_t)i;
    OzTriangle t;
    for (int c = 0; c < 3; c++) {
        t.corner[c] = oz_add2(centre, load2(corner + 2 * c));
    }
    return t;
}

/* A contact of elements a and b, whose force on b acts at a point seen from the centre of a. */
static OzStatus note_contact(Forces *f, const OzElementState *state, OzContactEntry entry,
                             OzVec2 force, OzVec2 normal, OzVec2 point)
{
    const double *at = state->position + 2 * (int64_t)entry.part_a;
    int body = f->elements->body[entry.part_b], wall = wall_of(f->elements, entry.part_b);
    if (!f->list) {
        return OZ_OK;
    }
    entry.a = f->elements->body[entry.part_a];
    entry.b = wall < 0 ? body : -1 - wall;
    entry.push = oz_dot2(force, normal);
    OzVec2 rest = oz_along2(force, -entry.push, normal);
    memcpy(entry.point, (double[2]){at[0] + point.x, at[1] + point.y}, 2 * sizeof(double));
    memcpy(entry.normal, (double[2]){normal.x, normal.y}, 2 * sizeof(double));
    memcpy(entry.tangential, (double[2]){rest.x, rest.y}, 2 * sizeof(double));
    return oz_contact_list_add(f->list, &entry);
}

/* The point nearest to the overlap's centroid at which the push has the moment that it has. */
static OzVec2 point_of(const OzOverlap *o, OzVec2 normal, double size)
{
    double off = (o->moment - oz_cross2(o->centroid, o->push)) / size;
    return oz_along2(o->centroid, off, oz_vec2(normal.y, -normal.x));
}

static OzStatus touch_triangles(Forces *f, const OzElementState *state, int a, int b, OzVec2 apart)
{
    OzTriangle one = triangle_at(f, a, oz_vec2(0, 0)), other = triangle_at(f, b, apart);
    if (!oz_triangle_near(&one, &other, 0)) {
        return OZ_OK;
    }
    double stiffness = f->scene->triangles.stiffness;
    OzOverlap o = oz_element_overlap_find(f->elements, a, b, &one, &other);
    bool fresh =
        oz_element_bear_contact(&f->bear, a, b, &o); /* how deep they are is nobody's fault */
    if (!fresh && !OZ_TRIANGLE_FIELD && (o.swallowed || o.deep)) {
        note_fault(f, o.swallowed ? OZ_ELEMENT_SWALLOWED : OZ_ELEMENT_DEEP, a, b);
    }
    if (!fresh) {
        judge_depth(f, o.share, a, b);
    }
    if (!(o.kind > 0 || (OZ_TRIANGLE_FIELD && o.area > 0))) { /* swallowed ones have no kind */
        return OZ_OK;
    }
    OzVec2 force = oz_scale2(o.push, stiffness);
    double size = fmax(oz_length2(o.push), OZ_TINY);
    OzVec2 normal = oz_scale2(o.push, 1 / size);
    add_load(f, state, a, oz_scale2(force, -1), -stiffness * o.moment);
    add_load(f, state, b, force, stiffness * o.moment - oz_cross2(apart, force));
    return note_contact(f, state,
                        (OzContactEntry){.part_a = a,
                                         .part_b = b,
                                         .kind = (OzContactKind)(int)o.kind,
                                         .overlap = o.area,
                                         .energy = stiffness * o.energy},
                        force, normal, point_of(&o, normal, size));
}

/* Where a disc meets a disc or a triangle, seen from the centre of a. */
static OzDiscPlace disc_place(const Forces *f, int a, int b, OzVec2 apart)
{
    double radius_a = f->elements->radius[a], radius_b = f->elements->radius[b];
    if (radius_a > 0 && radius_b > 0) {
        return oz_disc_meet(oz_vec2(0, 0), radius_a, apart, radius_b);
    }
    bool second = radius_b > 0; /* is the disc */
    OzVec2 centre = second ? apart : oz_vec2(0, 0);
    OzTriangle t = triangle_at(f, second ? a : b, second ? oz_vec2(0, 0) : apart);
    OzDiscPlace place = oz_disc_meet_triangle(&t, centre, second ? radius_b : radius_a);
    if (!second) {
        place.normal = oz_scale2(place.normal, -1);
    }
    return place;
}

static double effective_mass(const OzElements *elements, int a, int b)
{
    double mass_a = elements->mass[a], mass_b = elements->mass[b];
    return b < elements->free_count ? mass_a * mass_b / (mass_a + mass_b) : mass_a;
}

/* Of the discs among two elements. */
static double smaller_radius(const OzElements *elements, int a, int b)
{
    double one = elements->radius[a], other = elements->radius[b];
    return one > 0 && other > 0 ? fmin(one, other) : fmax(one, other);
}

static OzVec2 velocity_at(const OzElementState *state, int i, OzVec2 arm)
{
    return oz_along2(load2(state->velocity + 2 * (int64_t)i), state->angular_velocity[i],
                     oz_left2(arm));
}

static OzStatus touch_disc(Forces *f, const OzElementState *state, int a, int b, OzVec2 apart)
{
    int wall = wall_of(f->elements, b);
    OzDiscPlace place = disc_place(f, a, b, apart);
    OzVec2 arm = oz_minus2(place.point, apart);
    OzVec2 velocity = oz_minus2(velocity_at(state, b, arm), velocity_at(state, a, place.point));
    OzDiscForce d = oz_disc_force(place, velocity, effective_mass(f->elements, a, b),
                                  wall < 0 ? f->disc : f->disc_wall[wall]);
    judge_depth(f, place.overlap / (2 * smaller_radius(f->elements, a, b)), a, b);
    if (!d.touching) {
        return OZ_OK;
    }
    f->power.disc_damping += d.power_normal;
    f->power.disc_friction += d.power_tangential;
    add_load(f, state, a, oz_scale2(d.force, -1), -oz_cross2(place.point, d.force));
    add_load(f, state, b, d.force, oz_cross2(arm, d.force));
    return note_contact(f, state,
                        (OzContactEntry){.part_a = a,
                                         .part_b = b,
                                         .kind = OZ_CONTACT_DISC,
                                         .slips = d.slips,
                                         .overlap = place.overlap,
                                         .energy = d.energy},
                        d.force, place.normal, place.point);
}

static OzStatus touch_pair(Forces *f, const OzElementState *state, int a, int b)
{
    OzVec2 apart =
        oz_minus2(load2(state->position + 2 * (int64_t)b), load2(state->position + 2 * (int64_t)a));
    double reach = f->elements->reach[a] + f->elements->reach[b];
    int wall = wall_of(f->elements, b);
    bool gone =
        wall >= 0 && !oz_wall_motion_present(&f->scene->walls[wall], state->time, state->at_rest);
    if (gone || oz_dot2(apart, apart) >= reach * reach) {
        return OZ_OK;
    }
    bool disc = f->elements->radius[a] > 0 || f->elements->radius[b] > 0;
    return (disc ? touch_disc : touch_triangles)(f, state, a, b, apart);
}

static void turn_corners(Forces *f, const OzElementState *state)
{
    for (int64_t i = 0; i < f->elements->count; i++) {
        oz_elements_corners(f->elements, i, (double[2]){0, 0}, state->angle[i], f->turned + 6 * i);
    }
}

static void begin(Forces *f)
{
    const OzElements *elements = f->elements;
    memset(f->force, 0, 2 * (size_t)elements->free_count * sizeof *f->force);
    memset(f->torque, 0, (size_t)elements->free_count * sizeof *f->torque);
    if (f->list) {
        f->list->count = 0;
    }
    f->beams = (OzBeamSums){.stretch_min = 1, .stretch_max = 1};
    f->power = (OzElementLedger){0};
    f->deep_count = 0;
    f->fault = OZ_ELEMENT_SOUND;
}

static OzStatus add_touches(Forces *f, const OzElementState *state)
{
    OZ_PASS(oz_element_pairs_renew(&f->pairs, f->elements, state->position));
    turn_corners(f, state);
    for (int64_t p = 0; p < f->pairs.count; p++) {
        OZ_PASS(touch_pair(f, state, f->pairs.pair[p].a, f->pairs.pair[p].b));
    }
    return OZ_OK;
}

static OzBeamEnd beam_end(const OzElementState *state, int64_t i)
{
    return (OzBeamEnd){load2(state->position + 2 * i), load2(state->velocity + 2 * i),
                       state->angle[i], state->angular_velocity[i]};
}

static void sum_beam(Forces *f, const OzBeamForce *beam, int a, int b)
{
    double bend = fmax(fabs(beam->bend_a), fabs(beam->bend_b));
    f->beams.energy += beam->energy;
    f->beams.stretch_min = fmin(f->beams.stretch_min, beam->stretch);
    f->beams.stretch_max = fmax(f->beams.stretch_max, beam->stretch);
    f->beams.bend_max = fmax(f->beams.bend_max, bend);
    f->power.beam_axial += beam->power_axial;
    f->power.beam_bending += beam->power_bending;
    if (!(beam->stretch >= OZ_BEAM_STRETCH_LEAST && beam->stretch <= OZ_BEAM_STRETCH_MOST)) {
        note_fault(f, isnan(beam->stretch) ? OZ_ELEMENT_NAN : OZ_ELEMENT_STRETCHED, a, b);
    }
    if (!(fabs(beam->bend_a) <= OZ_BEAM_BEND_MOST && fabs(beam->bend_b) <= OZ_BEAM_BEND_MOST)) {
        note_fault(f, OZ_ELEMENT_BENT, a, b);
    }
}

static void add_beams(Forces *f, const OzElementState *state)
{
    for (int64_t k = 0; k < f->elements->beam_count; k++) {
        int a = f->elements->beam_a[k], b = f->elements->beam_b[k];
        OzBeamEnd one = beam_end(state, a), other = beam_end(state, b);
        OzBeamForce beam = oz_element_bear_beam(&f->bear, f->elements, k, one, other);
        sum_beam(f, &beam, a, b);
        add_load(f, state, a, oz_scale2(beam.force, -1), beam.moment_a);
        add_load(f, state, b, beam.force, beam.moment_b);
    }
}

static void add_gravity(Forces *f)
{
    for (int64_t i = 0; i < f->elements->free_count; i++) {
        f->force[2 * i] += f->elements->mass[i] * f->scene->gravity[0];
        f->force[2 * i + 1] += f->elements->mass[i] * f->scene->gravity[1];
    }
}

void oz_element_forces_watch(OzElementForces *forces, const OzElementState *state, double step)
{
    for (int64_t i = 0; i < forces->elements->free_count; i++) {
        double way = oz_length2(load2(state->velocity + 2 * i)) * step;
        if (!isfinite(state->position[2 * i] + state->position[2 * i + 1] + state->angle[i] +
                      state->angular_velocity[i])) {
            note_fault(forces, OZ_ELEMENT_NAN, (int)i, (int)i);
        }
        if (!(way < 0.5 * forces->elements->reach[i])) {
            note_fault(forces, OZ_ELEMENT_FAST, (int)i, (int)i);
        }
    }
}

static void find_nan(Forces *f)
{
    for (int64_t i = 0; i < f->elements->free_count; i++) {
        if (!isfinite(f->force[2 * i] + f->force[2 * i + 1] + f->torque[i])) {
            note_fault(f, OZ_ELEMENT_NAN, (int)i, (int)i);
        }
    }
}

OzStatus oz_element_forces_touch(OzElementForces *forces, const OzElementState *state)
{
    OZ_USE_SWITCHES(oz_host_switches_elements(forces->scene));
    begin(forces);
    OzStatus status = add_touches(forces, state);
    find_nan(forces);
    return status;
}

OzStatus oz_element_forces_hold(OzElementForces *forces, const OzElementState *state)
{
    OZ_USE_SWITCHES(oz_host_switches_elements(forces->scene));
    begin(forces);
    add_beams(forces, state);
    add_gravity(forces);
    find_nan(forces);
    return OZ_OK;
}

OzStatus oz_element_forces_evaluate(OzElementForces *forces, const OzElementState *state)
{
    OZ_USE_SWITCHES(oz_host_switches_elements(forces->scene));
    begin(forces);
    OZ_PASS(add_touches(forces, state));
    add_beams(forces, state);
    add_gravity(forces);
    find_nan(forces);
    return OZ_OK;
}

/* What each fault is called, two bodies following where it takes two, and what may help. */
static const struct {
    const char *name, *help;
} faults[] = {
    [OZ_ELEMENT_NAN] = {"has a state, or feels a force, that is no number", "a smaller time.step"},
    [OZ_ELEMENT_SWALLOWED] = {"has a triangle wholly inside one of, or around one of,",
                              "a larger triangles.stiffness"},
    [OZ_ELEMENT_DEEP] = {"overlaps by more than half an element with", "stiffer contacts"},
    [OZ_ELEMENT_STRETCHED] =
        {"has a beam shorter than half or longer than 1.5 of its length at rest",
         "a larger beams.stiffness"},
    [OZ_ELEMENT_FAST] = {"moves an element farther than half its reach", "a smaller time.step"},
    [OZ_ELEMENT_BENT] = {"has a beam bent by more than 1 rad", "a larger beams.second_moment"},
};

OzStatus oz_element_forces_check(const OzElementForces *forces, int64_t step, double time)
{
    const OzElements *elements = forces->elements;
    char other[48] = "";
    if (forces->fault == OZ_ELEMENT_SOUND) {
        return OZ_OK;
    }
    int a = elements->body[forces->fault_a], b = elements->body[forces->fault_b];
    if (a != b) {
        bool wall = b >= elements->grain_count;
        snprintf(other, sizeof other, " %s %d", wall ? "wall" : "grain",
                 wall ? b - (int)elements->grain_count : b);
    }
    return oz_status_fail(
        OZ_ERR_BLOWUP, "grain %d %s%s in step %lld (time %g s); with a stable step, %s may help", a,
        faults[forces->fault].name, other, (long long)step, time, faults[forces->fault].help);
}

OzStatus oz_element_forces_create(OzElementForces *forces, const OzScene *scene,
                                  const OzGrains *grains)
{
    OzStatus status = OZ_OK;
    const OzElements *elements = grains->elements;
    *forces = (OzElementForces){.scene = scene, .elements = elements};
    forces->bear.beam = oz_element_laws_beam(scene);
    forces->bear.strength = oz_element_laws_strength(scene);
    forces->bear.yield = oz_element_laws_yield(scene);
    forces->disc = oz_element_laws_disc(scene, -1);
    OZ_TRY(OZ_NEW(&forces->disc_wall, scene->wall_count));
    for (int w = 0; w < scene->wall_count; w++) {
        forces->disc_wall[w] = oz_element_laws_disc(scene, w);
    }
    OZ_TRY(OZ_NEW(&forces->turned, 6 * elements->count));
    OZ_TRY(OZ_NEW(&forces->force, 2 * elements->free_count));
    OZ_TRY(OZ_NEW(&forces->torque, elements->free_count));
done:
    if (status != OZ_OK) {
        oz_element_forces_free(forces);
    }
    return status;
}

void oz_element_forces_free(OzElementForces *forces)
{
    free(forces->disc_wall);
    oz_pieces_free(forces->pieces);
    oz_element_pairs_free(&forces->pairs);
    free(forces->turned);
    free(forces->force);
    free(forces->torque);
    memset(forces, 0, sizeof *forces);
}

OzStatus oz_element_forces_contacts(OzSnapshot *snapshot)
{
    OzStatus status = OZ_OK;
    OzElementForces forces = {0};
    OzElementState state = {.position = snapshot->element_position,
                            .angle = snapshot->element_angle,
                            .velocity = snapshot->element_velocity,
                            .angular_velocity = snapshot->element_angular_velocity,
                            .time = snapshot->time};
    OZ_TRY(oz_element_forces_create(&forces, snapshot->scene, snapshot->grains));
    forces.list = &snapshot->contacts;
    forces.bear.wear = snapshot->wear.whole ? &snapshot->wear : NULL;
    OZ_TRY(oz_element_forces_evaluate(&forces, &state));
    oz_contact_list_sort(&snapshot->contacts);
    snapshot->beams = forces.beams;
done:
    snapshot->has_contacts = status == OZ_OK;
    oz_element_forces_free(&forces);
    return status;
}
