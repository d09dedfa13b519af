/* Encodes pictures of known colours and decodes them again with libav itself, which this program
 * alone links: what a player would show must be what was drawn. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/file.h"
#include "draw/movie.h"
#include "scene/scene.h"

#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WIDTH = 320, HEIGHT = 180, FRAMES = 50 };
static const double FPS = 30;
static char folder[] = "/tmp/orzo-movie-XXXXXX";

/* What a test asks of a decoded movie. */
typedef struct Decoded {
    int width, height;
    int frames, uneven; /* uneven: frames not exactly one interval after the last       */
    AVRational rate;
    enum AVColorSpace space; /* as the last frame says                                       */
    enum AVColorRange range;
    enum AVColorPrimaries primaries;
    enum AVColorTransferCharacteristic transfer;
    uint8_t colour[FRAMES][4]; /* RGBA in the middle of the left half                         */
    AVDictionary *metadata;
    enum AVCodecID codec;
    double duration; /* of the stream, in intervals */
} Decoded;

static const uint8_t PALETTE[5][3] = {
    {255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 255}, {68, 1, 84}};

static char *in_folder(const char *name)
{
    static char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

/* One colour on the left, grey with a dark bar that moves on the right. */
static void paint(OzImage *image, int frame)
{
    const uint8_t *colour = PALETTE[frame / 10];
    for (int y = 0; y < image->height; y++) {
        for (int x = 0; x < image->width; x++) {
            uint8_t *pixel = &image->pixels[4 * (y * image->width + x)];
            uint8_t grey = abs(x - image->width / 2 - 3 * frame) < 4 ? 20 : 128;
            for (int k = 0; k < 3; k++) {
                pixel[k] = x < image->width / 2 ? colour[k] : grey;
            }
            pixel[3] = 255;
        }
    }
}

static OzStatus encode(const char *path, const char *encoder, int frames)
{
    static const char *const metadata[] = {"title", "tapped rods", "device", "a CPU, 2 threads",
                                           "seed",  "17",          NULL};
    OzMovie *movie = NULL;
    OzImage image = {WIDTH, HEIGHT, calloc(WIDTH * HEIGHT, 4)};
    OzStatus status = oz_movie_create_with(&movie, path, WIDTH, HEIGHT, FPS, metadata, encoder);
    for (int frame = 0; status == OZ_OK && frame < frames; frame++) {
        paint(&image, frame);
        status = oz_movie_add(movie, &image);
    }
    free(image.pixels);
    OzStatus finished = oz_movie_finish(movie);
    return status == OZ_OK ? finished : status;
}

/* RGB of the pixel a quarter of the way across, by the colour space that the frame itself names. */
static void look(const AVFrame *frame, uint8_t rgb[4])
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

static void take_frame(Decoded *decoded, const AVFrame *frame, AVRational unit)
{
    assert_true(decoded->frames < FRAMES);
    double at = (double)frame->pts * unit.num / unit.den * FPS;
    decoded->uneven += fabs(at - decoded->frames) > 1e-6;
    decoded->width = frame->width;
    decoded->height = frame->height;
    decoded->space = frame->colorspace;
    decoded->range = frame->color_range;
    decoded->primaries = frame->color_primaries;
    decoded->transfer = frame->color_trc;
    look(frame, decoded->colour[decoded->frames]);
    decoded->frames++;
}

static void decode(const char *path, Decoded *decoded)
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
        assert_int_equal(avcodec_send_packet(context, more ? packet : NULL), 0);
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

static void assert_metadata(const Decoded *decoded, const char *key, const char *value)
{
    const AVDictionaryEntry *entry = av_dict_get(decoded->metadata, key, NULL, 0);
    assert_non_null(entry);
    assert_string_equal(entry->value, value);
}

/* Where the box starts among the boxes at the file's top. */
static long find_box(const char *path, const char *name)
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

static void check_movie(const char *path, enum AVCodecID codec, int tolerance)
{
    Decoded decoded;
    decode(path, &decoded);
    assert_int_equal(decoded.codec, codec);
    assert_int_equal(decoded.frames, FRAMES);
    assert_int_equal(decoded.uneven, 0);
    assert_int_equal(decoded.rate.num, 30 * decoded.rate.den);
    for (int frame = 0; frame < FRAMES; frame++) {
        for (int k = 0; k < 3; k++) {
            int error = abs(decoded.colour[frame][k] - PALETTE[frame / 10][k]);
            if (error > tolerance) {
                fail_msg("frame %d channel %d is %d, not %d", frame, k, decoded.colour[frame][k],
                         PALETTE[frame / 10][k]);
            }
        }
    }
    assert_metadata(&decoded, "title", "tapped rods");
    assert_metadata(&decoded, "device", "a CPU, 2 threads");
    assert_metadata(&decoded, "seed", "17");
    av_dict_free(&decoded.metadata);
    assert_true(find_box(path, "moov") < find_box(path, "mdat"));
    assert_false(oz_file_exists(in_folder("movie.mp4.part")));
}

/* Eight bits in limited range lose up to 2 in RGB, the quantiser a little more; bt601 read as
 * bt709, the mistake to find, is off by 20 and more in green. */
static void test_h264(void **state)
{
    (void)state;
    const char *name = NULL;
    Decoded decoded;
    assert_int_equal(oz_movie_encoder(&name), OZ_OK);
    if (strcmp(name, "libx264") != 0) {
        skip();
    }
    assert_int_equal(encode(in_folder("movie.mp4"), NULL, FRAMES), OZ_OK);
    check_movie(in_folder("movie.mp4"), AV_CODEC_ID_H264, 5);
    decode(in_folder("movie.mp4"), &decoded);
    assert_int_equal(decoded.space, AVCOL_SPC_BT709);
    assert_int_equal(decoded.range, AVCOL_RANGE_MPEG);
    assert_int_equal(decoded.primaries, AVCOL_PRI_BT709);
    assert_int_equal(decoded.transfer, AVCOL_TRC_BT709);
    av_dict_free(&decoded.metadata);
}

/* The other encoder, for a libav without libx264; its colours are coarser. */
static void test_mpeg4(void **state)
{
    (void)state;
    assert_int_equal(encode(in_folder("movie.mp4"), "mpeg4", FRAMES), OZ_OK);
    check_movie(in_folder("movie.mp4"), AV_CODEC_ID_MPEG4, 8);
}

static void test_any_number_of_frames(void **state)
{
    (void)state;
    Decoded decoded;
    for (int frames = 1; frames <= 3; frames++) {
        assert_int_equal(encode(in_folder("short.mp4"), NULL, frames), OZ_OK);
        decode(in_folder("short.mp4"), &decoded);
        assert_int_equal(decoded.frames, frames);
        /* whole ticks of the stream times their length: rounding alone */
        assert_true(fabs(decoded.duration - frames) < 1e-6);
        av_dict_free(&decoded.metadata);
    }
    assert_int_equal(encode(in_folder("none.mp4"), NULL, 0), OZ_OK);
    assert_false(oz_file_exists(in_folder("none.mp4")));
    assert_false(oz_file_exists(in_folder("none.mp4.part")));
    assert_int_equal(oz_movie_finish(NULL), OZ_OK);
}

static void test_same_bytes(void **state)
{
    (void)state;
    char *first = NULL, *second = NULL;
    size_t length = 0, again = 0;
    assert_int_equal(encode(in_folder("movie.mp4"), NULL, FRAMES), OZ_OK);
    assert_int_equal(oz_file_read(&first, &length, in_folder("movie.mp4")), OZ_OK);
    assert_int_equal(encode(in_folder("movie.mp4"), NULL, FRAMES), OZ_OK);
    assert_int_equal(oz_file_read(&second, &again, in_folder("movie.mp4")), OZ_OK);
    assert_int_equal(length, again);
    assert_memory_equal(first, second, length);
    free(first);
    free(second);
}

static void refuse(const char *path, int width, int height, double fps, const char *encoder,
                   const char *text)
{
    OzMovie *movie = NULL;
    assert_int_equal(oz_movie_create_with(&movie, path, width, height, fps, NULL, encoder),
                     OZ_ERR_MOVIE);
    assert_null(movie);
    if (!strstr(oz_status_text(), text)) {
        fail_msg("%s lacks %s", oz_status_text(), text);
    }
}

static void test_refusals(void **state)
{
    (void)state;
    const char *path = in_folder("bad.mp4");
    refuse(path, 321, 180, FPS, NULL, "even numbers");
    refuse(path, 320, 0, FPS, NULL, "even numbers");
    refuse(path, 320, 180, 0, NULL, "frames a second");
    refuse(path, 320, 180, NAN, NULL, "frames a second");
    refuse(path, 320, 180, FPS, "theora", "no encoder theora");
    refuse("/nowhere/bad.mp4", 320, 180, FPS, NULL, "No such file");
    assert_false(oz_file_exists(in_folder("bad.mp4.part")));
    OzMovie *movie = NULL;
    uint8_t pixels[16 * 16 * 4] = {0};
    assert_int_equal(oz_movie_create(&movie, path, 320, 180, FPS, NULL), OZ_OK);
    assert_int_equal(oz_movie_add(movie, &(OzImage){16, 16, pixels}), OZ_ERR_MOVIE);
    assert_int_equal(oz_movie_finish(movie), OZ_OK);
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    remove(in_folder("movie.mp4"));
    remove(in_folder("short.mp4"));
    return rmdir(folder);
}

/* Whatever size a scene may ask for, both encoders take. */
static void test_limits_of_size(void **state)
{
    static const char *const encoders[] = {"libx264", "mpeg4"};
    enum { LOW = OZ_PICTURE_SIDE_MIN, HIGH = OZ_PICTURE_SIDE_MAX };
    static const int sizes[][2] = {{LOW, LOW}, {HIGH, LOW}, {LOW, HIGH}};
    (void)state;
    for (int i = 0; i < 6; i++) {
        int width = sizes[i / 2][0], height = sizes[i / 2][1];
        const char *path = in_folder("size.mp4");
        OzMovie *movie = NULL;
        OzImage image = {width, height, calloc((size_t)(width * height), 4)};
        paint(&image, 0);
        OzStatus status =
            oz_movie_create_with(&movie, path, width, height, FPS, NULL, encoders[i % 2]);
        status = status == OZ_OK ? oz_movie_add(movie, &image) : status;
        OzStatus finished = oz_movie_finish(movie);
        if (status != OZ_OK || finished != OZ_OK) {
            fail_msg("%d x %d by %s: %s", width, height, encoders[i % 2], oz_status_text());
        }
        free(image.pixels);
        Decoded found;
        decode(path, &found);
        av_dict_free(&found.metadata);
        assert_true(found.frames == 1 && found.width == width && found.height == height);
        assert_true(abs(found.colour[0][0] - PALETTE[0][0]) <= 8); /* as above */
        remove(path);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_h264),
        cmocka_unit_test(test_mpeg4),
        cmocka_unit_test(test_any_number_of_frames),
        cmocka_unit_test(test_same_bytes),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_limits_of_size),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
