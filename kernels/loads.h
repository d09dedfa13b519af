/* Force and torque on each grain, kept slot by slot while pairs and walls add theirs: always in the
 * same order, whatever the lists look like. OpenCL C only. */
#pragma once

#include "kernels/pairs.h"

#if OZ_GATHER

typedef struct OzSum {
    scalar4 force, torque;
} OzSum;

/* Where the force of a picked pair is kept. Given a pair that was not picked, it is the place of
 * the next pair that was. */
OZ_INLINE uint oz_loads_from(const OzWork *w, uint pair)
{
    uint before = (1u << (pair % OZ_LANES)) - 1;
    return (uint)w->pair_kept[pair / OZ_LANES] +
           popcount((uint)w->pair_active[pair / OZ_LANES] & before);
}

/* Where to read the force of a pair. Behind the kept forces of all pairs stands a zero (arrays are
 * made zeroed), which serves pairs that were not picked: a processor cannot foresee which are
 * picked, and a branch that it guesses wrong costs more than adding zero. */
OZ_INLINE uint oz_loads_at(const OzWork *w, uint pair)
{
    uint none = (uint)(w->z.regions * w->z.inner_capacity);
    int active = (w->pair_active[pair / OZ_LANES] >> (pair % OZ_LANES)) & 1;
    return active ? oz_loads_from(w, pair) : none;
}

/* Pairs first ... last of a grain's list of those in which it is the second. */
OZ_INLINE void oz_loads_sum_backs(OzSum *sum, const OzWork *w, int slot, int first, int last)
{
    global const int *back = w->back + (size_t)slot * w->z.back_capacity;
    for (int k = first; k < last; k++) {
        size_t at = oz_loads_at(w, (uint)back[k]);
        global const scalar4 *pair = (global const scalar4 *)(w->pair_force + at * OZ_PAIR_FORCE);
        sum->force += pair[OZ_F_FORCE / 4];
        sum->torque += pair[OZ_F_TORQUE / 4];
    }
}

/* Pairs in which a grain is the first: those picked follow each other. */
OZ_INLINE void oz_loads_sum_own(OzSum *sum, const OzWork *w, int slot)
{
    int first = w->pair_first[slot], last = first + w->pair_number[slot] - 1;
    if (last < first) {
        return;
    }
    uint end = oz_loads_from(w, (uint)last) +
               (((uint)w->pair_active[last / OZ_LANES] >> (last % OZ_LANES)) & 1);
    for (uint at = oz_loads_from(w, (uint)first); at < end; at++) {
        global const scalar *pair = w->pair_force + (size_t)at * OZ_PAIR_FORCE;
        sum->force -= *(global const scalar4 *)(pair + OZ_F_FORCE);
        sum->torque += *(global const scalar4 *)(w->pair_torque + (size_t)at * OZ_PAIR_TORQUE);
    }
}

/* The pairs' force and torque on a grain, in the order of each pair's first grain's id, then the
 * second's. */
OZ_INLINE void oz_loads_gather(OzWork *w, int slot)
{
    OzSum sum = {(scalar4)(0), (scalar4)(0)};
    int backs = w->back_number[slot], before = OZ_EQUAL ? backs : w->back_before[slot];
    oz_loads_sum_backs(&sum, w, slot, 0, before);
    oz_loads_sum_own(&sum, w, slot);
    oz_loads_sum_backs(&sum, w, slot, before, backs);
    global scalar4 *to = (global scalar4 *)(w->load + (size_t)slot * OZ_LOAD);
    to[0] = sum.force;
    to[1] = sum.torque;
}

OZ_INLINE void oz_loads_gather_region(OzWork *w, int region)
{
    for (int i = oz_work_region_begin(w, region); i < oz_work_region_end(w, region); i++) {
        oz_loads_gather(w, i);
    }
}

#endif

/* Adds to the loads of the grains in slots. */
OZ_INLINE void oz_loads_add(OzWork *w, const int *slots, OzVec3 force, OzVec3 torque)
{
    scalar4 forces[OZ_LANES], torques[OZ_LANES];
    oz_lanes_rows3(force, forces);
    oz_lanes_rows3(torque, torques);
#pragma unroll
    for (int l = 0; l < OZ_LANES; l++) {
        global scalar4 *load = (global scalar4 *)(w->load + (size_t)slots[l] * OZ_LOAD);
        load[0] += forces[l];
        load[1] += torques[l];
    }
}

/* The loads of a block of grains. */
OZ_INLINE OzLoad oz_loads_of(const OzWork *w, int block)
{
    int slots[OZ_LANES];
    real force[4], torque[4];
    for (int l = 0; l < OZ_LANES; l++) {
        slots[l] = block * OZ_LANES + l;
    }
    oz_lanes_load4(w->load, slots, OZ_LOAD, 0, force);
    oz_lanes_load4(w->load, slots, OZ_LOAD, 4, torque);
    OzLoad load = {oz_vec3(force[0], force[1], force[2]), oz_vec3(torque[0], torque[1], torque[2])};
    return load;
}

#if OZ_PUSHED
/* Adds what pushes and turns a block of grains from outside. */
OZ_INLINE void oz_loads_push(const OzWork *w, int block, OzLoad *load)
{
    int ids[OZ_LANES];
    real force[4], torque[4];
    for (int l = 0; l < OZ_LANES; l++) {
        ids[l] = w->id[block * OZ_LANES + l];
    }
    oz_lanes_load4(w->push, ids, OZ_LOAD, 0, force);
    oz_lanes_load4(w->push, ids, OZ_LOAD, 4, torque);
    load->force = oz_add(load->force, oz_vec3(force[0], force[1], force[2]));
    load->torque = oz_add(load->torque, oz_vec3(torque[0], torque[1], torque[2]));
}
#endif
