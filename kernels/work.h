/* A kernel's view of memory: every array of one member, and how work is shared out. OpenCL C only.
 * OZ_GROUP 1: one work-item does a member's whole launch and needs neither barriers nor atomics;
 * otherwise the work-group's size. OZ_RESORT 1: a large scene, phase by phase over many
 * work-groups. Work-items look after regions: runs of slots with their own pair lists. */
#ifndef OZ_KERNELS_WORK_H
#define OZ_KERNELS_WORK_H

#include "kernels/fields.h"
#include "kernels/integrate.h"
#include "kernels/lanes.h"
#include "kernels/layout.h"
#include "kernels/rods.h"

typedef OzParameters parameters_kind;
typedef OzControl control_kind;
typedef scalar scalar_kind;
typedef real real_kind;
typedef int integer_kind;
#if defined(OZ_DOUBLE)
typedef double fixed_position_kind;
#else
typedef int fixed_position_kind;
#endif
#if OZ_LEDGER
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double ledger_kind;
#else
typedef int ledger_kind;
#endif

#define OZ_WORK_MEMBER(kind, name, count, class)   global kind##_kind *name;
#define OZ_WORK_ARGUMENT(kind, name, count, class) global kind##_kind *name,
#define OZ_WORK_TAKE(kind, name, count, class)     w.name = name + (size_t)member * (size_t)(count);

typedef struct OzWork {
    OZ_FIELDS(OZ_WORK_MEMBER)
    OzSizes z;
} OzWork;

/* The arguments that every kernel begins with, and the view of one member made of them. */
#define OZ_WORK_ARGUMENTS OZ_FIELDS(OZ_WORK_ARGUMENT) OzSizes z
#define OZ_WORK_OPEN(member_index)                                                                 \
    OzWork w;                                                                                      \
    {                                                                                              \
        int member = (member_index);                                                               \
        OZ_FIELDS(OZ_WORK_TAKE)                                                                    \
        w.z = z;                                                                                   \
    }

#if OZ_GROUP == 1 && !OZ_RESORT
#define OZ_WORK_BARRIER()
#define OZ_WORK_COUNT(counter)   ((*(counter))++)
#define OZ_WORK_MARK(word, step) (*(word) = (step))
#define OZ_WORK_ITEM             0
#define OZ_WORK_STRIDE           1
#else
#define OZ_WORK_BARRIER()        barrier(CLK_GLOBAL_MEM_FENCE)
#define OZ_WORK_COUNT(counter)   atomic_inc(counter)
#define OZ_WORK_MARK(word, step) atomic_min(word, step) /* of a word that is OZ_NEVER unmarked */
#define OZ_WORK_ITEM             ((int)get_local_id(0))
#define OZ_WORK_STRIDE           ((int)get_local_size(0))
#endif

/* Asks for an end: reason bits, step and the lowest id of the first step that had any. */
OZ_INLINE void oz_work_stop(OzWork *w, int bits, int step, int grain)
{
    atomic_or(&w->control->stop_bits, bits);
    atomic_min(&w->control->stop_step, step);
    atomic_min(&w->control->stop_index, grain);
}

/* The same for every lane of hits, whose grains are in slots. */
OZ_INLINE void oz_work_stop_lanes(OzWork *w, mask hits, int bits, int step, const int *slots)
{
    int hit[OZ_LANES];
    oz_lanes_store_mask(hits, hit);
    for (int l = 0; l < OZ_LANES; l++) {
        if (hit[l] && slots[l] < w->z.count) {
            oz_work_stop(w, bits, step, w->id[slots[l]]);
        }
    }
}

/* The region's blocks of grains, padding included: first and one past the last. */
OZ_INLINE int oz_work_block_begin(const OzWork *w, int region)
{
    return min(region * w->z.region_slots, w->z.slots) / OZ_LANES;
}

OZ_INLINE int oz_work_block_end(const OzWork *w, int region)
{
    return min((region + 1) * w->z.region_slots, w->z.slots) / OZ_LANES;
}

OZ_INLINE int oz_work_region_begin(const OzWork *w, int region)
{
    return min(region * w->z.region_slots, w->z.slots);
}

/* One past the region's last grain, padding not included. */
OZ_INLINE int oz_work_region_end(const OzWork *w, int region)
{
    return min((region + 1) * w->z.region_slots, w->z.count);
}

/* Places, shafts, radii and masses of the grains in slots. */
OZ_INLINE OzGrain oz_work_geometry(const OzWork *w, const int *slots)
{
    real a[4], b[4];
    oz_lanes_load4(w->record, slots, OZ_RECORD, OZ_R_POSITION, a);
    oz_lanes_load4(w->record, slots, OZ_RECORD, OZ_R_SHAFT, b);
    OzGrain grain;
    grain.position.x = oz_fixed_position_of_bits(a[0]);
    grain.position.y = oz_fixed_position_of_bits(a[1]);
    grain.position.z = oz_fixed_position_of_bits(a[2]);
    grain.half_shaft = oz_vec3(b[0], b[1], b[2]);
    grain.radius = OZ_EQUAL ? REAL(w->parameters->radius) : a[3];
    grain.mass = OZ_EQUAL ? REAL(w->parameters->mass) : b[3];
    return grain;
}

/* Three words, from `word` on, of items in an array of blocks of `words` words. */
OZ_INLINE OzVec3 oz_work_fetch3(global const real *blocks, const int *items, int words, int word)
{
    return oz_vec3(oz_lanes_fetch(blocks, items, words, word),
                   oz_lanes_fetch(blocks, items, words, word + 1),
                   oz_lanes_fetch(blocks, items, words, word + 2));
}

#if OZ_FINE
OZ_INLINE OzQuaternion oz_work_fetch_turn(const OzWork *w, const int *slots, int word)
{
    OzVec3 first = oz_work_fetch3(w->state, slots, OZ_STATE, word);
    OzQuaternion turn = {first.x, first.y, first.z,
                         oz_lanes_fetch(w->state, slots, OZ_STATE, word + 3)};
    return turn;
}

/* All digits of where grains are. */
OZ_INLINE OzFineGrain oz_work_fine(const OzWork *w, const int *slots)
{
    OzFineGrain fine;
    real counts = REAL(w->parameters->inverse_unit);
    fine.position = oz_work_geometry(w, slots).position;
    fine.rest = oz_work_fetch3(w->state, slots, OZ_STATE, OZ_S_REST);
    fine.radius = OZ_EQUAL ? REAL(w->parameters->radius_count)
                           : oz_lanes_fetch(w->shape, slots, OZ_SHAPE, OZ_B_COUNT);
    fine.half_shaft = REAL(0.0);
    if (!OZ_ROUND) {
        fine.half_shaft =
            counts * (OZ_EQUAL ? REAL(w->parameters->half_length)
                               : oz_lanes_fetch(w->shape, slots, OZ_SHAPE, OZ_B_HALF_LENGTH));
        fine.axis = oz_fine_axis(oz_work_fetch_turn(w, slots, OZ_S_TURN),
                                 oz_work_fetch_turn(w, slots, OZ_S_TURN_REST));
    }
    return fine;
}
#endif

/* What contacts want beside that. */
OZ_INLINE void oz_work_load_motion(const OzWork *w, const int *slots, OzGrain *grain)
{
    real c[4], d[4];
    oz_lanes_load4(w->record, slots, OZ_RECORD, OZ_R_VELOCITY, c);
    oz_lanes_load4(w->record, slots, OZ_RECORD, OZ_R_RATE, d);
    grain->velocity = oz_vec3(c[0], c[1], c[2]);
    grain->rate = oz_vec3(d[0], d[1], d[2]);
    grain->inverse_inertia = d[3];
}

/* Grains in slots as contacts see them. */
OZ_INLINE OzGrain oz_work_grains(const OzWork *w, const int *slots)
{
    OzGrain grain = oz_work_geometry(w, slots);
    oz_work_load_motion(w, slots, &grain);
#if OZ_FINE
    grain.fine = oz_work_fine(w, slots);
#endif
    return grain;
}

/* Three words written likewise. */
OZ_INLINE void oz_work_put3(global real *blocks, const int *items, int words, int word, OzVec3 v)
{
    oz_lanes_put(blocks, items, words, word, v.x);
    oz_lanes_put(blocks, items, words, word + 1, v.y);
    oz_lanes_put(blocks, items, words, word + 2, v.z);
}

OZ_INLINE OzVec3 oz_work_load3(global const real *words)
{
    return oz_vec3(words[0], words[1], words[2]);
}

OZ_INLINE void oz_work_store3(global real *words, OzVec3 v)
{
    words[0] = v.x;
    words[1] = v.y;
    words[2] = v.z;
}

#if OZ_SCATTER
/* No forces yet on the region's grains. */
OZ_INLINE void oz_work_clear_loads(OzWork *w, int region)
{
    global real *words = (global real *)w->load;
    for (int k = oz_work_block_begin(w, region) * OZ_LOAD;
         k < oz_work_block_end(w, region) * OZ_LOAD; k++) {
        words[k] = REAL(0.0);
    }
}
#endif

#endif
