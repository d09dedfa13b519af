/* Pictures of a member for those who look on: while it settles, between the movie's frames, and
 * without a movie. No file depends on them, so that they are no part of a run's state. */
#pragma once

#include "draw/render_queue.h"

/* Zeroed is valid: nobody looks on. It must not move in memory while open. */
typedef struct OzGlances {
    OzRenderQueue *render_queue; /* borrowed; NULL: nobody looks on                      */
    OzPictures *own;             /* framed by what they show first                       */
    OzPictures *movie;           /* borrowed: instead of its own once time has begun, as the
                                  * movie frames; NULL: there is none                     */
    OzPicturesSettings settings; /* of its own */
} OzGlances;

/* Settings' texts and the movie's pictures must outlive the glances. */
OzStatus oz_glances_open(OzGlances *glances, OzRenderQueue *render_queue, OzPictures *movie,
                         const OzPicturesSettings *settings, const OzScene *scene);

/* Time begins, and with it the movie, if there is one. */
OzStatus oz_glances_begin(OzGlances *glances);

/* Whether somebody waits for a picture who can have one without delaying the run. */
bool oz_glances_wait(const OzGlances *glances);

/* Shows this state. One that cannot be drawn is no failure of the run's. */
OzStatus oz_glances_show(const OzGlances *glances, const OzSnapshot *now);

/* The run ends in this state: shows it where no movie does. */
OzStatus oz_glances_end(const OzGlances *glances, const OzSnapshot *now);

/* Another scene takes over, for pictures of its own; the movie's have it already. */
OzStatus oz_glances_take(const OzGlances *glances, const OzScene *next);

/* Finishes its own pictures. */
OzStatus oz_glances_close(OzGlances *glances);
