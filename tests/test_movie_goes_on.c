/* A movie that goes on from a state, whatever became of it since, is the one of a straight run. */
#include "movie_parts.h"

static void write_part(const char *bytes, int64_t length)
{
    FILE *file = fopen(part_path(), "w");
    assert_int_equal(fwrite(bytes, 1, (size_t)length, file), length);
    fclose(file);
}

/* The 20 frames of a state are found whatever part of two more lies behind them. */
static void test_goes_on_from_any_cut(void **state)
{
    (void)state;
    int64_t ends[2 + 2 * FRAMES];
    for (int e = 0; e < 2; e++) {
        char *bytes = NULL;
        OzMovie *movie = open_movie(ENCODERS[e]);
        must(add_frames(movie, 0, 20));
        save_state(movie, "early");
        must(add_frames(movie, 20, 22));
        save_state(movie, "late");
        assert_int_equal(find_ends(part_path(), ends, 2 + 2 * FRAMES), 2 + 2 * 22);
        must(oz_file_read(&bytes, NULL, part_path()));
        must(oz_movie_finish(movie));
        remove(movie_path());
        for (int64_t length = ends[2 + 2 * 20 - 1]; length < ends[2 + 2 * 22 - 1]; length += 7) {
            write_part(bytes, length);
            must(oz_movie_finish(load_state("early")));
            assert_int_equal(count_frames(movie_path()), 20);
            remove(movie_path());
        }
        free(bytes);
        remove_all();
    }
}

/* All frames, with states after 20, 40 and 41 of them; the process that goes on from each of these
 * is killed somewhat later. */
static void write_straight(const char *encoder, char **bytes, size_t *length)
{
    OzMovie *movie = open_movie(encoder);
    must(add_frames(movie, 0, 20));
    save_state(movie, "early");
    must(add_frames(movie, 20, 40));
    save_state(movie, "early");
    must(add_frames(movie, 40, 41));
    save_state(movie, "early");
    must(add_frames(movie, 41, 100));
    must(oz_movie_finish(movie));
    assert_int_equal(count_frames(movie_path()), 100);
    must(oz_file_read(bytes, length, movie_path()));
    remove_all();
}

/* Goes on from the state "late" (from none: begins), saves it anew after `save`, adds up to `end`,
 * and is no more. */
static void write_and_die(const char *encoder, int first, int save, int end)
{
    pid_t child = fork();
    int outcome = 0;
    if (child == 0) {
        OzMovie *movie = first ? load_state("late") : open_movie(encoder);
        must(add_frames(movie, first, save));
        save_state(movie, "late");
        must(add_frames(movie, save, end));
        kill(getpid(), SIGKILL);
    }
    waitpid(child, &outcome, 0);
    assert_true(WIFSIGNALED(outcome) && WTERMSIG(outcome) == SIGKILL);
}

static void assert_same(const char *bytes, size_t length)
{
    char *found = NULL;
    size_t found_length = 0;
    assert_int_equal(count_frames(movie_path()), 100);
    must(oz_file_read(&found, &found_length, movie_path()));
    assert_int_equal(found_length, length);
    assert_memory_equal(found, bytes, length);
    free(found);
    assert_false(is_left("movie.mp4.part") || is_left("movie.mp4.new"));
}

static void test_goes_on(void **state)
{
    (void)state;
    for (int e = 0; e < 2; e++) {
        char *bytes = NULL;
        size_t length = 0;
        write_straight(ENCODERS[e], &bytes, &length);
        write_and_die(ENCODERS[e], 0, 20, 63);
        assert_true(count_torn(part_path(), TORN) >= 63 - 30);
        write_and_die(ENCODERS[e], 20, 40, 40);
        write_and_die(ENCODERS[e], 40, 41, 60);
        OzMovie *movie = load_state("late");
        assert_int_equal(count_frames(part_path()), 41);
        must(add_frames(movie, 41, 100));
        must(oz_movie_finish(movie));
        assert_same(bytes, length);
        assert_true(find_box(movie_path(), "moov") < find_box(movie_path(), "mdat"));
        free(bytes);
        remove_all();
    }
}

/* A movie that had its name already is left alone until the longer one is whole. */
static void test_goes_on_after_the_end(void **state)
{
    (void)state;
    for (int e = 0; e < 2; e++) {
        OzMovie *movie = open_movie(ENCODERS[e]);
        must(add_frames(movie, 0, 30));
        save_state(movie, "early");
        must(add_frames(movie, 30, 35));
        must(oz_movie_finish(movie));
        movie = load_state("early");
        must(add_frames(movie, 30, 50));
        assert_int_equal(count_frames(movie_path()), 35);
        must(oz_movie_finish(movie));
        assert_int_equal(count_frames(movie_path()), 50);
        movie = load_state("early"); /* and nothing more comes */
        must(oz_movie_finish(movie));
        assert_int_equal(count_frames(movie_path()), 30);
        remove_all();
    }
}

/* Every frame an encoder of its own, as of a run that draws less than one a checkpoint. */
static void test_state_after_every_frame(void **state)
{
    (void)state;
    for (int e = 0; e < 2; e++) {
        OzMovie *movie = open_movie(ENCODERS[e]);
        for (int frame = 0; frame < 12; frame++) {
            must(add_frames(movie, frame, frame + 1));
            save_state(movie, "early");
            assert_int_equal(count_frames(part_path()), frame + 1);
        }
        must(oz_movie_finish(movie));
        assert_int_equal(count_frames(movie_path()), 12);
        remove_all();
    }
}

static void refuse_state(const char *text)
{
    OzMovie *movie = NULL;
    assert_int_equal(visit_state(&movie, "early", true), OZ_ERR_MOVIE);
    assert_null(movie);
    if (!strstr(oz_status_text(), text)) {
        fail_msg("%s lacks %s", oz_status_text(), text);
    }
    assert_false(is_left("movie.mp4.new"));
}

static void test_refusals(void **state)
{
    (void)state;
    OzMovie *movie = open_movie("mpeg4");
    must(add_frames(movie, 0, 30));
    save_state(movie, "early");
    must(oz_movie_finish(movie));
    movie = open_movie("mpeg4");
    must(add_frames(movie, 0, 29));
    must(oz_movie_finish(movie));
    refuse_state("movie.mp4 holds 29 frames; expected the first 30");
    remove(movie_path());
    refuse_state("cannot read /tmp/orzo-movie-");
    FILE *file = fopen(part_path(), "w");
    fputs("no movie", file);
    fclose(file);
    refuse_state("movie.mp4.part: Invalid data");
    remove_all();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_goes_on),
        cmocka_unit_test(test_goes_on_from_any_cut),
        cmocka_unit_test(test_goes_on_after_the_end),
        cmocka_unit_test(test_state_after_every_frame),
        cmocka_unit_test(test_refusals),
    };
    av_log_set_level(AV_LOG_QUIET); /* files are cut on purpose */
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
