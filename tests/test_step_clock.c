/* Steps and times, over several stretches of steps of their own length. */
#include "model/step_clock.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* In a run with one stretch a time is the step times dt, to the bit. */
static void test_one_stretch(void **state)
{
    (void)state;
    OzStepClock clock = oz_step_clock_begin(1e-5);
    for (int64_t step = 0; step < 100000; step += 7) {
        assert_true(oz_step_clock_time(&clock, step) == (double)step * 1e-5);
        assert_int_equal(oz_step_clock_nearest(&clock, (double)step * 1e-5), step);
    }
    oz_step_clock_change(&clock, 777, 1e-5);
    assert_true(oz_step_clock_time(&clock, 778) == 778 * 1e-5);
}

/* Powers of two are exact: 10 steps of 1/4 s, 6 of 1/8 s, 3 of 1/2 s. */
static void test_stretches_add_up(void **state)
{
    (void)state;
    OzStepClock clock = oz_step_clock_begin(0.25);
    oz_step_clock_change(&clock, 10, 0.125);
    assert_true(oz_step_clock_time(&clock, 10) == 2.5);
    assert_true(oz_step_clock_time(&clock, 14) == 3);
    oz_step_clock_change(&clock, 16, 0.5);
    assert_true(oz_step_clock_time(&clock, 16) == 3.25);
    assert_true(oz_step_clock_time(&clock, 19) == 4.75);
    assert_int_equal(oz_step_clock_nearest(&clock, 4.7), 19);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_stretch),
        cmocka_unit_test(test_stretches_add_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
