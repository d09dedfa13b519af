/* When a run is looked at, counted by hand. */
#include "observe/schedule.h"

#include "model/motion.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* How often each kind of event is due in a whole run, and at which step each was last. */
typedef struct Tally {
    int count[5];
    int64_t last[5];
} Tally;

static Tally run_through(const OzScene *scene)
{
    Tally tally = {0};
    OzSchedule schedule = oz_schedule_create(scene, -1);
    int64_t step = -1, before = -1;
    int due = 0;
    while (oz_schedule_next(&schedule, &step, &due)) {
        assert_true(step > before);
        before = step;
        for (int k = 0; k < 5; k++) {
            tally.count[k] += due >> k & 1;
            tally.last[k] = due >> k & 1 ? step : tally.last[k];
        }
    }
    return tally;
}

enum { ROW, SAMPLE, MOVIE, SNAPSHOT, KEPT = 5 }; /* bits of what is due */

/* Four samples a period, the start's among them; a row every 30 ms and one at the end. */
static void test_rows_and_samples(void **state)
{
    (void)state;
    OzScene scene = {.step = 1e-3, .duration = 0.1, .period = 0.02};
    scene.observe.interval = 0.03;
    scene.observe.samples_per_tap = 4;
    Tally tally = run_through(&scene);
    assert_int_equal(tally.count[SAMPLE], 21);
    assert_int_equal(tally.last[SAMPLE], 100);
    assert_int_equal(tally.count[ROW], 5); /* 0, 30, 60, 90 and 100 ms */
    assert_int_equal(tally.last[ROW], 100);
}

/* A movie of two seconds has its frames from the first step to the last; by `speed` so many a
 * second of the simulation. */
static void test_frames(void **state)
{
    (void)state;
    OzScene scene = {.step = 1e-3, .duration = 0.95};
    scene.observe.interval = 1;
    scene.movie = (OzMovieSettings){.present = true, .length = 2, .fps = 10};
    Tally tally = run_through(&scene);
    assert_int_equal(tally.count[MOVIE], 20);
    assert_int_equal(tally.last[MOVIE], 950);
    scene.movie = (OzMovieSettings){.present = true, .speed = 0.1, .fps = 10};
    tally = run_through(&scene);
    assert_int_equal(tally.count[MOVIE], 96); /* every 10 ms */
    assert_int_equal(tally.last[MOVIE], 950);
}

/* Frames farther apart than the floor's period stand at one phase of it. */
static void test_frames_stand_with_the_floor(void **state)
{
    (void)state;
    OzScene scene = {.step = 1e-3, .duration = 1.9, .period = 0.03};
    scene.movie = (OzMovieSettings){.present = true, .length = 2, .fps = 10};
    OzSchedule schedule = oz_schedule_create(&scene, -1);
    assert_true(fabs(schedule.track[OZ_TRACK_FRAME].interval - 0.09) <
                1e-15); /* 0.1, to whole periods */
    scene.duration = 0.19;
    schedule = oz_schedule_create(&scene, -1);
    assert_true(fabs(schedule.track[OZ_TRACK_FRAME].interval - 0.01) < 1e-15);
}

/* The steps, of 1 ms, at which a kind of event is due up to `most`, as text. */
static void list_steps(OzSchedule *schedule, int kind, int64_t most, char *text, size_t size)
{
    int64_t step = 0;
    int due = 0;
    size_t used = strlen(text);
    while (step < most && oz_schedule_next(schedule, &step, &due)) {
        if (due >> kind & 1) {
            used += (size_t)snprintf(text + used, size - used, "%d ", (int)step);
        }
    }
}

/* 10 Hz until 30 ms, when 20 Hz are asked for; the floor takes them at 50 ms, in tap 0.5. Rows lie
 * at whole taps, samples at quarters, whatever the frequency; what is told in seconds stays. */
static void test_taps_across_a_change(void **state)
{
    (void)state;
    OzWall old = {.motion = {.present = true, .frequency = 10, .amplitude = 1}}, new = old;
    OzScene scene = {.step = 1e-3, .duration = 0.2, .taps = 2, .period = 0.1, .wall_count = 1};
    scene.observe.interval = 0.1;
    scene.observe.interval_taps = 1;
    scene.observe.samples_per_tap = 4;
    scene.walls = &old;
    OzScene next = scene;
    new.motion.frequency = 20;
    next.walls = &new;
    next.period = next.observe.interval = 0.05;
    oz_motion_take_over(&next, &scene, 0.03);
    for (int kind = ROW; kind <= SAMPLE; kind++) {
        char text[128] = "";
        OzSchedule schedule = oz_schedule_create(&scene, -1);
        list_steps(&schedule, kind, 25, text, sizeof text);
        oz_schedule_take_over(&schedule, &next, 30);
        list_steps(&schedule, kind, 1000, text, sizeof text);
        assert_string_equal(text, kind == ROW ? "0 75 125 " : "0 25 50 63 75 88 100 113 125 ");
        assert_int_equal(schedule.last_step, 125); /* tap 2 */
    }
}

/* Another interval begins at its own whole multiples after the change, frames stay as they were. An
 * end that has passed is now. */
static void test_seconds_across_a_change(void **state)
{
    (void)state;
    OzScene scene = {.step = 1e-3, .duration = 0.2}, next;
    char text[128] = "";
    scene.observe.interval = 0.03;
    scene.movie = (OzMovieSettings){.present = true, .speed = 0.4, .fps = 10};
    next = scene;
    next.observe.interval = 0.05;
    OzSchedule schedule = oz_schedule_create(&scene, -1), frames = schedule;
    list_steps(&schedule, ROW, 30, text, sizeof text);
    oz_schedule_take_over(&schedule, &next, 45);
    list_steps(&schedule, ROW, 1000, text, sizeof text);
    assert_string_equal(text, "0 30 50 100 150 200 ");
    text[0] = '\0';
    list_steps(&frames, MOVIE, 45, text, sizeof text);
    oz_schedule_take_over(&frames, &next, 90);
    list_steps(&frames, MOVIE, 1000, text, sizeof text);
    assert_string_equal(text, "0 40 80 120 160 200 ");
    next.duration = 0.01;
    schedule = oz_schedule_create(&scene, -1);
    text[0] = '\0';
    list_steps(&schedule, ROW, 30, text, sizeof text);
    oz_schedule_take_over(&schedule, &next, 45);
    list_steps(&schedule, ROW, 1000, text, sizeof text);
    assert_string_equal(text, "0 30 45 ");
}

/* A moment at the very step of a change is due once, whether it has been looked at or not. */
static void test_moments_at_a_change(void **state)
{
    (void)state;
    double times[] = {0, 0.03, 0.06};
    OzScene scene = {.step = 1e-3, .duration = 0.1}, next;
    scene.observe.interval = 0.1;
    scene.snapshots.times = scene.checkpoint.times = times;
    scene.snapshots.count = scene.checkpoint.count = 3;
    next = scene;
    for (int kind = SNAPSHOT; kind <= KEPT; kind += KEPT - SNAPSHOT) {
        for (int64_t before = 29; before <= 30; before++) {
            char text[128] = "";
            OzSchedule schedule = oz_schedule_create(&scene, -1), given;
            for (int64_t step = 0; step < before;) {
                int due = 0;
                given = schedule;
                assert_true(oz_schedule_next(&schedule, &step, &due));
                schedule = step > before ? given : schedule;
            }
            oz_schedule_take_over(&schedule, &next, 30);
            list_steps(&schedule, kind, 1000, text, sizeof text);
            assert_string_equal(text, before < 30 ? "30 60 " : "60 ");
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rows_and_samples),
        cmocka_unit_test(test_frames),
        cmocka_unit_test(test_frames_stand_with_the_floor),
        cmocka_unit_test(test_taps_across_a_change),
        cmocka_unit_test(test_seconds_across_a_change),
        cmocka_unit_test(test_moments_at_a_change),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
