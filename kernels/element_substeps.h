/* A step of velocity-verlet in parts: half a kick by contacts, then beams and gravity in
 * OZ_SUBSTEPS parts, then the other half of the kick (Tuckerman, Berne and Martyna 1992). The state
 * holds x, v dt and the acceleration of beams and gravity times dt^2 / 2; what contacts do is kept
 * in slow_load from one step to the next. OpenCL C only. */
#pragma once

#include "kernels/element_beams.h"
#include "kernels/element_loads.h"
#include "kernels/element_move.h"

#define OZ_PART ((scalar)1 / OZ_SUBSTEPS)

/* Accelerations of a block by loads, times dt^2 / 2. */
typedef struct OzElementKick {
    real x, y, turn;
} OzElementKick;

OZ_INLINE OzElementKick oz_element_substeps_kick(const OzWork *w, global const scalar *loads,
                                                 int block)
{
    global const real *shape = w->shape + (size_t)block * OZ_ELEMENT_SHAPE;
    scalar dt = w->parameters->dt;
    real half_step2 = REAL((scalar)0.5 * dt * dt), load[4];
    int slots[OZ_LANES];
    oz_work_slots(block, slots);
    oz_lanes_load4(loads, slots, OZ_ELEMENT_LOAD, 0, load);
    OzElementKick kick = {load[0] * shape[OZ_PS_INVERSE_MASS] * half_step2,
                          load[1] * shape[OZ_PS_INVERSE_MASS] * half_step2,
                          load[2] * shape[OZ_PS_INVERSE_INERTIA] * half_step2};
    return kick;
}

OZ_INLINE void oz_element_substeps_clear(global scalar *loads, int block)
{
    for (int k = 0; k < OZ_ELEMENT_LOAD; k++) {
        ((global real *)loads)[(size_t)block * OZ_ELEMENT_LOAD + k] = REAL(0.0);
    }
}

OZ_INLINE void oz_element_substeps_push(real *q, OzElementKick kick)
{
    q[1] += kick.x;
    q[OZ_ORDER + 1] += kick.y;
    q[2 * OZ_ORDER + 1] += kick.turn;
}

/* A block to the end of a part, with the velocities that its acceleration predicts in its records.
 */
OZ_INLINE void oz_element_substeps_drift(OzWork *w, int block, real *q, real inverse_dt)
{
    real ahead[OZ_ELEMENT_STATE];
    for (int c = 0; c < 3; c++) {
        real *own = q + c * OZ_ORDER, *next = ahead + c * OZ_ORDER;
        own[0] += own[1] * REAL(OZ_PART) + own[2] * REAL(OZ_PART * OZ_PART);
        next[0] = own[0];
        next[1] = own[1] + own[2] * REAL(2 * OZ_PART);
    }
    oz_element_move_record(w, block, oz_element_move_body(w, block, ahead, inverse_dt));
}

/* Takes what beams and gravity do now as the acceleration; velocities to the end of a part by the
 * mean of those at its ends, or (share 0) left alone. */
OZ_INLINE void oz_element_substeps_turn(OzWork *w, int block, real *q, scalar share)
{
    global const OzParameters *p = w->parameters;
    OzElementKick kick = oz_element_substeps_kick(w, w->load, block);
    real lightness = w->shape[(size_t)block * OZ_ELEMENT_SHAPE + OZ_PS_INVERSE_MASS];
    real weight = lightness > REAL(0.0) ? REAL((scalar)0.5 * p->dt * p->dt) : REAL(0.0);
    real drag = REAL((scalar)0.5 * p->dt * p->drag);
    real now[3] = {kick.x + weight * REAL(p->gravity[0]), kick.y + weight * REAL(p->gravity[1]),
                   kick.turn};
    for (int c = 0; c < 3; c++) {
        real *own = q + c * OZ_ORDER;
        real predicted = own[1] + own[2] * REAL(2 * share);
        real next = now[c] - drag * predicted;
        own[1] += (own[2] + next) * REAL(share);
        own[2] = next;
    }
    oz_element_substeps_clear(w->load, block);
}

/* What contacts shall see: the velocities that their old forces predict. */
OZ_INLINE void oz_element_substeps_show(OzWork *w, int block, const real *q, real inverse_dt,
                                        int step)
{
    real ahead[OZ_ELEMENT_STATE];
    for (int k = 0; k < OZ_ELEMENT_STATE; k++) {
        ahead[k] = q[k];
    }
    oz_element_substeps_push(ahead, oz_element_substeps_kick(w, w->slow_load, block));
    oz_element_substeps_clear(w->slow_load, block);
    OzPose body = oz_element_move_body(w, block, ahead, inverse_dt);
    oz_element_move_check_stride(w, block, oz_vec2(q[1], q[OZ_ORDER + 1]), q[2 * OZ_ORDER + 1],
                                 step);
    oz_element_move_record(w, block, body);
    oz_element_move_watch(w, block, body, step);
}

/* Forces of beams, added up; their losses count for a share of the step. */
OZ_INLINE void oz_element_substeps_hold(OzWork *w, int step, scalar share)
{
    OzElementSums sums;
    oz_element_sums_clear(&sums);
    OZ_WORK_BARRIER();
    oz_element_beams_pull(w, step, share, &sums);
#if OZ_LEDGER
    oz_element_sums_add_part(w, &sums, share);
#endif
    OZ_WORK_BARRIER();
    oz_element_loads_beams(w, w->load);
    OZ_WORK_BARRIER();
}

/* What becomes of a block at a stage: 0 the contacts' kick, seen by beams at once; then the parts'
 * drifts, each after the turn that ends the part before; last what contacts see. */
OZ_INLINE void oz_element_substeps_stage(OzWork *w, int block, int stage, int step)
{
    real inverse_dt = REAL(1.0) / REAL(w->parameters->dt);
    real q[OZ_ELEMENT_STATE];
    oz_element_move_load(w, block, q);
    if (stage == 0) {
        oz_element_substeps_push(q, oz_element_substeps_kick(w, w->slow_load, block));
        oz_element_move_record(w, block, oz_element_move_body(w, block, q, inverse_dt));
    } else {
        oz_element_substeps_turn(w, block, q, stage == 1 ? 0 : OZ_PART);
    }
    if (stage > 0 && stage <= OZ_SUBSTEPS) {
        oz_element_substeps_drift(w, block, q, inverse_dt);
    } else if (stage > OZ_SUBSTEPS) {
        oz_element_substeps_show(w, block, q, inverse_dt, step);
    }
    oz_element_move_store(w, block, q);
}

/* All of a step but contacts at its end. */
OZ_INLINE void oz_element_substeps_run(OzWork *w, int step)
{
    for (int stage = 0; stage <= OZ_SUBSTEPS + 1; stage++) {
        OZ_EACH(w, block, w->z.free_blocks)
        {
            oz_element_substeps_stage(w, block, stage, step);
        }
        if (stage <= OZ_SUBSTEPS) {
            oz_element_substeps_hold(w, step, stage == 0 ? 0 : OZ_PART);
        }
    }
}

/* The second half of the contacts' kick. */
OZ_INLINE void oz_element_substeps_end(OzWork *w, int step)
{
    OZ_EACH(w, block, w->z.free_blocks)
    {
        real q[OZ_ELEMENT_STATE];
        oz_element_move_load(w, block, q);
        oz_element_substeps_push(q, oz_element_substeps_kick(w, w->slow_load, block));
        oz_element_move_check(w, block, q, step);
        oz_element_move_store(w, block, q);
    }
}
