/* The stream's thread: from the newest picture through the encoder and the writer of Matroska to
 * the outlet. Knows nothing of what the pictures show. */
#include "draw/movie_stream.h"

#include "base/clock.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/outlet.h"
#include "base/thread.h"
#include "draw/movie_codec.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { BUFFER_BYTES = 1 << 15, TICKS = 1000 /* a second */ };

struct OzMovieStream {
    OzOutlet outlet;
    pthread_t thread;
    pthread_mutex_t lock;   /* of what follows, down to counts */
    pthread_cond_t changed; /* there is a picture, or closing */
    bool started, closing;
    bool has_newest;
    OzImage newest;
    int64_t shown, taken;
    double fps;
    atomic_bool is_read; /* somebody is there  */
    atomic_bool is_over; /* nothing more comes */
    /* Of the thread alone: */
    OzImage image; /* in hand */
    double first;  /* wall clock of the first picture */
    int64_t time;  /* of the one in hand, ticks since then */
    OzMovieCodec codec;
    AVFormatContext *format;
    OzStatus written; /* the first failure of the outlet */
    char text[1024];  /* and its words */
};

OzStatus oz_movie_stream_create(OzMovieStream **stream, const char *path)
{
    OZ_PASS(OZ_NEW(stream, 1));
    pthread_mutex_init(&(*stream)->lock, NULL);
    pthread_cond_init(&(*stream)->changed, NULL);
    OzStatus status = oz_outlet_claim(&(*stream)->outlet, path);
    if (status != OZ_OK) {
        oz_movie_stream_finish(*stream);
        *stream = NULL;
    }
    return status;
}

#if LIBAVFORMAT_VERSION_MAJOR >= 61
typedef const uint8_t Byte;
#else
typedef uint8_t Byte;
#endif

/* Called by libav. */
static int put(void *context, Byte *bytes, int count)
{
    OzMovieStream *stream = context;
    if (stream->written == OZ_OK) {
        stream->written = oz_outlet_write(&stream->outlet, bytes, (size_t)count);
        snprintf(stream->text, sizeof stream->text, "%s", oz_status_text());
    }
    return stream->written == OZ_OK ? count : AVERROR(EPIPE);
}

static OzStatus open_format(OzMovieStream *stream)
{
    OzStatus status = OZ_OK;
    AVDictionary *options = NULL;
    AVStream *track = NULL;
    uint8_t *buffer = NULL;
    AV_TRY(av->avformat_alloc_output_context2(&stream->format, NULL, "matroska", NULL));
    AV_TRY_NEW(buffer, av->av_mallocz(BUFFER_BYTES));
    AV_TRY_NEW(stream->format->pb,
               av->avio_alloc_context(buffer, BUFFER_BYTES, 1, stream, NULL, put, NULL));
    buffer = NULL;
    AV_TRY_NEW(track, av->avformat_new_stream(stream->format, NULL));
    track->time_base = (AVRational){1, TICKS};
    AV_TRY(av->avcodec_parameters_from_context(track->codecpar, stream->codec.context));
    AV_TRY(av->av_dict_set(&options, "live", "1", 0));
    AV_TRY(av->avformat_write_header(stream->format, &options));
done:
    if (buffer) {
        av->av_freep(&buffer);
    }
    if (options) {
        av->av_dict_free(&options);
    }
    return status;
}

static OzStatus open_encoder(OzMovieStream *stream)
{
    OZ_PASS(oz_movie_libav_load());
    stream->codec = (OzMovieCodec){.width = stream->image.width,
                                   .height = stream->image.height,
                                   .rate = av->av_d2q(stream->fps, 60000),
                                   .live_ticks = TICKS};
    OZ_PASS(oz_movie_codec_choose(&stream->codec, NULL));
    OZ_PASS(oz_movie_codec_open(&stream->codec));
    return open_format(stream);
}

/* Every packet that is ready, and with it all that the writer still holds. */
static OzStatus drain(OzMovieStream *stream)
{
    AVPacket *packet = stream->codec.packet;
    for (bool any = true;;) {
        OZ_PASS(oz_movie_codec_receive(&stream->codec, &any));
        if (!any) {
            break;
        }
        packet->dts = packet->pts;
        packet->stream_index = 0;
        AV_PASS(av->av_write_frame(stream->format, packet));
        AV_PASS(av->av_write_frame(stream->format, NULL));
        av->avio_flush(stream->format->pb);
        AV_PASS(stream->format->pb->error);
    }
    return OZ_OK;
}

static OzStatus write_image(OzMovieStream *stream)
{
    if (!stream->format) {
        OZ_PASS(open_encoder(stream));
        stream->first = oz_clock_now();
    }
    int64_t time = 1 + (int64_t)((oz_clock_now() - stream->first) * TICKS);
    stream->time = time > stream->time ? time : stream->time + 1;
    OZ_PASS(oz_movie_codec_send(&stream->codec, &stream->image, stream->time));
    return drain(stream);
}

static void close_encoder(OzMovieStream *stream)
{
    if (stream->format) {
        AVIOContext *bytes = stream->format->pb;
        av->avformat_free_context(stream->format);
        if (bytes) {
            av->av_freep(&bytes->buffer);
            av->avio_context_free(&bytes);
        }
        stream->format = NULL;
    }
    oz_movie_codec_free(&stream->codec);
}

/* Waits for a reader, looking for one five times a second; false when the stream ends before. */
static bool wait_for_reader(OzMovieStream *stream, OzStatus *status)
{
    bool open = false;
    while (*status == OZ_OK && !atomic_load(&stream->outlet.ending)) {
        *status = oz_outlet_open(&stream->outlet, &open);
        if (open) {
            break;
        }
        nanosleep(&(struct timespec){.tv_nsec = 200000000}, NULL);
    }
    atomic_store(&stream->is_read, open);
    return open;
}

/* The newest picture into stream->image; false when there is none and none will come. */
static bool take(OzMovieStream *stream)
{
    pthread_mutex_lock(&stream->lock);
    while (!stream->has_newest && !stream->closing) {
        pthread_cond_wait(&stream->changed, &stream->lock);
    }
    bool any = stream->has_newest;
    if (any) {
        OzImage emptied = stream->image;
        stream->image = stream->newest;
        stream->newest = emptied;
        stream->has_newest = false;
        stream->taken++;
    }
    pthread_mutex_unlock(&stream->lock);
    return any;
}

static void *work(void *argument)
{
    OzMovieStream *stream = argument;
    OzStatus status = OZ_OK;
    bool reads = wait_for_reader(stream, &status);
    while (reads && status == OZ_OK && take(stream)) {
        status = write_image(stream);
    }
    if (status != OZ_OK) {
        oz_log_line("stream: %s; the run goes on without it",
                    stream->written == OZ_OK ? oz_status_text() : stream->text);
    }
    atomic_store(&stream->is_over, true);
    close_encoder(stream);
    return NULL;
}

/* A copy in the place of a picture that nobody took. With the lock held. */
static OzStatus keep(OzMovieStream *stream, const OzImage *image)
{
    OzImage *newest = &stream->newest;
    if (!newest->pixels) {
        OZ_PASS(oz_image_create(newest, image->width, image->height));
    }
    memcpy(newest->pixels, image->pixels, 4 * (size_t)image->width * (size_t)image->height);
    stream->has_newest = true;
    pthread_cond_signal(&stream->changed);
    return OZ_OK;
}

static OzStatus start(OzMovieStream *stream)
{
    int code = oz_thread_start(&stream->thread, work, stream);
    stream->started = code == 0;
    return code == 0 ? OZ_OK
                     : oz_status_fail(OZ_ERR_MEMORY, "cannot start its thread: %s", strerror(code));
}

void oz_movie_stream_show(OzMovieStream *stream, const OzImage *image, double fps)
{
    OzStatus status = OZ_OK;
    if (atomic_load(&stream->is_over)) {
        return;
    }
    pthread_mutex_lock(&stream->lock);
    stream->shown++;
    /* Of those before anybody reads one is kept, for there to be something to see at once. */
    if (atomic_load(&stream->is_read) || !stream->has_newest) {
        status = keep(stream, image);
    }
    if (status == OZ_OK && !stream->started) {
        stream->fps = fps;
        status = start(stream);
    }
    pthread_mutex_unlock(&stream->lock);
    if (status != OZ_OK) {
        atomic_store(&stream->is_over, true);
        oz_log_line("stream: %s; the run goes on without it", oz_status_text());
    }
}

bool oz_movie_stream_is_on(const OzMovieStream *stream)
{
    return !atomic_load(&stream->is_over);
}

void oz_movie_stream_finish(OzMovieStream *stream)
{
    if (!stream) {
        return;
    }
    pthread_mutex_lock(&stream->lock);
    stream->closing = true;
    pthread_cond_signal(&stream->changed);
    pthread_mutex_unlock(&stream->lock);
    oz_outlet_end(&stream->outlet);
    if (stream->started) {
        pthread_join(stream->thread, NULL);
        oz_log_line("stream: %lld of %lld pictures", (long long)stream->taken,
                    (long long)stream->shown);
    }
    oz_outlet_close(&stream->outlet);
    oz_image_free(&stream->newest);
    oz_image_free(&stream->image);
    pthread_cond_destroy(&stream->changed);
    pthread_mutex_destroy(&stream->lock);
    free(stream);
}
