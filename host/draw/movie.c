/* Encodes images into an mp4 through libav, opened at run time by the names of the versions that
 * this file was compiled against. Knows nothing of what the pictures show. */
#include "draw/movie.h"

#include "base/log.h"
#include "base/memory.h"

#include <dlfcn.h>
#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>

/* clang-format off */
/* Every function of libav that is called, by library; the table below and its filling walk these. */
#define AVUTIL_FUNCTIONS(F)                                                                        \
    F(av_dict_free) F(av_dict_set) F(av_d2q) F(av_frame_alloc) F(av_frame_free)                    \
    F(av_frame_get_buffer) F(av_frame_make_writable) F(av_log_format_line)                         \
    F(av_log_set_callback) F(av_strerror)
#define AVCODEC_FUNCTIONS(F)                                                                       \
    F(av_packet_alloc) F(av_packet_free) F(av_packet_rescale_ts) F(av_packet_unref)                \
    F(avcodec_alloc_context3) F(avcodec_find_encoder_by_name) F(avcodec_free_context)              \
    F(avcodec_open2) F(avcodec_parameters_from_context) F(avcodec_receive_packet)                  \
    F(avcodec_send_frame)
#define AVFORMAT_FUNCTIONS(F)                                                                      \
    F(av_interleaved_write_frame) F(av_write_trailer) F(avformat_alloc_output_context2)            \
    F(avformat_free_context) F(avformat_new_stream) F(avformat_write_header) F(avio_closep)        \
    F(avio_open)
#define SWSCALE_FUNCTIONS(F)                                                                       \
    F(sws_freeContext) F(sws_getCoefficients) F(sws_getContext) F(sws_scale)                       \
    F(sws_setColorspaceDetails)
/* clang-format on */

/* What the libraries export, the same for every movie of the process: a constant once loaded. */
#define MEMBER(function) __typeof__(function) *function;
static struct Libav {
    AVUTIL_FUNCTIONS(MEMBER)
    AVCODEC_FUNCTIONS(MEMBER)
    AVFORMAT_FUNCTIONS(MEMBER)
    SWSCALE_FUNCTIONS(MEMBER)
} av;

/* The encoders in the order of preference, each with what makes a good small picture of it. */
typedef struct Encoder {
    const char *name, *option, *value; /* option: an option of its own, or NULL           */
    const char *preset;
    int quantiser; /* fixed quantiser for encoders without such an option, 0: none    */
} Encoder;

static const Encoder encoders[] = {
    {"libx264", "crf", "18", "veryfast", 0}, /* 18: no artefact to be seen on thin rods */
    {"mpeg4", NULL, NULL, NULL, 3},          /* 3: the like of it                       */
};
enum { ENCODER_COUNT = sizeof encoders / sizeof *encoders };

struct OzMovie {
    char *path, *part; /* where it will stand, where it is written */
    AVFormatContext *format;
    AVCodecContext *codec;
    AVStream *stream;
    AVFrame *frame;
    AVPacket *packet;
    struct SwsContext *scaler;
    int64_t frame_count;
};

static OzStatus av_fail(int code, const char *call, int line)
{
    char reason[AV_ERROR_MAX_STRING_SIZE] = "unknown reason";
    av.av_strerror(code, reason, sizeof reason);
    return oz_status_fail(OZ_ERR_MOVIE, "movie: %s failed: %s (%d, draw/movie.c:%d)", call, reason,
                          code, line);
}

#define AV_TRY(call)                                                                               \
    do {                                                                                           \
        int av_code = (call);                                                                      \
        if (av_code < 0) {                                                                         \
            status = av_fail(av_code, #call, __LINE__);                                            \
            goto done;                                                                             \
        }                                                                                          \
    } while (0)
/* For what returns a pointer, NULL for out of memory. */
#define AV_TRY_NEW(pointer, call) AV_TRY(((pointer) = (call)) ? 0 : AVERROR(ENOMEM))

/* libav's own words: warnings and worse go to the log of the thread that they come from, everything
 * else nowhere. */
static void take_log(void *source, int level, const char *format, va_list arguments)
{
    char line[1024];
    int starts_line = 1;
    if (level > AV_LOG_WARNING) {
        return;
    }
    av.av_log_format_line(source, level, format, arguments, line, sizeof line, &starts_line);
    line[strcspn(line, "\n")] = '\0';
    oz_log_detail("libav: %s", line);
}

/* Fills `into` with the address of name: ISO C has no cast from an object to a function pointer. */
static OzStatus find_function(void *library, const char *name, void *into)
{
    void *address = dlsym(library, name);
    if (!address) {
        return oz_status_fail(OZ_ERR_MOVIE, "movie: libav lacks %s: %s", name, dlerror());
    }
    memcpy(into, &address, sizeof address);
    return OZ_OK;
}

static OzStatus open_library(void **library, const char *name)
{
    *library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (!*library) {
        return oz_status_fail(OZ_ERR_MOVIE,
                              "movie: cannot open %s: %s; install FFmpeg's libraries, or run "
                              "without a movie",
                              name, dlerror());
    }
    return OZ_OK;
}

#define FIND(function)      OZ_TRY(find_function(library, #function, &av.function));
#define SONAME(name, major) "lib" name ".so." AV_STRINGIFY(major)

/* The libraries stay open to the end of the process: they keep data of their own per thread. */
static OzStatus load_libraries(void)
{
    OzStatus status = OZ_OK;
    void *library = NULL;
    OZ_TRY(open_library(&library, SONAME("avutil", LIBAVUTIL_VERSION_MAJOR)));
    AVUTIL_FUNCTIONS(FIND)
    OZ_TRY(open_library(&library, SONAME("avcodec", LIBAVCODEC_VERSION_MAJOR)));
    AVCODEC_FUNCTIONS(FIND)
    OZ_TRY(open_library(&library, SONAME("avformat", LIBAVFORMAT_VERSION_MAJOR)));
    AVFORMAT_FUNCTIONS(FIND)
    OZ_TRY(open_library(&library, SONAME("swscale", LIBSWSCALE_VERSION_MAJOR)));
    SWSCALE_FUNCTIONS(FIND)
    av.av_log_set_callback(take_log);
done:
    return status;
}

/* Once a process, whatever the thread: the table of functions is written here and read alone after.
 */
static OzStatus load(void)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    static bool loaded;
    OzStatus status = OZ_OK;
    pthread_mutex_lock(&lock);
    if (!loaded) {
        status = load_libraries();
        loaded = status == OZ_OK;
    }
    pthread_mutex_unlock(&lock);
    return status;
}

/* The named encoder, or with NULL the first that this libav has. */
static OzStatus choose_encoder(const char *name, const Encoder **chosen, const AVCodec **codec)
{
    for (int i = 0; i < ENCODER_COUNT; i++) {
        *chosen = &encoders[i];
        bool wanted = !name || strcmp(name, encoders[i].name) == 0;
        *codec = wanted ? av.avcodec_find_encoder_by_name(encoders[i].name) : NULL;
        if (*codec) {
            return OZ_OK;
        }
    }
    return oz_status_fail(OZ_ERR_MOVIE, "movie: libav has no encoder %s; expected libx264 or mpeg4",
                          name ? name : "for mp4");
}

OzStatus oz_movie_encoder(const char **name)
{
    OzStatus status = OZ_OK;
    const Encoder *encoder = NULL;
    const AVCodec *codec = NULL;
    OZ_TRY(load());
    OZ_TRY(choose_encoder(NULL, &encoder, &codec));
    *name = encoder->name;
done:
    return status;
}

/* Says that the better encoder is missing. */
static void log_fallback(const Encoder *encoder, const char *asked)
{
    if (encoder != &encoders[0] && !asked) {
        oz_log_once("movie: libav has no %s, using %s", encoders[0].name, encoder->name);
    }
}

static void describe_pictures(AVCodecContext *codec, int width, int height, AVRational fps)
{
    codec->width = width;
    codec->height = height;
    codec->framerate = fps;
    codec->time_base = (AVRational){fps.den, fps.num};
    codec->pix_fmt = AV_PIX_FMT_YUV420P;
    codec->color_range = AVCOL_RANGE_MPEG;
    codec->colorspace = AVCOL_SPC_BT709;
    codec->color_primaries = AVCOL_PRI_BT709;
    codec->color_trc = AVCOL_TRC_BT709;
    codec->chroma_sample_location = AVCHROMA_LOC_LEFT;
    codec->thread_count = 2; /* a fixed number, so that the bytes do not depend on the machine */
}

static OzStatus open_encoder(OzMovie *movie, int width, int height, AVRational fps,
                             const char *name)
{
    OzStatus status = OZ_OK;
    const Encoder *encoder = NULL;
    const AVCodec *found = NULL;
    AVDictionary *options = NULL;
    OZ_TRY(choose_encoder(name, &encoder, &found));
    log_fallback(encoder, name);
    AV_TRY_NEW(movie->codec, av.avcodec_alloc_context3(found));
    describe_pictures(movie->codec, width, height, fps);
    if (movie->format->oformat->flags & AVFMT_GLOBALHEADER) {
        movie->codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    }
    if (encoder->quantiser) {
        movie->codec->flags |= AV_CODEC_FLAG_QSCALE;
        movie->codec->global_quality = encoder->quantiser * FF_QP2LAMBDA;
    }
    if (encoder->option) {
        AV_TRY(av.av_dict_set(&options, encoder->option, encoder->value, 0));
        AV_TRY(av.av_dict_set(&options, "preset", encoder->preset, 0));
    }
    AV_TRY(av.avcodec_open2(movie->codec, found, &options));
done:
    if (options) {
        av.av_dict_free(&options);
    }
    return status;
}

/* The stream, its metadata and the head of the file. */
static OzStatus open_file(OzMovie *movie, const char *const *metadata)
{
    OzStatus status = OZ_OK;
    AVDictionary *options = NULL;
    AV_TRY_NEW(movie->stream, av.avformat_new_stream(movie->format, NULL));
    movie->stream->time_base = movie->codec->time_base;
    movie->stream->avg_frame_rate = movie->codec->framerate;
    AV_TRY(av.avcodec_parameters_from_context(movie->stream->codecpar, movie->codec));
    for (; metadata && *metadata; metadata += 2) {
        AV_TRY(av.av_dict_set(&movie->format->metadata, metadata[0], metadata[1], 0));
    }
    /* use_metadata_tags keeps keys that mp4 has no name for, such as the device. */
    AV_TRY(av.av_dict_set(&options, "movflags", "+faststart+use_metadata_tags", 0));
    AV_TRY(av.avio_open(&movie->format->pb, movie->part, AVIO_FLAG_WRITE));
    AV_TRY(av.avformat_write_header(movie->format, &options));
done:
    if (options) {
        av.av_dict_free(&options);
    }
    return status;
}

/* The picture that the encoder reads, and the conversion into it: full-range RGB to limited-range
 * bt709, which is also what the file says it holds. */
static OzStatus open_conversion(OzMovie *movie)
{
    OzStatus status = OZ_OK;
    int width = movie->codec->width, height = movie->codec->height;
    AV_TRY_NEW(movie->packet, av.av_packet_alloc());
    AV_TRY_NEW(movie->frame, av.av_frame_alloc());
    movie->frame->format = movie->codec->pix_fmt;
    movie->frame->width = width;
    movie->frame->height = height;
    AV_TRY(av.av_frame_get_buffer(movie->frame, 0));
    AV_TRY_NEW(movie->scaler,
               av.sws_getContext(width, height, AV_PIX_FMT_RGBA, width, height, AV_PIX_FMT_YUV420P,
                                 SWS_BILINEAR | SWS_ACCURATE_RND, NULL, NULL, NULL));
    const int *bt709 = av.sws_getCoefficients(SWS_CS_ITU709);
    AV_TRY(av.sws_setColorspaceDetails(movie->scaler, bt709, 1, bt709, 0, 0, 1 << 16, 1 << 16));
done:
    return status;
}

/* Sizes and rates that no encoder takes, told in our words. fps becomes a fraction: MPEG-4 allows
 * neither part of it above 65535. */
static OzStatus check_request(int width, int height, double fps, AVRational *rate)
{
    if (width <= 0 || height <= 0 || width % 2 || height % 2 || width > 16384 || height > 16384) {
        return oz_status_fail(
            OZ_ERR_MOVIE, "movie: size %d x %d; expected even numbers up to 16384", width, height);
    }
    if (!(fps >= 0.01 && fps <= 1000)) {
        return oz_status_fail(OZ_ERR_MOVIE, "movie: %g frames a second; expected 0.01-1000", fps);
    }
    *rate = av.av_d2q(fps, 60000);
    return OZ_OK;
}

static void free_movie(OzMovie *movie)
{
    av.sws_freeContext(movie->scaler);
    av.av_packet_free(&movie->packet);
    av.av_frame_free(&movie->frame);
    av.avcodec_free_context(&movie->codec);
    if (movie->format) {
        av.avio_closep(&movie->format->pb);
    }
    av.avformat_free_context(movie->format);
    free(movie->path);
    free(movie->part);
    free(movie);
}

/* Frees a movie whose file is worth nothing. */
static void discard(OzMovie *movie)
{
    if (movie->format && movie->format->pb) {
        remove(movie->part);
    }
    free_movie(movie);
}

OzStatus oz_movie_create_with(OzMovie **movie, const char *path, int width, int height, double fps,
                              const char *const *metadata, const char *encoder)
{
    OzStatus status = OZ_OK;
    OzMovie *made = NULL;
    AVRational rate;
    *movie = NULL;
    OZ_TRY(load());
    OZ_TRY(check_request(width, height, fps, &rate));
    OZ_TRY(OZ_NEW(&made, 1));
    OZ_TRY(oz_memory_text(&made->path, path));
    if (asprintf(&made->part, "%s.part", path) < 0) {
        made->part = NULL;
        status = oz_status_fail(OZ_ERR_MEMORY, "out of memory for a file name");
        goto done;
    }
    AV_TRY(av.avformat_alloc_output_context2(&made->format, NULL, "mp4", made->part));
    OZ_TRY(open_encoder(made, width, height, rate, encoder));
    OZ_TRY(open_conversion(made));
    OZ_TRY(open_file(made, metadata));
    *movie = made;
done:
    if (status != OZ_OK && made) {
        discard(made);
    }
    return status;
}

OzStatus oz_movie_create(OzMovie **movie, const char *path, int width, int height, double fps,
                         const char *const *metadata)
{
    return oz_movie_create_with(movie, path, width, height, fps, metadata, NULL);
}

/* Writes every packet that the encoder has ready: "again" asks for more frames, "end" says that it
 * is flushed, and both are known here only. */
static OzStatus drain(OzMovie *movie)
{
    OzStatus status = OZ_OK;
    for (;;) {
        int code = av.avcodec_receive_packet(movie->codec, movie->packet);
        if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) {
            break;
        }
        AV_TRY(code);
        movie->packet->duration = 1; /* one frame: a constant rate, the last frame included */
        movie->packet->stream_index = movie->stream->index;
        av.av_packet_rescale_ts(movie->packet, movie->codec->time_base, movie->stream->time_base);
        AV_TRY(av.av_interleaved_write_frame(movie->format, movie->packet));
    }
done:
    av.av_packet_unref(movie->packet);
    return status;
}

OzStatus oz_movie_add(OzMovie *movie, const OzImage *image)
{
    OzStatus status = OZ_OK;
    const uint8_t *rows[4] = {image->pixels};
    int row_bytes[4] = {4 * image->width};
    if (image->width != movie->codec->width || image->height != movie->codec->height) {
        return oz_status_fail(OZ_ERR_MOVIE, "movie: a picture of %d x %d for a movie of %d x %d",
                              image->width, image->height, movie->codec->width,
                              movie->codec->height);
    }
    AV_TRY(av.av_frame_make_writable(movie->frame)); /* the encoder may still hold the last one */
    AV_TRY(av.sws_scale(movie->scaler, rows, row_bytes, 0, image->height, movie->frame->data,
                        movie->frame->linesize));
    movie->frame->pts = movie->frame_count;
    AV_TRY(av.avcodec_send_frame(movie->codec, movie->frame));
    movie->frame_count++;
    OZ_TRY(drain(movie));
done:
    return status;
}

static OzStatus flush(OzMovie *movie)
{
    OzStatus status = OZ_OK;
    AV_TRY(av.avcodec_send_frame(movie->codec, NULL));
    OZ_TRY(drain(movie));
done:
    return status;
}

/* Closes the file and gives it its name. */
static OzStatus publish(OzMovie *movie)
{
    OzStatus status = OZ_OK;
    AV_TRY(av.av_write_trailer(movie->format));
    AV_TRY(av.avio_closep(&movie->format->pb));
    if (rename(movie->part, movie->path) != 0) {
        status = oz_status_fail(OZ_ERR_MOVIE, "movie: cannot rename %s to %s: %s", movie->part,
                                movie->path, strerror(errno));
    }
done:
    if (status != OZ_OK) {
        remove(movie->part);
    }
    return status;
}

OzStatus oz_movie_finish(OzMovie *movie)
{
    if (!movie) {
        return OZ_OK;
    }
    if (movie->frame_count == 0) {
        discard(movie);
        return OZ_OK;
    }
    OzStatus flushed = flush(movie); /* when it fails, the frames before are still a movie */
    OzStatus published = publish(movie);
    free_movie(movie);
    return flushed != OZ_OK ? flushed : published;
}
