/* Images into packets: the encoder of a movie and the conversion before it. For the movie's files
 * alone. Times are counted in frames, or in ticks where it is live. */
#pragma once

#include "draw/image.h"
#include "draw/movie_libav.h"

#include <stdbool.h>

/* One of the encoders that orzo knows, with what makes a good small picture of it. */
typedef struct OzMovieEncoder OzMovieEncoder;

/* Zeroed is valid. Everything above `encoder` is set by who opens it. */
typedef struct OzMovieCodec {
    int width, height;
    AVRational rate;               /* frames a second                                     */
    int live_ticks;                /* a second; then no frame waits for a later one       */
    const OzMovieEncoder *encoder; /* set by oz_movie_codec_choose                        */
    AVCodecContext *context;       /* NULL: closed                                        */
    uint8_t *head;                 /* what the first context put before all packets; owned */
    int64_t head_bytes;
    int delay; /* frames by which a packet's decoding may be ahead of its showing */
    AVFrame *frame;
    AVPacket *packet; /* the one that was received last */
    int32_t *sums;    /* OZ_YUV_ROOM */
} OzMovieCodec;

/* The named encoder ("libx264", "mpeg4"), or with NULL the best that this libav has, whose lack of
 * a better one is said in the log. Fails with OZ_ERR_MOVIE, as all below. */
OzStatus oz_movie_codec_choose(OzMovieCodec *codec, const char *name);

const char *oz_movie_codec_name(const OzMovieCodec *codec);

/* Opens an encoder, if none is open. Refuses one whose packets cannot stand in one stream with
 * those of the one before (another `head`). */
OzStatus oz_movie_codec_open(OzMovieCodec *codec);

/* Hands in the frame of this number, of the codec's size; with a NULL image the end, after which
 * only oz_movie_codec_receive and oz_movie_codec_end may be called. */
OzStatus oz_movie_codec_send(OzMovieCodec *codec, const OzImage *image, int64_t number);

/* The next packet that is ready, codec->packet; *any is false when there is none. Its dts is not
 * set. */
OzStatus oz_movie_codec_receive(OzMovieCodec *codec, bool *any);

/* Frees the encoder; what it still held is lost. Another may be opened. */
void oz_movie_codec_end(OzMovieCodec *codec);

void oz_movie_codec_free(OzMovieCodec *codec); /* zeroed is fine */
