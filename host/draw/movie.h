/* An mp4 from images. The only file that knows libav, which it opens at run time: a process that
 * makes no movie never maps it. */
#pragma once

#include "base/status.h"
#include "draw/image.h"

typedef struct OzMovie OzMovie;

/* Opens a movie of one frame rate, H.264 (libx264) or else MPEG-4 part 2, yuv420p, colours
 * converted to and tagged as bt709. Written beside path as path.part until oz_movie_finish. Width
 * and height must be even. metadata: key, value pairs, ending with NULL; NULL is none. The same
 * images give the same bytes with the same libav. Fails with OZ_ERR_MOVIE. */
OzStatus oz_movie_create(OzMovie **movie, const char *path, int width, int height, double fps,
                         const char *const *metadata);

/* The same with the encoder named ("libx264", "mpeg4"); NULL takes the best there is. */
OzStatus oz_movie_create_with(OzMovie **movie, const char *path, int width, int height, double fps,
                              const char *const *metadata, const char *encoder);

/* Appends one frame of the movie's size. */
OzStatus oz_movie_add(OzMovie *movie, const OzImage *image);

/* Flushes, writes the trailer (faststart) and renames. Frees movie, also on failure; NULL is fine.
 * A movie without frames leaves no file. */
OzStatus oz_movie_finish(OzMovie *movie);

/* The encoder that would be used, for `orzo devices` ("libx264", "mpeg4"), or the reason in the
 * failure text. */
OzStatus oz_movie_encoder(const char **name);
