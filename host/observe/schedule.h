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
    OZ_DUE_EXPORT = 128,
    OZ_DUE_SHOWN = 256,    /* contacts in pictures */
    OZ_DUE_SETTLING = 512, /* a frame of the movie, before time 0 */
    OZ_DUE_FIELDS = 1024,
    OZ_DUE_LISTED = OZ_DUE_ROW | OZ_DUE_CONTACTS | OZ_DUE_EXPORT | OZ_DUE_SHOWN |
                    OZ_DUE_FIELDS /* what needs the snapshot's contacts */
};

/* Events of one kind: event `count` is next, at from + count x interval. */
typedef struct OzTrack {
    double from, interval; /* s; interval 0: there are none */
    int64_t count;         /* that have been due            */
} OzTrack;

typedef enum OzTrackKind {
    OZ_TRACK_ROW,
    OZ_TRACK_SAMPLE,
    OZ_TRACK_FRAME,
    OZ_TRACK_STROBE,
    OZ_TRACK_CONTACTS,
    OZ_TRACK_CHECKPOINT,
    OZ_TRACK_EXPORT,
    OZ_TRACK_FIELDS,
    OZ_TRACKS
} OzTrackKind;

typedef struct OzSchedule {
    const OzScene *scene; /* borrowed */
    OzStepClock clock;    /* of the simulation */
    int64_t last_step;
    OzTrack track[OZ_TRACKS];
    OzTrack later[OZ_TRACKS]; /* takes over from its track at `turn`; interval 0: it does not  */
    double turn;              /* s; INFINITY: there is nothing to take over                    */
    double phase; /* s after whole periods: rows and samples at observe.at; 0: at whole ones too */
    bool begun;   /* row 0, at time 0, has been due                                         */
    bool over;    /* the last step has been given                                           */
    int snapshots, kept; /* that have been due, of those at moments of their own              */
    double until; /* s: the run ends there if that is earlier than the scene's end; negative: not */
} OzSchedule;

/* The schedule of a scene, ending at the time `until` if that is earlier (negative: not given). Row
 * 0 is at time 0. With observe.at: mean, rows follow each `interval` seconds and at the last step,
 * samples samples_per_tap times a period. With top or bottom, there is a sample in every period
 * where the first moving wall is highest or lowest, and rows at such moments only, the first in the
 * first period, the others each `interval` seconds after. Contacts and fields asked for without an
 * interval are due with every row, an export without one with every frame of the movie, or else
 * row. */
OzSchedule oz_schedule_create(const OzScene *scene, double until);

/* Lets another scene's events follow from this step, before which all have been due; what has not
 * been due at it stays so: what keeps its distance goes on, what changes it is due at whole
 * multiples of the new one, of taps where it is written in taps. These change when the first moving
 * wall does (oz_motion_since). A scene that ends earlier than this step ends here. */
void oz_schedule_take_over(OzSchedule *schedule, const OzScene *next, int64_t step);

/* Finds the end again, after what the scene's end depends on has been loaded. */
void oz_schedule_find_end(OzSchedule *schedule);

/* The next step at which something is due, and what; events at one step come together. False when
 * there is nothing more up to the last step; the last step itself always comes, if
 * with nothing due. */
bool oz_schedule_next(OzSchedule *schedule, int64_t *step, int *due);

/* s between the movie's frames of settling, as far apart as those that follow, and what is due at
 * one of them; 0: settling is not in the movie. */
double oz_schedule_settling(const OzSchedule *schedule, int *due);

/* The snapshots that lie beyond the last step and are never due, in words; false without any. */
bool oz_schedule_missed(const OzSchedule *schedule, char *text, size_t size);

/* Whether two schedules have their events at the same times. */
bool oz_schedule_agrees(const OzSchedule *a, const OzSchedule *b);

/* Saves or loads (base/state.h) which events have been due, and how far frames of the movie are
 * apart: a run that is made longer keeps that. The end is not of it: a schedule that loads has its
 * own. */
OzStatus oz_schedule_state(OzSchedule *schedule, OzStateVisit *visit);
