/* An mp4 from images. The only file that knows libav, which it opens at run time. */
#ifndef OZ_DRAW_MOVIE_H
#define OZ_DRAW_MOVIE_H

#include "base/status.h"
#include "draw/image.h"

typedef struct OzMovie OzMovie;

/* Written beside path under a temporary name until oz_movie_finish. metadata: key, value pairs, ending
 * with NULL. Fails with OZ_ERR_MOVIE. */
OzStatus oz_movie_create(OzMovie **movie, const char *path, int width, int height, double fps,
                         const char *const *metadata);

/* Appends one frame. */
OzStatus oz_movie_add(OzMovie *movie, const OzImage *image);

/* Flushes, writes the trailer (faststart) and renames. Frees movie, also on failure; NULL is fine. A
 * movie without frames leaves no file. */
OzStatus oz_movie_finish(OzMovie *movie);

/* The encoder that would be used, for `orzo devices` ("libx264", "mpeg4"), or the reason in the
 * failure text. */
OzStatus oz_movie_encoder(const char **name);

#endif
