/* The pictures of a run: movie frames and snapshots, from the snapshots that are handed in. GL and
 * libav are opened by the first picture that needs them and never otherwise. */
#pragma once

#include "base/state.h"
#include "draw/live.h"
#include "draw/renderer.h"

typedef struct OzPictures OzPictures;

enum {
    OZ_PICTURES_STATES = 256,  /* more would hide each other                        */
    OZ_PICTURES_LIVE = 1 << 16 /* a purpose: for those who look on alone, no file's */
};

typedef struct OzPicturesSettings {
    const char *folder;     /* movie.mp4 and snapshots/ go here; borrowed        */
    const char *source_dir; /* as in oz_embed_read; borrowed, may be NULL        */
    OzGlBackend backend;
    const char *device;    /* for the movie's metadata: who computed; borrowed   */
    OzRenderer **renderer; /* shared by several pictures: made by the first that draws, freed by
                            * the caller after them; NULL: the pictures' own                */
    OzLive *live;          /* is shown the movie's frames; borrowed, NULL: nobody           */
} OzPicturesSettings;

/* settings are borrowed and must outlive the pictures; of the scene they keep a copy. */
OzStatus oz_pictures_create(OzPictures **pictures, const OzPicturesSettings *settings,
                            const OzScene *scene);

/* Fixes the framing of all pictures by this snapshot; left out, the first one added does. settles:
 * of those of settling, which are framed apart, for their bed is higher. */
void oz_pictures_frame(OzPictures *pictures, const OzSnapshot *snapshot, bool settles);

/* Draws a snapshot, by the pictures' own scene and not by the snapshot's, and hands it to the movie
 * and (or) writes it into snapshots/ (names: draw/picture_name.h) in the look of `snapshots`;
 * purpose: OZ_FRAME_ bits of observe/frames.h, or OZ_PICTURES_LIVE, which no later picture depends
 * on where the first one that was added is the movie's. Of those for the strobe copies are kept, at
 * most OZ_PICTURES_STATES of them. */
OzStatus oz_pictures_add(OzPictures *pictures, const OzSnapshot *snapshot, int purpose);

/* Another scene takes over: it becomes the pictures' own, and *next empty. They keep their framing
 * and take its colours and views from now on, and the movie shows the caption (empty: none) for two
 * seconds. */
void oz_pictures_take(OzPictures *pictures, OzScene *next, const char *caption);

/* Saves or loads (base/state.h) all that later pictures depend on: the framing, the states kept for
 * the strobe, and the movie (oz_movie_state: saving puts all its frames so far on the disk, loading
 * goes on with the movie that is in the folder). The snapshot has the grains of those states;
 * loading copies its scene, whose walls move as they did by then. */
OzStatus oz_pictures_state(OzPictures *pictures, const OzSnapshot *now, OzStateVisit *visit);

/* The movie's last frame once more; there must be one. */
OzStatus oz_pictures_repeat(OzPictures *pictures);

/* Seconds spent in drawing and in encoding so far. */
void oz_pictures_times(const OzPictures *pictures, double *drawing, double *encoding);

/* Draws snapshots/strobe.png, the kept states over each other, if there are any; closes the movie,
 * frees; NULL is fine. */
OzStatus oz_pictures_finish(OzPictures *pictures);
