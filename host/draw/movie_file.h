/* Packets in an mp4. Two kinds of file: one that is being written is a chain of fragments, each
 * packet its own, so that what is there plays however the process ends; one that is done has its
 * index in front (faststart). For the movie's files alone. Times are counted in frames. */
#pragma once

#include "draw/movie_codec.h"

/* Zeroed is valid: closed. */
typedef struct OzMovieFile {
    AVFormatContext *format;
    AVStream *stream;
    AVRational rate; /* frames a second                                            */
    bool is_chain;   /* being written                                              */
    int64_t packets; /* so many are in it                                          */
    int64_t whole;   /* of a chain: bytes up to the end of the last whole fragment */
} OzMovieFile;

/* Begins the file. metadata is copied; parameters are of the stream's packets. Fails with
 * OZ_ERR_MOVIE, as all below, and leaves no file. */
OzStatus oz_movie_file_create(OzMovieFile *file, const char *path, bool is_chain,
                              const AVCodecParameters *parameters, AVRational rate,
                              const AVDictionary *metadata);

/* Appends a packet; its times are changed to the file's. Into a chain with all that a player wants
 * of it, written when this returns. */
OzStatus oz_movie_file_add(OzMovieFile *file, AVPacket *packet);

/* Writes what belongs at the end, closes the file and waits until it is on the disk. */
OzStatus oz_movie_file_end(OzMovieFile *file, const char *path);

/* Closes the file as it is, a chain cut to its last whole fragment. Frees; zeroed is fine. */
void oz_movie_file_close(OzMovieFile *file, const char *path);

/* Waits until what was written is on the disk. */
OzStatus oz_movie_file_sync(const char *path);

/* Cuts a chain that somebody else has left to its last whole fragment; one without any stays. */
OzStatus oz_movie_file_mend(const char *path);

/* Copies the first `count` packets of a movie of orzo's into a new file, which stays open. codec:
 * the one that made them. goes_on: its packets will follow, so that the copied ones get the form of
 * those, in a chain; else the file is one that is done. Fails when there are fewer than count or
 * they are not the frames 0 to count - 1, and then closes the file. */
OzStatus oz_movie_file_copy(OzMovieFile *file, const char *path, const char *source, int64_t count,
                            const OzMovieCodec *codec, bool goes_on);
