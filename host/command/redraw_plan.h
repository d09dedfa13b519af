/* Which stored frames `orzo draw` makes its pictures of. */
#pragma once

#include "observe/frames.h"

/* One stored frame. */
typedef struct OzRedrawFrame {
    double time;         /* s                                                       */
    int stored, purpose; /* OZ_FRAME_ bits: what it was kept for, what to draw of it */
    int64_t repeats;     /* of OZ_FRAME_MOVIE: how often it stands in the movie      */
} OzRedrawFrame;

typedef struct OzRedrawPlan {
    OzRedrawFrame *frames; /* in the file's order; owned */
    int64_t count, capacity;
    int64_t settling; /* so many of them, the first, are of settling */
} OzRedrawPlan;

/* Notes a frame of the file, in order. The caller frees with oz_redraw_plan_free (zeroed is fine).
 */
OzStatus oz_redraw_plan_note(OzRedrawPlan *plan, double time, int stored);
void oz_redraw_plan_free(OzRedrawPlan *plan);

/* Decides what to draw for the scene `asked` of a run whose scene was `run`. What both ask for
 * alike are the frames kept for it. Movie frames, snapshots and strobe at other times are each the
 * frame nearest in time; the log says how far off. asked's snapshots become the times that are
 * drawn, where they are off by more than half a step, so that pictures are named truly. Fails with
 * OZ_ERR_INPUT when there is nothing to draw. */
OzStatus oz_redraw_plan_choose(OzRedrawPlan *plan, const OzScene *run, OzScene *asked);
