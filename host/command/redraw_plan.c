/* Times asked for against times stored. Draws nothing. */
#include "command/redraw_plan.h"

#include "base/log.h"
#include "base/memory.h"
#include "observe/schedule.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SNAPSHOTS_NAMED = 8 }; /* in the log, of those that are off */

OzStatus oz_redraw_plan_note(OzRedrawPlan *plan, double time, int stored)
{
    OZ_PASS(OZ_ROOM(&plan->frames, &plan->capacity, plan->count + 1, "stored frames"));
    plan->frames[plan->count++] = (OzRedrawFrame){.time = time, .stored = stored};
    plan->settling += (stored & OZ_FRAME_SETTLING) && plan->settling == plan->count - 1;
    return OZ_OK;
}

void oz_redraw_plan_free(OzRedrawPlan *plan)
{
    free(plan->frames);
    *plan = (OzRedrawPlan){0};
}

/* Frames one after the other in time: those of settling, or the run's. */
typedef struct Span {
    int64_t first, last;
} Span;

static Span span_of(const OzRedrawPlan *plan, bool settles)
{
    return settles ? (Span){0, plan->settling - 1} : (Span){plan->settling, plan->count - 1};
}

/* The frame nearest to time; its distance in time, s, widens *off. */
static OzRedrawFrame *find_nearest(const OzRedrawPlan *plan, Span span, double time, double *off)
{
    int64_t low = span.first, high = span.last;
    while (low < high) {
        int64_t middle = (low + high) / 2;
        if (plan->frames[middle].time < time) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    OzRedrawFrame *after = &plan->frames[low];
    OzRedrawFrame *before = low > span.first ? after - 1 : after;
    OzRedrawFrame *nearest = time - before->time < fabs(after->time - time) ? before : after;
    *off = fmax(*off, fabs(nearest->time - time));
    return nearest;
}

/* What the run kept for one purpose is drawn again. */
static void take_stored(OzRedrawPlan *plan, Span span, int purpose)
{
    for (int64_t i = span.first; i <= span.last; i++) {
        plan->frames[i].purpose |= plan->frames[i].stored & purpose;
        plan->frames[i].repeats += plan->frames[i].stored & purpose & OZ_FRAME_MOVIE ? 1 : 0;
    }
}

/* Frames at equal intervals, s, up to the last one, each from the nearest. */
static void take_evenly(OzRedrawPlan *plan, Span span, int purpose, double interval,
                        const char *what)
{
    double off = 0, end = span.last >= span.first ? plan->frames[span.last].time : -interval;
    int64_t count = interval > 0 ? (int64_t)floor(end / interval * (1 + 1e-9)) + 1 : 0;
    for (int64_t k = 0; k < count; k++) {
        OzRedrawFrame *frame = find_nearest(plan, span, (double)k * interval, &off);
        frame->purpose |= purpose;
        frame->repeats += (purpose & OZ_FRAME_MOVIE) != 0;
    }
    if (count > 0) {
        oz_log_line("%s: %lld frames, each from the stored one nearest in time, up to %.3g s off",
                    what, (long long)count, off);
    }
}

static bool keeps(const OzRedrawPlan *plan, int purpose)
{
    bool any = false;
    for (int64_t i = 0; i < plan->count; i++) {
        any |= (plan->frames[i].stored & purpose) != 0;
    }
    return any;
}

static double last_time(const OzRedrawPlan *plan)
{
    return plan->frames[plan->count - 1].time;
}

static void choose_movie(OzRedrawPlan *plan, const OzScene *run, const OzScene *asked)
{
    const OzMovieSettings *a = &run->movie, *b = &asked->movie;
    const int settling = OZ_FRAME_MOVIE | OZ_FRAME_SETTLING;
    bool same = a->speed == b->speed && a->length == b->length && a->fps == b->fps;
    if (!b->present) {
        return;
    }
    bool settles = b->settle && plan->settling > 0;
    if (b->settle && !settles) {
        oz_log_line("movie: settling is not shown, for the run stored none of it");
    }
    if (a->present && same && keeps(plan, OZ_FRAME_MOVIE)) {
        take_stored(plan, span_of(plan, false), OZ_FRAME_MOVIE);
        take_stored(plan, settles ? span_of(plan, true) : (Span){0, -1}, settling);
        return;
    }
    OzSchedule schedule = oz_schedule_create(asked, last_time(plan));
    double interval = schedule.track[OZ_TRACK_FRAME].interval;
    if (settles) {
        take_evenly(plan, span_of(plan, true), settling, interval, "settling");
    }
    take_evenly(plan, span_of(plan, false), OZ_FRAME_MOVIE, interval, "movie");
}

/* Up to when the run is known to have been: its last frame, and a gap between frames beyond. */
static double find_end(const OzRedrawPlan *plan)
{
    double gap = 0;
    for (int64_t i = plan->settling + 1; i < plan->count; i++) {
        gap = fmax(gap, plan->frames[i].time - plan->frames[i - 1].time);
    }
    return last_time(plan) + gap;
}

/* Snapshot i of the scene from the nearest frame; its time becomes that frame's where they differ.
 * Returns how far off, s; 0 within half a step. */
static double take_snapshot(OzRedrawPlan *plan, OzScene *asked, int i)
{
    OzSnapshotSettings *shots = &asked->snapshots;
    double off = 0, wanted = shots->times[i];
    OzRedrawFrame *frame = find_nearest(plan, span_of(plan, false), wanted, &off);
    frame->purpose |= OZ_FRAME_SNAPSHOT;
    if (off <= 0.501 * asked->step) {
        return 0;
    }
    shots->times[i] = frame->time;
    if (i < shots->tap_count) {
        shots->taps[i] = frame->time / asked->period;
    }
    return off;
}

static void tell_off(const OzScene *asked, double wanted, double drawn)
{
    bool taps = asked->snapshots.tap_count > 0;
    double unit = taps ? asked->period : 1;
    oz_log_line(
        "snapshots: %s %.9g%s is drawn from the stored frame nearest in time, %.9g%s, %.3g s "
        "off",
        taps ? "tap" : "time", wanted / unit, taps ? "" : " s", drawn / unit, taps ? "" : " s",
        fabs(wanted - drawn));
}

static void choose_snapshots(OzRedrawPlan *plan, const OzScene *run, OzScene *asked)
{
    const OzSnapshotSettings *a = &run->snapshots;
    OzSnapshotSettings *b = &asked->snapshots;
    char missed[512];
    int told = 0, off_count = 0;
    double most = 0;
    if (a->count == b->count &&
        (a->count == 0 || memcmp(a->times, b->times, (size_t)a->count * sizeof *a->times) == 0)) {
        take_stored(plan, span_of(plan, false), OZ_FRAME_SNAPSHOT);
        return;
    }
    OzSchedule schedule = oz_schedule_create(asked, find_end(plan));
    if (oz_schedule_missed(&schedule, missed, sizeof missed)) {
        oz_log_line("warning: %s", missed);
    }
    for (int i = 0; i < b->count; i++) {
        double wanted = b->times[i];
        if (oz_step_clock_nearest(&schedule.clock, wanted) > schedule.last_step) {
            break;
        }
        double off = take_snapshot(plan, asked, i);
        off_count += off > 0;
        most = fmax(most, off);
        if (off > 0 && told++ < SNAPSHOTS_NAMED) {
            tell_off(asked, wanted, b->times[i]);
        }
    }
    if (off_count > SNAPSHOTS_NAMED) {
        oz_log_line("snapshots: %d in all are off, by up to %.3g s", off_count, most);
    }
}

static void choose_strobe(OzRedrawPlan *plan, const OzScene *run, const OzScene *asked)
{
    double interval = asked->snapshots.strobe;
    if (interval == run->snapshots.strobe) {
        take_stored(plan, span_of(plan, false), OZ_FRAME_STROBE);
    } else {
        take_evenly(plan, span_of(plan, false), OZ_FRAME_STROBE, interval, "strobe");
    }
}

OzStatus oz_redraw_plan_choose(OzRedrawPlan *plan, const OzScene *run, OzScene *asked)
{
    bool any = false;
    if (plan->count > plan->settling) {
        choose_movie(plan, run, asked);
        choose_snapshots(plan, run, asked);
        choose_strobe(plan, run, asked);
    }
    for (int64_t i = 0; i < plan->count; i++) {
        any |= plan->frames[i].purpose != 0;
    }
    return any ? OZ_OK
               : oz_status_fail(
                     OZ_ERR_INPUT,
                     "nothing to draw: %s; expected a movie, or snapshots within the run",
                     plan->count > plan->settling
                         ? "no movie is asked for and no snapshot that the run "
                           "has come to"
                         : "the run has stored no frame of its time");
}
