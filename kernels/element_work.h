/* The trigrains kernels' view of memory: every array of one member, and how work is shared out.
 * OpenCL C only. OZ_GROUP 1: one work-item does a member's whole launch, with any number of lanes;
 * otherwise the work-group's size, with one lane. Switches: OZ_ORDER (words of a coordinate: 5 is
 * gear4, 3 velocity-verlet), OZ_MOVING (some wall moves), OZ_DISCS and OZ_BEAMS (the scene has
 * any), OZ_SUBSTEPS, OZ_LEDGER, OZ_FORCE_POINT, OZ_DAMPING_SHEAR. The law of discs is no switch: it
 * is a number in the parameters, of its own for each wall. */
#ifndef OZ_KERNELS_ELEMENT_WORK_H
#define OZ_KERNELS_ELEMENT_WORK_H

#include "kernels/element_fields.h"
#include "kernels/element_layout.h"
#include "kernels/lanes.h"
#include "kernels/triangle.h"

typedef OzElementParameters parameters_kind;
typedef OzElementControl control_kind;
typedef scalar scalar_kind;
typedef real real_kind;
typedef int integer_kind;
#if OZ_LEDGER
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double ledger_kind;
#else
typedef int ledger_kind;
#endif

#define OZ_ELEMENT_MEMBER(kind, name, count, class)   global kind##_kind *name;
#define OZ_ELEMENT_ARGUMENT(kind, name, count, class) global kind##_kind *name,
#define OZ_ELEMENT_TAKE(kind, name, count, class)     w.name = name + (size_t)member * (size_t)(count);

typedef struct OzElementWork {
    OZ_ELEMENT_FIELDS(OZ_ELEMENT_MEMBER)
    OzElementSizes z;
    int item, stride; /* this work-item, and how many there are */
} OzElementWork;

/* The arguments that every kernel begins with, and the view of one member made of them. */
#define OZ_ELEMENT_ARGUMENTS OZ_ELEMENT_FIELDS(OZ_ELEMENT_ARGUMENT) OzElementSizes z
#define OZ_ELEMENT_OPEN(member_index)                                                              \
    OzElementWork w;                                                                               \
    {                                                                                              \
        int member = (member_index);                                                               \
        OZ_ELEMENT_FIELDS(OZ_ELEMENT_TAKE)                                                         \
        w.z = z;                                                                                   \
        w.item = OZ_ELEMENT_ITEM;                                                                  \
        w.stride = OZ_ELEMENT_STRIDE;                                                              \
    }

#if OZ_GROUP == 1
#define OZ_ELEMENT_BARRIER()
#define OZ_ELEMENT_COUNT(counter) ((*(counter))++)
#define OZ_ELEMENT_ITEM           0
#define OZ_ELEMENT_STRIDE         1
#else
#define OZ_ELEMENT_BARRIER()      barrier(CLK_GLOBAL_MEM_FENCE)
#define OZ_ELEMENT_COUNT(counter) atomic_inc(counter)
#define OZ_ELEMENT_ITEM           ((int)get_local_id(0))
#define OZ_ELEMENT_STRIDE         ((int)get_local_size(0))
#endif

#define OZ_EACH(w, index, count) for (int index = (w)->item; index < (count); index += (w)->stride)

/* Asks for an end: reason bits, step and the lowest slot of the first step that had any. */
OZ_INLINE void oz_element_work_stop(OzElementWork *w, int bits, int step, int slot)
{
    atomic_or(&w->control->stop_bits, bits);
    atomic_min(&w->control->stop_step, step);
    atomic_min(&w->control->stop_index, slot);
}

/* Whether a slot holds an element; padding holds none. */
OZ_INLINE int oz_element_work_holds(const OzElementWork *w, int slot)
{
    return slot < w->z.free_slots ? slot < w->control->free_count
                                  : slot - w->z.free_slots < w->control->wall_count;
}

/* The same for every lane of hits, whose elements are in slots; padding is left out. */
OZ_INLINE void oz_element_work_stop_lanes(OzElementWork *w, mask hits, int bits, int step,
                                          const int *slots)
{
    int hit[OZ_LANES];
    oz_lanes_store_mask(hits, hit);
    for (int l = 0; l < OZ_LANES; l++) {
        if (hit[l] && oz_element_work_holds(w, slots[l])) {
            oz_element_work_stop(w, bits, step, slots[l]);
        }
    }
}

/* The slots of a block. */
OZ_INLINE void oz_element_work_slots(int block, int *slots)
{
    for (int l = 0; l < OZ_LANES; l++) {
        slots[l] = block * OZ_LANES + l;
    }
}

/* One past the last free element of a region. */
OZ_INLINE int oz_element_work_region_end(const OzElementWork *w, int region)
{
    return min((region + 1) * w->z.region_slots, w->control->free_count);
}

/* An element as contacts see it, in each lane. */
typedef struct OzElement {
    OzTriangle triangle; /* a disc's three corners are its centre */
    OzVec2 position;
} OzElement;

OZ_INLINE OzElement oz_element_work_element(const OzElementWork *w, const int *slots)
{
    OzElement element;
    real a[4], b[4];
    oz_lanes_load4(w->record, slots, OZ_ELEMENT_RECORD, OZ_PR_CORNER, a);
    oz_lanes_load4(w->record, slots, OZ_ELEMENT_RECORD, OZ_PR_CORNER + 4, b);
    element.triangle.corner[0] = oz_vec2(a[0], a[1]);
    element.triangle.corner[1] = oz_vec2(a[2], a[3]);
    element.triangle.corner[2] = oz_vec2(b[0], b[1]);
    element.position = oz_vec2(b[2], b[3]);
    return element;
}

/* Velocity, angle and spin of the elements in slots. */
OZ_INLINE void oz_element_work_motion(const OzElementWork *w, const int *slots, OzVec2 *velocity,
                                      real *angle, real *angular_velocity)
{
    real words[4];
    oz_lanes_load4(w->record, slots, OZ_ELEMENT_RECORD, OZ_PR_VELOCITY, words);
    *velocity = oz_vec2(words[0], words[1]);
    *angle = words[2];
    *angular_velocity = words[3];
}

OZ_INLINE void oz_element_work_label(const OzElementWork *w, const int *slots, real *radius,
                                     real *inverse_mass)
{
    real words[4];
    oz_lanes_load4(w->record, slots, OZ_ELEMENT_RECORD, OZ_PR_RADIUS, words);
    *radius = words[0];
    *inverse_mass = words[1];
}

#endif
