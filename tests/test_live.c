/* Those who look on while a run goes: --stream and --latest as a user meets them, and that the run
 * is the same without them. ORZO_NEEDS_DEVICE. */
#include "program.h"
#include "run_bed.h"

static int make_bed(void **state)
{
    if (enter_work(state) != 0) {
        return -1;
    }
    write_file("bed.yaml", "%s", bed);
    write_file("shown.yaml", "%s%s", bed, pictures);
    return orzo("run shown.yaml -o shown");
}

static void assert_matroska(const char *name)
{
    size_t size = 0;
    char *bytes = read_file(name, &size);
    assert_true(size > 1000);
    assert_memory_equal(bytes, "\x1a\x45\xdf\xa3", 4); /* EBML */
    assert_non_null(memmem(bytes, 64, "matroska", 8));
    free(bytes);
}

static void assert_same_run(const char *folder)
{
    static const char *const names[] = {"movie.mp4", "series.csv", "final.csv", "frames.bin",
                                        "snapshots/tap_00001.png"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char one[64], other[64];
        snprintf(one, sizeof one, "shown/%s", names[i]);
        snprintf(other, sizeof other, "%s/%s", folder, names[i]);
        assert_true(same_files(one, other));
    }
}

static void test_stream_and_latest(void **state)
{
    (void)state;
    assert_int_equal(orzo("run shown.yaml -o both --stream both.mkv --latest"), 0);
    assert_matroska("both.mkv");
    assert_same_run("both");
    assert_true(contains("both/log.txt", "stream: "));
    assert_true(contains("both/.orzo", "latest.png"));
    assert_false(is_there("both/latest.png.part") || is_there("shown/latest.png"));
    /* The movie's last frame, which is a snapshot of the end in the same look. */
    assert_int_equal(orzo("run shown.yaml -o end --latest --set 'snapshots.taps=[2]'"), 0);
    assert_true(same_files("end/latest.png", "end/snapshots/tap_00002.png"));
    assert_true(same_files("end/latest.png", "both/latest.png"));
    assert_int_equal(orzo("resume both --set time.taps=3 --latest --stream more.mkv"), 0);
    assert_matroska("more.mkv");
    assert_false(same_files("end/latest.png", "both/latest.png"));
    assert_int_equal(orzo("run shown.yaml -o both --overwrite"), 0);
    assert_false(is_there("both/latest.png"));
}

/* Nothing but Matroska, and a reader that leaves ends the stream alone. */
static void test_standard_output(void **state)
{
    (void)state;
    char command[1024];
    snprintf(command, sizeof command,
             "'%s' run shown.yaml -o out --stream - 2>err >out.mkv && "
             "{ '%s' run shown.yaml -o left --stream - 2>left.err; echo $? >left.status; } | true",
             ORZO_PROGRAM, ORZO_PROGRAM);
    assert_int_equal(system(command), 0);
    assert_matroska("out.mkv");
    assert_same_run("out");
    assert_true(contains("err", "grains"));
    assert_true(contains("left.status", "0\n"));
    assert_true(contains("left/log.txt",
                         "cannot write to standard output: its reader has left; the run goes on"));
    assert_same_run("left");
}

static void test_members(void **state)
{
    (void)state;
    assert_int_equal(orzo("run shown.yaml -o seeds --seeds 1..2 --latest --stream seeds.mkv"), 0);
    assert_true(contains("seeds/log.txt", "--stream and --latest show the first member"));
    assert_true(is_there("seeds/seed_00001/latest.png"));
    assert_false(is_there("seeds/seed_00002/latest.png"));
    assert_matroska("seeds.mkv");
}

static void test_refusals(void **state)
{
    (void)state;
    expect(2, "expected --stream with the name of a file", "run shown.yaml --stream ''");
    expect(2, "FILE|- is missing", "run shown.yaml --stream");
    write_file("mine.mkv", "mine");
    expect(2, "mine.mkv is there already", "run shown.yaml -o no --overwrite --stream mine.mkv");
    assert_true(contains("mine.mkv", "mine"));
    assert_false(is_there("no") || is_there("x"));
}

/* Without a movie, or with a slow one, pictures are drawn for those who look on, and no file is
 * another for it. */
static void test_without_movie(void **state)
{
    (void)state;
    static const char *const names[] = {"series.csv", "final.csv"};
    static const char *const folders[] = {"plain/", "glanced/", "no_video/"};
    assert_int_equal(orzo("run bed.yaml -o plain"), 0);
    assert_int_equal(orzo("run bed.yaml -o glanced --latest --stream glanced.mkv"), 0);
    assert_int_equal(orzo("run shown.yaml -o no_video --no-video --latest"), 0);
    assert_matroska("glanced.mkv");
    assert_true(is_there("glanced/latest.png") && is_there("no_video/latest.png"));
    assert_false(is_there("glanced/movie.mp4") || is_there("no_video/movie.mp4") ||
                 is_there("glanced/frames.bin"));
    for (int i = 0; i < 4; i++) {
        char one[64], other[64];
        snprintf(one, sizeof one, "%s%s", folders[0], names[i % 2]);
        snprintf(other, sizeof other, "%s%s", folders[1 + i / 2], names[i % 2]);
        assert_true(same_files(one, other));
    }
    /* Paced so that wall seconds lie between the movie's two frames. */
    assert_int_equal(orzo("run shown.yaml -o slow --realtime 0.02 --set movie.length=0.2"), 0);
    assert_int_equal(orzo("run shown.yaml -o between --realtime 0.02 --set movie.length=0.2 "
                          "--stream between.mkv"),
                     0);
    assert_true(same_files("slow/movie.mp4", "between/movie.mp4"));
    assert_true(same_files("slow/snapshots/tap_00001.png", "between/snapshots/tap_00001.png"));
    int taken = 0, shown = 0;
    char *log = read_file("between/log.txt", NULL), *line = strstr(log, "stream: ");
    assert_int_equal(line ? sscanf(line, "stream: %d of %d", &taken, &shown) : 0, 2);
    assert_true(shown > 2); /* which are the movie's */
    free(log);
}

/* What cannot be written is said, and the run is none the worse. */
static void test_nowhere(void **state)
{
    (void)state;
    assert_int_equal(orzo("run shown.yaml -o nowhere --stream gone/x.mkv"), 0);
    assert_true(contains("nowhere/log.txt", "gone/x.mkv: No such file or directory; the run goes"));
    assert_same_run("nowhere");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stream_and_latest), cmocka_unit_test(test_standard_output),
        cmocka_unit_test(test_members),           cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_nowhere),           cmocka_unit_test(test_without_movie),
    };
    return cmocka_run_group_tests(tests, make_bed, leave_work);
}
