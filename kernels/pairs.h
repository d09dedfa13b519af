/* Forces between grains: one pair a lane, each pair once. OpenCL C only. */
#ifndef OZ_KERNELS_PAIRS_H
#define OZ_KERNELS_PAIRS_H

#include "kernels/work.h"

#if OZ_LEDGER
/* What the ledger needs of this contact after the step. */
OZ_INLINE void oz_pairs_note(global real *words, OzContact contact, OzContactForce parts,
                             OzVec3 third, OzVec3 arm)
{
    oz_work_store3(words, parts.spring);
    oz_work_store3(words + 3, parts.dashpot);
    oz_work_store3(words + 6, contact.velocity);
    oz_work_store3(words + 9, third);
    oz_work_store3(words + 12, arm);
}
#endif

/* Pairs first ... first + lanes of the inner list; first is a whole block. */
OZ_INLINE void oz_pairs_block(OzWork *w, int first, OzLawConstants law, int step)
{
    int a[OZ_LANES], b[OZ_LANES];
#pragma unroll
    for (int l = 0; l < OZ_LANES; l++) {
        a[l] = w->pair_a[first + l];
        b[l] = w->pair_b[first + l];
    }
    OzGrain one = oz_work_grains(w, a), other = oz_work_grains(w, b);
    OzVec3 history = oz_vec3(REAL(0.0), REAL(0.0), REAL(0.0));
    size_t block = (size_t)(first / OZ_LANES);
    if (OZ_HISTORY) {
        history = oz_work_load3(w->pair_history + 3 * block);
    }
    scalar unit = w->parameters->length_unit, dt = w->parameters->dt;
    OzPairForce pair = oz_rods_pair(one, other, unit, law, &history, dt, OZ_HISTORY_SHARE);
    if (OZ_HISTORY) {
        oz_work_store3(w->pair_history + 3 * block, history);
    }
    real force[4] = {pair.force.x, pair.force.y, pair.force.z, pair.overlap};
    real on_a[4] = {pair.torque_a.x, pair.torque_a.y, pair.torque_a.z, REAL(0.0)};
    real on_b[4] = {pair.torque_b.x, pair.torque_b.y, pair.torque_b.z, REAL(0.0)};
    global scalar *out = w->pair_force + (size_t)first * OZ_PAIR_FORCE;
    oz_lanes_store4(out, OZ_PAIR_FORCE, OZ_F_FORCE, force);
    oz_lanes_store4(out, OZ_PAIR_FORCE, OZ_F_TORQUE_A, on_a);
    oz_lanes_store4(out, OZ_PAIR_FORCE, OZ_F_TORQUE_B, on_b);
    if (OZ_ANY(pair.deep)) {
        oz_work_stop_lanes(w, pair.deep, OZ_STOP_DEEP, step, a);
    }
    if (OZ_ANY(pair.crossed)) {
        atomic_inc(&w->control->crossed);
    }
#if OZ_LEDGER
    oz_pairs_note(w->pair_ledger + block * OZ_CONTACT_LEDGER, pair.contact, pair.parts, pair.arm_a,
                  pair.arm_b);
    if (OZ_LINE) {
        oz_work_store3(w->pair_couple + 6 * block, pair.couple);
        oz_work_store3(w->pair_couple + 6 * block + 3, pair.turning);
    }
#endif
}

OZ_INLINE void oz_pairs_region(OzWork *w, int region, int step)
{
    OzLawConstants law = w->parameters->law;
    int begin = region * w->z.inner_capacity, end = begin + w->pair_count[region];
    for (int first = begin; first < end; first += OZ_LANES) {
        oz_pairs_block(w, first, law, step);
    }
}

#endif
