/* Encodes pictures of known colours and decodes them again: what a player would show must be what
 * was drawn. */
#include "movie_rig.h"

#include "scene/scene.h"

#include <malloc.h>

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

static void assert_metadata(const Decoded *decoded, const char *key, const char *value)
{
    const AVDictionaryEntry *entry = av_dict_get(decoded->metadata, key, NULL, 0);
    assert_non_null(entry);
    assert_string_equal(entry->value, value);
}

static void check_movie(const char *path, enum AVCodecID codec, int tolerance)
{
    Decoded decoded;
    decode(path, &decoded);
    assert_int_equal(decoded.codec, codec);
    assert_int_equal(decoded.frames, FRAMES);
    assert_int_equal(decoded.uneven, 0);
    assert_int_equal(decoded.broken, 0);
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
    assert_metadata(&decoded, "major_brand", "isom"); /* no trace of how it was written first */
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

/* Also where memory holds something else before. */
static void test_same_bytes(void **state)
{
    (void)state;
    char *first = NULL, *second = NULL;
    size_t length = 0, again = 0;
    assert_int_equal(encode(in_folder("movie.mp4"), NULL, FRAMES), OZ_OK);
    assert_int_equal(oz_file_read(&first, &length, in_folder("movie.mp4")), OZ_OK);
    mallopt(M_PERTURB, 77);
    assert_int_equal(encode(in_folder("movie.mp4"), NULL, FRAMES), OZ_OK);
    mallopt(M_PERTURB, 0);
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
