/* Impulses: what each grain has pushed and turned each wall with so far, force times time, added up
 * in double step by step. Means of forces on walls are differences of these sums. A grain has its
 * own, by id, so that they are the same whatever its slot and its lists. Only compiled when a scene
 * asks for such means. OpenCL C only. */
#pragma once

#include "kernels/enclosure_side.h"

#if OZ_IMPULSES && OZ_WALL_COUNT > 0

/* Adds what a step's forces do to the first `count` grains in slots, padding left out. The torque
 * is about the side's point, where that is now; of a wall that swings, about the wall's. */
OZ_INLINE void oz_wall_impulse_add(OzWork *w, const OzSide *side, OzGrain grain, const int *slots,
                                   int count, OzWallForce found)
{
    OzVec3 force = found.parts.force;
    OzVec3 place = oz_enclosure_side_from(w, grain.position, found.arm, side);
#if OZ_SWUNG
    const scalar *home = side->swing.home;
    place = oz_minus(place, oz_vec3(REAL(home[0]), REAL(home[1]), REAL(home[2])));
#endif
    OzVec3 torque = oz_add(oz_cross(place, force), oz_rods_wall_couple(found));
    scalar lane[OZ_IMPULSE_WORDS][OZ_LANES];
    OZ_LANES_STORE(force.x, lane[0]);
    OZ_LANES_STORE(force.y, lane[1]);
    OZ_LANES_STORE(force.z, lane[2]);
    OZ_LANES_STORE(torque.x, lane[3]);
    OZ_LANES_STORE(torque.y, lane[4]);
    OZ_LANES_STORE(torque.z, lane[5]);
    for (int l = 0; l < OZ_LANES && l < count; l++) {
        if (slots[l] >= w->z.count) {
            continue; /* padding, which a side may pass */
        }
        size_t row = (size_t)w->id[slots[l]] * OZ_WALL_COUNT + side->wall;
        global double *sum = w->wall_impulse + row * OZ_IMPULSE_WORDS;
        for (int k = 0; k < OZ_IMPULSE_WORDS; k++) {
            sum[k] -= (double)w->parameters->dt * (double)lane[k][l];
        }
    }
}

#endif
