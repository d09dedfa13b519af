/* The energy ledger: after each step, the work of every contact's parts over that step, each power
 * taken with the mean of the velocities before and after it, added up in double. What the
 * tangential springs were given and do not hold any more is friction; the host subtracts. Only
 * compiled when a scene asks for it. */
#pragma once

#include "kernels/lists.h"
#include "kernels/motion.h"

/* Adds values times `scale` to the sums of the grains in slots, for lanes whose bit is set, one
 * after the other: a grain's sums are made in the order of its partners' ids, whatever its lists
 * and its slot. */
OZ_INLINE void oz_ledger_give(OzWork *w, const int *slots, int bits, int word, real values,
                              double scale)
{
    scalar lane[OZ_LANES];
    OZ_LANES_STORE(values, lane);
    for (int l = 0; l < OZ_LANES; l++) {
        if ((bits >> l) & 1) {
            w->ledger[(size_t)w->id[slots[l]] * OZ_LEDGER_WORDS + word] += scale * (double)lane[l];
        }
    }
}

/* Mean relative velocity of a noted contact over the step. */
OZ_INLINE OzVec3 oz_ledger_mean(global const real *words, OzVec3 after)
{
    return oz_scale(oz_add(oz_work_load3(words + 6), after), REAL(0.5));
}

/* Adds what the springs and dashpots of one noted contact took in. */
OZ_INLINE void oz_ledger_add(OzWork *w, const int *slots, int bits, global const real *words,
                             OzVec3 after)
{
    OzVec3 mean = oz_ledger_mean(words, after);
    double dt = w->parameters->dt;
    oz_ledger_give(w, slots, bits, OZ_L_SPRING, oz_dot(oz_work_load3(words), mean), -dt);
    oz_ledger_give(w, slots, bits, OZ_L_DISSIPATED, oz_dot(oz_work_load3(words + 3), mean), -dt);
}

/* Adds what dashpots took in that act elsewhere than at the mean of a pair's points
 * (contact_line.h), and what resists rotation. */
OZ_INLINE void oz_ledger_add_couple(OzWork *w, const int *slots, int bits, global const real *words,
                                    OzVec3 after)
{
    OzVec3 mean = oz_scale(oz_add(oz_work_load3(words + 3), after), REAL(0.5));
    double dt = w->parameters->dt;
    oz_ledger_give(w, slots, bits, OZ_L_DISSIPATED, oz_dot(oz_work_load3(words), mean), -dt);
    if (OZ_ROLLING) {
        oz_ledger_give(w, slots, bits, OZ_L_SPRING, oz_dot(oz_work_load3(words + 6), mean), -dt);
    }
}

OZ_INLINE void oz_ledger_pairs(OzWork *w, int region)
{
    int begin = region * w->z.inner_capacity, end = begin + w->pair_count[region];
    oz_work_tile(w, region);
    for (int first = begin; first < end; first += OZ_LANES) {
        int a[OZ_LANES], b[OZ_LANES], bits = w->pair_active[first / OZ_LANES];
        for (int l = 0; l < OZ_LANES; l++) {
            a[l] = w->pair_a[first + l];
            b[l] = w->pair_b[first + l];
            bits &= oz_work_is_own(w, a[l]) ? -1 : ~(1 << l); /* the first one's tile gives it */
        }
        if (bits == 0) {
            continue; /* the others do not touch */
        }
        global const real *words = w->pair_ledger + (size_t)(first / OZ_LANES) * OZ_CONTACT_LEDGER;
        OzGrain one = oz_work_grains(w, a), other = oz_work_grains(w, b);
#if OZ_SHEAR
        OzSpace space = oz_work_space(w);
        OzVec3 apart = oz_space_minus(one.position, other.position, space);
        other.velocity = oz_rods_beside(other.velocity, apart, space);
        oz_ledger_give(w, a, bits, OZ_L_WORK_WALLS, words[OZ_CONTACT_LEDGER - 1],
                       w->parameters->dt);
#endif
        OzVec3 after = oz_minus(oz_grain_velocity_at(other, oz_work_load3(words + 12)),
                                oz_grain_velocity_at(one, oz_work_load3(words + 9)));
        oz_ledger_add(w, a, bits, words, after);
        if (OZ_LINE || OZ_ROLLING) {
            OzVec3 turning = oz_minus(other.rate, one.rate);
            size_t at = (size_t)(first / OZ_LANES) * OZ_COUPLE_LEDGER;
            oz_ledger_add_couple(w, a, bits, w->pair_couple + at, turning);
        }
    }
}

#if OZ_WALL_COUNT > 0

/* Velocity of a wall along z at the start of a step. */
OZ_INLINE scalar oz_ledger_wall_speed(const OzWork *w, int wall, int step)
{
    return OZ_MOVING ? w->motion[OZ_MOTION * ((size_t)step * OZ_WALL_COUNT + wall) + OZ_M_SPEED]
                     : 0;
}

/* Of a wall where it touches grains, as the forces of a step see it, or (step + 1 less
 * OZ_MOVES_BEFORE) as it is at the step's end. */
OZ_INLINE OzVec3 oz_ledger_wall_velocity(const OzWork *w, OzGrain grain, OzVec3 arm, int index,
                                         int step)
{
    OzSide side = oz_enclosure_side_of(w, index, step);
    return oz_enclosure_side_velocity(w, grain.position, arm, &side);
}

#if OZ_ROLLING
/* What resists rotation at a wall, and the work of one that turns. */
OZ_INLINE void oz_ledger_wall_couple(OzWork *w, const int *slots, int bits, OzVec3 rate, int index,
                                     int step)
{
    global const real *words =
        w->wall_couple + ((size_t)(slots[0] / OZ_LANES) * OZ_WALL_ENDS + index) * OZ_COUPLE_LEDGER;
    OzSide old_side = oz_enclosure_side_of(w, index, step);
    OzSide new_side = oz_enclosure_side_of(w, index, step + 1 - OZ_MOVES_BEFORE);
    OzVec3 turning = oz_enclosure_side_turning(w, &new_side);
    oz_ledger_add_couple(w, slots, bits, words, oz_minus(rate, turning));
    OzVec3 couple = oz_add(oz_work_load3(words), oz_work_load3(words + 6));
    real power = oz_dot(couple, oz_add(turning, oz_enclosure_side_turning(w, &old_side)));
    oz_ledger_give(w, slots, bits, OZ_L_WORK_WALLS, power, 0.5 * w->parameters->dt);
}
#endif

#if OZ_GATED
/* A wall that comes into a grain puts in what the contact stores, and one that goes takes away what
 * is left of it where its forces end: after this step, or where grains move first in the middle of
 * the next. */
OZ_INLINE void oz_ledger_gate(OzWork *w, const int *slots, int bits, int index, OzVec3 after,
                              global const real *words, int step)
{
    int gate = oz_enclosure_side_of(w, index, step).gate;
    real energy = words[OZ_CONTACT_LEDGER - 1];
    OzVec3 force = oz_minus(oz_work_load3(words + 9), oz_work_load3(words + 3));
    force = oz_minus(force, oz_work_load3(words));
    real given = oz_dot(force, oz_ledger_mean(words, after)) *
                 REAL(w->parameters->dt * (OZ_MOVES_BEFORE ? 0.5 : 1.0));
    if (gate & OZ_GATE_COMES) {
        oz_ledger_give(w, slots, bits, OZ_L_WORK_WALLS, energy, 1.0);
    }
    if (gate & OZ_GATE_GOES) {
        oz_ledger_give(w, slots, bits, OZ_L_WORK_WALLS, given - energy, 1.0);
    }
}
#endif

OZ_INLINE void oz_ledger_walls(OzWork *w, int region, int step)
{
    int begin = oz_work_region_begin(w, region) / OZ_LANES;
    int end = min((region + 1) * w->z.region_slots, w->z.slots) / OZ_LANES;
    for (int block = begin; block < end; block++) {
        int slots[OZ_LANES], here = min(OZ_LANES, w->z.count - block * OZ_LANES);
        for (int l = 0; l < OZ_LANES; l++) {
            slots[l] = block * OZ_LANES + l;
        }
        OzGrain grain = oz_work_grains(w, slots);
        for (int index = 0; index < OZ_WALL_ENDS; index++) {
            int bits =
                w->wall_active[(size_t)block * OZ_WALL_ENDS + index] & (int)((1u << here) - 1);
            global const real *words =
                w->wall_ledger + ((size_t)block * OZ_WALL_ENDS + index) * OZ_CONTACT_LEDGER;
            int wall = oz_wall_shaft_wall(index, oz_enclosure_side_numbers());
            scalar old_speed = oz_ledger_wall_speed(w, wall, OZ_ENCLOSURE_STEP(step));
            scalar new_speed = oz_ledger_wall_speed(w, wall, step + 1);
            OzVec3 arm = oz_work_load3(words + 12), after = oz_grain_velocity_at(grain, arm);
#if OZ_FREE_MOTION
            OzVec3 old_one = oz_ledger_wall_velocity(w, grain, arm, index, step);
            OzVec3 new_one =
                oz_ledger_wall_velocity(w, grain, arm, index, step + 1 - OZ_MOVES_BEFORE);
            after = oz_minus(after, new_one);
            real power = oz_dot(oz_work_load3(words + 9), oz_add(old_one, new_one));
#if OZ_SERVOS > 0
            /* a piston's work on grains stays within what the ledger is of */
            power = oz_enclosure_servo(w, wall) < 0 ? power : REAL(0.0);
#endif
            oz_ledger_give(w, slots, bits, OZ_L_WORK_WALLS, power, 0.5 * w->parameters->dt);
#else
            after.z -= REAL(new_speed);
            double mean = 0.5 * ((double)old_speed + (double)new_speed);
            oz_ledger_give(w, slots, bits, OZ_L_WORK_WALLS, words[11], mean * w->parameters->dt);
#endif
            oz_ledger_add(w, slots, bits, words, after);
#if OZ_ROLLING
            oz_ledger_wall_couple(w, slots, bits, grain.rate, index, step);
#endif
#if OZ_GATED
            oz_ledger_gate(w, slots, bits, index, after, words, step);
#endif
        }
    }
}

#endif

OZ_INLINE void oz_ledger_region(OzWork *w, int region, int step)
{
    OZ_WORK_PLACES(w, step + 1);
    oz_ledger_pairs(w, region);
#if OZ_WALL_COUNT > 0
    oz_ledger_walls(w, region, step);
#endif
}
