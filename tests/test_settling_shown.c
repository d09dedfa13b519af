/* `movie: {settle: true}`: settling is in the movie and in frames.bin before the run, which stays
 * as it was. ORZO_NEEDS_DEVICE. */
#include "program.h"
#include "run_bed.h"

#include "observe/frame_reader.h"
#include "scene/scene.h"

#include <math.h>

/* Members come to rest each at its own time; frames lie between looks at the energy. */
enum { STEPS = 65 }; /* between frames */
static const char settles[] =
    "settle: {drag: 70, threshold: 0.02, time_max: 0.3, rest_time: 0.01}\n";

static int begin(void **state)
{
    if (enter_work(state) != 0) {
        return -1;
    }
    write_file("base.yaml", "%s", bed);
    write_file("bed.yaml",
               "extends: base.yaml\n%smovie: {speed: 0.0325, size: [64, 64]}\n"
               "snapshots: {taps: [0, 1]}\n",
               settles);
    int status = orzo("run bed.yaml -o plain");
    return status == 0 ? orzo("run bed.yaml -o shown --set movie.settle=true") : status;
}

static void must(OzStatus status)
{
    if (status != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
}

/* Whether the files end alike, in the smaller one's last bytes after the head that both have. */
static bool end_alike(const char *large, const char *small, size_t head)
{
    size_t size_large, size_small;
    char *a = read_file(large, &size_large), *b = read_file(small, &size_small);
    size_t tail = size_small - head;
    bool same = size_large > size_small && memcmp(a, b, head) == 0 &&
                memcmp(a + size_large - tail, b + head, tail) == 0;
    free(a);
    free(b);
    return same;
}

/* What is observed, and the frames after settling, are those of a run that does not show it. */
static void the_run_stays_as_it_was(void **state)
{
    (void)state;
    assert_true(same_files("plain/series.csv", "shown/series.csv"));
    assert_true(same_files("plain/final.csv", "shown/final.csv"));
    assert_true(same_files("plain/snapshots/tap_00000.png", "shown/snapshots/tap_00000.png"));
    assert_true(same_files("plain/snapshots/tap_00001.png", "shown/snapshots/tap_00001.png"));
    assert_true(end_alike("shown/frames.bin", "plain/frames.bin", 32 + 30 * 28 + 8));
}

/* The steps of settling's frames are 0, 50, 100 ... from its beginning, and the run follows. */
static void frames_count_from_where_settling_began(void **state)
{
    (void)state;
    OzScene scene;
    OzGrains grains;
    OzSnapshot now;
    OzFrames *frames = NULL;
    int purpose = 0, settling = 0, after = 0;
    bool more_frames = true;
    must(oz_scene_load(&scene, "shown/scene.yaml", NULL, 0));
    must(oz_frame_reader_open(&frames, "shown/frames.bin", &grains));
    must(oz_snapshot_create(&now, &scene, &grains));
    for (;;) {
        must(oz_frame_reader_next(frames, &now, &purpose, &more_frames));
        if (!more_frames) {
            break;
        }
        if (purpose & OZ_FRAME_SETTLING) {
            assert_int_equal(after, 0);
            assert_int_equal(purpose, OZ_FRAME_MOVIE | OZ_FRAME_SETTLING);
            assert_int_equal(now.step, settling * STEPS);
            assert_true(fabs(now.time - 2e-5 * (double)now.step) < 1e-12); /* rounding */
            settling++;
        } else if (purpose & OZ_FRAME_MOVIE) {
            assert_int_equal(now.step, after * STEPS);
            after++;
        }
    }
    assert_in_range(settling, 8, 239); /* a frame is 1.3 ms; 10 ms of rest, and 300 ms at most */
    assert_int_equal(after, 31);
    oz_frames_finish(frames);
    oz_snapshot_free(&now);
    oz_grains_free(&grains);
    oz_scene_free(&scene);
}

/* Whatever its companions do meanwhile, and however many stops their frames make. */
static void members_have_frames_of_their_own(void **state)
{
    (void)state;
    struct stat first, second;
    expect(0, "1 launches at a time",
           "run bed.yaml -o seeds --no-video --threads 1 --seeds 1..3 "
           "--set movie.settle=true");
    assert_true(same_files("seeds/seed_00001/frames.bin", "shown/frames.bin"));
    expect(0, "and pictures",
           "run bed.yaml -o second --no-video --set seed=2 --set movie.settle=true");
    assert_true(same_files("seeds/seed_00002/frames.bin", "second/frames.bin"));
    assert_int_equal(stat("shown/frames.bin", &first), 0);
    assert_int_equal(stat("second/frames.bin", &second), 0);
    assert_true(first.st_size != second.st_size); /* they do not rest at the same time */
}

/* The run has 31 frames of its movie and a snapshot between them. */
static void draw_and_export_know_it(void **state)
{
    (void)state;
    expect(0, "frames drawn", "draw shown -o again");
    assert_true(same_files("again/snapshots/tap_00001.png", "shown/snapshots/tap_00001.png"));
    expect(0, "32 frames drawn", "draw shown -o without --set movie.settle=false");
    assert_true(same_files("without/snapshots/tap_00001.png", "shown/snapshots/tap_00001.png"));
    expect(0, "32 frames exported", "export shown --to csv -o out");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_run_stays_as_it_was),
        cmocka_unit_test(frames_count_from_where_settling_began),
        cmocka_unit_test(members_have_frames_of_their_own),
        cmocka_unit_test(draw_and_export_know_it),
    };
    return cmocka_run_group_tests(tests, begin, leave_work);
}
