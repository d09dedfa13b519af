/* Events of a run. */
#include "observe/schedule.h"

#include "model/motion.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Simulated seconds between frames of the movie. A `length` spreads the frames evenly over the run;
 * once they lie more than a period of the floor apart they are put a whole number of periods apart,
 * so that the floor stands still in a long run and moves in a short one. */
static double frame_interval(const OzScene *scene, double duration)
{
    const OzMovieSettings *movie = &scene->movie;
    if (!movie->present) {
        return 0;
    }
    if (movie->speed > 0) {
        return movie->speed / movie->fps;
    }
    double interval = duration / fmax(1, round(movie->length * movie->fps) - 1);
    if (scene->period > 0 && interval > scene->period) {
        interval = round(interval / scene->period) * scene->period;
    }
    return fmax(interval, scene->step);
}

static double phase_of(const OzScene *scene)
{
    static const double share[] = {
        [OZ_OBSERVE_MEAN] = 0, [OZ_OBSERVE_TOP] = 0.25, [OZ_OBSERVE_BOTTOM] = 0.75};
    return share[scene->observe.at] * scene->period;
}

/* s between the moments of contacts.csv; 0: those of the rows. */
static double contacts_interval(const OzScene *scene)
{
    const OzContactTable *table = &scene->contacts;
    double interval = table->interval > 0 ? table->interval : table->interval_taps * scene->period;
    return table->present ? interval : 0;
}

/* The same of fields.csv. */
static double fields_interval(const OzScene *scene)
{
    const OzFieldTable *table = &scene->fields;
    double interval = table->interval > 0 ? table->interval : table->interval_taps * scene->period;
    return table->present ? interval : 0;
}

/* s between events of each kind; 0: there are none. */
static void intervals_of(const OzScene *scene, double until, double intervals[OZ_TRACKS])
{
    double duration = until >= 0 && until < scene->duration ? until : scene->duration;
    double samples = (double)scene->observe.samples_per_tap;
    intervals[OZ_TRACK_ROW] = scene->observe.interval;
    intervals[OZ_TRACK_SAMPLE] = phase_of(scene) > 0 ? scene->period
                                 : scene->period > 0 ? scene->period / samples
                                                     : 0;
    intervals[OZ_TRACK_FRAME] = frame_interval(scene, duration);
    intervals[OZ_TRACK_STROBE] = scene->snapshots.strobe;
    intervals[OZ_TRACK_CONTACTS] = contacts_interval(scene);
    intervals[OZ_TRACK_FIELDS] = fields_interval(scene);
    intervals[OZ_TRACK_EXPORT] = scene->export_count > 0 ? scene->export_interval : 0;
    intervals[OZ_TRACK_CHECKPOINT] = scene->checkpoint.interval_taps * scene->period;
}

static int64_t last_step_of(const OzScene *scene, const OzStepClock *clock, double until)
{
    double duration = until >= 0 && until < scene->duration ? until : scene->duration;
    return oz_step_clock_nearest(clock, duration);
}

OzSchedule oz_schedule_create(const OzScene *scene, double until)
{
    OzSchedule s = {.scene = scene,
                    .clock = oz_step_clock_begin(scene->step),
                    .turn = INFINITY,
                    .until = until};
    double intervals[OZ_TRACKS];
    intervals_of(scene, until, intervals);
    s.last_step = last_step_of(scene, &s.clock, until);
    s.phase = phase_of(scene);
    for (int k = 0; k < OZ_TRACKS; k++) {
        s.track[k].interval = intervals[k];
        s.track[k].from = k == OZ_TRACK_ROW || k == OZ_TRACK_SAMPLE ? s.phase : 0;
    }
    s.track[OZ_TRACK_CHECKPOINT].count = 1; /* the start is not kept */
    return s;
}

static double time_of(const OzTrack *track)
{
    return track->interval > 0 ? track->from + (double)track->count * track->interval : INFINITY;
}

/* The track whose event is next, and its time. */
static OzTrack *next_of(OzSchedule *s, int kind, double *time)
{
    *time = time_of(&s->track[kind]);
    if (s->later[kind].interval > 0 && *time >= s->turn) {
        *time = time_of(&s->later[kind]);
        return &s->later[kind];
    }
    return &s->track[kind];
}

static int64_t step_of(const OzSchedule *s, double time)
{
    return isfinite(time) ? oz_step_clock_nearest(&s->clock, time) : INT64_MAX;
}

static int64_t earlier(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static int64_t snapshot_step(const OzSchedule *s)
{
    const OzSnapshotSettings *shots = &s->scene->snapshots;
    return s->snapshots < shots->count
               ? oz_step_clock_nearest(&s->clock, shots->times[s->snapshots])
               : INT64_MAX;
}

static int64_t kept_step(const OzSchedule *s)
{
    const OzCheckpoints *kept = &s->scene->checkpoint;
    return s->kept < kept->count ? oz_step_clock_nearest(&s->clock, kept->times[s->kept])
                                 : INT64_MAX;
}

/* Counts the events of one kind that are due by a step; true when there were any. */
static bool pass(OzSchedule *s, int kind, int64_t step)
{
    bool any = false;
    double time = 0;
    OzTrack *track = next_of(s, kind, &time);
    while (step_of(s, time) <= step) {
        track->count++;
        any = true;
        track = next_of(s, kind, &time);
    }
    return any;
}

/* States to be kept. */
static bool pass_checkpoints(OzSchedule *s, int64_t step)
{
    bool any = pass(s, OZ_TRACK_CHECKPOINT, step);
    for (; kept_step(s) <= step; s->kept++) {
        any = true;
    }
    return any;
}

/* Row 0 is the start whatever the phase. */
static bool is_first(const OzSchedule *s)
{
    return !s->begun && s->track[OZ_TRACK_ROW].interval > 0;
}

static bool pass_rows(OzSchedule *s, int64_t step)
{
    bool first = is_first(s);
    s->begun = true;
    return pass(s, OZ_TRACK_ROW, step) || first;
}

static int64_t next_step(OzSchedule *s)
{
    int64_t next = is_first(s) ? 0 : earlier(snapshot_step(s), kept_step(s));
    for (int k = 0; k < OZ_TRACKS; k++) {
        double time = 0;
        next_of(s, k, &time);
        next = earlier(next, step_of(s, time));
    }
    return next;
}

/* What is due because something else is. */
static int due_with(const OzSchedule *s, int due)
{
    bool contacts = s->scene->contacts.present && s->track[OZ_TRACK_CONTACTS].interval == 0;
    bool fields = s->scene->fields.present && s->track[OZ_TRACK_FIELDS].interval == 0;
    bool exports = s->scene->export_count > 0 && s->track[OZ_TRACK_EXPORT].interval == 0;
    int leads = s->scene->movie.present ? OZ_DUE_MOVIE : OZ_DUE_ROW;
    return (contacts && (due & OZ_DUE_ROW) ? OZ_DUE_CONTACTS : 0) |
           (fields && (due & OZ_DUE_ROW) ? OZ_DUE_FIELDS : 0) |
           (exports && (due & leads) ? OZ_DUE_EXPORT : 0);
}

/* Pictures of contacts need them. */
static int due_with_pictures(const OzSchedule *s, int due)
{
    bool is_drawn = due & (OZ_DUE_MOVIE | OZ_DUE_SNAPSHOT | OZ_DUE_STROBE | OZ_DUE_SETTLING);
    return is_drawn && oz_scene_shows_contacts(s->scene) ? OZ_DUE_SHOWN : 0;
}

bool oz_schedule_next(OzSchedule *s, int64_t *step, int *due)
{
    int64_t next = next_step(s);
    if (s->over) {
        return false;
    }
    s->over = next >= s->last_step;
    next = s->over ? s->last_step : next;
    *step = next;
    *due = s->over && s->phase == 0 ? OZ_DUE_ROW : 0;
    *due |= pass_rows(s, next) ? OZ_DUE_ROW : 0;
    *due |= pass(s, OZ_TRACK_SAMPLE, next) ? OZ_DUE_SAMPLE : 0;
    *due |= pass(s, OZ_TRACK_FRAME, next) ? OZ_DUE_MOVIE : 0;
    *due |= pass(s, OZ_TRACK_STROBE, next) ? OZ_DUE_STROBE : 0;
    *due |= pass_checkpoints(s, next) ? OZ_DUE_CHECKPOINT : 0;
    *due |= pass(s, OZ_TRACK_CONTACTS, next) ? OZ_DUE_CONTACTS : 0;
    *due |= pass(s, OZ_TRACK_FIELDS, next) ? OZ_DUE_FIELDS : 0;
    *due |= pass(s, OZ_TRACK_EXPORT, next) ? OZ_DUE_EXPORT : 0;
    *due |= due_with(s, *due);
    while (snapshot_step(s) <= next) {
        *due |= OZ_DUE_SNAPSHOT;
        s->snapshots++;
    }
    *due |= due_with_pictures(s, *due);
    return true;
}

double oz_schedule_settling(const OzSchedule *s, int *due)
{
    const OzMovieSettings *movie = &s->scene->movie;
    *due = OZ_DUE_SETTLING | due_with_pictures(s, OZ_DUE_SETTLING);
    return movie->present && movie->settle ? s->track[OZ_TRACK_FRAME].interval : 0;
}

/* What has taken over is the track from now on. */
static void settle_tracks(OzSchedule *s, double now)
{
    for (int k = 0; k < OZ_TRACKS; k++) {
        if (s->later[k].interval > 0 && now >= s->turn) {
            s->track[k] = s->later[k];
        }
        s->later[k] = (OzTrack){0};
    }
    s->turn = INFINITY;
}

/* The first event after `from` of those that lie whole intervals after `zero`. */
static OzTrack track_after(double zero, double interval, double from)
{
    const double rounding = 1e-9; /* of an interval */
    double count = floor((from - zero) / interval + rounding) + 1;
    return (OzTrack){.from = zero + count * interval, .interval = interval};
}

/* Whether a kind's events lie at taps. */
static bool is_by_tap(const OzScene *scene, int kind)
{
    return kind == OZ_TRACK_SAMPLE || kind == OZ_TRACK_CHECKPOINT ||
           (kind == OZ_TRACK_CONTACTS && scene->contacts.interval_taps > 0) ||
           (kind == OZ_TRACK_FIELDS && scene->fields.interval_taps > 0) ||
           (kind == OZ_TRACK_ROW && (scene->observe.interval_taps > 0 || phase_of(scene) > 0));
}

/* Events at taps go by the old period until the wall takes its new one. An event at the very turn
 * is the new track's. */
static void take_track(OzSchedule *s, const OzScene *next, int kind, double interval, double now)
{
    bool by_tap = is_by_tap(next, kind);
    double since = oz_motion_since(next),
           phase = by_tap && kind != OZ_TRACK_CHECKPOINT ? phase_of(next) : 0;
    if (interval == s->track[kind].interval) {
        return;
    }
    if (interval > 0 && by_tap && since > now) {
        double zero = since - oz_motion_tap(next, since) * next->period + phase;
        s->later[kind] = track_after(zero, interval, since - 1e-6 * next->period);
        s->turn = since;
    } else if (interval > 0) {
        double zero = by_tap ? now - oz_motion_tap(next, now) * next->period + phase : 0;
        s->track[kind] = track_after(zero, interval, now);
    } else {
        s->track[kind].interval = 0;
    }
}

void oz_schedule_find_end(OzSchedule *s)
{
    s->last_step = last_step_of(s->scene, &s->clock, s->until);
}

/* How many of these moments have been due: those before a step, and with_it the one at it. */
static int count_due(const OzSchedule *s, const double *times, int count, int64_t step,
                     bool with_it)
{
    int due = 0;
    while (due < count && oz_step_clock_nearest(&s->clock, times[due]) < step + with_it) {
        due++;
    }
    return due;
}

/* Whether the last of the moments that have been due lies at a step. */
static bool had(const OzSchedule *s, const double *times, int due, int64_t step)
{
    return due > 0 && oz_step_clock_nearest(&s->clock, times[due - 1]) == step;
}

void oz_schedule_take_over(OzSchedule *s, const OzScene *next, int64_t step)
{
    const OzSnapshotSettings *shots = &next->snapshots;
    bool had_shot = had(s, s->scene->snapshots.times, s->snapshots, step);
    bool had_kept = had(s, s->scene->checkpoint.times, s->kept, step);
    double now = oz_step_clock_time(&s->clock, step), intervals[OZ_TRACKS];
    settle_tracks(s, now);
    oz_step_clock_change(&s->clock, step, next->step);
    intervals_of(next, s->until, intervals);
    for (int k = 0; k < OZ_TRACKS; k++) {
        take_track(s, next, k, intervals[k], now);
    }
    s->scene = next;
    s->snapshots = count_due(s, shots->times, shots->count, step, had_shot);
    s->kept = count_due(s, next->checkpoint.times, next->checkpoint.count, step, had_kept);
    oz_schedule_find_end(s);
    s->last_step = s->last_step > step ? s->last_step : step;
}

bool oz_schedule_missed(const OzSchedule *s, char *text, size_t size)
{
    enum { NAMED = 8 };
    const OzSnapshotSettings *shots = &s->scene->snapshots;
    bool taps = shots->tap_count > 0;
    double end = oz_step_clock_time(&s->clock, s->last_step);
    end = taps ? oz_motion_tap(s->scene, end) : end;
    int first = 0, named = 0;
    while (first < shots->count &&
           oz_step_clock_nearest(&s->clock, shots->times[first]) <= s->last_step) {
        first++;
    }
    int missed = shots->count - first;
    size_t used = (size_t)snprintf(text, size, "snapshots.%s", taps ? "taps" : "times");
    for (; named < missed && named < NAMED && used < size; named++) {
        double at = taps ? shots->taps[first + named] : shots->times[first + named];
        used += (size_t)snprintf(text + used, size - used, "%s %.9g", named ? "," : "", at);
    }
    if (missed > named && used < size) {
        used += (size_t)snprintf(text + used, size - used, " and %d more", missed - named);
    }
    if (used < size) {
        snprintf(text + used, size - used,
                 taps ? " beyond the run's end at tap %.4g are not drawn"
                      : " s beyond the run's end at %g s are not drawn",
                 end);
    }
    return missed > 0;
}

static bool same(const double *a, int a_count, const double *b, int b_count)
{
    return a_count == b_count && (a_count == 0 || memcmp(a, b, (size_t)a_count * sizeof *a) == 0);
}

bool oz_schedule_agrees(const OzSchedule *a, const OzSchedule *b)
{
    const OzScene *x = a->scene, *y = b->scene;
    for (int k = 0; k < OZ_TRACKS; k++) {
        if (a->track[k].interval != b->track[k].interval) {
            return false;
        }
    }
    return a->last_step == b->last_step && a->phase == b->phase &&
           x->movie.settle == y->movie.settle &&
           same(x->snapshots.times, x->snapshots.count, y->snapshots.times, y->snapshots.count) &&
           same(x->checkpoint.times, x->checkpoint.count, y->checkpoint.times, y->checkpoint.count);
}

static OzStatus track_state(OzTrack *track, OzStateVisit *visit, const char *name, int kind)
{
    oz_state_enter_one(visit, name, kind);
    OZ_PASS(oz_state_double(visit, "from", "s", &track->from, 1));
    OZ_PASS(oz_state_double(visit, "interval", "s", &track->interval, 1));
    OZ_PASS(oz_state_index(visit, "count", &track->count, 0, INT64_MAX));
    oz_state_leave(visit);
    return OZ_OK;
}

OzStatus oz_schedule_state(OzSchedule *s, OzStateVisit *visit)
{
    int64_t snapshots = s->snapshots, kept = s->kept;
    double checkpoint = s->track[OZ_TRACK_CHECKPOINT].interval;
    OZ_PASS(oz_state_enter(visit, "schedule", 6));
    OZ_PASS(oz_step_clock_state(&s->clock, visit, "clock"));
    for (int k = 0; k < OZ_TRACKS; k++) {
        OZ_PASS(track_state(&s->track[k], visit, "track", k));
        OZ_PASS(track_state(&s->later[k], visit, "later", k));
    }
    s->track[OZ_TRACK_CHECKPOINT].interval = checkpoint;
    OZ_PASS(oz_state_double(visit, "turn", "s", &s->turn, 1));
    OZ_PASS(oz_state_bool(visit, "begun", &s->begun));
    OZ_PASS(oz_state_index(visit, "snapshots", &snapshots, 0, s->scene->snapshots.count));
    OZ_PASS(oz_state_index(visit, "kept", &kept, 0, INT64_MAX));
    oz_state_leave(visit);
    s->snapshots = (int)snapshots;
    s->kept = (int)earlier(kept, s->scene->checkpoint.count);
    return OZ_OK;
}
