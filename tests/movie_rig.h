/* Movies in a test: pictures of known colours, and what libav itself, linked for this, decodes from
 * a file of them. */
#ifndef OZ_TESTS_MOVIE_RIG_H
#define OZ_TESTS_MOVIE_RIG_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/file.h"
#include "draw/movie.h"

#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WIDTH = 320, HEIGHT = 180, FRAMES = 50, FRAMES_MOST = 400 };
static const double FPS = 30;
static char folder[] = "/tmp/orzo-movie-XXXXXX";

/* What a test asks of a decoded movie. */
typedef struct Decoded {
    int width, height;
    int frames, uneven;      /* uneven: frames not exactly one interval after the last       */
    int broken;              /* packets that the decoder refused                             */
    int number[FRAMES_MOST]; /* of each frame, by its time */
    AVRational rate;
    enum AVColorSpace space; /* as the last frame says                                       */
    enum AVColorRange range;
    enum AVColorPrimaries primaries;
    enum AVColorTransferCharacteristic transfer;
    uint8_t colour[FRAMES_MOST][4]; /* RGBA in the middle of the left half */
    AVDictionary *metadata;
    enum AVCodecID codec;
    double duration; /* of the stream, in intervals */
} Decoded;

static const uint8_t PALETTE[5][3] = {
    {255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 255}, {68, 1, 84}};

static inline char *in_folder(const char *name)
{
    static char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

/* One colour on the left, grey with a dark bar that moves on the right. */
static inline void paint(OzImage *image, int frame)
{
    const uint8_t *colour = PALETTE[frame / 10 % 5];
    for (int y = 0; y < image->height; y++) {
        for (int x = 0; x < image->width; x++) {
            uint8_t *pixel = &image->pixels[4 * (y * image->width + x)];
            uint8_t grey = abs(x - image->width / 2 - 3 * (frame % FRAMES)) < 4 ? 20 : 128;
            for (int k = 0; k < 3; k++) {
                pixel[k] = x < image->width / 2 ? colour[k] : grey;
            }
            pixel[3] = 255;
        }
    }
}

/* RGB of the pixel a quarter of the way across, by the colour space that the frame itself names. */
static inline void look(const AVFrame *frame, uint8_t rgb[4])
{
    int width = frame->width, height = frame->height;
    uint8_t *row = malloc(4 * (size_t)width * (size_t)height);
    uint8_t *planes[4] = {row};
    int bytes[4] = {4 * width};
    struct SwsContext *scaler =
        sws_getContext(width, height, frame->format, width, height, AV_PIX_FMT_RGBA,
                       SWS_BILINEAR | SWS_ACCURATE_RND, NULL, NULL, NULL);
    const int *table = sws_getCoefficients((int)frame->colorspace);
    sws_setColorspaceDetails(scaler, table, frame->color_range == AVCOL_RANGE_JPEG, table, 1, 0,
                             1 << 16, 1 << 16);
    sws_scale(scaler, (const uint8_t *const *)frame->data, frame->linesize, 0, height, planes,
              bytes);
    memcpy(rgb, &row[4 * ((size_t)(height / 2) * (size_t)width + (size_t)(width / 4))], 4);
    const char *picture = getenv("ORZO_MOVIE_PICTURE"); /* a person wants to see the last frame */
    if (picture) {
        oz_image_write_png(&(OzImage){width, height, row}, picture);
    }
    sws_freeContext(scaler);
    free(row);
}

static inline void take_frame(Decoded *decoded, const AVFrame *frame, AVRational unit)
{
    assert_true(decoded->frames < FRAMES_MOST);
    double at = (double)frame->pts * unit.num / unit.den * FPS;
    decoded->uneven += !(fabs(at - decoded->frames) <= 1e-6);
    decoded->number[decoded->frames] = (int)lround(at);
    decoded->width = frame->width;
    decoded->height = frame->height;
    decoded->space = frame->colorspace;
    decoded->range = frame->color_range;
    decoded->primaries = frame->color_primaries;
    decoded->transfer = frame->color_trc;
    look(frame, decoded->colour[decoded->frames]);
    decoded->frames++;
}

static inline void decode(const char *path, Decoded *decoded)
{
    AVFormatContext *format = NULL;
    const AVCodec *codec = NULL;
    AVPacket *packet = av_packet_alloc();
    AVFrame *frame = av_frame_alloc();
    memset(decoded, 0, sizeof *decoded);
    assert_int_equal(avformat_open_input(&format, path, NULL, NULL), 0);
    assert_int_equal(format->nb_streams, 1);
    AVStream *stream = format->streams[0];
    decoded->codec = stream->codecpar->codec_id;
    decoded->rate = stream->avg_frame_rate;
    decoded->duration =
        (double)stream->duration * stream->time_base.num / stream->time_base.den * FPS;
    av_dict_copy(&decoded->metadata, format->metadata, 0);
    codec = avcodec_find_decoder(stream->codecpar->codec_id);
    AVCodecContext *context = avcodec_alloc_context3(codec);
    assert_true(avcodec_parameters_to_context(context, stream->codecpar) >= 0);
    assert_int_equal(avcodec_open2(context, codec, NULL), 0);
    for (bool more = true; more;) {
        more = av_read_frame(format, packet) >= 0;
        int code = avcodec_send_packet(context, more ? packet : NULL);
        assert_true(code == 0 || code == AVERROR_INVALIDDATA);
        decoded->broken += code != 0;
        while (avcodec_receive_frame(context, frame) >= 0) {
            take_frame(decoded, frame, stream->time_base);
        }
        av_packet_unref(packet);
    }
    avcodec_free_context(&context);
    avformat_close_input(&format);
    av_frame_free(&frame);
    av_packet_free(&packet);
}

/* Where the box starts among the boxes at the file's top. */
static inline long find_box(const char *path, const char *name)
{
    char *bytes = NULL;
    size_t length = 0, at = 0;
    assert_int_equal(oz_file_read(&bytes, &length, path), OZ_OK);
    while (at + 8 <= length && memcmp(bytes + at + 4, name, 4) != 0) {
        const unsigned char *size = (unsigned char *)bytes + at;
        size_t step =
            (size_t)size[0] << 24 | (size_t)size[1] << 16 | (size_t)size[2] << 8 | size[3];
        assert_true(step >= 8);
        at += step;
    }
    assert_true(at + 8 <= length);
    free(bytes);
    return (long)at;
}

static inline int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

#endif
