/* Events of a run. */
#include "observe/schedule.h"

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

OzSchedule oz_schedule_create(const OzScene *scene, double until)
{
    OzSchedule s = {.scene = scene, .clock = oz_step_clock_begin(scene->step)};
    double duration = until >= 0 && until < scene->duration ? until : scene->duration;
    s.last_step = oz_step_clock_nearest(&s.clock, duration);
    s.row = scene->observe.interval;
    s.phase = phase_of(scene);
    s.sample = s.phase > 0         ? scene->period
               : scene->period > 0 ? scene->period / (double)scene->observe.samples_per_tap
                                   : 0;
    s.frame = frame_interval(scene, duration);
    s.strobe = scene->snapshots.strobe;
    s.checkpoint = scene->checkpoint.interval_taps * scene->period;
    s.contact = scene->observe.contacts ? scene->observe.contacts_interval : 0;
    return s;
}

/* Event `index` of a kind, the first at time `from`. */
static int64_t step_from(const OzSchedule *s, double from, double interval, int64_t index)
{
    return interval > 0 ? oz_step_clock_nearest(&s->clock, from + (double)index * interval)
                        : INT64_MAX;
}

static int64_t step_of(const OzSchedule *s, double interval, int64_t index)
{
    return step_from(s, 0, interval, index);
}

/* Row 0 is the start whatever the phase. */
static int64_t row_step(const OzSchedule *s)
{
    return s->phase > 0 && s->rows > 0 ? step_from(s, s->phase, s->row, s->rows - 1)
                                       : step_of(s, s->row, s->rows);
}

static int64_t sample_step(const OzSchedule *s)
{
    return step_from(s, s->phase, s->sample, s->samples);
}

static int64_t earlier(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

/* Counts the events of one kind that are due by a step; true when there were any. */
static bool pass(const OzSchedule *s, double interval, int64_t *count, int64_t step)
{
    bool any = false;
    while (step_of(s, interval, *count) <= step) {
        ++*count;
        any = true;
    }
    return any;
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

/* Counts states to be kept that are due by a step; those by interval begin after the start. */
static bool pass_checkpoints(OzSchedule *s, int64_t step)
{
    bool any = false;
    for (; step_of(s, s->checkpoint, s->checkpoints + 1) <= step; s->checkpoints++) {
        any = true;
    }
    for (; kept_step(s) <= step; s->kept++) {
        any = true;
    }
    return any;
}

/* Counts rows and samples that are due by a step, likewise. */
static bool pass_rows(OzSchedule *s, int64_t step)
{
    bool any = false;
    for (; row_step(s) <= step; s->rows++) {
        any = true;
    }
    return any;
}

static bool pass_samples(OzSchedule *s, int64_t step)
{
    bool any = false;
    for (; sample_step(s) <= step; s->samples++) {
        any = true;
    }
    return any;
}

bool oz_schedule_next(OzSchedule *s, int64_t *step, int *due)
{
    int64_t next = earlier(row_step(s), sample_step(s));
    next = earlier(next, step_of(s, s->frame, s->frames));
    next = earlier(next, step_of(s, s->strobe, s->strobes));
    next = earlier(next, step_of(s, s->contact, s->contacts));
    next = earlier(next, snapshot_step(s));
    next = earlier(next, step_of(s, s->checkpoint, s->checkpoints + 1));
    next = earlier(next, kept_step(s));
    if (s->over) {
        return false;
    }
    s->over = next >= s->last_step;
    next = s->over ? s->last_step : next;
    *step = next;
    *due = s->over && s->phase == 0 ? OZ_DUE_ROW : 0;
    *due |= pass_rows(s, next) ? OZ_DUE_ROW : 0;
    *due |= pass_samples(s, next) ? OZ_DUE_SAMPLE : 0;
    *due |= pass(s, s->frame, &s->frames, next) ? OZ_DUE_MOVIE : 0;
    *due |= pass(s, s->strobe, &s->strobes, next) ? OZ_DUE_STROBE : 0;
    *due |= pass_checkpoints(s, next) ? OZ_DUE_CHECKPOINT : 0;
    *due |= pass(s, s->contact, &s->contacts, next) ? OZ_DUE_CONTACTS : 0;
    bool with_rows = s->scene->observe.contacts && s->contact == 0;
    *due |= with_rows && (*due & OZ_DUE_ROW) ? OZ_DUE_CONTACTS : 0;
    while (snapshot_step(s) <= next) {
        *due |= OZ_DUE_SNAPSHOT;
        s->snapshots++;
    }
    return true;
}

bool oz_schedule_missed(const OzSchedule *s, char *text, size_t size)
{
    enum { NAMED = 8 };
    const OzSnapshotSettings *shots = &s->scene->snapshots;
    bool taps = shots->tap_count > 0;
    double end = oz_step_clock_time(&s->clock, s->last_step) / (taps ? s->scene->period : 1);
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
    return a->last_step == b->last_step && a->row == b->row && a->sample == b->sample &&
           a->phase == b->phase && a->frame == b->frame && a->strobe == b->strobe &&
           a->contact == b->contact && a->checkpoint == b->checkpoint &&
           same(x->snapshots.times, x->snapshots.count, y->snapshots.times, y->snapshots.count) &&
           same(x->checkpoint.times, x->checkpoint.count, y->checkpoint.times, y->checkpoint.count);
}

OzStatus oz_schedule_state(OzSchedule *s, OzStateVisit *visit)
{
    OzStatus status = OZ_OK;
    int64_t snapshots = s->snapshots, kept = s->kept;
    OZ_TRY(oz_state_enter(visit, "schedule", 3));
    OZ_TRY(oz_step_clock_state(&s->clock, visit, "clock"));
    OZ_TRY(oz_state_index(visit, "rows", &s->rows, 0, INT64_MAX));
    OZ_TRY(oz_state_index(visit, "samples", &s->samples, 0, INT64_MAX));
    OZ_TRY(oz_state_index(visit, "frames", &s->frames, 0, INT64_MAX));
    OZ_TRY(oz_state_index(visit, "strobes", &s->strobes, 0, INT64_MAX));
    OZ_TRY(oz_state_index(visit, "contacts", &s->contacts, 0, INT64_MAX));
    OZ_TRY(oz_state_index(visit, "snapshots", &snapshots, 0, s->scene->snapshots.count));
    OZ_TRY(oz_state_index(visit, "checkpoints", &s->checkpoints, 0, INT64_MAX - 1));
    OZ_TRY(oz_state_index(visit, "kept", &kept, 0, INT64_MAX));
    OZ_TRY(oz_state_double(visit, "frame", "s between frames", &s->frame, 1));
    oz_state_leave(visit);
    s->snapshots = (int)snapshots;
    s->kept = (int)earlier(kept, s->scene->checkpoint.count);
done:
    return status;
}
