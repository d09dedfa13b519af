/* `orzo draw`: what is asked for is drawn from the nearest stored frame, or refused by name. */
#include "program.h"

#include "command/redraw_plan.h"
#include "model/insert.h"
#include "observe/frames.h"

#include <math.h>

enum { FRAMES = 11 }; /* a tenth of a second apart */

static const char text[] = "model: rods\n"
                           "time: {step: 1e-3, duration: 1}\n"
                           "contact: {contact_time: 1e-2, restitution: 0.5}\n"
                           "grains: [{kind: single, diameter: 1e-3, position: [0, 0, 2e-3]}]\n"
                           "walls: [{kind: plane}, {kind: cylinder, diameter: 8e-3}]\n"
                           "movie: {size: [160, 120], fps: 10, colour: speed}\n"
                           "snapshots: {times: [0.5]}\n";

static void must(OzStatus status)
{
    if (status != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
}

/* What such a run keeps of frame k. */
static int purpose_of(int k)
{
    return OZ_FRAME_MOVIE | (k == 5 ? OZ_FRAME_SNAPSHOT : 0);
}

/* A run's folder: the scene and its frames, the grain a little higher in each. */
static void make_run(void)
{
    OzScene scene;
    OzGrains grains;
    OzSnapshot now;
    OzFrames *frames = NULL;
    assert_int_equal(mkdir("run", 0777), 0);
    write_file("run/scene.yaml", "%s", text);
    must(oz_scene_parse(&scene, "scene.yaml", text, NULL, 0));
    must(oz_insert_grains(&grains, &scene));
    must(oz_snapshot_create(&now, &scene, &grains));
    must(oz_frames_create(&frames, "run/frames.bin", &scene, &grains));
    for (int k = 0; k < FRAMES; k++) {
        now.step = 100 * k;
        now.time = 0.1 * k;
        now.position[2] = 1e-3 + 1e-4 * k;
        now.quaternion[0] = 1;
        must(oz_frames_add(frames, &now, purpose_of(k)));
    }
    must(oz_frames_finish(frames));
    oz_snapshot_free(&now);
    oz_grains_free(&grains);
    oz_scene_free(&scene);
}

static int begin(void **state)
{
    if (enter_work(state) != 0) {
        return -1;
    }
    make_run();
    return 0;
}

/* The plan for the run's scene with these settings, and that scene. */
static OzRedrawPlan plan_for(OzScene *asked, const char *const *settings, int count)
{
    OzScene run;
    OzRedrawPlan plan = {0};
    must(oz_scene_parse(&run, "scene.yaml", text, NULL, 0));
    must(oz_scene_parse(asked, "scene.yaml", text, (char *const *)(uintptr_t)settings, count));
    for (int k = 0; k < FRAMES; k++) {
        must(oz_redraw_plan_note(&plan, 0.1 * k, purpose_of(k)));
    }
    must(oz_redraw_plan_choose(&plan, &run, asked));
    oz_scene_free(&run);
    return plan;
}

static void same_times_are_the_stored_frames(void **state)
{
    (void)state;
    static const char *const settings[] = {"movie.colour=angle", "snapshots.size=[400, 400]"};
    OzScene asked;
    OzRedrawPlan plan = plan_for(&asked, settings, 2);
    for (int k = 0; k < FRAMES; k++) {
        assert_int_equal(plan.frames[k].purpose, purpose_of(k));
        assert_int_equal(plan.frames[k].repeats, 1);
    }
    oz_redraw_plan_free(&plan);
    oz_scene_free(&asked);
}

/* Thirty frames spread over the run's second: the ones nearest to k / 29 s. */
static void longer_movie_repeats_frames(void **state)
{
    (void)state;
    static const char *const settings[] = {"movie.length=3"};
    int expected[FRAMES] = {0};
    OzScene asked;
    OzRedrawPlan plan = plan_for(&asked, settings, 1);
    for (int k = 0; k < 30; k++) {
        expected[(int)floor(k / 29.0 * 10 + 0.5)]++;
    }
    for (int k = 0; k < FRAMES; k++) {
        assert_int_equal(plan.frames[k].repeats, expected[k]);
    }
    oz_redraw_plan_free(&plan);
    oz_scene_free(&asked);
}

static void slower_rate_leaves_frames_out(void **state)
{
    (void)state;
    static const char *const settings[] = {"movie.speed=2"};
    OzScene asked;
    OzRedrawPlan plan = plan_for(&asked, settings, 1);
    for (int k = 0; k < FRAMES; k++) {
        assert_int_equal(plan.frames[k].repeats, k % 2 == 0);
    }
    oz_redraw_plan_free(&plan);
    oz_scene_free(&asked);
}

/* What lies beyond the run is left out; what is off by less than half a step keeps its time. */
static void snapshots_come_from_the_nearest_frame(void **state)
{
    (void)state;
    static const char *const settings[] = {"snapshots.times=[0.24, 0.2604, 0.7004, 7]"};
    OzScene asked;
    OzRedrawPlan plan = plan_for(&asked, settings, 1);
    for (int k = 0; k < FRAMES; k++) {
        bool wanted = k == 2 || k == 3 || k == 7;
        assert_int_equal((plan.frames[k].purpose & OZ_FRAME_SNAPSHOT) != 0, wanted);
    }
    /* the frames' own times: whole steps times the step, rounded once */
    assert_true(fabs(asked.snapshots.times[0] - 0.2) < 1e-12);
    assert_true(fabs(asked.snapshots.times[1] - 0.3) < 1e-12);
    assert_true(asked.snapshots.times[2] == 0.7004);
    oz_redraw_plan_free(&plan);
    oz_scene_free(&asked);
}

/* Settling's frames, which come first, are of another time: five, a fifth of a second apart. */
static OzRedrawPlan plan_settled(const char *const *settings, int count)
{
    OzScene run, asked;
    OzRedrawPlan plan = {0};
    must(oz_scene_parse(&run, "scene.yaml", text, NULL, 0));
    must(oz_scene_parse(&asked, "scene.yaml", text, (char *const *)(uintptr_t)settings, count));
    for (int k = 0; k < 5; k++) {
        must(oz_redraw_plan_note(&plan, 0.2 * k, OZ_FRAME_MOVIE | OZ_FRAME_SETTLING));
    }
    for (int k = 0; k < FRAMES; k++) {
        must(oz_redraw_plan_note(&plan, 0.1 * k, purpose_of(k)));
    }
    must(oz_redraw_plan_choose(&plan, &run, &asked));
    assert_int_equal(plan.settling, 5);
    oz_scene_free(&run);
    oz_scene_free(&asked);
    return plan;
}

static void settling_is_drawn_where_it_is_asked_for(void **state)
{
    (void)state;
    static const char *const settings[] = {"movie.settle=true", "movie.speed=4",
                                           "snapshots.times=[0.4]"};
    OzRedrawPlan plan = plan_settled(settings, 0);
    for (int k = 0; k < 5; k++) {
        assert_int_equal(plan.frames[k].purpose, 0);
    }
    oz_redraw_plan_free(&plan);
    plan = plan_settled(settings, 1);
    for (int k = 0; k < 5; k++) {
        assert_int_equal(plan.frames[k].purpose, OZ_FRAME_MOVIE | OZ_FRAME_SETTLING);
        assert_int_equal(plan.frames[k].repeats, 1);
    }
    assert_int_equal(plan.frames[5].purpose, OZ_FRAME_MOVIE);
    oz_redraw_plan_free(&plan);
    plan = plan_settled(settings, 3); /* 0.4 s a frame, in settling and after */
    for (int k = 0; k < 5 + FRAMES; k++) {
        bool every = k < 5 ? k % 2 == 0 : (k - 5) % 4 == 0;
        assert_int_equal(plan.frames[k].repeats, every);
        assert_int_equal((plan.frames[k].purpose & OZ_FRAME_SNAPSHOT) != 0, k == 5 + 4);
    }
    oz_redraw_plan_free(&plan);
}

static void what_is_off_is_said(void **state)
{
    (void)state;
    expect(0, "time 0.24 s is drawn from the stored frame nearest in time, 0.2 s, 0.04 s off",
           "draw run -o nearest --set movie=false --set 'snapshots.times=[0.24]'");
    assert_true(is_there("nearest/snapshots/time_0.200000.png"));
    expect(0, "movie: 30 frames, each from the stored one nearest in time, up to 0.0483 s off",
           "draw run -o longer --set movie.length=3"); /* 1 / 29 s x 14: 0.4827 s */
    assert_true(is_playable("longer/movie.mp4"));
    expect(0, "settling is not shown, for the run stored none",
           "draw run -o settled --set movie.settle=true");
    expect(0, "snapshots.times 7 s beyond the run's end at 1 s are not drawn",
           "draw run -o late --set 'snapshots.times=[0.5, 7]'");
}

static void physics_is_refused_by_name(void **state)
{
    (void)state;
    expect(2, "contact.friction, walls.1.diameter: frames that are stored cannot be changed",
           "draw run -o none --set contact.friction=0.1 --set title=x --set walls.1.diameter=9e-3");
    expect(2, "frames.bin has no contacts", "draw run -o none --set movie.chains=true");
    expect(2, "nothing to draw", "draw run -o none --set movie=false --set 'snapshots.times=[]'");
    assert_false(is_there("none"));
}

/* Without its movie a picture has the movie's size still, or its own. */
static void stills_without_the_movie_keep_its_size(void **state)
{
    (void)state;
    expect(0, "1 frames drawn", "draw run -o still --set movie=false");
    assert_false(is_there("still/movie.mp4"));
    char *png = read_file("still/snapshots/time_0.500000.png", NULL);
    assert_memory_equal(png + 16, "\0\0\0\xa0\0\0\0\x78", 8); /* 160 x 120 */
    free(png);
    expect(0, "1 frames drawn",
           "draw run -o large --set movie=false --set 'snapshots.size=[257, 67]'");
    png = read_file("large/snapshots/time_0.500000.png", NULL);
    assert_memory_equal(png + 16, "\0\0\1\1\0\0\0\x43", 8);
    free(png);
}

/* A still frames what the movie does, not what its own frame would. */
static void stills_frame_the_first_state(void **state)
{
    (void)state;
    expect(0, "frames drawn", "draw run -o all");
    expect(0, "frames drawn", "draw run -o one --set movie=false");
    assert_true(same_files("all/snapshots/time_0.500000.png", "one/snapshots/time_0.500000.png"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_times_are_the_stored_frames),
        cmocka_unit_test(longer_movie_repeats_frames),
        cmocka_unit_test(slower_rate_leaves_frames_out),
        cmocka_unit_test(snapshots_come_from_the_nearest_frame),
        cmocka_unit_test(settling_is_drawn_where_it_is_asked_for),
        cmocka_unit_test(what_is_off_is_said),
        cmocka_unit_test(physics_is_refused_by_name),
        cmocka_unit_test(stills_without_the_movie_keep_its_size),
        cmocka_unit_test(stills_frame_the_first_state),
    };
    return cmocka_run_group_tests(tests, begin, leave_work);
}
