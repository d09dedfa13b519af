/* Encoders, their settings, and pictures in and packets out. Knows no file. */
#include "draw/movie_codec.h"

#include "base/log.h"
#include "base/memory.h"
#include "draw/yuv.h"

#include <stdlib.h>
#include <string.h>

struct OzMovieEncoder {
    const char *name, *option, *value; /* option: an option of its own, or NULL           */
    const char *preset;
    int quantiser; /* fixed quantiser for encoders without such an option, 0: none    */
};

/* In the order of preference. */
static const OzMovieEncoder encoders[] = {
    {"libx264", "crf", "18", "veryfast", 0}, /* 18: no artefact to be seen on thin rods */
    {"mpeg4", NULL, NULL, NULL, 3},          /* 3: the like of it                       */
};
enum { ENCODER_COUNT = sizeof encoders / sizeof *encoders };

/* Says that the better encoder is missing. */
static void log_fallback(const OzMovieEncoder *encoder, const char *asked)
{
    if (encoder != &encoders[0] && !asked) {
        oz_log_once("movie: libav has no %s, using %s", encoders[0].name, encoder->name);
    }
}

OzStatus oz_movie_codec_choose(OzMovieCodec *codec, const char *name)
{
    for (int i = 0; i < ENCODER_COUNT; i++) {
        bool wanted = !name || strcmp(name, encoders[i].name) == 0;
        if (wanted && av->avcodec_find_encoder_by_name(encoders[i].name)) {
            codec->encoder = &encoders[i];
            log_fallback(codec->encoder, name);
            return OZ_OK;
        }
    }
    return oz_status_fail(OZ_ERR_MOVIE, "movie: libav has no encoder %s; expected libx264 or mpeg4",
                          name ? name : "for mp4");
}

const char *oz_movie_codec_name(const OzMovieCodec *codec)
{
    return codec->encoder->name;
}

static void describe_pictures(AVCodecContext *context, const OzMovieCodec *codec)
{
    context->width = codec->width;
    context->height = codec->height;
    context->framerate = codec->rate;
    context->time_base = (AVRational){codec->rate.den, codec->rate.num};
    context->pix_fmt = AV_PIX_FMT_YUV420P;
    context->color_range = AVCOL_RANGE_MPEG;
    context->colorspace = AVCOL_SPC_BT709;
    context->color_primaries = AVCOL_PRI_BT709;
    context->color_trc = AVCOL_TRC_BT709;
    context->chroma_sample_location = AVCHROMA_LOC_LEFT;
    context->thread_count = 2; /* a fixed number, so that the bytes do not depend on the machine */
    if (codec->live_ticks > 0) {
        context->time_base = (AVRational){1, codec->live_ticks};
        context->thread_count = 1; /* a movie may be encoded beside it */
    }
    context->flags |= AV_CODEC_FLAG_GLOBAL_HEADER; /* mp4 and Matroska want it so */
}

static bool has_avx512(void)
{
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512f");
#else
    return false;
#endif
}

static OzStatus open_context(OzMovieCodec *codec)
{
    OzStatus status = OZ_OK;
    const OzMovieEncoder *encoder = codec->encoder;
    const AVCodec *found = av->avcodec_find_encoder_by_name(encoder->name);
    AVDictionary *options = NULL;
    AV_TRY_NEW(codec->context, av->avcodec_alloc_context3(found));
    describe_pictures(codec->context, codec);
    if (encoder->quantiser) {
        codec->context->flags |= AV_CODEC_FLAG_QSCALE;
        codec->context->global_quality = encoder->quantiser * FF_QP2LAMBDA;
    }
    if (encoder->option) {
        AV_TRY(av->av_dict_set(&options, encoder->option, encoder->value, 0));
        AV_TRY(av->av_dict_set(&options, "preset", encoder->preset, 0));
        AV_TRY(av->av_dict_set(&options, "tune", codec->live_ticks ? "zerolatency" : NULL, 0));
    }
    /* sync-lookahead, four frames that are held for the sake of a thread, changes no byte.
     * x264 164 reads memory that nobody has written in its AVX-512 code for pictures whose width is
     * no multiple of 128, and packets then depend on what it held. Its AVX2 code gives the bytes
     * that are meant, at the same speed. */
    if (encoder->option) {
        const char *words = has_avx512() ? "sync-lookahead=0:asm=AVX2" : "sync-lookahead=0";
        AV_TRY(av->av_dict_set(&options, "x264-params", words, 0));
    }
    AV_TRY(av->avcodec_open2(codec->context, found, &options));
done:
    if (options) {
        av->av_dict_free(&options);
    }
    return status;
}

/* The picture that the encoder reads. */
static OzStatus open_frame(OzMovieCodec *codec)
{
    OZ_PASS(OZ_NEW(&codec->sums, OZ_YUV_ROOM(codec->width)));
    AV_PASS_NEW(codec->packet, av->av_packet_alloc());
    AV_PASS_NEW(codec->frame, av->av_frame_alloc());
    codec->frame->format = AV_PIX_FMT_YUV420P;
    codec->frame->width = codec->width;
    codec->frame->height = codec->height;
    AV_PASS(av->av_frame_get_buffer(codec->frame, 0));
    return OZ_OK;
}

/* Keeps the first context's head, and compares those of later ones with it. */
static OzStatus check_head(OzMovieCodec *codec)
{
    const AVCodecContext *context = codec->context;
    size_t bytes = (size_t)context->extradata_size;
    if (!codec->head) {
        OZ_PASS(OZ_NEW(&codec->head, bytes));
        codec->head_bytes = context->extradata_size;
        codec->delay = context->has_b_frames;
        memcpy(codec->head, context->extradata, bytes);
    }
    bool same = context->extradata_size == codec->head_bytes &&
                memcmp(codec->head, context->extradata, bytes) == 0 &&
                codec->delay == context->has_b_frames;
    return same ? OZ_OK
                : oz_status_fail(OZ_ERR_MOVIE,
                                 "movie: this libav's %s makes other packets than the one that the "
                                 "movie was begun with; expected the same version, or --no-video",
                                 codec->encoder->name);
}

OzStatus oz_movie_codec_open(OzMovieCodec *codec)
{
    OzStatus status = OZ_OK;
    if (codec->context) {
        return OZ_OK;
    }
    OZ_TRY(open_context(codec));
    OZ_TRY(check_head(codec));
    if (!codec->frame) {
        OZ_TRY(open_frame(codec));
    }
done:
    if (status != OZ_OK) {
        av->avcodec_free_context(&codec->context);
    }
    return status;
}

OzStatus oz_movie_codec_send(OzMovieCodec *codec, const OzImage *image, int64_t number)
{
    if (!image) {
        AV_PASS(av->avcodec_send_frame(codec->context, NULL));
        return OZ_OK;
    }
    AV_PASS(av->av_frame_make_writable(codec->frame)); /* the encoder may still hold the last one */
    oz_yuv_convert(image, codec->sums, codec->frame->data, codec->frame->linesize);
    codec->frame->pts = number;
    AV_PASS(av->avcodec_send_frame(codec->context, codec->frame));
    return OZ_OK;
}

/* "Again" asks for more frames, "end" says that it is flushed, and both are known here only. */
OzStatus oz_movie_codec_receive(OzMovieCodec *codec, bool *any)
{
    int code = av->avcodec_receive_packet(codec->context, codec->packet);
    *any = code >= 0;
    if (code != AVERROR(EAGAIN) && code != AVERROR_EOF) {
        AV_PASS(code);
        /* One frame: a constant rate, the last frame included. */
        codec->packet->duration = codec->live_ticks ? 0 : 1;
    }
    return OZ_OK;
}

void oz_movie_codec_end(OzMovieCodec *codec)
{
    if (codec->context) {
        av->avcodec_free_context(&codec->context);
    }
}

void oz_movie_codec_free(OzMovieCodec *codec)
{
    oz_movie_codec_end(codec);
    if (codec->packet) {
        av->av_packet_free(&codec->packet);
    }
    if (codec->frame) {
        av->av_frame_free(&codec->frame);
    }
    free(codec->sums);
    free(codec->head);
    *codec = (OzMovieCodec){0};
}
