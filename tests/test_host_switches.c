/* The host's switches are those of the innermost block that says so, of each thread by itself, and
 * those of before when the block is left, by a return in its middle too. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "sim/host_switches.h"

#include <pthread.h>

static int law_now(void)
{
    return oz_host_switches_now.rods.law;
}

static int leave_early(bool early)
{
    OZ_USE_SWITCHES(oz_host_switches_rods(&(OzSwitches){.law = OZ_LAW_HERTZ}));
    if (early) {
        return law_now();
    }
    oz_host_switches_now.rods.law = OZ_LAW_HERTZ_MINDLIN;
    return law_now();
}

static void test_blocks_put_back_what_was(void **state)
{
    (void)state;
    OZ_USE_SWITCHES(oz_host_switches_rods(&(OzSwitches){.law = OZ_LAW_HERTZ_MINDLIN, .line = 1}));
    for (int early = 0; early < 2; early++) {
        assert_int_equal(leave_early(early), early ? OZ_LAW_HERTZ : OZ_LAW_HERTZ_MINDLIN);
        assert_int_equal(law_now(), OZ_LAW_HERTZ_MINDLIN);
        assert_int_equal(oz_host_switches_now.rods.line, 1);
    }
}

static void *look(void *law)
{
    *(int *)law = law_now();
    return leave_early(false) ? law : NULL;
}

static void test_threads_have_their_own(void **state)
{
    (void)state;
    OZ_USE_SWITCHES(oz_host_switches_rods(&(OzSwitches){.law = OZ_LAW_HERTZ}));
    pthread_t thread;
    int law = -1;
    assert_int_equal(pthread_create(&thread, NULL, look, &law), 0);
    pthread_join(thread, NULL);
    assert_int_equal(law, OZ_LAW_HOOKE);
    assert_int_equal(law_now(), OZ_LAW_HERTZ);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_blocks_put_back_what_was),
        cmocka_unit_test(test_threads_have_their_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
