/* Turns: cosine, sine and the angle between directions by polynomials against the C library's, and
 * the length that a quaternion keeps. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "sim/dialect.h"

#include "kernels/turn.h"

#include <math.h>
#include <stdlib.h>

/* A double's digits: the series ends below its last bit, a few roundings remain. Angles of up to
 * 2^20 quarter turns; pi/2 in two parts is right to 1e-27, far below that. */
static void test_cosine_and_sine(void **state)
{
    (void)state;
    for (int i = -20000; i <= 20000; i++) {
        double angle = i * 0.0123 * (i % 3 ? 1 : 1000);
        OzVec2 turn = oz_turn_of(angle);
        /* a last digit of each of both, 1e-16, with some to spare */
        assert_true(fabs(turn.x - cos(angle)) < 4e-16);
        assert_true(fabs(turn.y - sin(angle)) < 4e-16);
    }
    for (int quarter = -9; quarter <= 9; quarter++) { /* both sides of each seam */
        double seam = (quarter + 0.5) * 2 * atan(1);
        for (int side = -1; side <= 1; side += 2) {
            OzVec2 turn = oz_turn_of(seam + side * 1e-9);
            /* as above */
            assert_true(fabs(turn.x - cos(seam + side * 1e-9)) < 4e-16);
            assert_true(fabs(turn.y - sin(seam + side * 1e-9)) < 4e-16);
        }
    }
}

/* From any direction to any other of any length; beyond the most that it tells, that. Both
 * directions are rounded: a few last digits of numbers up to 6. */
static void test_angle_between(void **state)
{
    (void)state;
    for (int i = -3100; i <= 3100; i++) {
        double angle = i * 1e-3, from = 0.7 * (i % 9), length = 0.2 + 0.3 * (abs(i) % 7);
        OzVec2 start = {cos(from), sin(from)};
        OzVec2 end = {length * cos(from + angle), length * sin(from + angle)};
        double expected = fmax(-OZ_TURN_MOST, fmin(OZ_TURN_MOST, angle));
        /* some last digits of directions up to 6 rad: 7e-16 */
        assert_true(fabs(oz_turn_between(start, end, length) - expected) < 2e-15);
    }
}

static double length_of(OzQuaternion q)
{
    return sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
}

/* A free sphere's spin keeps its angular velocity: n turns of the angle are one turn of n times it.
 * Each is exact to 1e-8 up to 1 rad, and its length is brought back before errors add up. */
static void test_turning_keeps_its_length(void **state)
{
    (void)state;
    OzShape sphere = {.inverse_inertia = 2, .inverse_inertia_axis = 2};
    for (int gyroscopic = 0; gyroscopic < 2; gyroscopic++) {
        OzBody body = {.turn = {0, 0, 0, 1}};
        OzVec3 angular_velocity = {0.6, 0, 0.8};
        oz_host_switches_rods(&(OzSwitches){.gyroscopic = gyroscopic});
        for (int i = 0; i < 10000; i++) {
            oz_body_turn(&body, angular_velocity, sphere, gyroscopic ? 0.5 : 1);
            /* the series' error at 1 rad */
            assert_true(fabs(length_of(body.turn) - 1) < 1e-8);
        }
        double half = 0.5 * 10000;
        /* 10000 turns, each exact to 1e-10 at these angles */
        assert_true(fabs(body.turn.x - 0.6 * sin(half)) < 1e-5);
        assert_true(fabs(body.turn.z - 0.8 * sin(half)) < 1e-5);
        assert_true(fabs(body.turn.w - cos(half)) < 1e-5);
    }
    /* Newton's step for 1 / sqrt: an error of 1e-3 leaves 3/2 of its square and a third of 1e-3 of
     * that */
    OzQuaternion off = {0, 0.6 * 1.001, 0, 0.8 * 1.001};
    double left = length_of(oz_quaternion_add(off, oz_quaternion_to_unit(off))) - 1;
    assert_true(fabs(left / -1.5e-6 - 1) < 1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cosine_and_sine),
        cmocka_unit_test(test_angle_between),
        cmocka_unit_test(test_turning_keeps_its_length),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
