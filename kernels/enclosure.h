/* Forces between grains and walls. Few grains touch a wall: a sieve picks the ends that do, wall by
 * wall, and the contact law gets full blocks of them, one end a lane; then points of shafts at
 * walls with edges (wall_shaft.h) in the same way. OpenCL C only. */
#pragma once

#include "kernels/mesh_find.h"
#include "kernels/servo.h"
#include "kernels/wall_impulse.h"

#if OZ_WALL_COUNT > 0

/* Whether a side's touches share a response with others. */
OZ_INLINE int oz_enclosure_shares(const OzSide *side)
{
    int is_slot = OZ_MESHES > 0 && side->index >= OZ_ENCLOSURE_MESH;
    int is_at_edges = !OZ_ROUND && side->index >= OZ_ENCLOSURE_EDGED;
    return is_slot || is_at_edges;
}

/* Stops the run at overlaps that no run may go on with. Lanes outside of `counts` are not looked
 * at: they repeat an end of another lane. */
OZ_INLINE void oz_enclosure_guard(OzWork *w, const int *slots, OzContact contact, real radius,
                                  mask counts, int step)
{
    OzDeep deep = {contact.overlap, contact.rate, REAL(0.5) * radius, radius, counts, OZ_DEEP_WALL};
    if (oz_deep_guard(w, deep, slots, step)) {
        mask lost = counts & !(contact.overlap <= REAL(2.0) * radius);
        oz_work_stop_lanes(w, lost, OZ_STOP_ESCAPED, step, slots);
    }
}

/* Where the ends of shafts stand against all walls with edges. */
OZ_INLINE OzWallRod oz_enclosure_rod(const OzWork *w, OzGrain grain, const OzSide *sides,
                                     const OzSide *side)
{
    OzVec3 none = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0));
    OzWallRod rod = {oz_enclosure_side_from(w, grain.position, none, side), grain.half_shaft,
                     grain.radius, -grain.radius, -grain.radius};
    for (int j = OZ_ENCLOSURE_EDGED; j < OZ_ENCLOSURE_SHAFT; j++) {
        OzVec3 end = oz_scale(grain.half_shaft, sides[j].sign);
        real overlap =
            grain.radius - oz_enclosure_side_distance(w, grain.position, end, &sides[j]).distance;
        real *most = sides[j].first ? &rod.tip : &rod.tail;
        *most = oz_larger(*most, overlap);
    }
    return rod;
}

/* Leaves out a point of shafts at the wall of sides[k] that touches another wall there, which comes
 * first. */
OZ_INLINE void oz_enclosure_hide(const OzWork *w, OzGrain grain, const OzSide *sides, int k,
                                 OzWallPoint *point)
{
    OzVec3 place = oz_scale(grain.half_shaft, point->at);
    for (int j = OZ_ENCLOSURE_EDGED; j < OZ_ENCLOSURE_SHAFT; j++) {
        if (sides[j].wall < sides[k].wall && sides[j].first) {
            OzVec3 from = oz_enclosure_side_from(w, grain.position, place, &sides[j]);
            mask hides = oz_wall_shaft_hides(from, sides[j].shape, *point, grain.radius);
            point->overlap = hides ? -grain.radius : point->overlap;
        }
    }
}

/* The points of shafts at a wall, sides[k] and the next. Answers whether any touches. */
OZ_INLINE int oz_enclosure_points(const OzWork *w, OzGrain grain, const OzSide *sides, int k,
                                  OzWallPoint points[OZ_WALL_SHAFT_PARTS])
{
    OzWallRod rod = oz_enclosure_rod(w, grain, sides, &sides[k]);
    oz_wall_shaft_points(rod, sides[k].shape, points);
    int touches = OZ_ANY(oz_larger(points[0].overlap, points[1].overlap) > REAL(0.0));
    if (touches) {
        oz_enclosure_hide(w, grain, sides, k, &points[0]);
        oz_enclosure_hide(w, grain, sides, k, &points[1]);
        oz_wall_shaft_push(rod, points);
    }
    return touches;
}

/* Where one block of picked ends stands against their side. The wall's velocity is left open. */
OZ_INLINE OzWallEnd oz_enclosure_end(const OzWork *w, OzGrain grain, const OzSide *side,
                                     const int *slots)
{
    OzWallEnd where;
    where.end = oz_scale(grain.half_shaft, side->sign);
    where.wall = oz_enclosure_side_distance(w, grain.position, where.end, side);
#if OZ_FINE
    where.wall.overlap = oz_enclosure_side_fine(w, grain, side);
    mask near = where.wall.overlap > REAL(0.0);
#else
    mask near = where.wall.distance < grain.radius;
#endif
    /* a sphere in a population of rods touches once, not with two coincident ends */
    where.present = OZ_EQUAL || side->first ? near : oz_dot(where.end, where.end) > REAL(0.0);
    where.share = REAL(1.0);
    if (!OZ_ROUND && side->index >= OZ_ENCLOSURE_EDGED) {
        real overlap = grain.radius - where.wall.distance;
        real left = overlap - oz_lanes_fetch(w->wall_relief, slots, 2, side->part);
        where.present = where.present & (left > REAL(0.0)) & near;
        where.share = where.present ? left / overlap : REAL(1.0);
    }
    return where;
}

/* Forces of one block of picked ends or points, one a lane. Only the first `count` lanes hold one
 * of their own; in a last block that is not full the lanes after them repeat one of these, and what
 * they find is left out. */
OZ_INLINE void oz_enclosure_touch(OzWork *w, const OzSide *side, OzGrain grain, OzWallEnd where,
                                  const int *slots, int count, int step)
{
    OzMemory memory = oz_enclosure_side_memory(w, side, slots);
    where.wall_velocity = oz_enclosure_side_velocity(
        w, grain.position, oz_rods_wall_arm(grain, where.end, where.wall), side);
    where.wall_turning = oz_enclosure_side_turning(w, side);
    OzWallForce found = oz_rods_wall(grain, where, OZ_MATERIAL_WALL_LAW(w, side->wall, slots),
                                     &memory, w->parameters->dt, oz_integrate_share());
    oz_enclosure_side_remember(w, side->index, slots, memory);
    mask counts = OZ_ACTIVE_BEFORE(count);
    oz_loads_add(w, slots, oz_where(counts, found.parts.force),
                 oz_where(counts, oz_rods_wall_torque(found)));
#if OZ_IMPULSES
    oz_wall_impulse_add(w, side, grain, slots, count, found);
#endif
#if OZ_SERVOS > 0
    oz_servo_add(w, side, slots, count, found.parts.force);
#endif
    OzContact whole = found.contact;
    if (oz_enclosure_shares(side)) {
        whole.overlap = grain.radius - where.wall.distance;
        whole.rate = whole.rate / where.share;
        counts = counts & where.present;
    } else if (!OZ_EQUAL && !side->first) {
        counts = counts & (oz_dot(where.end, where.end) > REAL(0.0));
    }
    oz_enclosure_guard(w, slots, whole, grain.radius, counts, step);
#if OZ_LEDGER
    oz_pairs_note(w->wall_ledger, slots, OZ_WALL_ENDS * OZ_CONTACT_LEDGER,
                  side->index * OZ_CONTACT_LEDGER, found.contact, found.parts, found.parts.force,
                  found.arm);
    oz_lanes_put(w->wall_ledger, slots, OZ_WALL_ENDS * OZ_CONTACT_LEDGER,
                 side->index * OZ_CONTACT_LEDGER + OZ_CONTACT_LEDGER - 1, found.parts.energy);
    if (OZ_ROLLING) {
        oz_pairs_note_couple(w->wall_couple, slots, OZ_WALL_ENDS * OZ_COUPLE_LEDGER,
                             side->index * OZ_COUPLE_LEDGER, found.contact, found.parts,
                             oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0)));
    }
#endif
}

/* Picked shafts of which none touches have no springs. */
OZ_INLINE void oz_enclosure_forget(OzWork *w, const int *slots, int k)
{
    OzVec3 none = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0));
    OzMemory memory = {none, none};
    for (int part = 0; part < OZ_WALL_SHAFT_PARTS; part++) {
        oz_enclosure_side_remember(w, k + part, slots, memory);
    }
}

/* Both points of picked shafts at the wall of sides[k] and the next; notes what they relieve the
 * ends of. */
OZ_INLINE void oz_enclosure_touch_shafts(OzWork *w, const OzSide *sides, int k, const int *slots,
                                         int count, int step)
{
    OzGrain grain = oz_work_grains(w, slots);
    OzWallPoint points[OZ_WALL_SHAFT_PARTS];
    if (!oz_enclosure_points(w, grain, sides, k, points)) {
        oz_enclosure_forget(w, slots, k);
        return;
    }
    real tip = oz_lanes_fetch(w->wall_relief, slots, 2, OZ_WALL_TIP);
    real tail = oz_lanes_fetch(w->wall_relief, slots, 2, OZ_WALL_TAIL);
    for (int part = 0; part < OZ_WALL_SHAFT_PARTS; part++) {
        OzWallPoint at = points[part];
        OzWallEnd where;
        tip += at.push * oz_wall_shaft_reach(at.at, REAL(1.0));
        tail += at.push * oz_wall_shaft_reach(at.at, REAL(-1.0));
        where.end = oz_scale(grain.half_shaft, at.at);
        where.wall = at.wall;
        where.present = at.push > REAL(0.0);
        where.share = where.present ? at.push / (grain.radius - at.wall.distance) : REAL(1.0);
        oz_enclosure_touch(w, &sides[k + part], grain, where, slots, count, step);
    }
    oz_lanes_put(w->wall_relief, slots, 2, OZ_WALL_TIP, tip);
    oz_lanes_put(w->wall_relief, slots, 2, OZ_WALL_TAIL, tail);
}

/* One spring goes over, unless there is one; is_picked: whether it may. */
OZ_INLINE void oz_enclosure_hand(global scalar *given, global scalar *taken, int is_picked)
{
    int is_free = taken[0] == 0 && taken[OZ_LANES] == 0 && taken[2 * OZ_LANES] == 0;
    is_free = is_free && is_picked;
    for (int c = 0; c < 3; c++) {
        taken[c * OZ_LANES] = is_free ? given[c * OZ_LANES] : taken[c * OZ_LANES];
        given[c * OZ_LANES] = 0;
    }
}

/* An end that touches another side in the place of this one is not picked here. Its springs go over
 * to there, unless there are some. */
OZ_INLINE void oz_enclosure_hand_over(OzWork *w, int slot, int from, int to)
{
    size_t block = (size_t)(slot / OZ_LANES) * OZ_WALL_ENDS;
    int lane = slot % OZ_LANES;
#if OZ_HISTORY
    int is_picked = (w->wall_active[block + to] >> lane) & 1;
    oz_enclosure_hand((global scalar *)(w->wall_history + 3 * (block + from)) + lane,
                      (global scalar *)(w->wall_history + 3 * (block + to)) + lane, is_picked);
#endif
#if OZ_ROLLING_SPRING
    oz_enclosure_hand((global scalar *)(w->wall_rolling + 3 * (block + from)) + lane,
                      (global scalar *)(w->wall_rolling + 3 * (block + to)) + lane, is_picked);
#endif
    w->wall_active[block + from] &= ~(1 << lane);
}

/* One block of picked ends of sides[k], which has edges: those that touch another side at the same
 * place (wall_joint.h) are left to that. */
OZ_INLINE void oz_enclosure_join(OzWork *w, const OzSide *sides, int k, const int *slots, int count)
{
    OzGrain grain = oz_work_grains(w, slots);
    OzVec3 end = oz_scale(grain.half_shaft, sides[k].sign);
    OzWallDistance own = oz_enclosure_side_distance(w, grain.position, end, &sides[k]);
    int left = (int)((1u << min(count, OZ_LANES)) - 1);
    for (int j = OZ_ENCLOSURE_EDGED; j < OZ_ENCLOSURE_SHAFT; j++) {
        if (j != k && sides[j].first == sides[k].first) {
            OzVec3 from = oz_enclosure_side_from(w, grain.position, end, &sides[j]);
            OzWallDistance other = oz_wall_distance(from, sides[j].shape);
            mask hides = oz_wall_joint_hides(from, sides[j].shape, other, j < k, own, grain.radius);
            int bits = oz_lanes_bits(hides) & left;
            left &= ~bits;
            for (int l = 0; bits >> l != 0 && l < OZ_LANES; l++) {
                if ((bits >> l) & 1) {
                    oz_enclosure_hand_over(w, slots[l], k, j);
                }
            }
        }
    }
}

/* One block of grains that touch a mesh in the slot of sides[k]. */
OZ_INLINE void oz_enclosure_touch_mesh(OzWork *w, const OzSide *sides, int k, const int *slots,
                                       int count, int step)
{
#if OZ_MESHES > 0
    int slot = k - OZ_ENCLOSURE_MESH;
    OzGrain grain = oz_work_grains(w, slots);
    OzWallEnd where = oz_mesh_find_end(w, grain, slot / OZ_MESH_SLOTS, slot % OZ_MESH_SLOTS, slots);
    oz_enclosure_touch(w, &sides[k], grain, where, slots, count, step);
#endif
}

/* What is done with picked ends of a side, or shafts: joining them, or their forces. */
OZ_INLINE void oz_enclosure_handle(OzWork *w, const OzSide *sides, int k, int joins,
                                   const int *slots, int count, int step)
{
    if (joins) {
        oz_enclosure_join(w, sides, k, slots, count);
    } else if (k >= OZ_ENCLOSURE_MESH) {
        oz_enclosure_touch_mesh(w, sides, k, slots, count, step);
    } else if (k >= OZ_ENCLOSURE_SHAFT) {
        oz_enclosure_touch_shafts(w, sides, k, slots, count, step);
    } else {
        OzGrain grain = oz_work_grains(w, slots);
        OzWallEnd where = oz_enclosure_end(w, grain, &sides[k], slots);
        oz_enclosure_touch(w, &sides[k], grain, where, slots, count, step);
    }
}

/* Notes which ends of a block are picked now (one bit a lane), and sets to zero the tangential
 * springs of those that were picked before and are not any more. */
OZ_INLINE void oz_enclosure_part(OzWork *w, size_t index, int bits)
{
#if OZ_HISTORY
    int gone = w->wall_active[index] & ~bits;
    global scalar *kept = (global scalar *)(w->wall_history + 3 * index);
    for (int l = 0; gone != 0 && l < OZ_LANES; l++) {
        if ((gone >> l) & 1) {
            kept[l] = kept[OZ_LANES + l] = kept[2 * OZ_LANES + l] = 0;
#if OZ_ROLLING_SPRING
            global scalar *turned = (global scalar *)(w->wall_rolling + 3 * index);
            turned[l] = turned[OZ_LANES + l] = turned[2 * OZ_LANES + l] = 0;
#endif
        }
    }
#endif
    w->wall_active[index] = bits;
}

/* Picks the ends of a block at one side of a wall without edges, or of spheres at any. */
OZ_INLINE void oz_enclosure_sieve_end(OzWork *w, const OzSide *side, OzBody body, OzVec3 half_shaft,
                                      real near, int block)
{
    OzVec3 end = oz_scale(half_shaft, side->sign);
    OzWallDistance at = oz_enclosure_side_distance(w, body.position, end, side);
    oz_enclosure_part(w, (size_t)block * OZ_WALL_ENDS + side->index,
                      oz_lanes_bits(at.distance < near));
}

/* Picks the ends and the shafts of a block at one wall with edges, whose sides are those from `tip`
 * and from `ahead` on. A shaft may touch between its ends if they are not flush with the wall,
 * which no point of the shaft is nearer to by more than its way from the middle or an end. */
OZ_INLINE void oz_enclosure_sieve_rods(OzWork *w, const OzSide *tip, const OzSide *ahead,
                                       OzBody body, OzVec3 half_shaft, OzShape shape, int block)
{
    OzVec3 none = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0));
    real near = shape.radius * REAL(1 + OZ_PAIRS_MARGIN);
    OzVec3 from = oz_enclosure_side_from(w, body.position, none, tip);
    real middle = oz_wall_distance(from, tip->shape).distance - shape.half_length;
    int at_tip = 0, at_tail = 0, across = 0;
    if (OZ_ANY(middle < near)) {
        OzVec3 one = oz_add(from, half_shaft), other = oz_minus(from, half_shaft);
        real there = oz_wall_distance(one, tip->shape).distance;
        real here = oz_wall_distance(other, tip->shape).distance;
        at_tip = oz_lanes_bits(there < near);
        at_tail = oz_lanes_bits(here < near);
        across = oz_lanes_bits((shape.half_length > REAL(0.0)) &
                               (REAL(0.5) * (middle + oz_smaller(here, there)) < near));
        if (across != 0) {
            real flush = oz_wall_flush(one, tip->shape) * oz_wall_flush(other, tip->shape);
            across &= ~oz_lanes_bits(flush > REAL(0.0));
        }
    }
    size_t first = (size_t)block * OZ_WALL_ENDS;
    oz_enclosure_part(w, first + tip->index, at_tip);
    oz_enclosure_part(w, first + tip->index + 1, at_tail);
    for (int part = 0; part < OZ_WALL_SHAFT_PARTS; part++) {
        oz_enclosure_part(w, first + ahead->index + part, across);
    }
}

/* Picks the ends of a block of grains that touch a wall, or nearly so. */
OZ_INLINE void oz_enclosure_sieve(OzWork *w, const OzSide *sides, int block)
{
    OzBody body = oz_grains_load(w, block);
    OzShape shape = oz_grains_shape(w, block);
    OzVec3 half_shaft = oz_scale(oz_quaternion_axis(body.turn), shape.half_length);
    real near = shape.radius * REAL(1 + OZ_PAIRS_MARGIN);
    int plain = OZ_ROUND ? OZ_ENCLOSURE_SHAFT : OZ_ENCLOSURE_EDGED;
    for (int k = 0; k < plain; k++) {
        oz_enclosure_sieve_end(w, &sides[k], body, half_shaft, near, block);
    }
    for (int wall = 0; plain + 2 * wall < OZ_ENCLOSURE_SHAFT; wall++) {
        const OzSide *ahead = &sides[OZ_ENCLOSURE_SHAFT + OZ_WALL_SHAFT_PARTS * wall];
        oz_enclosure_sieve_rods(w, &sides[plain + 2 * wall], ahead, body, half_shaft, shape, block);
    }
    for (int part = 0; part < (OZ_ROUND ? 0 : 2 * (OZ_WALL_EDGED > 0)); part++) {
        w->wall_relief[(size_t)block * 2 + part] = REAL(0.0);
    }
#if OZ_LEDGER
    global real *words = w->wall_ledger + (size_t)block * OZ_WALL_ENDS * OZ_CONTACT_LEDGER;
    for (int k = 0; k < OZ_WALL_ENDS * OZ_CONTACT_LEDGER; k++) {
        words[k] = REAL(0.0);
    }
    words = w->wall_couple + (size_t)block * OZ_WALL_ENDS * OZ_COUPLE_LEDGER;
    for (int k = 0; k < (OZ_ROLLING ? OZ_WALL_ENDS * OZ_COUPLE_LEDGER : 0); k++) {
        words[k] = REAL(0.0);
    }
#endif
}

/* Handles a region's picked ends of one side. One side is finished for all grains of the region
 * before the next is begun. So a grain's forces are added in the order of walls, whichever ends
 * happen to share a block. */
OZ_INLINE void oz_enclosure_handle_region(OzWork *w, const OzSide *sides, int k, int joins,
                                          int region, int step)
{
    int end = oz_work_block_end(w, region);
    OzActive active;
    active.count = 0;
    for (int block = oz_work_block_begin(w, region); block < end; block++) {
        int bits = w->wall_active[(size_t)block * OZ_WALL_ENDS + k];
        int last = block + 1 == end;
        if (bits != 0) {
            oz_active_add(&active, OZ_LANES_IOTA + block * OZ_LANES, bits);
        }
        if (last || active.count >= OZ_ACTIVE_BLOCKS * OZ_LANES) {
            int due = oz_active_due(&active, last);
            oz_active_fill(&active, due);
            for (int at = 0; at < due; at += OZ_LANES) {
                oz_enclosure_handle(w, sides, k, joins, active.item + at, active.count - at, step);
            }
            oz_active_drop(&active, due);
        }
    }
}

#if OZ_MESHES > 0
/* Picks the grains of a block that touch meshes, slot by slot. */
OZ_INLINE void oz_enclosure_sieve_meshes(OzWork *w, const OzSide *sides, int block, int step)
{
    for (int mesh = 0; mesh < OZ_MESHES; mesh++) {
        const OzSide *side = &sides[OZ_ENCLOSURE_MESH + mesh * OZ_MESH_SLOTS];
        int picked[OZ_MESH_SLOTS];
        oz_mesh_find_block(w, side, mesh, block, step, picked);
        for (int k = 0; k < OZ_MESH_SLOTS; k++) {
            oz_enclosure_part(w, (size_t)block * OZ_WALL_ENDS + side->index + k, picked[k]);
        }
    }
}
#endif

OZ_INLINE void oz_enclosure_region(OzWork *w, int region, int step)
{
    OzSide sides[OZ_WALL_ENDS];
    for (int k = 0; k < OZ_WALL_ENDS; k++) {
        sides[k] = oz_enclosure_side_of(w, k, step);
    }
#if OZ_SERVOS > 0
    oz_servo_clear(w, region);
#endif
    for (int block = oz_work_block_begin(w, region); block < oz_work_block_end(w, region);
         block++) {
        oz_enclosure_sieve(w, sides, block);
#if OZ_MESHES > 0
        oz_enclosure_sieve_meshes(w, sides, block, step);
#endif
    }
    for (int k = OZ_ENCLOSURE_EDGED; k < OZ_ENCLOSURE_SHAFT; k++) {
        oz_enclosure_handle_region(w, sides, k, 1, region, step);
    }
    for (int k = OZ_ENCLOSURE_SHAFT; k < OZ_ENCLOSURE_MESH; k += OZ_WALL_SHAFT_PARTS) {
        oz_enclosure_handle_region(w, sides, k, 0, region, step);
    }
    for (int k = 0; k < OZ_ENCLOSURE_SHAFT; k++) {
        oz_enclosure_handle_region(w, sides, k, 0, region, step);
    }
    for (int k = OZ_ENCLOSURE_MESH; k < OZ_WALL_ENDS; k++) {
        oz_enclosure_handle_region(w, sides, k, 0, region, step);
    }
}

#endif
