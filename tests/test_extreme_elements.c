/* The stiff and extreme suite of trigrains, long rows shortened: each row is right, or refused with
 * the message that names what is wrong. `orzo report --extreme` prints the whole table. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "report/report_extreme.h"
#include "report/report_extreme_elements.h"

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

static OzExtremeOutcome outcome_of(const OzExtremeCase *row, OzPrecision precision)
{
    OzExtremeOutcome outcome;
    if (oz_report_extreme_try(&outcome, row, &device, precision, true, NULL) != OZ_OK) {
        fail_msg("%s: %s", row->name, oz_status_text());
    }
    return outcome;
}

static void check_all(OzPrecision precision)
{
    int bad = 0;
    for (const OzExtremeCase *row = oz_report_extreme_elements_suite.rows; row->name; row++) {
        if (oz_report_extreme_serves(row, precision)) {
            OzExtremeOutcome outcome = outcome_of(row, precision);
            if (outcome.verdict != OZ_VERDICT_RIGHT && outcome.verdict != OZ_VERDICT_REFUSED) {
                print_error("%s: %g, expected %g ... %g; %s\n", row->name, outcome.value, row->low,
                            row->high, outcome.message);
                bad++;
            }
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

static const OzExtremeCase *find(const char *name)
{
    for (const OzExtremeCase *row = oz_report_extreme_elements_suite.rows; row->name; row++) {
        if (strcmp(row->name, name) == 0) {
            return row;
        }
    }
    fail_msg("no row called %s", name);
    return NULL;
}

/* The verdicts themselves: a range that is missed, a refusal for another reason, none at all. */
static void test_verdicts(void **state)
{
    (void)state;
    OzExtremeCase row = *find("two stars");
    row.high = 1e-9; /* the force jumps of kinds ii to vi are far above */
    assert_int_equal(OZ_VERDICT_WRONG, outcome_of(&row, OZ_PRECISION_FLOAT).verdict);
    row.value = NULL;
    assert_int_equal(OZ_VERDICT_WRONG, outcome_of(&row, OZ_PRECISION_FLOAT).verdict);
    row = *find("a die inside another");
    row.says = "more than half";
    assert_int_equal(OZ_VERDICT_STOPPED, outcome_of(&row, OZ_PRECISION_FLOAT).verdict);
    row = *find("step 3 times too long");
    row.forced = true;
    assert_int_equal(OZ_VERDICT_WRONG, outcome_of(&row, OZ_PRECISION_FLOAT).verdict);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_float),
        cmocka_unit_test(test_double),
        cmocka_unit_test(test_verdicts),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
