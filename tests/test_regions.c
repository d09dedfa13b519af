/* The regions that grains are put into at random, columns of rods and basins of trigrains, against
 * plain geometry: how large they are, what they draw, what they hold. */
#include "model/element_walls.h"
#include "model/fill_region.h"
#include "model/fill_region_flat.h"
#include "model/insert.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double pi = 3.14159265358979323846;

/* Sums and roots of a few numbers: rounding. */
static void assert_near(double found, double expected)
{
    if (!(fabs(found - expected) <= 1e-12 * fabs(expected))) {
        fail_msg("%.17g is not %.17g", found, expected);
    }
}

static OzScene scene_with(OzWall *walls, int count)
{
    return (OzScene){.path = "made.yaml", .walls = walls, .wall_count = count};
}

/* The volume asked is shared by the directions that are open; a tube's is that of its circle. */
static void test_columns_have_the_volume(void **state)
{
    (void)state;
    OzWall walls[] = {{.kind = OZ_WALL_PLANE, .normal = {0, 0, 1}, .point = {0, 0, 0.5}},
                      {.kind = OZ_WALL_PLANE, .normal = {0, 0, -1}, .point = {0, 0, 2.5}},
                      {.kind = OZ_WALL_CYLINDER, .diameter = 0.4}};
    OzScene open = scene_with(walls, 0), layer = scene_with(walls, 2), tube = open;
    OzFillRegion fill_region = oz_fill_region_make(&open, 0.027, 0.1);
    for (int k = 0; k < 3; k++) {
        assert_near(fill_region.high[k] - fill_region.low[k], 0.3);
        assert_near(fill_region.high[k], 0.15);
    }
    fill_region = oz_fill_region_make(&layer, 18, 0.1);
    assert_near(fill_region.high[0] - fill_region.low[0], 3);
    assert_near(fill_region.high[1], 1.5);
    assert_true(fill_region.low[2] == 0.5 && fill_region.high[2] == 2.5);
    tube.walls = &walls[2];
    tube.wall_count = 1;
    fill_region = oz_fill_region_make(&tube, 0.02, 0.1);
    assert_true(fill_region.low[2] == 0);
    assert_near(fill_region.high[2], 0.02 / (pi / 4 * 0.16));
    assert_near(fill_region.high[0], 0.2);
    assert_near(oz_fill_region_make(&tube, 1e-6, 0.7).high[2], 0.7); /* room for the longest */
}

/* A tenth more of volume, whatever the number of open sides. */
static void test_columns_grow_by_a_tenth(void **state)
{
    (void)state;
    OzWall walls[] = {{.kind = OZ_WALL_PLANE, .normal = {0, 0, 1}},
                      {.kind = OZ_WALL_PLANE, .normal = {0, 0, -1}, .point = {0, 0, 2}}};
    for (int count = 0; count <= 2; count++) {
        OzScene scene = scene_with(walls, count);
        OzFillRegion fill_region = oz_fill_region_make(&scene, 3, 0.1), before = fill_region;
        double grown = 1;
        assert_true(oz_fill_region_raise(&fill_region));
        for (int k = 0; k < 3; k++) {
            grown *= (fill_region.high[k] - fill_region.low[k]) / (before.high[k] - before.low[k]);
        }
        assert_near(grown, 1.1);
        assert_true(count == 0 || fill_region.low[2] == 0);
    }
}

/* What is drawn lies inside as a whole, and comes near every side. */
static void test_columns_draw_whole_capsules(void **state)
{
    (void)state;
    OzScene scene = scene_with(NULL, 0);
    OzFillRegion fill_region = oz_fill_region_make(&scene, 1, 0.1);
    OzCapsule capsule = {.half_shaft = {0.1, -0.2, 0.05}, .radius = 0.03};
    OzRandom random = oz_random_stream(5, 1);
    double least[3] = {1, 1, 1}, most[3] = {-1, -1, -1};
    for (int n = 0; n < 2000; n++) {
        oz_fill_region_draw(&fill_region, &random, &capsule);
        for (int k = 0; k < 3; k++) {
            double extent = fabs(capsule.half_shaft[k]) + capsule.radius;
            least[k] = fmin(least[k], capsule.centre[k] - extent);
            most[k] = fmax(most[k], capsule.centre[k] + extent);
        }
    }
    for (int k = 0; k < 3; k++) { /* of 2000 even draws the outermost leaves 1/2000 on average */
        assert_true(least[k] >= -0.5 && least[k] < -0.49 && most[k] <= 0.5 && most[k] > 0.49);
    }
}

/* Whether a region holds a circle at `out` (a unit vector) from a point of the container's boundary
 * at a distance of radius and tooth, within rounding of it on either side. */
static void check_edge(const OzFillRegionFlat *fill_region, const double at[2], const double out[2],
                       double radius)
{
    for (int side = -1; side <= 1; side += 2) {
        double away = radius + fill_region->container->tooth_depth + side * 1e-9;
        double centre[2] = {at[0] + away * out[0], at[1] + away * out[1]};
        assert_int_equal(oz_fill_region_flat_holds(fill_region, centre, radius), side > 0);
    }
}

static void test_basins_keep_off_their_container(void **state)
{
    (void)state;
    const double slope = 0.9, c = cos(slope), s = sin(slope), x = 0.01, y = 0.02;
    OzWall drum = {
        .kind = OZ_WALL_DRUM, .diameter = 0.06, .tooth_depth = 1e-3, .point = {0.01, 0.02}};
    OzWall hopper = {.kind = OZ_WALL_HOPPER,
                     .width = 0.06,
                     .height = 0.1,
                     .opening = 0.01,
                     .slope = slope,
                     .tooth_depth = 1e-3,
                     .point = {0.01, 0.02}};
    OzFillRegionFlat fill_region = {.container = &drum};
    for (double angle = 0; angle < 6; angle += 0.7) {
        check_edge(&fill_region, (double[2]){x + 0.03 * cos(angle), y + 0.03 * sin(angle)},
                   (double[2]){-cos(angle), -sin(angle)}, 2e-3);
    }
    fill_region.container = &hopper;
    for (int side = -1; side <= 1; side += 2) {
        for (double up = 0.005; up < 0.03; up += 0.005) { /* along the slope, from its lip */
            check_edge(&fill_region, (double[2]){x + side * (0.005 + up * c), y + up * s},
                       (double[2]){-side * s, c}, 2e-3);
        }
    }
}

/* A face without a container: circles nearer to it than their radius touch it, on both its sides.
 */
static void test_basins_keep_off_walls(void **state)
{
    (void)state;
    OzWall wall = {
        .kind = OZ_WALL_SEGMENT, .from = {-1, 0}, .to = {1, 0}, .thickness = 0.1, .until = 0};
    OzTriangleSet triangle_set;
    OzFillRegionFlat fill_region = {
        .walls = &triangle_set, .wall_count = 1, .low = {-1, -1}, .high = {1, 1}};
    assert_int_equal(oz_element_walls_make(&triangle_set, &wall, 0.1), OZ_OK);
    for (int side = -1; side <= 1; side += 2) {
        double above[2] = {0.2, 0.05 + 1e-9 * side}, below[2] = {0.2, -0.15 - 1e-9 * side};
        double beyond[2] = {0.2, 0.95 - 1e-9 * side};
        assert_int_equal(oz_fill_region_flat_holds(&fill_region, above, 0.05), side > 0);
        assert_int_equal(oz_fill_region_flat_holds(&fill_region, below, 0.05), side > 0);
        assert_int_equal(oz_fill_region_flat_holds(&fill_region, beyond, 0.05), side > 0);
    }
    oz_triangle_set_free(&triangle_set);
}

/* Circles around the grains fill the share asked of a vessel's column, wherever they lie in it. */
static void test_basins_are_as_high_as_asked(void **state)
{
    (void)state;
    OzScene scene;
    OzGrains grains;
    const char *text =
        "model: trigrains\ntime: {step: 1e-6, duration: 1}\n"
        "contact: {contact_time: 1e-4, restitution: 0.5}\ngrains:\n"
        "  - {kind: random, shape: disc, radius: 1e-3, density: 4, count: 200, fill: 0.2}\n"
        "walls: [{kind: vessel, width: 0.04, height: 0.2}]\n";
    if (oz_scene_parse(&scene, "made.yaml", text, NULL, 0) != OZ_OK ||
        oz_insert_grains(&grains, &scene) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    double height = 200 * pi * 1e-6 / 0.2 / 0.04, top = 0;
    for (int64_t i = 0; i < grains.count; i++) {
        top = fmax(top, grains.position[3 * i + 1]);
    }
    /* discs of a radius of 0.013 height; of 200 the highest centre is within some hundredths of
     * the top */
    assert_true(top < height && top > 0.9 * height);
    oz_grains_free(&grains);
    oz_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_columns_have_the_volume),
        cmocka_unit_test(test_columns_grow_by_a_tenth),
        cmocka_unit_test(test_columns_draw_whole_capsules),
        cmocka_unit_test(test_basins_keep_off_their_container),
        cmocka_unit_test(test_basins_keep_off_walls),
        cmocka_unit_test(test_basins_are_as_high_as_asked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
