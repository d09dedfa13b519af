/* Names of single pictures: what was asked for, and one for each. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "draw/picture_name.h"

#include <math.h>
#include <string.h>

/* A scene of so many snapshots; with a period the numbers are taps. */
static OzScene make_scene(double *numbers, double *times, int count, double period, double step)
{
    OzScene scene = {.step = step, .period = period};
    for (int i = 0; i < count; i++) {
        times[i] = period > 0 ? numbers[i] * period : numbers[i];
    }
    scene.snapshots.times = times;
    scene.snapshots.count = count;
    scene.snapshots.taps = period > 0 ? numbers : NULL;
    scene.snapshots.tap_count = period > 0 ? count : 0;
    return scene;
}

/* The picture of snapshot i is drawn at the step that is nearest to its time. */
static void expect(const OzScene *scene, int i, const char *expected)
{
    char name[512];
    double time = round(scene->snapshots.times[i] / scene->step) * scene->step;
    oz_picture_name_make(scene, time, oz_picture_name_decimals(scene), name, sizeof name);
    assert_string_equal(name, expected);
}

static void times_below_a_microsecond_are_told_apart(void **state)
{
    (void)state;
    double numbers[] = {0, 1e-7, 2e-7, 4e-7, 1e-6}, times[5];
    OzScene scene = make_scene(numbers, times, 5, 0, 1e-8);
    expect(&scene, 0, "time_0.0000000.png");
    expect(&scene, 1, "time_0.0000001.png");
    expect(&scene, 4, "time_0.0000010.png");
}

static void plain_times_keep_six_digits(void **state)
{
    (void)state;
    double numbers[] = {0, 0.1, 1.25}, times[3];
    OzScene scene = make_scene(numbers, times, 3, 0, 1.5e-6);
    expect(&scene, 1, "time_0.100000.png"); /* the step's time is 0.1000005 s */
    expect(&scene, 2, "time_1.250000.png");
}

/* Taps a part in 1e5 apart are steps apart, and the whole one among them is one alone. */
static void near_taps_are_told_apart(void **state)
{
    (void)state;
    double numbers[] = {1, 1.0001, 1.0002, 300}, times[4];
    OzScene scene = make_scene(numbers, times, 4, 1.0 / 30, 2e-6);
    expect(&scene, 0, "tap_00001.png");
    expect(&scene, 1, "tap_00001.0001.png");
    expect(&scene, 2, "tap_00001.0002.png");
    expect(&scene, 3, "tap_00300.png");
    double few[] = {0.5, 3};
    scene = make_scene(few, times, 2, 1.0 / 30, 2e-5);
    expect(&scene, 0, "tap_00000.500.png");
    expect(&scene, 1, "tap_00003.png");
}

/* Two times in one step are one picture, for which names need no more digits. */
static void times_of_one_step_share_a_name(void **state)
{
    (void)state;
    double numbers[] = {0.1, 0.1 + 1e-12}, times[2];
    OzScene scene = make_scene(numbers, times, 2, 0, 1e-5);
    assert_int_equal(oz_picture_name_decimals(&scene), 6);
    expect(&scene, 1, "time_0.100000.png");
}

static void others_are_named_by_their_own_time(void **state)
{
    (void)state;
    char name[512];
    OzScene scene = {.step = 1e-5};
    oz_picture_name_make(&scene, 0.25, oz_picture_name_decimals(&scene), name, sizeof name);
    assert_string_equal(name, "time_0.250000.png");
    scene.period = 0.1;
    oz_picture_name_make(&scene, 0.300004, oz_picture_name_decimals(&scene), name, sizeof name);
    assert_string_equal(name, "tap_00003.png"); /* taps are met to half a step */
    oz_picture_name_make(&scene, 0.33, oz_picture_name_decimals(&scene), name, sizeof name);
    assert_string_equal(name, "tap_00003.300.png");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(times_below_a_microsecond_are_told_apart),
        cmocka_unit_test(plain_times_keep_six_digits),
        cmocka_unit_test(near_taps_are_told_apart),
        cmocka_unit_test(times_of_one_step_share_a_name),
        cmocka_unit_test(others_are_named_by_their_own_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
