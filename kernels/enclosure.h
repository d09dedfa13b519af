/* Forces between grains and walls. Few grains touch a wall: a sieve picks the ends that do, wall by
 * wall, and the contact law gets full blocks of them, one end a lane; then points of shafts at
 * walls with edges (wall_shaft.h) in the same way. OpenCL C only. */
#pragma once

#include "kernels/grains.h"
#include "kernels/wall_drive.h"
#include "kernels/wall_joint.h"

#if OZ_WALL_COUNT > 0

/* The forces of a step see the walls where they stand at the beginning of this step: the next one
 * where the integrator moves grains before the forces. */
#if OZ_MOVES_BEFORE
#define OZ_ENCLOSURE_STEP(step) ((step) + 1)
#else
#define OZ_ENCLOSURE_STEP(step) (step)
#endif

/* The first end at a wall with edges, and the first point of a shaft. */
#define OZ_ENCLOSURE_SHAFT ((OZ_ROUND ? 1 : 2) * OZ_WALL_COUNT)
#define OZ_ENCLOSURE_EDGED (OZ_ENCLOSURE_SHAFT - (OZ_ROUND ? 1 : 2) * OZ_WALL_EDGED)

/* One of the two ends of every grain, or a point of its shaft, paired with one wall: what is the
 * same for all grains in a step. */
typedef struct OzSide {
    int wall;
    real sign; /* of the half-shaft that leads to the end: 1 or -1 */
    int index; /* among all ends and points at all walls           */
    int part;  /* OZ_WALL_TIP ...                                  */
    int first; /* the first end: a sphere has no other             */
    OzWallShape shape;
    fixed_position_kind point[3]; /* the shape's                             */
    scalar unit;
    scalar offset, speed;   /* m, m/s of the wall along its direction: z without OZ_FREE_MOTION */
    scalar rise, rise_rest; /* units: the offset with all its digits   */
    scalar rate;            /* rad/s                                   */
} OzSide;

OZ_INLINE OzSide oz_enclosure_side(const OzWork *w, int index, int step)
{
    OzSide side;
    int ends = OZ_ROUND ? 1 : 2;
    side.index = index;
    side.wall = oz_wall_shaft_wall(index, ends, OZ_WALL_COUNT, OZ_WALL_EDGED);
    side.part = oz_wall_shaft_part(index, ends, OZ_WALL_COUNT);
    side.first = side.part == OZ_WALL_TIP;
    side.sign = REAL(side.first ? 1.0 : -1.0);
    side.shape = w->parameters->wall[side.wall].shape;
    side.shape.kind = oz_wall_kind(side.wall);
    for (int c = 0; c < 3; c++) {
        side.point[c] = (fixed_position_kind)side.shape.point[c];
    }
    side.unit = w->parameters->length_unit;
    side.offset = side.speed = side.rise = side.rise_rest = 0;
    if (OZ_MOVING) {
        size_t at = (size_t)OZ_ENCLOSURE_STEP(step) * OZ_WALL_COUNT + side.wall;
        side.offset = w->motion[OZ_MOTION * at];
        side.speed = w->motion[OZ_MOTION * at + OZ_M_SPEED];
        side.rise = w->motion[OZ_MOTION * at + OZ_M_RISE];
        side.rise_rest = w->motion[OZ_MOTION * at + OZ_M_RISE_REST];
        side.rate = w->motion[OZ_MOTION * at + OZ_M_RATE];
    }
    return side;
}

/* How the side's wall moves. */
OZ_INLINE OzWallDrive oz_enclosure_drive(const OzWork *w, const OzSide *side)
{
    OzWallDrive drive;
    const OzWallParameters wall = w->parameters->wall[side->wall];
    drive.direction =
        oz_vec3(REAL(wall.direction[0]), REAL(wall.direction[1]), REAL(wall.direction[2]));
    drive.axis = oz_vec3(REAL(wall.axis[0]), REAL(wall.axis[1]), REAL(wall.axis[2]));
    drive.offset = REAL(side->offset);
    drive.speed = REAL(side->speed);
    drive.rate = REAL(side->rate);
    return drive;
}

/* A place on a grain, `end` from its centre, seen from the wall's point, where that is now. */
OZ_INLINE OzVec3 oz_enclosure_from(const OzWork *w, OzFixedPosition position_, OzVec3 end,
                                   const OzSide *side)
{
    scalar unit = side->unit;
    OzVec3 from = oz_vec3(oz_fixed_position_to_real(position_.x - side->point[0]) * unit + end.x,
                          oz_fixed_position_to_real(position_.y - side->point[1]) * unit + end.y,
                          oz_fixed_position_to_real(position_.z - side->point[2]) * unit + end.z -
                              (OZ_FREE_MOTION ? 0 : side->offset));
    if (OZ_FREE_MOTION) {
        OzWallDrive drive = oz_enclosure_drive(w, side);
        from = oz_along(from, -drive.offset, drive.direction);
    }
    return from;
}

OZ_INLINE OzWallDistance oz_enclosure_distance(const OzWork *w, OzFixedPosition position_,
                                               OzVec3 end, const OzSide *side)
{
    return oz_wall_distance(oz_enclosure_from(w, position_, end, side), side->shape);
}

/* The wall's velocity where it touches a grain, arm from the grain's centre. */
OZ_INLINE OzVec3 oz_enclosure_velocity(const OzWork *w, OzFixedPosition position_, OzVec3 arm,
                                       const OzSide *side)
{
    if (!OZ_FREE_MOTION) {
        return oz_vec3(REAL(0.0), REAL(0.0), REAL(side->speed));
    }
    return oz_wall_drive_velocity(oz_enclosure_drive(w, side),
                                  oz_enclosure_from(w, position_, arm, side));
}

#if OZ_FINE
/* The overlap of ends and a wall. */
OZ_INLINE real oz_enclosure_fine(const OzWork *w, OzGrain grain, const OzSide *side)
{
    real unit = grain.radius / grain.fine.radius;
    OzFixedPosition from = grain.position; /* of every lane the same */
    from.x = side->point[0];
    from.y = side->point[1];
    from.z = side->point[2];
    OzFine rise = {REAL(side->rise), REAL(side->rise_rest)};
    return unit * oz_wall_overlap(oz_fine_end(grain.fine, side->sign, from), side->shape, rise,
                                  grain.fine.radius, w->parameters->inverse_unit);
}
#endif

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
    OzWallRod rod = {oz_enclosure_from(w, grain.position, none, side), grain.half_shaft,
                     grain.radius, -grain.radius, -grain.radius};
    for (int j = OZ_ENCLOSURE_EDGED; j < OZ_ENCLOSURE_SHAFT; j++) {
        OzVec3 end = oz_scale(grain.half_shaft, sides[j].sign);
        real overlap =
            grain.radius - oz_enclosure_distance(w, grain.position, end, &sides[j]).distance;
        real *most = sides[j].first ? &rod.tip : &rod.tail;
        *most = oz_larger(*most, overlap);
    }
    return rod;
}

/* The points of shafts at a wall, sides[k] and the next; those that touch another wall there, which
 * comes first, are none. */
OZ_INLINE void oz_enclosure_points(const OzWork *w, OzGrain grain, const OzSide *sides, int k,
                                   OzWallPoint points[OZ_WALL_SHAFT_PARTS])
{
    OzWallRod rod = oz_enclosure_rod(w, grain, sides, &sides[k]);
    for (int part = 0; part < OZ_WALL_SHAFT_PARTS; part++) {
        OzWallPoint point = oz_wall_shaft_point(rod, sides[k].shape, part == 0);
        for (int j = OZ_ENCLOSURE_EDGED; j < OZ_ENCLOSURE_SHAFT; j++) {
            if (sides[j].wall < sides[k].wall && sides[j].first) {
                OzVec3 place = oz_scale(grain.half_shaft, point.at);
                OzVec3 from = oz_enclosure_from(w, grain.position, place, &sides[j]);
                mask hides = oz_wall_shaft_hides(from, sides[j].shape, point, grain.radius);
                point.overlap = hides ? -grain.radius : point.overlap;
            }
        }
        points[part] = point;
    }
    oz_wall_shaft_push(rod, &points[0], &points[1]);
}

/* Where one block of picked ends stands against their side. The wall's velocity is left open. */
OZ_INLINE OzWallEnd oz_enclosure_end(const OzWork *w, OzGrain grain, const OzSide *side,
                                     const int *slots)
{
    OzWallEnd where;
    where.end = oz_scale(grain.half_shaft, side->sign);
    where.wall = oz_enclosure_distance(w, grain.position, where.end, side);
#if OZ_FINE
    where.wall.overlap = oz_enclosure_fine(w, grain, side);
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
    OzVec3 history = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0));
    if (OZ_HISTORY) {
        history = oz_work_fetch3(w->wall_history, slots, 3 * OZ_WALL_ENDS, 3 * side->index);
    }
    where.wall_velocity = oz_enclosure_velocity(
        w, grain.position, oz_rods_wall_arm(grain, where.end, where.wall), side);
    OzWallForce found = oz_rods_wall(grain, where, w->parameters->wall[side->wall].law, &history,
                                     w->parameters->dt, oz_integrate_share());
    if (OZ_HISTORY) {
        oz_work_put3(w->wall_history, slots, 3 * OZ_WALL_ENDS, 3 * side->index, history);
    }
    OzVec3 force = oz_where(OZ_ACTIVE_BEFORE(count), found.parts.force);
    oz_loads_add(w, slots, force, oz_cross(found.arm, force));
    mask counts = OZ_ACTIVE_BEFORE(count);
    OzContact whole = found.contact;
    if (!OZ_ROUND && side->index >= OZ_ENCLOSURE_EDGED) {
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
#endif
}

/* The same of both points of picked shafts at the wall of sides[k] and the next; notes what they
 * relieve the ends of. */
OZ_INLINE void oz_enclosure_touch_shafts(OzWork *w, const OzSide *sides, int k, const int *slots,
                                         int count, int step)
{
    OzGrain grain = oz_work_grains(w, slots);
    OzWallPoint points[OZ_WALL_SHAFT_PARTS];
    oz_enclosure_points(w, grain, sides, k, points);
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

/* The forces of picked ends of a side, or of shafts. */
OZ_INLINE void oz_enclosure_forces(OzWork *w, const OzSide *sides, int k, const int *slots,
                                   int count, int step)
{
    if (k >= OZ_ENCLOSURE_SHAFT) {
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
        }
    }
#endif
    w->wall_active[index] = bits;
}

/* The tangential springs of a block's ends (one bit a lane) that touch one side no more, but one
 * that it joins: those that were picked before take theirs along to where none is yet. */
OZ_INLINE void oz_enclosure_hand_over(OzWork *w, int block, int from, int to, int bits)
{
#if OZ_HISTORY
    size_t old = (size_t)block * OZ_WALL_ENDS + from, new = (size_t)block *OZ_WALL_ENDS + to;
    global const scalar *given = (global const scalar *)(w->wall_history + 3 * old);
    global scalar *taken = (global scalar *)(w->wall_history + 3 * new);
    bits &= w->wall_active[old] & (to < from ? w->wall_active[new] : -1);
    for (int l = 0; bits >> l != 0 && l < OZ_LANES; l++) {
        int is_free = taken[l] == 0 && taken[OZ_LANES + l] == 0 && taken[2 * OZ_LANES + l] == 0;
        for (int c = 0; c < 3 && is_free && (bits >> l) & 1; c++) {
            taken[c * OZ_LANES + l] = given[c * OZ_LANES + l];
        }
    }
    w->wall_active[new] |= bits; /* if the sieve does not pick them there, they are cleared */
#endif
}

/* Which ends of a block touch another side with edges at the same place (wall_joint.h). */
OZ_INLINE mask oz_enclosure_hidden(OzWork *w, const OzSide *sides, int k, int block, OzBody body,
                                   OzVec3 end, OzWallDistance own, real radius)
{
    mask hidden = own.distance < REAL(0.0);
    for (int j = OZ_ENCLOSURE_EDGED; j < OZ_ENCLOSURE_SHAFT; j++) {
        if (j != k && sides[j].first == sides[k].first) {
            OzVec3 from = oz_enclosure_from(w, body.position, end, &sides[j]);
            OzWallDistance other = oz_wall_distance(from, sides[j].shape);
            mask hides = oz_wall_joint_hides(from, sides[j].shape, other, j < k, own, radius);
            oz_enclosure_hand_over(w, block, k, j, oz_lanes_bits(hides & !hidden));
            hidden = hidden | hides;
        }
    }
    return hidden;
}

/* The shafts of a block that may touch a side between their ends. */
OZ_INLINE int oz_enclosure_across(const OzWork *w, const OzSide *side, OzBody body,
                                  OzVec3 half_shaft, OzShape shape)
{
    OzVec3 none = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0));
    OzVec3 from = oz_enclosure_from(w, body.position, none, side);
    real near = shape.radius * REAL(1 + OZ_PAIRS_MARGIN) + shape.half_length;
    real tip = oz_wall_flush(oz_add(from, half_shaft), side->shape);
    real tail = oz_wall_flush(oz_minus(from, half_shaft), side->shape);
    mask apart = !(tip * tail > REAL(0.0)) & (shape.half_length > REAL(0.0));
    return oz_lanes_bits(apart & (oz_wall_distance(from, side->shape).distance < near));
}

/* Picks the ends of a block of grains that touch a wall, or nearly so. */
OZ_INLINE void oz_enclosure_sieve(OzWork *w, const OzSide *sides, int block)
{
    OzBody body = oz_grains_load(w, block);
    OzShape shape = oz_grains_shape(w, block);
    OzVec3 half_shaft = oz_scale(oz_quaternion_axis(body.turn), shape.half_length);
    real near = shape.radius * REAL(1 + OZ_PAIRS_MARGIN);
    for (int k = 0; k < OZ_ENCLOSURE_SHAFT; k++) {
        OzVec3 end = oz_scale(half_shaft, sides[k].sign);
        OzWallDistance at = oz_enclosure_distance(w, body.position, end, &sides[k]);
        int bits = oz_lanes_bits(at.distance < near);
        if (k >= OZ_ENCLOSURE_EDGED && bits != 0) {
            bits &= ~oz_lanes_bits(
                oz_enclosure_hidden(w, sides, k, block, body, end, at, shape.radius));
        }
        oz_enclosure_part(w, (size_t)block * OZ_WALL_ENDS + k, bits);
    }
    for (int part = 0; part < (OZ_ROUND ? 0 : 2 * (OZ_WALL_EDGED > 0)); part++) {
        w->wall_relief[(size_t)block * 2 + part] = REAL(0.0);
    }
    for (int k = OZ_ENCLOSURE_SHAFT; k < OZ_WALL_ENDS; k += OZ_WALL_SHAFT_PARTS) {
        int bits = oz_enclosure_across(w, &sides[k], body, half_shaft, shape);
        for (int part = 0; part < OZ_WALL_SHAFT_PARTS; part++) {
            oz_enclosure_part(w, (size_t)block * OZ_WALL_ENDS + k + part, bits);
        }
    }
#if OZ_LEDGER
    global real *words = w->wall_ledger + (size_t)block * OZ_WALL_ENDS * OZ_CONTACT_LEDGER;
    for (int k = 0; k < OZ_WALL_ENDS * OZ_CONTACT_LEDGER; k++) {
        words[k] = REAL(0.0);
    }
#endif
}

/* Forces of a region's picked ends of one side. One side is finished for all grains of the region
 * before the next is begun. So a grain's forces are added in the order of walls, whichever ends
 * happen to share a block. */
OZ_INLINE void oz_enclosure_side_region(OzWork *w, const OzSide *sides, int k, int region, int step)
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
                oz_enclosure_forces(w, sides, k, active.item + at, active.count - at, step);
            }
            oz_active_drop(&active, due);
        }
    }
}

OZ_INLINE void oz_enclosure_region(OzWork *w, int region, int step)
{
    OzSide sides[OZ_WALL_ENDS];
    for (int k = 0; k < OZ_WALL_ENDS; k++) {
        sides[k] = oz_enclosure_side(w, k, step);
    }
    for (int block = oz_work_block_begin(w, region); block < oz_work_block_end(w, region);
         block++) {
        oz_enclosure_sieve(w, sides, block);
    }
    for (int k = OZ_ENCLOSURE_SHAFT; k < OZ_WALL_ENDS; k += OZ_WALL_SHAFT_PARTS) {
        oz_enclosure_side_region(w, sides, k, region, step);
    }
    for (int k = 0; k < OZ_ENCLOSURE_SHAFT; k++) {
        oz_enclosure_side_region(w, sides, k, region, step);
    }
}

#endif
