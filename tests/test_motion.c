/* Walls whose motion changes: the closed form on both sides of the zero crossing. */
#include "model/motion.h"
#include "model/wall_motion.h"
#include "scene/scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

/* A scene of one wall that is shaken so. */
typedef struct Floor {
    OzWall wall;
    OzScene scene;
} Floor;

static void make(Floor *floor, double amplitude, double frequency)
{
    *floor = (Floor){0};
    floor->wall.motion =
        (OzMotion){.present = true, .amplitude = amplitude, .frequency = frequency};
    floor->scene.walls = &floor->wall;
    floor->scene.wall_count = 1;
    floor->scene.period = 1 / frequency;
}

static double offset_at(const Floor *floor, double time, double *speed)
{
    double offset = 0;
    oz_motion_offset(&floor->wall.motion, time, &offset, speed);
    return offset;
}

/* Of sums of a few numbers of order one. */
static const double rounding = 1e-12;

#define ASSERT_NEAR(a, b) assert_true(fabs((a) - (b)) < rounding)

/* 10 Hz and 20 Hz: asked for at 0.03 s, on at 0.05 s, where the old wall goes down through zero. */
static void test_takes_over_at_zero_crossing(void **state)
{
    (void)state;
    Floor old, next;
    double speed = 0, before = 0;
    make(&old, 1, 10);
    make(&next, 3, 20);
    next.scene.taps = 3;
    oz_motion_take_over(&next.scene, &old.scene, 0.03);
    for (double t = 0.03; t < 0.05; t += 0.003) {
        assert_true(offset_at(&next, t, &speed) == offset_at(&old, t, &before));
        assert_true(speed == before);
    }
    ASSERT_NEAR(offset_at(&next, 0.05, &speed), 0);
    ASSERT_NEAR(speed / (-3 * 2 * PI * 20), 1); /* on the way down, as before */
    ASSERT_NEAR(offset_at(&next, 0.05 + 0.0125, &speed), -3);
    ASSERT_NEAR(offset_at(&next, 0.05 + 0.0375, &speed), 3);
    ASSERT_NEAR(oz_motion_tap(&next.scene, 0.03), 0.3);
    ASSERT_NEAR(oz_motion_tap(&next.scene, 0.05), 0.5);
    ASSERT_NEAR(oz_motion_tap(&next.scene, 0.1), 1.5); /* half an old period, one new one */
    for (double t = 0; t < 0.3; t += 0.007) {
        ASSERT_NEAR(oz_motion_time(&next.scene, oz_motion_tap(&next.scene, t)), t);
    }
    ASSERT_NEAR(next.scene.duration, 0.05 + 2.5 / 20);
}

/* What nobody asked to change moves as before, to the bit, also while a change is still to come. */
static void test_unchanged_stays(void **state)
{
    (void)state;
    Floor first, second, third;
    double speed = 0, other = 0;
    make(&first, 1, 10);
    make(&second, 1, 10);
    oz_motion_take_over(&second.scene, &first.scene, 0.123);
    assert_true(offset_at(&second, 0.4567, &speed) == offset_at(&first, 0.4567, &other));
    make(&second, 2, 15);
    oz_motion_take_over(&second.scene, &first.scene, 0.123);
    make(&third, 2, 15);
    oz_motion_take_over(&third.scene, &second.scene, 0.13);
    for (double t = 0.1; t < 0.4; t += 0.013) {
        assert_true(offset_at(&third, t, &speed) == offset_at(&second, t, &other));
    }
}

/* A second change before the crossing replaces the first; asked for at the crossing it waits no
 * longer, and one after it goes on from there. */
static void test_changes_follow_each_other(void **state)
{
    (void)state;
    Floor first, second, third, fourth;
    double speed = 0;
    make(&first, 1, 10);
    make(&second, 2, 40);
    oz_motion_take_over(&second.scene, &first.scene, 0.01);
    make(&third, 5, 10);
    oz_motion_take_over(&third.scene, &second.scene, 0.02);
    ASSERT_NEAR(offset_at(&third, 0.025, &speed), 1);
    ASSERT_NEAR(offset_at(&third, 0.075, &speed), -5);
    make(&fourth, 7, 10);
    oz_motion_take_over(&fourth.scene, &third.scene, 0.1);
    ASSERT_NEAR(oz_motion_since(&fourth.scene), 0.1);
    ASSERT_NEAR(offset_at(&fourth, 0.125, &speed), 7);
    ASSERT_NEAR(oz_motion_tap(&fourth.scene, 0.2), 2);
}

/* 3 mm at 5 Hz, from 60 degrees of the sine on, between 0.2 and 0.73 s: where it was built before,
 * where it has come to afterwards; periods are counted from time 0. */
static void test_shakes_from_a_phase_between_two_times(void **state)
{
    (void)state;
    static const char text[] =
        "model: rods\ntime: {step: 1e-5, duration: 1}\n"
        "contact: {contact_time: 1e-3, restitution: 0.5}\n"
        "grains:\n  - {kind: single, diameter: 0.01, position: [0, 0, 0.1]}\nwalls:\n"
        "  - {kind: plane, motion: {frequency: 5, amplitude: 3, phase: 60, from: 0.2, until: "
        "0.73}}\n";
    OzScene scene;
    assert_int_equal(oz_scene_parse(&scene, "phase.yaml", text, NULL, 0), OZ_OK);
    const OzMotion *motion = &scene.walls[0].motion;
    for (double t = 0; t < 1; t += 0.0313) {
        double way = fmin(fmax(t, 0.2), 0.73) - 0.2, offset, speed, moves = t >= 0.2 && t < 0.73;
        oz_motion_offset(motion, t, &offset, &speed);
        ASSERT_NEAR(offset, 3 * (sin(2 * PI * 5 * way + PI / 3) - sin(PI / 3)));
        ASSERT_NEAR(speed / 100, moves * 0.3 * PI * cos(2 * PI * 5 * way + PI / 3));
        assert_true(fabs(offset) <= oz_motion_reach(motion));
        ASSERT_NEAR(oz_motion_tap(&scene, t), 5 * t);
        ASSERT_NEAR(oz_motion_time(&scene, 5 * t), t);
    }
    oz_scene_free(&scene);
}

/* 10 Hz from the sine's top on: asked for another at 0.01 s, it is on at 0.025 s, where the sine
 * crosses zero, 1 below where the wall was built. */
static void test_takes_over_from_a_phase(void **state)
{
    (void)state;
    Floor old, next;
    double speed = 0, before = 0;
    make(&old, 1, 10);
    old.wall.motion.shake = (OzShake){.phase = PI / 2, .base = 1};
    make(&next, 3, 20);
    oz_motion_take_over(&next.scene, &old.scene, 0.01);
    ASSERT_NEAR(oz_motion_since(&next.scene), 0.025);
    for (double t = 0.01; t < 0.025; t += 0.003) {
        assert_true(offset_at(&next, t, &speed) == offset_at(&old, t, &before));
    }
    ASSERT_NEAR(offset_at(&next, 0.025, &speed), -1);
    ASSERT_NEAR(speed / (-3 * 2 * PI * 20), 1);
    ASSERT_NEAR(offset_at(&next, 0.025 + 0.0125, &speed), -4);
    ASSERT_NEAR(oz_motion_tap(&next.scene, 0.025), 0.25);
    ASSERT_NEAR(oz_motion_tap(&next.scene, 0.075), 1.25);
    for (double t = 0; t < 0.3; t += 0.007) {
        ASSERT_NEAR(oz_motion_time(&next.scene, oz_motion_tap(&next.scene, t)), t);
    }
}

/* A drum changes at once, and its angle does not jump. */
static void test_drums_go_on_from_their_angle(void **state)
{
    (void)state;
    Floor slow = {.wall.motion = {.present = true, .angular_velocity = 2}}, fast = slow, again;
    slow.scene = fast.scene = (OzScene){.wall_count = 1};
    slow.scene.walls = &slow.wall;
    fast.scene.walls = &fast.wall;
    fast.wall.motion.angular_velocity = -5;
    oz_motion_take_over(&fast.scene, &slow.scene, 3);
    ASSERT_NEAR(oz_motion_turn(&fast.wall.motion, 3), 6);
    ASSERT_NEAR(oz_motion_turn(&fast.wall.motion, 4), 1);
    again = fast;
    again.scene.walls = &again.wall;
    again.wall.motion = (OzMotion){.present = true, .angular_velocity = -5};
    oz_motion_take_over(&again.scene, &fast.scene, 9);
    ASSERT_NEAR(oz_motion_turn(&again.wall.motion, 4), 1);
}

/* 0.5 m/s along a line, between 2 and 5 s, and without an end. */
static void test_goes_on_between_two_times(void **state)
{
    (void)state;
    Floor floor = {
        .wall.motion = {.present = true, .velocity = {0.3, 0, -0.4}, .from = 2, .until = 5}};
    static const double times[] = {-1, 0, 2, 3, 5, 9}, ways[] = {0, 0, 0, 0.5, 1.5, 1.5};
    static const double speeds[] = {0, 0, 0.5, 0.5, 0, 0};
    double speed = 0;
    for (int i = 0; i < 6; i++) {
        ASSERT_NEAR(offset_at(&floor, times[i], &speed), ways[i]);
        ASSERT_NEAR(speed, speeds[i]);
    }
    floor.wall.motion.until = 0;
    ASSERT_NEAR(offset_at(&floor, 9, &speed), 3.5);
    ASSERT_NEAR(speed, 0.5);
    ASSERT_NEAR(oz_motion_speed(&floor.wall.motion), 0.5);
}

/* 2 rad/s between 3 and 5 s; another rate that is asked for on the way ends then, too, and one that
 * is asked for before or after has not turned yet, or turns no more. */
static void test_turns_between_two_times(void **state)
{
    (void)state;
    Floor drum = {.wall.motion = {.present = true, .angular_velocity = 2, .from = 3, .until = 5}};
    static const double times[] = {0, 2.5, 3, 4, 5, 9}, angles[] = {0, 0, 0, 2, 4, 4};
    static const double rates[] = {0, 0, 2, 2, 0, 0}, asked[] = {1, 4, 8};
    static const double ends[] = {-6, -1, 4};
    drum.scene = (OzScene){.walls = &drum.wall, .wall_count = 1};
    for (int i = 0; i < 6; i++) {
        OzWallPose pose = oz_wall_motion_pose(&drum.wall, times[i], false);
        ASSERT_NEAR(pose.turn, angles[i]);
        ASSERT_NEAR(pose.angular_velocity, rates[i]);
        ASSERT_NEAR(oz_motion_turn(&drum.wall.motion, times[i]), angles[i]);
        ASSERT_NEAR(oz_motion_rate(&drum.wall.motion, times[i]), rates[i]);
    }
    for (int i = 0; i < 3; i++) {
        Floor next = drum;
        next.scene.walls = &next.wall;
        next.wall.motion.angular_velocity = -3;
        oz_motion_take_over(&next.scene, &drum.scene, asked[i]);
        ASSERT_NEAR(oz_motion_turn(&next.wall.motion, 9), ends[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_takes_over_at_zero_crossing),
        cmocka_unit_test(test_unchanged_stays),
        cmocka_unit_test(test_changes_follow_each_other),
        cmocka_unit_test(test_shakes_from_a_phase_between_two_times),
        cmocka_unit_test(test_takes_over_from_a_phase),
        cmocka_unit_test(test_drums_go_on_from_their_angle),
        cmocka_unit_test(test_goes_on_between_two_times),
        cmocka_unit_test(test_turns_between_two_times),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
