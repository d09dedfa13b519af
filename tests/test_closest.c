/* Closest points of two shafts in double precision, against a search that shares no code with them.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "shafts.h"

#define OZ_HOST
#include "kernels/closest.h"

static OzClosest closest_of(const OzCapsule pair[2])
{
    const double *x = pair[0].centre, *y = pair[1].centre;
    const double *a = pair[0].half_shaft, *b = pair[1].half_shaft;
    return oz_closest(oz_vec3(x[0] - y[0], x[1] - y[1], x[2] - y[2]), oz_vec3(a[0], a[1], a[2]),
                      oz_vec3(b[0], b[1], b[2]));
}

/* Rounding of coordinates up to 5, a few times over. */
static void test_distance_is_the_least(void **state)
{
    (void)state;
    for (int k = 0; k < SHAFT_PAIRS; k++) {
        OzCapsule pair[2];
        make_pair(pair, k);
        OzClosest at = closest_of(pair);
        assert_true(at.s >= -1 && at.s <= 1 && at.t >= -1 && at.t <= 1);
        double excess = distance_between(pair, at.s, at.t) - brute_distance(&pair[0], &pair[1]);
        if (!(fabs(excess) < allowed_excess(pair, 1e-14, 1e-12))) {
            fail_msg("pair %d: %g too far", k, excess);
        }
    }
}

/* Shafts of half-lengths 1 and `half_length` along x, the second one's centre at x. */
static OzClosest side_by_side(double x, double half_length, double direction)
{
    return oz_closest(oz_vec3(-x, -1, 0), oz_vec3(1, 0, 0), oz_vec3(direction * half_length, 0, 0));
}

/* Exact in double: every number is a small multiple of a power of two. */
static void test_parallel_shafts_touch_amid_their_common_span(void **state)
{
    (void)state;
    for (int direction = -1; direction <= 1; direction += 2) {
        OzClosest same = side_by_side(0, 1, direction);
        assert_true(same.s == 0 && same.t == 0);
        OzClosest shifted = side_by_side(1, 1, direction); /* common span 0...1 */
        assert_true(shifted.s == 0.5 && shifted.t == -0.5 * direction);
        OzClosest inside = side_by_side(0.5, 0.25, direction); /* 0.25...0.75 */
        assert_true(inside.s == 0.5 && inside.t == 0);
        OzClosest beyond = side_by_side(4, 2, direction); /* nearest ends */
        assert_true(beyond.s == 1 && beyond.t == -direction);
    }
}

static void test_crossing_shafts_meet(void **state)
{
    (void)state;
    OzClosest at = oz_closest(oz_vec3(-0.5, 0.25, 0), oz_vec3(1, 0, 0), oz_vec3(0, 1, 0));
    assert_true(at.s == 0.5 && at.t == 0.25);
    at = oz_closest(oz_vec3(0, 0, 0), oz_vec3(1, 0, 0), oz_vec3(1, 0, 0)); /* coincident */
    assert_true(at.s == 0 && at.t == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_distance_is_the_least),
        cmocka_unit_test(test_parallel_shafts_touch_amid_their_common_span),
        cmocka_unit_test(test_crossing_shafts_meet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
