/* What people look at while a run makes its pictures: a stream (draw/movie_stream.h) and latest.png
 * in the run's folder. Neither is a result, and neither's failure is the run's: it is said in the
 * log. */
#pragma once

#include "base/status.h"
#include "draw/image.h"
#include "draw/movie_stream.h"

#include <stdatomic.h>
#include <stdbool.h>

/* Another one who looks on: is shown a picture, by the thread that draws, if it wants one. */
typedef struct OzLiveWatcher {
    bool (*wants)(void *context); /* from any thread; NULL: there is none */
    void (*show)(void *context, const OzImage *image);
    void *context;
} OzLiveWatcher;

/* Zeroed is valid: nobody looks, and showing costs nothing. */
typedef struct OzLive {
    OzMovieStream *stream;    /* owned; NULL: none                          */
    atomic_bool wants_latest; /* may be set at any time, by any thread      */
    bool is_noted;            /* latest.png, in the folder's marker         */
    bool is_stale;            /* a newer picture than latest.png was shown  */
    double written;           /* wall clock at which latest.png was, or 0   */
    _Atomic double shown;     /* wall clock of the last picture, or 0       */
    atomic_bool is_over;      /* pictures for it cannot be made             */
    OzLiveWatcher watcher;    /* set before the first picture               */
} OzLive;

/* Shows a picture: hands it to the stream, and writes folder/latest.png if it is wanted and none
 * was written for half a second. fps: of the movie. From one thread. */
void oz_live_show(OzLive *live, const OzImage *image, double fps, const char *folder);

/* Whether somebody looks and has seen nothing new for a while: 0.2 s, of latest.png alone 0.5 s.
 * From any thread. */
bool oz_live_waits(const OzLive *live);

/* A picture for those who look on alone could not be made, for the reason in oz_status_text: says
 * so once, and nobody waits for one any more. */
void oz_live_fail(OzLive *live);

/* No more pictures come, and this was the last: latest.png shows it. */
void oz_live_end(OzLive *live, const OzImage *image, const char *folder);

void oz_live_free(OzLive *live); /* ends the stream; zeroed is fine */
