/* Pictures drawn beside the simulation: one thread that owns the GL context and the encoders of all
 * its galleries, and before it a short queue of copied snapshots. Several
 * threads may hand in pictures, each those of its own galleries. */
#pragma once

#include "draw/gallery.h"

enum { OZ_STUDIO_JOBS = 8 }; /* pictures that may wait or be in hand: a second or so of drawing */

typedef struct OzStudio OzStudio;

/* Seconds. */
typedef struct OzStudioTimes {
    double drawing, encoding; /* of the studio's thread, of galleries that are finished  */
    double waited;            /* in oz_studio_add, all its callers together              */
} OzStudioTimes;

/* Starts no thread: the first picture does. */
OzStatus oz_studio_create(OzStudio **studio);

/* Where the studio's renderer stands, for OzGallerySettings.renderer. The studio makes it, uses it and
 * frees it. */
OzRenderer **oz_studio_renderer(OzStudio *studio);

/* oz_gallery_add of a copy, later; the bits do not depend on when. From the first call on the
 * gallery belongs to the studio's thread until oz_studio_finish. Waits while OZ_STUDIO_JOBS
 * pictures, or fewer large ones, wait or are in hand. Fails with the first failure of any picture
 * so far; those that still wait after one are left out. */
OzStatus oz_studio_add(OzStudio *studio, OzGallery *gallery, const OzSnapshot *snapshot,
                       int purpose);

/* oz_gallery_finish after every picture that waits; NULL for either is fine. Fails with the first
 * failure so far, and the movie holds the frames before it. */
OzStatus oz_studio_finish(OzStudio *studio, OzGallery *gallery);

/* The times since the last call. */
OzStudioTimes oz_studio_take_times(OzStudio *studio);

/* Every gallery must be finished; NULL is fine. */
void oz_studio_free(OzStudio *studio);
