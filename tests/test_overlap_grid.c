/* One grain's shape, mass and orientation, and the search for overlaps among many. */
#include "brute.h"

#include "base/random.h"
#include "model/grains.h"
#include "model/overlap_grid.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static const double pi = 3.14159265358979323846;

static OzCapsule random_capsule(OzRandom *random, double side, double radius, double half_length)
{
    OzCapsule capsule = {.radius = radius};
    double axis[3];
    oz_random_direction(random, axis);
    for (int k = 0; k < 3; k++) {
        capsule.centre[k] = oz_random_uniform(random, -side, side);
        capsule.half_shaft[k] = half_length * axis[k];
    }
    return capsule;
}

/* Thin slices across the shaft: each a disc of radius s. */
static void integrate_shape(double diameter, double length, double density, double result[3])
{
    double r = 0.5 * diameter, half = 0.5 * length;
    int slices = 200000;
    double thickness = 2 * (half + r) / slices;
    result[0] = result[1] = result[2] = 0;
    for (int i = 0; i < slices; i++) {
        double z = -half - r + (i + 0.5) * thickness;
        double over = fmax(fabs(z) - half, 0);
        double s2 = r * r - over * over;
        double mass = density * pi * s2 * thickness;
        result[0] += mass;
        result[1] += mass * (0.25 * s2 + z * z);
        result[2] += mass * 0.5 * s2;
    }
}

static void test_mass_and_inertia(void **state)
{
    (void)state;
    double aspects[] = {0, 1e-3, 1, 4, 100};
    OzGrains grains;
    assert_int_equal(oz_grains_create(&grains, 1), OZ_OK);
    for (size_t a = 0; a < sizeof aspects / sizeof *aspects; a++) {
        double expected[3];
        grains.diameter[0] = 2e-3;
        grains.length[0] = 2e-3 * aspects[a];
        oz_grains_set_mass(&grains, 0, 1200);
        integrate_shape(2e-3, grains.length[0], 1200, expected);
        /* The midpoint rule's error is (thickness / radius)^2, at most 3e-7 here. */
        assert_true(fabs(grains.mass[0] / expected[0] - 1) < 1e-6);
        assert_true(fabs(grains.inertia[0] / expected[1] - 1) < 1e-6);
        assert_true(fabs(grains.inertia_axis[0] / expected[2] - 1) < 1e-6);
    }
    oz_grains_free(&grains);
}

static void test_axis_and_quaternion(void **state)
{
    (void)state;
    OzRandom random = oz_random_stream(1, 1);
    for (int i = 0; i < 10000; i++) {
        double axis[3], quaternion[4], back[3], norm = 0;
        oz_random_direction(&random, axis);
        if (i < 6) {
            memset(axis, 0, sizeof axis);
            axis[i % 3] = i < 3 ? 1 : -1;
        }
        oz_grains_quaternion(axis, quaternion);
        oz_grains_axis(quaternion, back);
        for (int k = 0; k < 4; k++) {
            norm += quaternion[k] * quaternion[k];
        }
        for (int k = 0; k < 3; k++) {
            /* a root and some products of numbers up to 1: some last digits */
            assert_true(fabs(axis[k] - back[k]) < 1e-15);
        }
        assert_true(fabs(norm - 1) < 1e-15);
    }
}

static void test_distance(void **state)
{
    (void)state;
    OzRandom random = oz_random_stream(2, 1);
    for (int i = 0; i < 3000; i++) {
        OzCapsule a = random_capsule(&random, 1, 0.1, i % 5 ? 1 : 0);
        OzCapsule b = random_capsule(&random, 1, 0.1, i % 7 ? 0.5 : 0);
        if (i % 3 == 0) { /* parallel and nearly so */
            for (int k = 0; k < 3; k++) {
                b.half_shaft[k] = -0.7 * a.half_shaft[k] + (i % 2 ? 1e-9 : 0);
            }
        }
        /* A search by thirds finds the place to 1e-8, and the distance to the square of that,
         * unless the shafts intersect. */
        assert_true(fabs(oz_overlap_grid_distance(&a, &b) - brute_distance(&a, &b)) < 1e-13);
    }
}

/* Sizes over a factor of 100 and aspects to 1000, each asked about each: same answer as all pairs.
 */
static void test_crowd_against_all_pairs(void **state)
{
    (void)state;
    OzRandom random = oz_random_stream(3, 1);
    OzOverlapGrid overlap_grid = {0};
    OzCapsule capsules[400];
    int touching_count = 0;
    for (int i = 0; i < 400; i++) {
        double radius = pow(10, oz_random_uniform(&random, -2, 0)) * 0.2;
        double half = i % 3 ? radius * oz_random_uniform(&random, 0, 5) : i % 2 ? 0 : 1;
        capsules[i] = random_capsule(&random, 2, i % 12 ? radius : 1e-3, half);
    }
    for (int i = 0; i < 400; i++) {
        bool expected = false;
        for (int j = 0; j < i; j++) {
            expected |= brute_distance(&capsules[i], &capsules[j]) <
                        capsules[i].radius + capsules[j].radius;
        }
        assert_int_equal(oz_overlap_grid_touches(&overlap_grid, &capsules[i]), expected);
        touching_count += expected;
        assert_int_equal(oz_overlap_grid_add(&overlap_grid, &capsules[i]), OZ_OK);
    }
    assert_in_range(touching_count, 40, 360); /* both answers were tested */
    oz_overlap_grid_free(&overlap_grid);
}

/* Pairs that only just touch, or just do not, of any size ratio and aspect: none is out of reach.
 */
static void test_crowd_at_the_margin(void **state)
{
    (void)state;
    OzRandom random = oz_random_stream(4, 1);
    for (int i = 0; i < 20000; i++) {
        OzCapsule a = random_capsule(&random, 1, 0, i % 3 ? oz_random_uniform(&random, 0, 2) : 0);
        OzCapsule b = random_capsule(&random, 1, 0, i % 5 ? oz_random_uniform(&random, 0, 2) : 0);
        double distance = oz_overlap_grid_distance(&a, &b);
        OzOverlapGrid overlap_grid = {0};
        a.radius = distance * oz_random_uniform(&random, 0.01, 0.99);
        b.radius = distance * (1 + 1e-6) - a.radius;
        assert_int_equal(oz_overlap_grid_add(&overlap_grid, &a), OZ_OK);
        assert_true(oz_overlap_grid_touches(&overlap_grid, &b));
        b.radius = distance * (1 - 1e-6) - a.radius;
        assert_false(oz_overlap_grid_touches(&overlap_grid, &b));
        oz_overlap_grid_free(&overlap_grid);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mass_and_inertia),
        cmocka_unit_test(test_axis_and_quaternion),
        cmocka_unit_test(test_distance),
        cmocka_unit_test(test_crowd_against_all_pairs),
        cmocka_unit_test(test_crowd_at_the_margin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
