/* When a run is looked at, counted by hand. */
#include "observe/schedule.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

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

enum { ROW, SAMPLE, MOVIE };

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
    assert_true(fabs(schedule.frame - 0.09) < 1e-15); /* 0.1, to whole periods */
    scene.duration = 0.19;
    schedule = oz_schedule_create(&scene, -1);
    assert_true(fabs(schedule.frame - 0.01) < 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rows_and_samples),
        cmocka_unit_test(test_frames),
        cmocka_unit_test(test_frames_stand_with_the_floor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
