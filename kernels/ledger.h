/* The energy ledger: after each step, the work of every contact's parts over that step, each power taken with
 * the mean of the velocities before and after it, added up in double. What the tangential springs were given
 * and do not hold any more is friction; the host subtracts. Only compiled when a scene asks for it. */
#ifndef OZ_KERNELS_LEDGER_H
#define OZ_KERNELS_LEDGER_H

#include "kernels/lists.h"
#include "kernels/motion.h"

OZ_INLINE double oz_ledger_sum(real value, const int *counts)
{
    scalar lane[OZ_LANES];
#if OZ_LANES == 1
    lane[0] = value;
#else
    OZ_PASTE(vstore, OZ_LANES)(value, 0, lane);
#endif
    double sum = 0;
    for (int l = 0; l < OZ_LANES; l++) {
        sum += counts[l] ? (double)lane[l] : 0.0;
    }
    return sum;
}

/* Mean relative velocity of a noted contact over the step. */
OZ_INLINE OzVec3 oz_ledger_mean(global const real *words, OzVec3 after)
{
    return oz_scale(oz_add(oz_work_load3(words + 6), after), REAL(0.5));
}

/* Adds what the springs and dashpots of one noted contact took in. */
OZ_INLINE void oz_ledger_add(OzWork *w, int region, global const real *words, OzVec3 after,
                             const int *counts)
{
    OzVec3 mean = oz_ledger_mean(words, after);
    double dt = w->parameters->dt;
    global double *sums = w->ledger + (size_t)region * OZ_LEDGER_WORDS;
    sums[OZ_L_SPRING] -= dt * oz_ledger_sum(oz_dot(oz_work_load3(words), mean), counts);
    sums[OZ_L_DISSIPATED] -= dt * oz_ledger_sum(oz_dot(oz_work_load3(words + 3), mean), counts);
}

/* Adds what dashpots took in that act elsewhere than at the mean of a pair's points (contact_line.h). */
OZ_INLINE void oz_ledger_add_couple(OzWork *w, int region, int block, OzVec3 after, const int *counts)
{
    global const real *words = w->pair_couple + 6 * (size_t)block;
    OzVec3 mean = oz_scale(oz_add(oz_work_load3(words + 3), after), REAL(0.5));
    double power = oz_ledger_sum(oz_dot(oz_work_load3(words), mean), counts);
    w->ledger[(size_t)region * OZ_LEDGER_WORDS + OZ_L_DISSIPATED] -= w->parameters->dt * power;
}

OZ_INLINE void oz_ledger_pairs(OzWork *w, int region)
{
    int begin = region * w->z.inner_capacity, end = begin + w->pair_count[region];
    for (int first = begin; first < end; first += OZ_LANES) {
        int a[OZ_LANES], b[OZ_LANES], counts[OZ_LANES];
        for (int l = 0; l < OZ_LANES; l++) {
            a[l] = w->pair_a[first + l];
            b[l] = w->pair_b[first + l];
            counts[l] = first + l < end;
        }
        global const real *words = w->pair_ledger + (size_t)(first / OZ_LANES) * OZ_CONTACT_LEDGER;
        OzGrain one = oz_work_grains(w, a), other = oz_work_grains(w, b);
        OzVec3 after = oz_minus(oz_grain_velocity_at(other, oz_work_load3(words + 12)),
                                oz_grain_velocity_at(one, oz_work_load3(words + 9)));
        oz_ledger_add(w, region, words, after, counts);
        if (OZ_LINE) {
            OzVec3 turning = oz_minus(other.rate, one.rate);
            oz_ledger_add_couple(w, region, first / OZ_LANES, turning, counts);
        }
    }
}

#if OZ_WALL_COUNT > 0

/* Velocity of a wall along z at the start of a step. */
OZ_INLINE scalar oz_ledger_wall_speed(const OzWork *w, int wall, int step)
{
    return OZ_MOVING ? w->motion[OZ_MOTION * ((size_t)step * OZ_WALL_COUNT + wall) + OZ_M_SPEED] : 0;
}

OZ_INLINE void oz_ledger_walls(OzWork *w, int region, int step)
{
    int begin = oz_work_region_begin(w, region) / OZ_LANES;
    int end = min((region + 1) * w->z.region_slots, w->z.slots) / OZ_LANES;
    for (int block = begin; block < end; block++) {
        int slots[OZ_LANES], counts[OZ_LANES];
        for (int l = 0; l < OZ_LANES; l++) {
            slots[l] = block * OZ_LANES + l;
            counts[l] = slots[l] < w->z.count;
        }
        OzGrain grain = oz_work_grains(w, slots);
        for (int index = 0; index < OZ_WALL_ENDS; index++) {
            global const real *words =
                w->wall_ledger + ((size_t)block * OZ_WALL_ENDS + index) * OZ_CONTACT_LEDGER;
            int wall = index / (OZ_ROUND ? 1 : 2);
            scalar old_speed = oz_ledger_wall_speed(w, wall, OZ_ENCLOSURE_STEP(step));
            scalar new_speed = oz_ledger_wall_speed(w, wall, step + 1);
            OzVec3 after = oz_grain_velocity_at(grain, oz_work_load3(words + 12));
            after.z -= REAL(new_speed);
            oz_ledger_add(w, region, words, after, counts);
            double mean = 0.5 * ((double)old_speed + (double)new_speed);
            w->ledger[(size_t)region * OZ_LEDGER_WORDS + OZ_L_WALLS] +=
                mean * w->parameters->dt * oz_ledger_sum(words[11], counts);
        }
    }
}

#endif

OZ_INLINE void oz_ledger_region(OzWork *w, int region, int step)
{
    oz_ledger_pairs(w, region);
#if OZ_WALL_COUNT > 0
    oz_ledger_walls(w, region, step);
#endif
}

#endif
