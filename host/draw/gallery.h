/* The pictures of a run: movie frames and snapshots, from the snapshots that are handed in. GL and
 * libav are opened by the first picture that needs them and never otherwise. */
#pragma once

#include "draw/renderer.h"

typedef struct OzGallery OzGallery;

enum { OZ_GALLERY_STATES = 256 }; /* more would hide each other */

typedef struct OzGallerySettings {
    const char *folder;     /* movie.mp4 and snapshots/ go here; borrowed        */
    const char *source_dir; /* as in oz_embed_read; borrowed, may be NULL        */
    OzGlBackend backend;
    const char *device;    /* for the movie's metadata: who computed; borrowed   */
    OzRenderer **renderer; /* shared by several galleries: made by the first that draws, freed by
                            * the caller after them; NULL: the gallery's own                */
} OzGallerySettings;

/* settings and scene are borrowed and must outlive the gallery. */
OzStatus oz_gallery_create(OzGallery **gallery, const OzGallerySettings *settings,
                           const OzScene *scene);

/* Fixes the framing of all pictures by this snapshot; left out, the first one added does. */
void oz_gallery_frame(OzGallery *gallery, const OzSnapshot *snapshot);

/* Draws a snapshot and hands it to the movie and (or) writes it into snapshots/ (names:
 * draw/picture_name.h) in the look of `snapshots`; purpose: OZ_FRAME_ bits of observe/frames.h. Of
 * those for the strobe copies are kept, at most OZ_GALLERY_STATES of them. */
OzStatus oz_gallery_add(OzGallery *gallery, const OzSnapshot *snapshot, int purpose);

/* The movie's last frame once more; there must be one. */
OzStatus oz_gallery_repeat(OzGallery *gallery);

/* Seconds spent in drawing and in encoding so far. */
void oz_gallery_times(const OzGallery *gallery, double *drawing, double *encoding);

/* Draws snapshots/strobe.png, the kept states over each other, if there are any; closes the movie,
 * frees; NULL is fine. */
OzStatus oz_gallery_finish(OzGallery *gallery);
