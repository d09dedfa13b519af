/* Movies whose writing ends before its time: by a kill at any moment, cut short, on a full disk.
 * What is there plays. */
#include "movie_parts.h"

#include <sys/resource.h>

/* A process that writes a movie, a byte into the pipe after each frame, and is killed when it has
 * said so many. Returns how many it had added by then, as far as it could say. */
static int kill_writer(const char *encoder, int frames, useconds_t later)
{
    int ends[2], said = 0;
    char byte = 0;
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    if (child == 0) {
        OzMovie *movie = open_movie(encoder);
        for (int frame = 0;; frame++) {
            must(add_frames(movie, frame, frame + 1));
            assert_int_equal(write(ends[1], &byte, 1), 1);
        }
    }
    close(ends[1]);
    while (said < frames && read(ends[0], &byte, 1) == 1) {
        said++;
    }
    usleep(later);
    kill(child, SIGKILL);
    while (read(ends[0], &byte, 1) == 1) {
        said++;
    }
    close(ends[0]);
    waitpid(child, NULL, 0);
    return said;
}

/* What the encoder held is lost (draw/movie.h), and what was being written. */
enum { LOST = 13 };

static void test_killed(void **state)
{
    (void)state;
    for (int e = 0; e < 2; e++) {
        for (int i = 0; i < 10; i++) {
            int said = kill_writer(ENCODERS[e], 31 + 7 * i, (useconds_t)(137 * i));
            int found = count_torn(part_path(), TORN);
            if (found < said - LOST || found > said + 1) {
                fail_msg("%s: %d frames play of the %d before the kill", ENCODERS[e], found, said);
            }
            assert_false(is_left("movie.mp4"));
            remove_all();
        }
    }
}

/* The file's two first boxes are its head, then every frame is two, of which the second is its
 * data.
 */
static void test_cut_in_a_frame(void **state)
{
    (void)state;
    int64_t ends[2 + 2 * FRAMES];
    for (int e = 0; e < 2; e++) {
        OzMovie *movie = open_movie(ENCODERS[e]);
        must(add_frames(movie, 0, FRAMES));
        save_state(movie, "early");
        assert_int_equal(find_ends(part_path(), ends, 2 + 2 * FRAMES), 2 + 2 * FRAMES);
        for (int whole = FRAMES - 1; whole > 0; whole--) {
            int64_t *end = ends + 1 + 2 * whole, cut = end[1] + (end[2] - end[1]) * (whole % 8) / 8;
            assert_int_equal(truncate(part_path(), whole % 8 ? cut : end[0]), 0);
            int found = count_torn(part_path(), TORN);
            if (found != whole && found != whole + 1) { /* a player may guess what is missing */
                fail_msg("%d frames play of the %d that are whole", found, whole);
            }
        }
        must(oz_movie_finish(movie));
        remove_all();
    }
}

/* Files of this process end here, as on a full disk. */
static void limit_files(rlim_t bytes)
{
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &(struct rlimit){bytes, RLIM_INFINITY}), 0);
}

/* The movie of what fits, and the failure with its reason. */
static void test_full_disk(void **state)
{
    (void)state;
    signal(SIGXFSZ, SIG_IGN); /* as the program does */
    for (int e = 0; e < 2; e++) {
        for (rlim_t most = 12000; most < 20000; most += 997) {
            OzMovie *movie = open_movie(ENCODERS[e]);
            limit_files(most);
            assert_int_equal(add_frames(movie, 0, FRAMES_MOST), OZ_ERR_MOVIE);
            assert_non_null(strstr(oz_status_text(), "File too large"));
            OzStatus finished = oz_movie_finish(movie);
            limit_files(RLIM_INFINITY);
            assert_int_equal(finished, OZ_ERR_MOVIE);
            assert_true(count_torn(movie_path(), TORN) > TORN);
            assert_false(is_left("movie.mp4.part") || is_left("movie.mp4.new"));
            remove_all();
        }
    }
    int64_t ends[2 + 2 * FRAMES_MOST];
    OzMovie *movie = open_movie("mpeg4");
    limit_files(30000);
    assert_int_equal(add_frames(movie, 0, FRAMES_MOST), OZ_ERR_MOVIE);
    limit_files(1000); /* not even once more */
    assert_int_equal(oz_movie_finish(movie), OZ_ERR_MOVIE);
    limit_files(RLIM_INFINITY);
    assert_true(find_ends(movie_path(), ends, 2 + 2 * FRAMES_MOST) > 2 + 2 * TORN);
    assert_true(count_torn(movie_path(), TORN) > TORN);
    remove_all();
    movie = open_movie(NULL);
    limit_files(1);
    assert_int_equal(add_frames(movie, 0, FRAMES), OZ_ERR_MOVIE);
    assert_int_equal(oz_movie_finish(movie), OZ_ERR_MOVIE);
    limit_files(RLIM_INFINITY);
    assert_false(is_left("movie.mp4") || is_left("movie.mp4.part") || is_left("movie.mp4.new"));
}

/* All frames are there and their file cannot be written once more. */
static void test_stays_in_fragments(void **state)
{
    (void)state;
    OzMovie *movie = open_movie(NULL);
    must(add_frames(movie, 0, FRAMES));
    save_state(movie, "early");
    limit_files(1000);
    OzStatus finished = oz_movie_finish(movie);
    limit_files(RLIM_INFINITY);
    must(finished);
    assert_int_equal(count_frames(movie_path()), FRAMES);
    assert_false(is_left("movie.mp4.part") || is_left("movie.mp4.new"));
    remove_all();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_killed),
        cmocka_unit_test(test_cut_in_a_frame),
        cmocka_unit_test(test_full_disk),
        cmocka_unit_test(test_stays_in_fragments),
    };
    av_log_set_level(AV_LOG_QUIET); /* files are cut on purpose */
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
