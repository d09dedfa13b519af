/* Contacts: the inner list's pairs are classified, those that touch are closed up, and forces are
 * computed for these alone, a block of lanes at a time. OpenCL C only. */
#pragma once

#include "kernels/beam_strength.h"
#include "kernels/disc.h"
#include "kernels/element_near.h"
#include "kernels/element_sums.h"

/* What a pair does to each other. */
typedef struct OzElementPush {
    OzVec2 force;            /* N, on b; -force on a            */
    real torque_a, torque_b; /* N m, about each one's centre    */
    mask deep, swallowed;
    real share; /* of a triangle inside the other, or of a disc's diameter */
    real power_normal, power_tangential; /* W, dissipated by discs */
#if OZ_STRENGTH
    real depth; /* root of m^3, of two triangles' overlap (kernels/beam_strength.h) */
#endif
} OzElementPush;

/* Closes up the region's pairs that may touch. */
OZ_INLINE void oz_element_contacts_classify(OzWork *w, int region)
{
    int begin = region * w->z.inner_capacity, end = begin + w->pair_count[region], count = 0;
    for (int first = begin; first < end; first += OZ_LANES) {
        int a[OZ_LANES], b[OZ_LANES], active[OZ_LANES];
        for (int l = 0; l < OZ_LANES; l++) {
            a[l] = w->pair_a[first + l];
            b[l] = w->pair_b[first + l];
        }
        OzNear one = oz_near_load(w, a), other = oz_near_load(w, b);
        mask hits = oz_near_pairs(w, &one, &other, REAL(0.0)) &
                    oz_lanes_mask_of(OZ_LANES_IOTA + first < end);
        int hit_count = oz_lanes_compact(active, OZ_LANES_IOTA + first, hits);
#if !OZ_SCATTER
        for (int l = 0; l < OZ_LANES; l++) {
            w->pair_hit[first + l] = -1;
        }
#endif
        for (int l = 0; l < hit_count; l++) {
            w->touch[begin + count + l] = active[l];
#if !OZ_SCATTER
            w->pair_hit[active[l]] = begin + count + l;
#endif
        }
        count += hit_count;
    }
    w->touch_count[region] = count;
}

#if OZ_STRENGTH
/* Least depths of the contacts of pairs that were of one grain, 0 of others; whether any is not. */
OZ_INLINE int oz_element_contacts_scars(const OzWork *w, const int *a, const int *b, real *least)
{
    scalar lane[OZ_LANES];
    int any = 0;
    for (int l = 0; l < OZ_LANES; l++) {
        lane[l] = b[l] < w->scar_end[a[l]] ? w->scar[w->scar_first[a[l]] + b[l]] : (scalar)0;
        any |= lane[l] > 0;
    }
    *least = OZ_LANES_LOAD(lane);
    return any;
}
#endif

#if OZ_TRIANGLE_FIELD

/* outer[k]: edge k of an element is one of its outer ones. */
OZ_INLINE void oz_element_contacts_outer(const OzWork *w, const int *slots, mask outer[3])
{
    int edges[OZ_LANES];
    for (int l = 0; l < OZ_LANES; l++) {
        edges[l] = w->outer_edges[slots[l]];
    }
    OZ_UNROLL
    for (int k = 0; k < 3; k++) {
        outer[k] = oz_lanes_mask_of((OZ_LANES_LOAD(edges) & (1 << k)) != 0);
    }
}

#endif

OZ_INLINE OzOverlap oz_element_contacts_overlap(const OzWork *w, const OzTriangle *a,
                                                const OzTriangle *b, const int *slots_a,
                                                const int *slots_b)
{
#if OZ_TRIANGLE_FIELD
    OzFieldPair pair;
    oz_element_contacts_outer(w, slots_a, pair.outer_a);
    oz_element_contacts_outer(w, slots_b, pair.outer_b);
    oz_field_weigh(&pair, oz_lanes_mask_of(OZ_LANES_LOAD(slots_b) >= w->z.free_slots));
    OzOverlap o = oz_field_overlap(a, b, &pair);
#if OZ_STRENGTH
    real least;
    o.energy = REAL(0.0);
    if (oz_element_contacts_scars(w, slots_a, slots_b, &least)) {
        o.energy = oz_field_energy(a, b, &pair);
    }
#endif
    return o;
#else
    return oz_triangle_overlap(a, b);
#endif
}

/* Two triangles. */
OZ_INLINE OzElementPush oz_element_contacts_triangles(const OzWork *w, const OzElement *a,
                                                      const OzElement *b, const int *slots_a,
                                                      const int *slots_b)
{
    OzElementPush push;
    OzTriangle first, second;
    OzVec2 apart = oz_minus2(b->position, a->position);
    OZ_UNROLL
    for (int k = 0; k < 3; k++) {
        first.corner[k] = oz_minus2(a->triangle.corner[k], a->position);
        second.corner[k] = oz_minus2(b->triangle.corner[k], a->position);
    }
    OzOverlap o = oz_element_contacts_overlap(w, &first, &second, slots_a, slots_b);
    real stiffness = REAL(w->parameters->stiffness);
    push.force = oz_scale2(o.push, stiffness);
    push.torque_a = -(stiffness * o.moment);
    push.torque_b = stiffness * (o.moment - oz_cross2(apart, o.push));
    push.deep = o.deep;
    push.share = o.share;
    push.swallowed = o.swallowed;
    push.power_normal = push.power_tangential = REAL(0.0);
#if OZ_STRENGTH
    push.depth = o.swallowed ? REAL(OZ_HUGE) : sqrt(oz_larger(o.energy, REAL(0.0)));
#endif
    return push;
}

#if OZ_DISCS

/* Where a disc and a disc or triangle meet. */
OZ_INLINE OzDiscPlace oz_element_contacts_place(const OzElement *a, const OzElement *b,
                                                real radius_a, real radius_b)
{
    mask both = (radius_a > REAL(0.0)) & (radius_b > REAL(0.0)), second = radius_b > REAL(0.0);
    OzTriangle triangle;
    for (int k = 0; k < 3; k++) {
        triangle.corner[k] = oz_choose2(second, a->triangle.corner[k], b->triangle.corner[k]);
    }
    OzVec2 centre = oz_choose2(second, b->position, a->position);
    OzDiscPlace discs = oz_disc_meet(a->position, radius_a, b->position, radius_b);
    OzDiscPlace mixed = oz_disc_meet_triangle(&triangle, centre, second ? radius_b : radius_a);
    mixed.normal = oz_choose2(second, mixed.normal, oz_scale2(mixed.normal, REAL(-1.0)));
    discs.normal = oz_choose2(both, discs.normal, mixed.normal);
    discs.point = oz_choose2(both, discs.point, mixed.point);
    discs.overlap = both ? discs.overlap : mixed.overlap;
    return discs;
}

/* The force of discs by the law of each lane: 0 among grains, 1 + w at wall w. */
OZ_INLINE OzDiscForce oz_element_contacts_law(const OzWork *w, OzDiscPlace place, OzVec2 velocity,
                                              real mass, const int *b)
{
    OzDiscForce sum = oz_disc_force(place, velocity, mass, w->parameters->law[0]);
    int law[OZ_LANES];
    for (int l = 0; l < OZ_LANES; l++) {
        law[l] = w->wall[b[l]] + 1;
    }
    for (int k = 1; k <= w->z.walls; k++) {
        mask mine = oz_lanes_mask_of(OZ_LANES_LOAD(law) == k);
        if (OZ_ANY(mine)) {
            OzDiscForce own = oz_disc_force(place, velocity, mass, w->parameters->law[k]);
            sum.force = oz_choose2(mine, own.force, sum.force);
            sum.power_normal = mine ? own.power_normal : sum.power_normal;
            sum.power_tangential = mine ? own.power_tangential : sum.power_tangential;
        }
    }
    return sum;
}

/* Puts what a disc does in place of what triangles do, in lanes with one. */
OZ_INLINE void oz_element_contacts_discs(const OzWork *w, const OzElement *a, const OzElement *b,
                                         const int *slots_a, const int *slots_b,
                                         OzElementPush *push)
{
    OzVec2 velocity_a, velocity_b;
    real radius_a, radius_b, light_a, light_b, angle, spin_a, spin_b;
    oz_element_work_label(w, slots_a, &radius_a, &light_a);
    oz_element_work_label(w, slots_b, &radius_b, &light_b);
    mask disc = (radius_a > REAL(0.0)) | (radius_b > REAL(0.0));
    if (!OZ_ANY(disc)) {
        return;
    }
    oz_element_work_motion(w, slots_a, &velocity_a, &angle, &spin_a);
    oz_element_work_motion(w, slots_b, &velocity_b, &angle, &spin_b);
    OzDiscPlace place = oz_element_contacts_place(a, b, radius_a, radius_b);
    OzVec2 arm_a = oz_minus2(place.point, a->position), arm_b = oz_minus2(place.point, b->position);
    OzVec2 velocity = oz_minus2(oz_along2(velocity_b, spin_b, oz_left2(arm_b)),
                                oz_along2(velocity_a, spin_a, oz_left2(arm_a)));
    OzDiscForce f =
        oz_element_contacts_law(w, place, velocity, REAL(1.0) / (light_a + light_b), slots_b);
    push->force = oz_choose2(disc, f.force, push->force);
    push->torque_a = disc ? -oz_cross2(arm_a, f.force) : push->torque_a;
    push->torque_b = disc ? oz_cross2(arm_b, f.force) : push->torque_b;
    real small = oz_smaller(radius_a, radius_b), radius = oz_larger(radius_a, radius_b);
    radius = small > REAL(0.0) ? small : radius;
    push->deep = disc ? !(place.overlap <= radius) : push->deep;
    push->share = disc ? oz_larger(place.overlap, REAL(0.0)) / (REAL(2.0) * radius) : push->share;
    push->swallowed &= !disc;
    push->power_normal = disc ? f.power_normal : REAL(0.0);
    push->power_tangential = disc ? f.power_tangential : REAL(0.0);
}

#endif

/* Counts deep contacts; of the launch's first step with any keeps the lowest slot and the greatest
 * share. */
OZ_INLINE void oz_element_contacts_count(OzWork *w, real share, mask deep, const int *slots,
                                         int step)
{
    global OzControl *control = w->control;
    scalar lane[OZ_LANES];
    int hit[OZ_LANES];
    OZ_LANES_STORE(share, lane);
    oz_lanes_store_mask(deep, hit);
    for (int l = 0; l < OZ_LANES; l++) {
        if (!hit[l]) {
            continue;
        }
        atomic_inc(&control->deep_count);
        if (step <= control->deep_step) {
            atomic_min(&control->deep_step, step);
            atomic_min(&control->deep_index, slots[l]);
            atomic_max(&control->deep_depth, convert_int_sat(lane[l] * (scalar)OZ_DEEP_SHARE));
        }
    }
}

/* Stops where a triangle is inside another or half in it, or a disc by more than its radius. */
OZ_INLINE void oz_element_contacts_check(OzWork *w, const OzElementPush *push, mask present,
                                         const int *slots, int step)
{
    mask deep = push->deep & present, swallowed = push->swallowed & present;
    mask warn = !(push->share <= REAL(w->parameters->deep_warn)) & present;
    mask stop = !(push->share <= REAL(w->parameters->deep_stop)) & present & !swallowed;
    if (OZ_ANY(deep | swallowed | warn | stop)) {
        oz_element_contacts_count(w, push->share, warn, slots, step);
        oz_work_stop_lanes(w, swallowed, OZ_ELEMENT_STOP_SWALLOWED, step, slots);
        oz_work_stop_lanes(w, deep | stop, OZ_ELEMENT_STOP_DEEP, step, slots);
    }
}

/* What discs dissipate, and what walls put in: the opposite of what is done to them. */
OZ_INLINE void oz_element_contacts_account(const OzWork *w, const OzElementPush *push, mask present,
                                           const int *slots_b, OzElementSums *sums)
{
    OzVec2 velocity;
    real angle, angular_velocity;
    oz_element_work_motion(w, slots_b, &velocity, &angle, &angular_velocity);
    mask walls = oz_lanes_mask_of(OZ_LANES_LOAD(slots_b) >= w->z.free_slots) & present;
    real power = oz_dot2(push->force, velocity) + push->torque_b * angular_velocity;
    sums->word[OZ_PL_WORK_WALLS] -= walls ? power : REAL(0.0);
    sums->word[OZ_PL_DISC_DAMPING] += present ? push->power_normal : REAL(0.0);
    sums->word[OZ_PL_DISC_FRICTION] += present ? push->power_tangential : REAL(0.0);
}

#if OZ_STRENGTH
/* Weakens the push of triangles that were of one grain and overlapped when it broke between them.
 * count: lanes with pairs. */
OZ_INLINE void oz_element_contacts_heal(OzWork *w, const int *a, const int *b, int count,
                                        OzElementPush *push)
{
    real least;
    scalar lane[OZ_LANES];
    if (!oz_element_contacts_scars(w, a, b, &least)) {
        return;
    }
    real share = oz_beam_strength_share(push->depth, least);
    OZ_LANES_STORE(oz_beam_strength_least(push->depth, least), lane);
    for (int l = 0; l < count; l++) {
        if (b[l] < w->scar_end[a[l]]) {
            w->scar[w->scar_first[a[l]] + b[l]] = lane[l];
        }
    }
    push->force = oz_scale2(push->force, share);
    push->torque_a *= share;
    push->torque_b *= share;
    mask fresh = oz_beam_strength_least(push->depth, least) > REAL(0.0);
    push->share = fresh ? REAL(0.0) : push->share; /* how deep they are is nobody's fault */
    push->deep = push->deep & !fresh;
    push->swallowed = push->swallowed & !fresh;
}
#endif

/* Forces of the region's touching pairs. Lanes beyond the last repeat the first pair. */
OZ_INLINE void oz_element_contacts_push(OzWork *w, int region, int step, OzElementSums *sums)
{
    int begin = region * w->z.inner_capacity, end = begin + w->touch_count[region];
    for (int first = begin; first < end; first += OZ_LANES) {
        int a[OZ_LANES], b[OZ_LANES];
        for (int l = 0; l < OZ_LANES; l++) {
            int p = w->touch[first + l < end ? first + l : first];
            a[l] = w->pair_a[p];
            b[l] = w->pair_b[p];
        }
        mask present = oz_lanes_mask_of(OZ_LANES_IOTA + first < end);
        OzElement element_a = oz_element_work_element(w, a),
                  element_b = oz_element_work_element(w, b);
        OzElementPush push = oz_element_contacts_triangles(w, &element_a, &element_b, a, b);
#if OZ_DISCS
        oz_element_contacts_discs(w, &element_a, &element_b, a, b, &push);
#endif
#if OZ_STRENGTH
        oz_element_contacts_heal(w, a, b, min(OZ_LANES, end - first), &push);
#endif
        oz_element_contacts_check(w, &push, present, a, step);
        if (OZ_LEDGER) {
            oz_element_contacts_account(w, &push, present, b, sums);
        }
        real words[4] = {push.force.x, push.force.y, push.torque_a, push.torque_b};
        oz_lanes_store4(w->pair_force + (size_t)first * OZ_ELEMENT_LOAD, OZ_ELEMENT_LOAD, 0, words);
    }
}
