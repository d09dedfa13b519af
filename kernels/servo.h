/* Servo walls in the kernels' memory (servo_move.h says how one moves). What a grain pushes each
 * with in a step is kept by its id; runs of ids are added up side by side, then these by one
 * work-item, all in the order of ids: the sum has the same bits whatever slots, tiles and threads
 * are. Only compiled when a scene has such walls. OpenCL C only. */
#pragma once

#include "kernels/enclosure_side.h"

#if OZ_SERVOS > 0

#include "kernels/servo_move.h"

/* A region's grains push nothing yet. */
OZ_INLINE void oz_servo_clear(OzWork *w, int region)
{
    for (int i = oz_work_region_begin(w, region); i < oz_work_region_end(w, region); i++) {
        for (int s = 0; s < OZ_SERVOS; s++) {
            w->servo_push[(size_t)w->id[i] * OZ_SERVOS + s] = 0;
        }
    }
}

/* Adds what the first `count` grains in slots, padding left out, push a side with. */
OZ_INLINE void oz_servo_add(OzWork *w, const OzSide *side, const int *slots, int count,
                            OzVec3 force)
{
    scalar lane[OZ_LANES];
    if (side->servo < 0) {
        return;
    }
    OZ_LANES_STORE(oz_dot(force, oz_enclosure_side_drive(w, side).direction), lane);
    for (int l = 0; l < OZ_LANES && l < count; l++) {
        if (slots[l] < w->z.count) {
            w->servo_push[(size_t)w->id[slots[l]] * OZ_SERVOS + side->servo] -= (double)lane[l];
        }
    }
}

OZ_INLINE int oz_servo_runs(const OzWork *w)
{
    return (w->z.count + OZ_SERVO_RUN - 1) / OZ_SERVO_RUN;
}

/* The sums of runs. */
OZ_INLINE void oz_servo_sum(OzWork *w)
{
    OZ_EACH(w, run, oz_servo_runs(w))
    {
        int end = min((run + 1) * OZ_SERVO_RUN, w->z.count);
        for (int s = 0; s < OZ_SERVOS; s++) {
            double sum = 0;
            for (int id = run * OZ_SERVO_RUN; id < end; id++) {
                sum += w->servo_push[(size_t)id * OZ_SERVOS + s];
            }
            w->servo_run[(size_t)run * OZ_SERVOS + s] = sum;
        }
    }
}

OZ_INLINE OzServoState oz_servo_load(const OzWork *w, int s)
{
    global const double *words = w->servo + s * OZ_SERVO;
    OzServoState state = {words[OZ_SERVO_PLACE], words[OZ_SERVO_SPEED],
                          words[OZ_SERVO_ACCELERATION], words[OZ_SERVO_SEEN], words[OZ_SERVO_PUSH]};
    return state;
}

OZ_INLINE void oz_servo_store(OzWork *w, int s, OzServoState state)
{
    global double *words = w->servo + s * OZ_SERVO;
    words[OZ_SERVO_PLACE] = state.place;
    words[OZ_SERVO_SPEED] = state.speed;
    words[OZ_SERVO_ACCELERATION] = state.acceleration;
    words[OZ_SERVO_SEEN] = state.seen;
    words[OZ_SERVO_PUSH] = state.push;
}

/* Whether it stands at a step whatever drives it. */
OZ_INLINE int oz_servo_is_held(const OzWork *w, int s, int step)
{
    int held = w->servo_held[0];
#if OZ_GATED
    size_t at = (size_t)OZ_ENCLOSURE_STEP(step) * OZ_WALL_COUNT;
    at += (int)w->parameters->servo[s].wall;
    held |= (int)w->motion[OZ_MOTION * at + OZ_M_GATE] & OZ_GATE_GONE;
#endif
    return held;
}

#if OZ_MOVES_BEFORE
/* The part of a step before the forces. */
OZ_INLINE void oz_servo_move_before(OzWork *w, int step)
{
    for (int s = 0; s < OZ_SERVOS; s++) {
        if (!oz_servo_is_held(w, s, step)) {
            OzServoState state = oz_servo_load(w, s);
            oz_servo_before(&state, (double)w->parameters->dt);
            oz_servo_store(w, s, state);
        }
    }
}
#endif

/* What the piston itself brings into the ledger stands in the first grain's row: only sums over all
 * rows are read. */
OZ_INLINE void oz_servo_note(OzWork *w, OzServoWork work)
{
#if OZ_LEDGER
    w->ledger[OZ_L_WORK_WALLS] += work.given;
    w->ledger[OZ_L_DISSIPATED] += work.lost;
#endif
}

/* The part after the forces, all of it one work-item's. */
OZ_INLINE void oz_servo_move(OzWork *w, int step)
{
    double places[OZ_SERVOS];
    for (int s = 0; s < OZ_SERVOS; s++) {
        places[s] = w->servo[s * OZ_SERVO + OZ_SERVO_PLACE];
    }
    for (int s = 0; s < OZ_SERVOS; s++) {
        OzServoState state = oz_servo_load(w, s);
        OzServoConstants servo = w->parameters->servo[s];
        double drive = oz_servo_drive(servo, places);
        state.push = 0;
        for (int run = 0; run < oz_servo_runs(w); run++) {
            state.push += w->servo_run[(size_t)run * OZ_SERVOS + s];
        }
        if (oz_servo_is_held(w, s, step)) {
            oz_servo_stand(&state, servo, drive);
        } else {
            oz_servo_note(w, oz_servo_after(&state, servo, drive, (double)w->parameters->dt));
        }
        oz_servo_store(w, s, state);
        /* half, for the wall's own point is added to it */
        if (!(fabs(state.place) * w->parameters->inverse_unit < 0.5 * w->parameters->domain)) {
            oz_work_stop(w, OZ_STOP_SERVO, step, OZ_NEVER);
        }
    }
}

#endif
