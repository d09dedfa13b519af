/* A stream shows each picture at once to whoever reads, and nobody waits for a reader: one who is
 * late, slow, asleep or gone. */
#include "movie_rig.h"

#include "base/clock.h"
#include "base/log.h"
#include "draw/movie_stream.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>

static OzLog *said;

static const char *stream_path(void)
{
    static char path[256];
    snprintf(path, sizeof path, "%s/stream", folder);
    return path;
}

static OzMovieStream *open_stream(void)
{
    OzMovieStream *stream = NULL;
    if (oz_movie_stream_create(&stream, stream_path()) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    return stream;
}

/* Shows a frame and returns how long that took, s. */
static double show(OzMovieStream *stream, int frame)
{
    OzImage image = {WIDTH, HEIGHT, malloc(4 * WIDTH * HEIGHT)};
    paint(&image, frame);
    double start = oz_clock_now();
    oz_movie_stream_show(stream, &image, FPS);
    double spent = oz_clock_now() - start;
    free(image.pixels);
    return spent;
}

/* In the log since the test began. */
static int count_said(const char *words)
{
    char *text = NULL;
    int count = 0;
    assert_int_equal(oz_file_read(&text, NULL, in_folder("log")), OZ_OK);
    for (char *at = text; (at = strstr(at, words)); at++) {
        count++;
    }
    free(text);
    return count;
}

static void assert_colour(const Decoded *decoded, int index, int frame)
{
    for (int k = 0; k < 3; k++) {
        assert_true(abs(decoded->colour[index][k] - PALETTE[frame / 10 % 5][k]) <= 8);
    }
}

/* How many frames of what is there so far decode, once it has a head; waits for that many. */
static int wait_for_frames(Decoded *decoded, int frames)
{
    double start = oz_clock_now();
    decoded->frames = 0;
    while (decoded->frames < frames && oz_clock_now() - start < 20) {
        struct stat what;
        if (stat(stream_path(), &what) == 0 && what.st_size > 1000) {
            decode(stream_path(), decoded);
            av_dict_free(&decoded->metadata);
        }
        usleep(10000);
    }
    return decoded->frames;
}

/* Each frame is there and whole before the next is shown: nothing waits for a later one. */
static void test_at_once(void **state)
{
    (void)state;
    static Decoded decoded;
    OzMovieStream *stream = open_stream();
    for (int frame = 0; frame < FRAMES; frame += 10) {
        show(stream, frame);
        assert_int_equal(wait_for_frames(&decoded, frame / 10 + 1), frame / 10 + 1);
        assert_colour(&decoded, frame / 10, frame);
    }
    oz_movie_stream_finish(stream);
    assert_int_equal(count_said("stream: 5 of 5 pictures"), 1);
    OzMovieStream *refused = NULL;
    assert_int_equal(oz_movie_stream_create(&refused, stream_path()), OZ_ERR_INPUT);
    assert_non_null(strstr(oz_status_text(), "is there already"));
    assert_null(refused);
    remove(stream_path());
}

/* As fast as they come: some are left out, the newest never. */
static void test_newest_is_shown(void **state)
{
    (void)state;
    static Decoded decoded;
    OzMovieStream *stream = open_stream();
    for (int frame = 0; frame < 200; frame++) {
        show(stream, frame < 199 ? 10 : 25);
    }
    oz_movie_stream_finish(stream);
    decode(stream_path(), &decoded);
    av_dict_free(&decoded.metadata);
    assert_true(decoded.frames > 1 && decoded.frames <= 200 && decoded.broken == 0);
    assert_colour(&decoded, decoded.frames - 1, 25);
    remove(stream_path());
}

/* The longest that showing took; a picture is copied in a millisecond, and a loaded machine may
 * take its time over that, but never as long as a reader that sleeps. */
static double show_many(OzMovieStream *stream, int count)
{
    double longest = 0;
    for (int frame = 0; frame < count; frame++) {
        longest = fmax(longest, show(stream, frame));
    }
    return longest;
}

static void test_nobody_reads(void **state)
{
    (void)state;
    assert_int_equal(mkfifo(stream_path(), 0600), 0);
    OzMovieStream *stream = open_stream();
    double start = oz_clock_now();
    assert_true(show_many(stream, 50) < 2);
    oz_movie_stream_finish(stream);
    assert_true(oz_clock_now() - start < 10);
    assert_int_equal(count_said("stream: 0 of 50 pictures"), 1);
    remove(stream_path());
}

/* He comes late, reads the first bytes and sleeps: a pipe holds a few frames. */
static void test_reader_sleeps(void **state)
{
    (void)state;
    char bytes[5];
    assert_int_equal(mkfifo(stream_path(), 0600), 0);
    OzMovieStream *stream = open_stream();
    show(stream, 0);
    int reader = open(stream_path(), O_RDONLY);
    assert_int_equal(read(reader, bytes, 5), 5);
    assert_memory_equal(bytes, "\x1a\x45\xdf\xa3", 4); /* EBML, which Matroska is written in */
    assert_true(fcntl(reader, F_SETPIPE_SZ, 4096) >= 0);
    assert_true(show_many(stream, 300) < 2);
    double start = oz_clock_now();
    oz_movie_stream_finish(stream);
    assert_true(oz_clock_now() - start < 10);
    assert_int_equal(count_said("its reader takes no more"), 1);
    close(reader);
    remove(stream_path());
}

static void test_reader_leaves(void **state)
{
    (void)state;
    char byte;
    assert_int_equal(mkfifo(stream_path(), 0600), 0);
    OzMovieStream *stream = open_stream();
    show(stream, 0);
    int reader = open(stream_path(), O_RDONLY);
    assert_int_equal(read(reader, &byte, 1), 1);
    close(reader);
    for (int frame = 0; frame < 200; frame++) {
        show(stream, frame);
        usleep(1000);
    }
    oz_movie_stream_finish(stream);
    assert_int_equal(count_said("its reader has left; the run goes on without it"), 1);
    remove(stream_path());
}

static int open_log(void **state)
{
    if (make_folder(state) != 0 || oz_log_create(&said, NULL, false) != OZ_OK) {
        return -1;
    }
    oz_log_use(said);
    signal(SIGPIPE, SIG_IGN); /* as the program does */
    return oz_log_open(said, in_folder("log")) == OZ_OK ? 0 : -1;
}

static int close_log(void **state)
{
    (void)state;
    oz_log_use(NULL);
    oz_log_free(said);
    remove(in_folder("log"));
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_at_once),       cmocka_unit_test(test_newest_is_shown),
        cmocka_unit_test(test_nobody_reads),  cmocka_unit_test(test_reader_sleeps),
        cmocka_unit_test(test_reader_leaves),
    };
    av_log_set_level(AV_LOG_QUIET); /* files are read while they grow */
    return cmocka_run_group_tests(tests, open_log, close_log);
}
