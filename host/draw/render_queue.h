/* Pictures drawn beside the simulation: one thread that owns the GL context and the encoders of all
 * its pictures, and before it a short queue of copied snapshots. Several
 * threads may hand in pictures, each those of its own pictures. */
#pragma once

#include "draw/pictures.h"

enum { OZ_RENDER_QUEUE_JOBS = 8 }; /* pictures that may wait or be in hand: a second's drawing */

typedef struct OzRenderQueue OzRenderQueue;

/* Seconds. */
typedef struct OzRenderQueueTimes {
    double drawing, encoding; /* of the render queue's thread, of pictures that are finished  */
    double waited;            /* in oz_render_queue_add, all its callers together              */
} OzRenderQueueTimes;

/* Starts no thread: the first picture does. */
OzStatus oz_render_queue_create(OzRenderQueue **render_queue);

/* Where the render queue's renderer stands, for OzPicturesSettings.renderer. The render queue makes
 * it, uses it and frees it. */
OzRenderer **oz_render_queue_renderer(OzRenderQueue *render_queue);

/* What is shown to those who look on, for OzPicturesSettings.live of one member's pictures. What it
 * shows is asked for before the first picture (a stream) or at any time (latest.png). The render
 * queue frees it. */
OzLive *oz_render_queue_live(OzRenderQueue *render_queue);

/* oz_pictures_add of a copy, later; the bits do not depend on when. From the first call on the
 * pictures belongs to the render queue's thread until oz_render_queue_finish. Waits while
 * OZ_RENDER_QUEUE_JOBS pictures, or fewer large ones, wait or are in hand. Fails with the first
 * failure of any picture so far; those that still wait after one are left out. */
OzStatus oz_render_queue_add(OzRenderQueue *render_queue, OzPictures *pictures,
                             const OzSnapshot *snapshot, int purpose);

/* Whether nothing waits or is in hand: a picture that is added now delays nobody. */
bool oz_render_queue_is_idle(OzRenderQueue *render_queue);

/* oz_pictures_take of a copy of the scene, once the pictures that wait are drawn by the scene
 * before it; does not wait for them, but for room where as many changes wait as pictures may. NULL
 * for either of the first two is fine. Fails with the first failure so far. */
OzStatus oz_render_queue_take(OzRenderQueue *render_queue, OzPictures *pictures,
                              const OzScene *scene, const char *caption);

/* oz_pictures_state once every picture that waits is drawn; NULL for either of the first two visits
 * nothing. Fails with the first failure so far. */
OzStatus oz_render_queue_state(OzRenderQueue *render_queue, OzPictures *pictures,
                               const OzSnapshot *now, OzStateVisit *visit);

/* oz_pictures_finish after every picture that waits; NULL for either is fine. Fails with the first
 * failure so far, and the movie holds the frames before it. */
OzStatus oz_render_queue_finish(OzRenderQueue *render_queue, OzPictures *pictures);

/* The times since the last call. */
OzRenderQueueTimes oz_render_queue_take_times(OzRenderQueue *render_queue);

/* All pictures must be finished; NULL is fine. */
void oz_render_queue_free(OzRenderQueue *render_queue);
