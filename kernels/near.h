/* What the grid and the lists want to know of grains: where one is and how far it reaches, which
 * pairs are near, what has moved. OpenCL C only. */
#pragma once

#include "kernels/grains.h"
#include "kernels/mesh_list.h"

#define OZ_DIMENSIONS             3
#define OZ_NEAR_UNIT(w)           ((w)->parameters->length_unit)
#define OZ_NEAR_REAL(counts)      oz_fixed_position_to_real(counts)
#define OZ_NEAR_SLOTS(w)          ((w)->z.count)
#define OZ_NEAR_IS_LARGE(w, slot) 0
#define OZ_NEAR_MOVES(w, slot)    1              /* its forces are wanted                      */
#define OZ_NEAR_NONE(w)           ((w)->z.slots) /* second of a pair that never touches */
#define OZ_NEAR_MIXED             (!OZ_EQUAL)    /* a pair's first may have the higher id */
#define OZ_NEAR_PERIODIC          OZ_PERIODIC
/* Along the grid's first axis, which is x. */
#if OZ_SHEAR
#define OZ_NEAR_SLANT(w, far) oz_images_slant(w, far)
#else
#define OZ_NEAR_SLANT(w, far) 0
#endif

typedef fixed_position_kind place_kind;
typedef OzGrain OzNear;

OZ_INLINE int oz_near_listed(const OzWork *w, int slot)
{
    return 1;
}

OZ_INLINE void oz_near_place(const OzWork *w, int slot, place_kind place[3])
{
    global const place_kind *record =
        (global const place_kind *)(w->record + (size_t)slot * OZ_RECORD + OZ_R_POSITION);
    place[0] = record[0];
    place[1] = record[1];
    place[2] = record[2];
}

/* Half-length + radius of a grain, m, from its shape. The length of the shaft's vector would not
 * do: its rounding changes as the grain turns, so that two grains of equal reach would change their
 * order in a pair. */
OZ_INLINE scalar oz_near_reach(const OzWork *w, int slot)
{
    if (OZ_EQUAL) {
        return w->parameters->reach_max;
    }
    global const scalar *words = (global const scalar *)w->shape;
    return words[oz_lanes_at(slot, OZ_SHAPE, OZ_B_RADIUS)] +
           words[oz_lanes_at(slot, OZ_SHAPE, OZ_B_HALF_LENGTH)];
}

OZ_INLINE void oz_near_lay(OzWork *w, int to, int slot)
{
    w->sorted_id[to] = w->id[slot];
    if (!OZ_EQUAL) {
        w->sorted_reach[to] = oz_near_reach(w, slot);
    }
}

OZ_INLINE OzNear oz_near_load(const OzWork *w, const int *slots)
{
    return oz_work_geometry(w, slots);
}

/* A pair's first grain is the one with the longer reach (half-length + radius), then the lower id:
 * the sorted grains from k on of which the one in `slot` is the first. */
OZ_INLINE mask oz_near_seconds(const OzWork *w, int k, int slot)
{
    mask later = oz_lanes_mask_of(OZ_LANES_LOAD(w->sorted_id + k) > w->id[slot]);
    if (!OZ_EQUAL) {
        real reach = OZ_LANES_LOAD(w->sorted_reach + k), own = REAL(oz_near_reach(w, slot));
        later = (reach < own) | ((reach == own) & later);
    }
    return later;
}

/* Whether one grain is the first of a pair with another. */
OZ_INLINE int oz_near_leads(const OzWork *w, int one, int other)
{
    if (!OZ_EQUAL) {
        scalar reach = oz_near_reach(w, one), others = oz_near_reach(w, other);
        if (reach != others) {
            return reach > others;
        }
    }
    return w->id[one] < w->id[other];
}

/* Pairs whose gap is below `margin`. */
OZ_INLINE mask oz_near_pairs(const OzWork *w, const OzNear *a, const OzNear *b, real margin)
{
    real radii, distance2 = oz_pairs_distance2(w, *a, *b, &radii), near = radii + margin;
    return distance2 < near * near;
}

/* A block of grains as its motion is measured. */
typedef struct OzPose {
    OzBody body;
    OzShape shape;
    OzVec3 axis, shaft;
#if OZ_SHEAR
    real flow, tilt; /* m/s, at which a sheared cell draws apart what touches the grain; its tilt */
#endif
} OzPose;

OZ_INLINE OzPose oz_near_pose_of(OzBody body, OzShape shape)
{
    OzPose pose = {body, shape, oz_quaternion_axis(body.turn)};
    pose.shaft = oz_scale(pose.axis, shape.half_length);
    return pose;
}

OZ_INLINE OzPose oz_near_pose(const OzWork *w, int block)
{
    OzPose pose = oz_near_pose_of(oz_grains_load(w, block), oz_grains_shape(w, block));
#if OZ_SHEAR
    OzSpace space = oz_work_space(w);
    pose.flow = REAL(fabs(space.rate)) * (pose.shape.radius + pose.shape.half_length);
    pose.tilt = REAL(space.tilt);
#endif
    return pose;
}

/* How fast any point of a grain moves at most. */
OZ_INLINE real oz_near_speed(OzPose pose)
{
    OzVec3 rate = oz_body_rate(pose.body.spin, pose.axis, pose.shape);
    real speed = sqrt(oz_dot(pose.body.velocity, pose.body.velocity)) +
                 pose.shape.half_length * sqrt(oz_dot(rate, rate));
#if OZ_SHEAR
    speed += pose.flow;
#endif
    return speed;
}

OZ_INLINE void oz_near_note(global real *reference, OzPose pose)
{
    reference[0] = oz_fixed_position_bits(pose.body.position.x);
    reference[1] = oz_fixed_position_bits(pose.body.position.y);
    reference[2] = oz_fixed_position_bits(pose.body.position.z);
    oz_work_store3(reference + 3, pose.shaft);
#if OZ_SHEAR
    reference[OZ_REFERENCE_TILT] = pose.tilt;
#endif
}

#if OZ_SHEAR
/* What is left of a way that a grain may move about the flow: a pair that touches was not farther
 * than both reaches and skins apart along y, so that the flow has brought it nearer by at most that
 * times the change of the tilt; each takes its share. */
OZ_INLINE real oz_near_left(const OzWork *w, global const real *reference, OzPose pose, real most)
{
    real change = oz_magnitude(REAL(oz_work_space(w).tilt) - reference[OZ_REFERENCE_TILT]);
    return most -
           change * (pose.shape.radius + pose.shape.half_length + reference[OZ_REFERENCE_SKIN]);
}
#endif

/* Whether no point of the shaft can have moved farther than `most` since the reference was taken:
 * the larger of |dx + da| and |dx - da|. */
OZ_INLINE mask oz_near_stays(const OzWork *w, global const real *reference, OzPose pose, real most)
{
    OzFixedPosition from;
    from.x = oz_fixed_position_of_bits(reference[0]);
    from.y = oz_fixed_position_of_bits(reference[1]);
    from.z = oz_fixed_position_of_bits(reference[2]);
    OzVec3 dx = oz_space_minus(pose.body.position, from, oz_work_space(w));
    real moved2 = oz_dot(dx, dx);
    if (!OZ_ROUND) {
        OzVec3 da = oz_minus(pose.shaft, oz_work_load3(reference + 3));
        moved2 = moved2 + oz_dot(da, da) + REAL(2.0) * oz_magnitude(oz_dot(dx, da));
    }
#if OZ_SHEAR
    most = oz_near_left(w, reference, pose, most);
    return (most >= REAL(0.0)) & (moved2 <= most * most);
#else
    return moved2 <= most * most;
#endif
}

/* What else is made anew when a block's outer list is, and asked for when the inner one is. */
OZ_INLINE void oz_near_refer(OzWork *w, int block)
{
#if OZ_MESHES > 0
    oz_mesh_list_forget(w, block);
#endif
}

OZ_INLINE void oz_near_measure(OzWork *w, int block)
{
#if OZ_MESHES > 0
    oz_mesh_list_ask(w, block);
#endif
}

/* Any pair of a new list may have a spring. */
OZ_INLINE void oz_near_fresh(OzWork *w, int begin, int count)
{
    for (int p = begin; p < begin + count; p += OZ_LANES) {
        w->pair_active[p / OZ_LANES] = -1;
    }
}
