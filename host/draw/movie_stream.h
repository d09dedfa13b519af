/* Pictures to somebody who looks on: Matroska without delay, every packet written at once, by a
 * thread of its own that takes the newest picture whenever it is ready for one. Whoever shows
 * pictures never waits; those that come too fast for the encoder or the reader are left out. Times
 * in it are of the wall, from the first picture. */
#pragma once

#include "base/status.h"
#include "draw/image.h"

#include <stdbool.h>

typedef struct OzMovieStream OzMovieStream;

/* To a new file, a named pipe (a reader may come later), or "-", the standard output, which nothing
 * else writes to from now on. path is borrowed. Starts no thread and opens no library yet. Fails
 * with OZ_ERR_INPUT, as oz_outlet_claim. */
OzStatus oz_movie_stream_create(OzMovieStream **stream, const char *path);

/* Copies the picture; the first one sets the size. fps: what the encoder may expect. A stream that
 * fails, because its reader has left or for any other reason, says so in the log and is over:
 * nobody else's work depends on it. */
void oz_movie_stream_show(OzMovieStream *stream, const OzImage *image, double fps);

/* False once it is over. From any thread. */
bool oz_movie_stream_is_on(const OzMovieStream *stream);

/* The last picture is still written, if the reader takes it within a second. Says how many pictures
 * it took and frees; NULL is fine. */
void oz_movie_stream_finish(OzMovieStream *stream);
