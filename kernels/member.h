/* A kernel's view of memory, the same for every model: every array of one member, how work is
 * shared out, how a run is stopped. A model's own header (work.h, element_work.h) says first what
 * its OZ_FIELDS, OzParameters, OzControl and OzSizes are; OZ_WORK_BODIES(w) bodies that move, in
 * OZ_WORK_SLOTS(w) slots; whether OZ_WORK_HOLDS(w, slot) a body; its OZ_WORK_ID(w, slot), by which
 * the host is told of it and which no order of slots changes. OpenCL C only. OZ_GROUP 1: one
 * work-item does a member's whole launch and needs neither barriers nor atomics; otherwise the
 * work-group's size. OZ_RESORT 1: a large scene, phase by phase over many work-groups. Pair lists
 * are kept by region, a run of slots. OZ_TILES 1: a region is a tile, whose forces and motion are
 * one work-item's in one launch. Its lists hold every pair of its bodies, also those with a body of
 * another tile, which that tile lists and computes too, from the same words in the same order: each
 * adds to its own body, and both copies of a tangential spring stay equal. So nothing is handed
 * over within a step but the bodies' records, of which there are two halves: a step reads one,
 * which holds what all bodies were before it, and writes the other. */
#pragma once

#include "kernels/head.h"
#include "kernels/lanes.h"

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
#if OZ_SERVOS > 0
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double wide_kind;
#else
typedef int wide_kind;
#endif
#if OZ_LEDGER || OZ_IMPULSES
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
    int item, stride; /* this work-item, and how many share the work */
#if OZ_SHEAR
    int places; /* the step that the cell now stands as at */
#endif
#if OZ_TILES
    global scalar *record_next; /* the half of the records that the step writes */
    global scalar *fine_next;
    int own_begin, own_end; /* slots of the tile at hand                    */
    int stray;              /* slot of loads that nobody asks for           */
#endif
} OzWork;

/* The arguments that every kernel begins with, and the view of one member made of them. */
#define OZ_WORK_ARGUMENTS OZ_FIELDS(OZ_WORK_ARGUMENT) OzSizes z
#define OZ_WORK_OPEN(member_index)                                                                 \
    OzWork w;                                                                                      \
    {                                                                                              \
        int member = (member_index);                                                               \
        OZ_FIELDS(OZ_WORK_TAKE)                                                                    \
        w.z = z;                                                                                   \
        w.item = OZ_WORK_ITEM;                                                                     \
        w.stride = OZ_WORK_STRIDE;                                                                 \
    }

/* With tiles: the halves of the records as a step finds them. */
#if OZ_TILES
#define OZ_WORK_AT(w, number)                                                                      \
    {                                                                                              \
        size_t slots = (size_t)(w)->z.slots + 1;                                                   \
        size_t odd = (size_t)(((w)->control->front + (number)) & 1);                               \
        (w)->record_next = (w)->record + (1 - odd) * slots * OZ_RECORD;                            \
        (w)->record += odd * slots * OZ_RECORD;                                                    \
        (w)->fine_next = (w)->fine + (1 - odd) * slots * OZ_FINE_RECORD;                           \
        (w)->fine += odd * slots * OZ_FINE_RECORD;                                                 \
    }
#else
#define OZ_WORK_AT(w, number)
#endif

/* Of a sheared cell: places are those of this step of the launch from here on. */
#if OZ_SHEAR
#define OZ_WORK_PLACES(w, step) ((w)->places = (step))
#else
#define OZ_WORK_PLACES(w, step)
#endif

/* OZ_WORK_BEGIN, OZ_WORK_END, OZ_WORK_NEXT: which of `count` things a work-item looks after. Those
 * of a large scene's follow each other in memory. */
#if OZ_SCATTER
#define OZ_WORK_BARRIER()
#define OZ_WORK_COUNT(counter)   ((*(counter))++)
#define OZ_WORK_MARK(word, step) (*(word) = (step))
#define OZ_WORK_ITEM             0
#define OZ_WORK_STRIDE           1
#else
#define OZ_WORK_BARRIER()        barrier(CLK_GLOBAL_MEM_FENCE)
#define OZ_WORK_COUNT(counter)   atomic_inc(counter)
#define OZ_WORK_MARK(word, step) atomic_min(word, step) /* of a word that is OZ_NEVER unmarked */
#if OZ_RESORT
#define OZ_WORK_ITEM   ((int)get_global_id(0))
#define OZ_WORK_STRIDE (z.regions)
#else
#define OZ_WORK_ITEM   ((int)get_local_id(0))
#define OZ_WORK_STRIDE ((int)get_local_size(0))
#endif
#endif
#if OZ_RESORT
#define OZ_WORK_PART(w, count, k) ((int)((long)(count)*min(k, (w)->stride) / (w)->stride))
#define OZ_WORK_BEGIN(w, count)   OZ_WORK_PART(w, count, (w)->item)
#define OZ_WORK_END(w, count)     OZ_WORK_PART(w, count, (w)->item + 1)
#define OZ_WORK_NEXT(w)           1
#else
#define OZ_WORK_BEGIN(w, count) (w)->item
#define OZ_WORK_END(w, count)   (count)
#define OZ_WORK_NEXT(w)         (w)->stride
#endif

#define OZ_EACH(w, index, count)                                                                   \
    for (int index = OZ_WORK_BEGIN(w, count), index##_end = OZ_WORK_END(w, count);                 \
         index < index##_end; index += OZ_WORK_NEXT(w))
#define OZ_EACH_REGION(w) OZ_EACH(w, region, (w)->z.regions)

/* Asks for an end: reason bits, step and the lowest index of the first step that had any. */
OZ_INLINE void oz_work_stop(OzWork *w, int bits, int step, int index)
{
    atomic_or(&w->control->stop_bits, bits);
    atomic_min(&w->control->stop_step, step);
    atomic_min(&w->control->stop_index, index);
}

/* A region's slots, without and with the padding of the last one; OZ_WORK_BODIES(w) bodies that
 * move are in OZ_WORK_SLOTS(w) slots. */
OZ_INLINE int oz_work_region_begin(const OzWork *w, int region)
{
    return min(region * w->z.region_slots, OZ_WORK_SLOTS(w));
}

OZ_INLINE int oz_work_region_end(const OzWork *w, int region)
{
    return min((region + 1) * w->z.region_slots, OZ_WORK_BODIES(w));
}

OZ_INLINE int oz_work_block_begin(const OzWork *w, int region)
{
    return oz_work_region_begin(w, region) / OZ_LANES;
}

OZ_INLINE int oz_work_block_end(const OzWork *w, int region)
{
    return oz_work_region_begin(w, region + 1) / OZ_LANES;
}

#if OZ_TILES
/* Makes a region the tile at hand. */
OZ_INLINE void oz_work_tile(OzWork *w, int region)
{
    w->own_begin = oz_work_region_begin(w, region);
    w->own_end = oz_work_region_end(w, region);
    w->stray = w->z.slots + 2 * region; /* tiles do not share a cache line */
}

/* Whether a slot is of the tile at hand. */
OZ_INLINE int oz_work_is_own(const OzWork *w, int slot)
{
    return (slot >= w->own_begin) & (slot < w->own_end);
}
#else
#define oz_work_tile(w, region) ((void)0)
#define oz_work_is_own(w, slot) 1
#endif

/* The same for every lane of hits, whose bodies are in slots; padding is left out. */
OZ_INLINE void oz_work_stop_lanes(OzWork *w, mask hits, int bits, int step, const int *slots)
{
    int hit[OZ_LANES];
    oz_lanes_store_mask(hits, hit);
    for (int l = 0; l < OZ_LANES; l++) {
        if (hit[l] && OZ_WORK_HOLDS(w, slots[l])) {
            oz_work_stop(w, bits, step, OZ_WORK_ID(w, slots[l]));
        }
    }
}

/* The slots of a block. */
OZ_INLINE void oz_work_slots(int block, int *slots)
{
    for (int l = 0; l < OZ_LANES; l++) {
        slots[l] = block * OZ_LANES + l;
    }
}

/* Sizes of the structs that both sides share. */
kernel void oz_layout(global int *sizes)
{
    sizes[0] = (int)sizeof(OzParameters);
    sizes[1] = (int)sizeof(OzControl);
    sizes[2] = (int)sizeof(OzSizes);
    sizes[3] = (int)sizeof(scalar);
    sizes[4] = OZ_LANES;
}
