/* An mp4 from images. Its files (movie*.c) alone know libav, which is opened at run time: a process
 * that makes no movie never maps it.
 *
 * A movie is written beside path as path.part, in fragments: whatever ends the process, what lies
 * there plays, up to the twelve frames that the encoder may still hold (0.4 s of 30 frames a
 * second). At its end it is written once more as path.new, with its index in front, and renamed. */
#pragma once

#include "base/state.h"
#include "base/status.h"
#include "draw/image.h"

typedef struct OzMovie OzMovie;

/* Opens a movie of one frame rate, H.264 (libx264) or else MPEG-4 part 2, yuv420p, colours
 * converted to and tagged as bt709. Width and height must be even. metadata: key, value pairs,
 * ending with NULL; NULL is none. The same images give the same bytes with the same libav, and so
 * do the same with oz_movie_state after the same frames. Fails with OZ_ERR_MOVIE. */
OzStatus oz_movie_create(OzMovie **movie, const char *path, int width, int height, double fps,
                         const char *const *metadata);

/* The same with the encoder named ("libx264", "mpeg4"); NULL takes the best there is. */
OzStatus oz_movie_create_with(OzMovie **movie, const char *path, int width, int height, double fps,
                              const char *const *metadata, const char *encoder);

/* Appends one frame of the movie's size. */
OzStatus oz_movie_add(OzMovie *movie, const OzImage *image);

/* Saves or loads (base/state.h) the movie; NULL is saved as none.
 *
 * Saving lets the encoder go: all frames so far are on the disk afterwards, and the next one begins
 * anew, with a key frame.
 *
 * Loading makes a movie that goes on after those frames. They are copied, as they are, from
 * path.part or, where that is not there or has them not, from path; frames that came later are left
 * out. path.part is replaced when the copy is whole, path not before oz_movie_finish; size, rate,
 * encoder and metadata are the earlier ones. Fails with OZ_ERR_MOVIE when neither file has them. */
OzStatus oz_movie_state(OzMovie **movie, const char *path, OzStateVisit *visit);

/* Ends the movie, gives it its name and frees it, also on failure; NULL is fine. A movie without
 * frames leaves no file. After a failure to write, the frames before it are a movie still. Where
 * there is no room for path.new, the movie stays in fragments, and a line of the log says so. */
OzStatus oz_movie_finish(OzMovie *movie);

/* The encoder that would be used, for `orzo devices` ("libx264", "mpeg4"), or the reason in the
 * failure text. */
OzStatus oz_movie_encoder(const char **name);
