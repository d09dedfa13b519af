/* The members of a simulation and how far they have come: what both models' simulations keep of
 * steps, of members that wait or that a guard stopped, and of how long launches are. */
#pragma once

#include "base/state.h"
#include "model/step_clock.h"
#include "sim/sim.h"

#include <stdbool.h>

/* Settling is not begun, damps, rests, is over. */
typedef enum OzSettling {
    OZ_SETTLING_AHEAD,
    OZ_SETTLING_DAMPS,
    OZ_SETTLING_RESTS,
    OZ_SETTLING_OVER
} OzSettling;

typedef struct OzBatch {
    OzMember *members; /* with scenes of its own, below */
    OzScene *scenes;   /* one a member: copies          */
    int member_count;
    int64_t step;          /* made since time 0 (or since settling began) by those that go on */
    int64_t *reached;      /* one a member: steps that it has made itself                     */
    OzStepClock *clock;    /* one a member: alike in all that go on                           */
    bool *waits;           /* one a member: makes no steps for now (settled before others)    */
    char **stopped;        /* one a member: what a guard said; NULL while it goes on          */
    int64_t *deep_count;   /* one a member: deep contacts, each counted once a step        */
    bool *deep_told;       /* one a member: the first of them has been said                */
    int launch_steps;      /* of the next launch */
    bool walls_still;      /* while settling     */
    OzSettling settling;   /* how far settling has come */
    int64_t settling_last; /* step that ends its part */
    OzSimCounts counts;
} OzBatch;

/* Copies the members and their scenes, all at step 0. The caller frees with oz_batch_free (zeroed
 * is fine), also after a failure. */
OzStatus oz_batch_create(OzBatch *batch, const OzMember *members, int member_count);
void oz_batch_free(OzBatch *batch);

/* Whether the member makes steps: it neither waits nor was stopped. */
bool oz_batch_goes_on(const OzBatch *batch, int member);

/* Fails with OZ_ERR_BLOWUP, saying what the last member's guard said, once all are stopped. */
OzStatus oz_batch_check(const OzBatch *batch);

/* For a launch that has nothing to move: every member's clock goes on to the step, or stays where
 * it is beyond it. */
void oz_batch_skip(OzBatch *batch, int64_t step);

/* oz_batch_launch_steps: how many steps the next launch towards the given step shall make.
 * oz_batch_note_launch learns from a launch how long steps take: it is told how many steps were
 * made in how many seconds, and chooses the next launch's steps, at most most_steps. */
int oz_batch_launch_steps(const OzBatch *batch, int64_t step);
void oz_batch_note_launch(OzBatch *batch, int made, double seconds, int most_steps);

/* To be called after a launch, for each member that took part in it. oz_batch_count adds the steps
 * that this member made (own); *most becomes own where that is more. oz_batch_stop notes that a
 * guard stopped the member, and keeps a copy of oz_status_text() as what the guard said. */
void oz_batch_count(OzBatch *batch, int member, int own, int *most);
OzStatus oz_batch_stop(OzBatch *batch, int member);

/* To be called once after those. The clock goes on by the launch's steps. Where every member is
 * stopped now, it goes on by `most` instead (what the member that came farthest made), and the call
 * fails as oz_batch_check does. */
OzStatus oz_batch_end_launch(OzBatch *batch, int steps, int most);

/* Gives a member a copy of another scene, and its clock that scene's step from here on. */
OzStatus oz_batch_take_scene(OzBatch *batch, int member, const OzScene *scene);

/* Time of a step of a member's present stretch, s. */
double oz_batch_time(const OzBatch *batch, int member, int64_t step);

/* Time 0: no steps made, nothing counted or said, walls free to move. Members that wait or are
 * stopped stay so. */
void oz_batch_start_clock(OzBatch *batch);

/* Saves or loads (base/state.h) how far members have come and what was said of them. */
OzStatus oz_batch_state(OzBatch *batch, OzStateVisit *visit);
