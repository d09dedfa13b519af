/* Bringing the members of a simulation to rest before time 0, whatever their model: the settling
 * of sim/settle.h. */
#pragma once

#include "model/snapshot.h"
#include "sim/batch.h"

#include <stdbool.h>

/* Told between launches how far settling has come; what is not OZ_OK ends it. */
typedef OzStatus (*OzSettleWatch)(void *context, double time, double energy_ratio);

/* Shown a member that has come to a whole number of intervals since it began to settle, the first
 * of them 0; what is not OZ_OK ends settling. */
typedef OzStatus (*OzSettleShow)(void *context, int member);

/* What settling asks of a model's simulation; each function is called with it. */
typedef struct OzRelax {
    void *sim;       /* borrowed                                                */
    OzBatch *batch;  /* the simulation's own                                    */
    bool is_empty;   /* there is nothing that could settle                      */
    int judge_steps; /* between looks at the energy: often enough to stop in
                      * time, rarely enough to cost nothing                     */
    /* One launch towards the step. */
    OzStatus (*launch)(void *sim, int64_t step);
    /* All members' drag from now on, 1/s. */
    OzStatus (*set_drag)(void *sim, double drag);
    /* A member's state now, for which room was made, and its kinetic energy, of motion and of
     * rotation, J. */
    OzStatus (*take_energy)(void *sim, int member, OzSnapshot *now, double *energy);
    /* Nothing counted nor added up yet, in what the batch does not know. */
    OzStatus (*start_ledger)(void *sim);
    OzSettleShow show;    /* NULL: nothing is shown                                            */
    double show_interval; /* s, of it                                                          */
} OzRelax;

/* Whether members that settle so may do it side by side. */
bool oz_relax_is_same(const OzSettle *a, const OzSettle *b);

/* Lets the grains come to rest as scene.settle says: walls still, with drag until a member's
 * kinetic energy is below threshold x N m g d (it then waits for the others) or time_max is reached
 * (logged), then rest_time without drag. The step count is 0 again afterwards. Does nothing without
 * scene.settle, nor a second time; settling whose state was loaded goes on where it was. *seconds
 * receives the simulated time of the member that took longest. Fails with what watch (may be NULL)
 * or show fails with; both get the context. */
OzStatus oz_relax_run(const OzRelax *rest, double *seconds, OzSettleWatch watch, void *context);
