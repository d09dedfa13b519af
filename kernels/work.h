/* Grains in the kernels' memory. OpenCL C only. */
#pragma once

#define OZ_TILES OZ_RESORT

#include "kernels/space.h"

#include "kernels/fields.h"
#include "kernels/integrate.h"
#include "kernels/layout.h"
#include "kernels/rods.h"
#if OZ_SHEAR
#include "kernels/shear.h"
#endif

#define OZ_WORK_BODIES(w)      ((w)->z.count)
#define OZ_WORK_SLOTS(w)       ((w)->z.slots)
#define OZ_WORK_HOLDS(w, slot) ((slot) < (w)->z.count)
#define OZ_WORK_ID(w, slot)    ((w)->id[slot])

#include "kernels/member.h"

#include "kernels/material.h"

OZ_INLINE OzSpace oz_work_space(const OzWork *w)
{
    OzSpace space;
    space.unit = w->parameters->length_unit;
    for (int k = 0; k < 3; k++) {
        space.period[k] = w->parameters->period[k];
        space.period_rest[k] = w->parameters->period_rest[k];
        space.inverse_period[k] = w->parameters->inverse_period[k];
    }
#if OZ_SHEAR
    global const scalar *words = w->shear + OZ_SHEAR_WORDS * w->places;
    space.tilt = words[OZ_H_TILT];
    space.tilt_rest = words[OZ_H_TILT_REST];
    space.rate = words[OZ_H_RATE];
#endif
    return space;
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
OZ_INLINE OzQuaternion oz_work_load_turn(const OzWork *w, const int *slots, int word)
{
    real words[4];
    oz_lanes_load4(w->fine, slots, OZ_FINE_RECORD, word, words);
    OzQuaternion turn = {words[0], words[1], words[2], words[3]};
    return turn;
}

/* All digits of where grains are. */
OZ_INLINE OzFineGrain oz_work_fine(const OzWork *w, const int *slots)
{
    OzFineGrain fine;
    real counts = REAL(w->parameters->inverse_unit), rest[4];
    oz_lanes_load4(w->fine, slots, OZ_FINE_RECORD, OZ_N_REST, rest);
    fine.space = oz_work_space(w);
    fine.position = oz_work_geometry(w, slots).position;
    fine.rest = oz_vec3(rest[0], rest[1], rest[2]);
    fine.radius = OZ_EQUAL ? REAL(w->parameters->radius_count)
                           : oz_lanes_fetch(w->shape, slots, OZ_SHAPE, OZ_B_COUNT);
    fine.half_shaft = REAL(0.0);
    if (!OZ_ROUND) {
        fine.half_shaft =
            counts * (OZ_EQUAL ? REAL(w->parameters->half_length)
                               : oz_lanes_fetch(w->shape, slots, OZ_SHAPE, OZ_B_HALF_LENGTH));
        fine.axis = oz_fine_axis(oz_work_load_turn(w, slots, OZ_N_TURN),
                                 oz_work_load_turn(w, slots, OZ_N_TURN_REST));
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

#if !OZ_GATHER
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
