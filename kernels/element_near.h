/* What the grid and the lists want to know of elements: where one is and how far it reaches, which
 * pairs may touch (a cheap test that is never wrong about pairs that do), what has moved. OpenCL C
 * only. */
#pragma once

#include "kernels/element_work.h"

#define OZ_DIMENSIONS             2
#define OZ_NEAR_UNIT(w)           ((scalar)1)
#define OZ_NEAR_REAL(counts)      (counts)
#define OZ_NEAR_SLOTS(w)          ((w)->z.slots)
#define OZ_NEAR_IS_LARGE(w, slot) (oz_near_reach(w, slot) > (w)->parameters->reach_max)
#define OZ_NEAR_MOVES(w, slot)    ((slot) < (w)->z.free_slots) /* its forces are wanted           */
#define OZ_NEAR_NONE(w)           0 /* second of a pair that is passed over: lists know their end */
#define OZ_NEAR_MIXED             0 /* a pair's first has the lower id                           */
#define OZ_NEAR_PERIODIC          0 /* space does not repeat itself                              */

typedef scalar place_kind;

typedef struct OzNear {
    OzElement element;
    real radius;
} OzNear;

/* Elements of walls that are gone, and padding, are in no list. */
OZ_INLINE int oz_near_listed(const OzWork *w, int slot)
{
    return w->body[slot] >= 0;
}

OZ_INLINE void oz_near_place(const OzWork *w, int slot, place_kind place[3])
{
    global const scalar *record = w->record + (size_t)slot * OZ_RECORD + OZ_PR_POSITION;
    place[0] = record[0];
    place[1] = record[1];
    place[2] = 0;
}

OZ_INLINE scalar oz_near_reach(const OzWork *w, int slot)
{
    return ((global const scalar *)w->shape)[oz_lanes_at(slot, OZ_ELEMENT_SHAPE, OZ_PS_REACH)];
}

OZ_INLINE void oz_near_lay(OzWork *w, int to, int slot)
{
    w->sorted_body[to] = w->body[slot];
}

OZ_INLINE OzNear oz_near_load(const OzWork *w, const int *slots)
{
    OzNear near = {oz_element_work_element(w, slots), REAL(0.0)};
#if OZ_DISCS
    real unused;
    oz_element_work_label(w, slots, &near.radius, &unused);
#endif
    return near;
}

/* The sorted elements from k on of which the one in `slot` is the first: later ones of other
 * bodies. */
OZ_INLINE mask oz_near_seconds(const OzWork *w, int k, int slot)
{
    return oz_lanes_mask_of((OZ_LANES_LOAD(w->sorted_slot + k) > slot) &
                            (OZ_LANES_LOAD(w->sorted_body + k) != w->body[slot]));
}

/* False only for pairs farther apart than margin. A disc is a triangle of no size with a radius,
 * whose edges separate nothing: of two discs the distance decides. */
OZ_INLINE mask oz_near_pairs(const OzWork *w, const OzNear *a, const OzNear *b, real margin)
{
#if OZ_DISCS
    real all = margin + a->radius + b->radius;
    OzVec2 apart = oz_minus2(b->element.position, a->element.position);
    mask discs = (a->radius > REAL(0.0)) & (b->radius > REAL(0.0));
    mask apart_discs = discs & (oz_dot2(apart, apart) > all * all);
    return oz_triangle_near(&a->element.triangle, &b->element.triangle, all) & !apart_discs;
#else
    return oz_triangle_near(&a->element.triangle, &b->element.triangle, margin);
#endif
}

/* Where a block's elements are and how they move, and how far each reaches. */
typedef struct OzPose {
    OzVec2 position, velocity;
    real angle, angular_velocity, reach;
} OzPose;

OZ_INLINE OzPose oz_near_pose(const OzWork *w, int block)
{
    OzPose pose;
    real at[4];
    int slots[OZ_LANES];
    oz_work_slots(block, slots);
    oz_lanes_load4(w->record, slots, OZ_RECORD, OZ_PR_CORNER + 4, at);
    pose.position = oz_vec2(at[2], at[3]);
    oz_element_work_motion(w, slots, &pose.velocity, &pose.angle, &pose.angular_velocity);
    pose.reach = w->shape[(size_t)block * OZ_ELEMENT_SHAPE + OZ_PS_REACH];
    return pose;
}

/* How fast any point of an element moves at most. */
OZ_INLINE real oz_near_speed(OzPose pose)
{
    return oz_length2(pose.velocity) + pose.reach * oz_magnitude(pose.angular_velocity);
}

OZ_INLINE void oz_near_note(global real *reference, OzPose pose)
{
    reference[OZ_PF_X] = pose.position.x;
    reference[OZ_PF_Y] = pose.position.y;
    reference[OZ_PF_ANGLE] = pose.angle;
}

/* Whether a way and a turn (by its magnitude) at some reach are together no more than most, and
 * numbers. */
OZ_INLINE mask oz_near_within(OzVec2 way, real turn, real reach, real most)
{
    real left = most - reach * turn;
    return (left >= REAL(0.0)) & (oz_dot2(way, way) <= left * left);
}

/* Whether no point of an element can have moved farther than `most` since the reference was taken.
 */
OZ_INLINE mask oz_near_stays(const OzWork *w, global const real *reference, OzPose pose, real most)
{
    OzVec2 way =
        oz_vec2(pose.position.x - reference[OZ_PF_X], pose.position.y - reference[OZ_PF_Y]);
    return oz_near_within(way, oz_magnitude(pose.angle - reference[OZ_PF_ANGLE]), pose.reach, most);
}

#define oz_near_fresh(w, begin, count) ((void)0)
#define oz_near_refer(w, block)        ((void)0)
#define oz_near_measure(w, block)      ((void)0)
