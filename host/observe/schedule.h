/* When a run is looked at. Events are whole step numbers (event k of a kind lies at the step
 * nearest to k T), so that a frame rate never changes the physics. */
#pragma once

#include "base/state.h"
#include "model/step_clock.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stdint.h>

/* What is due at a step, as bits. */
enum {
    OZ_DUE_ROW = 1,
    OZ_DUE_SAMPLE = 2,
    OZ_DUE_MOVIE = 4,
    OZ_DUE_SNAPSHOT = 8,
    OZ_DUE_STROBE = 16,
    OZ_DUE_CHECKPOINT = 32, /* a state to be kept */
    OZ_DUE_CONTACTS = 64,
    OZ_DUE_LISTED = OZ_DUE_ROW | OZ_DUE_CONTACTS /* what needs the snapshot's contacts */
};

typedef struct OzSchedule {
    const OzScene *scene; /* borrowed */
    OzStepClock clock;    /* of the simulation */
    int64_t last_step;
    double row, sample, frame, strobe, contact,
        checkpoint; /* s between events; 0: there are none */
    double phase; /* s after whole periods: rows and samples at observe.at; 0: at whole ones too */
    bool over;    /* the last step has been given                                   */
    int64_t rows, samples, frames, strobes, contacts,
        checkpoints;     /* events of each kind that have been due */
    int snapshots, kept; /* the same of those at moments of their own */
} OzSchedule;

/* The schedule of a scene, ending at the time `until` if that is earlier (negative: not given). Row
 * 0 is at time 0. With observe.at: mean, rows follow each `row` seconds and at the last step,
 * samples samples_per_tap times a period. With top or bottom, there is a sample in every period
 * where the first moving wall is highest or lowest, and rows at such moments only, the first in the
 * first period, the others each `row` seconds after. Contacts asked for without an interval are due
 * with every row. */
OzSchedule oz_schedule_create(const OzScene *scene, double until);

/* The next step at which something is due, and what; events at one step come together. False when
 * there is nothing more up to the last step; the last step itself always comes, if
 * with nothing due. */
bool oz_schedule_next(OzSchedule *schedule, int64_t *step, int *due);

/* The snapshots that lie beyond the last step and are never due, in words; false without any. */
bool oz_schedule_missed(const OzSchedule *schedule, char *text, size_t size);

/* Whether two schedules have their events at the same times. */
bool oz_schedule_agrees(const OzSchedule *a, const OzSchedule *b);

/* Saves or loads (base/state.h) which events have been due, and how far frames of the movie are
 * apart: a run that is made longer keeps that. The end is not of it: a schedule that loads has its
 * own. */
OzStatus oz_schedule_state(OzSchedule *schedule, OzStateVisit *visit);
