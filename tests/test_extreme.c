/* The stiff and extreme suite, long rows shortened: each row is right or refused with a message, in
 * float and in double. `orzo report --extreme` prints the whole table. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "report/report_extreme.h"

#include <string.h>

static OzDevice device;

static int open_device(void **state)
{
    (void)state;
    return oz_device_open(&device, NULL, 0) == OZ_OK ? 0 : -1;
}

static int close_device(void **state)
{
    (void)state;
    oz_device_close(&device);
    return 0;
}

static const OzExtremeCase *find(const char *name)
{
    for (const OzExtremeCase *row = oz_report_extreme_cases_suite.rows; row->name; row++) {
        if (strcmp(row->name, name) == 0) {
            return row;
        }
    }
    fail_msg("no row called %s", name);
    return NULL;
}

static void check_all(OzPrecision precision)
{
    int bad = 0;
    for (const OzExtremeCase *row = oz_report_extreme_cases_suite.rows; row->name; row++) {
        OzExtremeOutcome outcome;
        assert_int_equal(OZ_OK,
                         oz_report_extreme_try(&outcome, row, &device, precision, true, NULL));
        if (outcome.verdict != OZ_VERDICT_RIGHT && outcome.verdict != OZ_VERDICT_REFUSED) {
            print_error("%s: %g, expected %g ... %g; %s\n", row->name, outcome.value, row->low,
                        row->high, outcome.message);
            bad++;
        }
    }
    assert_int_equal(0, bad);
}

static void test_float(void **state)
{
    (void)state;
    check_all(OZ_PRECISION_FLOAT);
}

static void test_double(void **state)
{
    (void)state;
    if (device.has_double) {
        check_all(OZ_PRECISION_DOUBLE);
    }
}

/* The verdicts themselves: a range that is missed is told from one that is met. */
static void test_a_missed_range_is_wrong(void **state)
{
    (void)state;
    OzExtremeOutcome outcome;
    OzExtremeCase row = *find("crossed at 90 degrees");
    row.low = 0.6;
    row.high = 0.7;
    assert_int_equal(
        OZ_OK, oz_report_extreme_try(&outcome, &row, &device, OZ_PRECISION_FLOAT, true, NULL));
    assert_int_equal(OZ_VERDICT_WRONG, outcome.verdict);
    row.value = NULL;
    assert_int_equal(
        OZ_OK, oz_report_extreme_try(&outcome, &row, &device, OZ_PRECISION_FLOAT, true, NULL));
    assert_int_equal(OZ_VERDICT_WRONG, outcome.verdict);
}

static void test_a_refusal_has_a_message(void **state)
{
    (void)state;
    OzExtremeOutcome outcome;
    assert_int_equal(OZ_OK, oz_report_extreme_try(&outcome, find("speed above a diameter per step"),
                                                  &device, OZ_PRECISION_FLOAT, true, NULL));
    assert_int_equal(OZ_VERDICT_REFUSED, outcome.verdict);
    assert_non_null(strstr(outcome.message, "radius in one step"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_float),
        cmocka_unit_test(test_double),
        cmocka_unit_test(test_a_missed_range_is_wrong),
        cmocka_unit_test(test_a_refusal_has_a_message),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
