/* Polygons cut into triangles, whatever their corners, and what is refused as none. */
#include "outlines.h"

#include "base/random.h"
#include "model/triangulation.h"

#include <string.h>

/* Comb of four teeth, spiral, thin quadrilateral; each as x y of its corners. */
static const double COMB[] = {0, 0, 7, 0, 7, 3, 6, 3, 6, 1, 5, 1, 5, 3, 4, 3,
                              4, 1, 3, 1, 3, 3, 2, 3, 2, 1, 1, 1, 1, 3, 0, 3};
static const double SPIRAL[] = {0, 0, 6, 0, 6, 6, 1, 6, 1, 2, 4, 2, 4, 4,
                                3, 4, 3, 3, 2, 3, 2, 5, 5, 5, 5, 1, 0, 1};
static const double KITE[] = {-10, 0, 0, -1, 10, 0, 0, 1};

static const struct {
    const double *corners;
    int count;
} awkward[] = {{COMB, 16}, {SPIRAL, 14}, {ARROW, 4}, {ELL, 6}, {KITE, 4}};

static double shoelace(const double *p, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) {
        const double *a = p + 2 * i, *b = p + 2 * ((i + 1) % n);
        sum += 0.5 * (a[0] * b[1] - b[0] * a[1]);
    }
    return sum;
}

static bool holds(const OzTriangleSet *triangle_set, int t, double x, double y)
{
    double c[6];
    oz_triangle_set_corners(triangle_set, t, c);
    for (int k = 0; k < 3; k++) {
        const double *a = c + 2 * k, *b = c + 2 * ((k + 1) % 3);
        if ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1]) <= 0) {
            return false;
        }
    }
    return true;
}

/* No point is in two triangles; with equal areas that makes a tiling. */
static void check_tiling(const OzTriangleSet *triangle_set)
{
    OzRandom random = oz_random_stream(3, 0);
    for (int i = 0; i < 500; i++) {
        double x = oz_random_uniform(&random, -10, 10), y = oz_random_uniform(&random, -1, 7);
        int count = 0;
        for (int t = 0; t < triangle_set->triangle_count; t++) {
            count += holds(triangle_set, t, x, y);
        }
        assert_true(count <= 1);
    }
}

static void cuts_awkward_polygons(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof awkward / sizeof *awkward; i++) {
        int n = awkward[i].count;
        double turned[32];
        for (int k = 0; k < n; k++) {
            memcpy(turned + 2 * k, awkward[i].corners + 2 * (n - 1 - k), 2 * sizeof(double));
        }
        for (int way = 0; way < 2; way++) {
            OzTriangleSet triangle_set;
            assert_int_equal(
                oz_triangulation_make(&triangle_set, way ? turned : awkward[i].corners, n, "here"),
                OZ_OK);
            assert_int_equal(triangle_set.triangle_count, n - 2);
            assert_int_equal(triangle_set.joint_count, n - 3);
            assert_int_equal(triangle_set.outline_count, n);
            close_to(triangle_set.area, fabs(shoelace(awkward[i].corners, n)));
            double gap[2];
            close_to(outline_area(&triangle_set, gap), triangle_set.area);
            check_tiling(&triangle_set);
            oz_triangle_set_free(&triangle_set);
        }
    }
}

/* Of the kite's diagonals the short one gives the fatter triangles. */
static void cuts_across_the_short_way(void **state)
{
    (void)state;
    OzTriangleSet triangle_set;
    assert_int_equal(oz_triangulation_make(&triangle_set, KITE, 4, "here"), OZ_OK);
    close_to(oz_triangle_set_joint_length(&triangle_set, 0), 20.0 / 3);
    oz_triangle_set_free(&triangle_set);
}

/* The angle at a triangle's corner that the other one has not. */
static double angle_across(const OzTriangleSet *triangle_set, int t, int other)
{
    const int *own = triangle_set->triangle + 3 * t, *its = triangle_set->triangle + 3 * other;
    int k = 0;
    while (k < 2 && (own[k] == its[0] || own[k] == its[1] || own[k] == its[2])) {
        k++;
    }
    const double *a = triangle_set->vertex + 2 * own[k],
                 *b = triangle_set->vertex + 2 * own[(k + 1) % 3],
                 *c = triangle_set->vertex + 2 * own[(k + 2) % 3];
    double sine = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    double cosine = (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1]);
    return atan2(sine, cosine);
}

/* Angles across an edge add up to half a turn at most, or the other diagonal would be better. */
static void check_delaunay(const OzTriangleSet *triangle_set)
{
    for (int k = 0; k < triangle_set->joint_count; k++) {
        int a = triangle_set->joint[2 * k], b = triangle_set->joint[2 * k + 1];
        /* four corners on a circle may go either way: rounding of pi */
        assert_true(angle_across(triangle_set, a, b) + angle_across(triangle_set, b, a) <=
                    PI + 1e-14);
    }
}

/* Random star-shaped polygons, most of them jagged. */
static void cuts_random_polygons(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 200; seed++) {
        OzRandom random = oz_random_stream(seed, 0);
        double corners[80];
        int n = 3 + (int)(seed % 38);
        for (int i = 0; i < n; i++) {
            double radius = oz_random_uniform(&random, 0.2, 1);
            corners[2 * i] = radius * cos(2 * PI * i / n);
            corners[2 * i + 1] = radius * sin(2 * PI * i / n);
        }
        OzTriangleSet triangle_set;
        assert_int_equal(oz_triangulation_make(&triangle_set, corners, n, "here"), OZ_OK);
        /* rounding of a sum of n products */
        assert_true(fabs(triangle_set.area - shoelace(corners, n)) <= ROUNDING * n);
        assert_int_equal(triangle_set.joint_count, n - 3);
        check_delaunay(&triangle_set);
        oz_triangle_set_free(&triangle_set);
    }
}

static void refuse_corners(const double *corners, int count, const char *text)
{
    OzTriangleSet triangle_set;
    assert_int_equal(oz_triangulation_make(&triangle_set, corners, count, "grains.yaml:7"),
                     OZ_ERR_INPUT);
    assert_string_equal(oz_status_text(), text);
    assert_null(triangle_set.vertex);
}

static void refuses_what_is_no_simple_polygon(void **state)
{
    (void)state;
    const double closed[] = {0, 0, 1, 0, 0, 1, 0, 0};
    refuse_corners(
        closed, 4,
        "grains.yaml:7: corners 0 and 3 of the grain are the same point (0, 0); expected "
        "each once, the first not repeated at the end");
    const double straight[] = {0, 0, 1, 0, 2, 0, 0, 1};
    refuse_corners(
        straight, 4,
        "grains.yaml:7: corner 1 (1, 0) of the grain lies on the line of its neighbours; "
        "expected it left out");
    const double bow[] = {0, 0, 1, 1, 1, 0, 0, 1};
    refuse_corners(bow, 4,
                   "grains.yaml:7: the edges from corner 0 and from corner 2 of the grain meet; "
                   "expected a simple polygon");
    const double touching[] = {0, 0, 4, 0, 4, 2, 2, 0, 0, 2};
    refuse_corners(touching, 5,
                   "grains.yaml:7: the edges from corner 0 and from corner 2 of the grain meet; "
                   "expected a simple polygon");
    refuse_corners(touching, 2, "grains.yaml:7: a grain of 2 corners; expected 3 to 300");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cuts_awkward_polygons),
        cmocka_unit_test(cuts_across_the_short_way),
        cmocka_unit_test(cuts_random_polygons),
        cmocka_unit_test(refuses_what_is_no_simple_polygon),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
