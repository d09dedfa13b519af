/* Shapes of grains: their areas against formulas, their outlines closed, their beams; what is
 * refused, with its reason; and a hopper's corners. */
#include "outlines.h"

#include "model/element_walls.h"
#include "model/shape.h"

#include <string.h>

static OzScene scene_with(OzPopulation *population)
{
    population->line = 7;
    return (OzScene){.path = (char *)(uintptr_t) "grains.yaml",
                     .beams = {.length_min = 6e-4, .area_min = 4e-7},
                     .populations = population,
                     .population_count = 1};
}

static OzTriangleSet make(OzPopulation population, uint64_t seed)
{
    OzTriangleSet triangle_set;
    OzScene scene = scene_with(&population);
    OzRandom random = oz_random_stream(seed, 0);
    if (oz_shape_make(&triangle_set, &scene, &population, &random) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    return triangle_set;
}

static void refuses(OzPopulation population, const char *words)
{
    OzTriangleSet triangle_set;
    OzScene scene = scene_with(&population);
    OzRandom random = oz_random_stream(1, 0);
    assert_int_equal(oz_shape_make(&triangle_set, &scene, &population, &random), OZ_ERR_INPUT);
    assert_int_equal(triangle_set.triangle_count, 0);
    if (!strstr(oz_status_text(), words) || !strstr(oz_status_text(), "grains.yaml:7: ")) {
        fail_msg("%s", oz_status_text());
    }
}

/* What holds for every grain: triangles fill the outline, which closes, about the centre of mass.
 */
static void check_whole(const OzTriangleSet *triangle_set)
{
    double gap[2], moment[2] = {0, 0}, c[6], sum = 0;
    close_to(outline_area(triangle_set, gap), triangle_set->area);
    assert_true(hypot(gap[0], gap[1]) <= ROUNDING * triangle_set->reach);
    for (int t = 0; t < triangle_set->triangle_count; t++) {
        oz_triangle_set_corners(triangle_set, t, c);
        double area = 0.5 * ((c[2] - c[0]) * (c[5] - c[1]) - (c[4] - c[0]) * (c[3] - c[1]));
        assert_true(area > 0);
        sum += area;
        moment[0] += area * (c[0] + c[2] + c[4]) / 3;
        moment[1] += area * (c[1] + c[3] + c[5]) / 3;
    }
    close_to(sum, triangle_set->area);
    assert_true(hypot(moment[0], moment[1]) <= ROUNDING * triangle_set->area * triangle_set->reach);
}

static void a_square_is_four_triangles_in_a_ring(void **state)
{
    (void)state;
    OzTriangleSet die = make((OzPopulation){.shape = OZ_SHAPE_SQUARE, .edge = {2e-3, 2e-3}}, 1);
    assert_int_equal(die.triangle_count, 4);
    assert_int_equal(die.joint_count, 4);
    assert_int_equal(die.outline_count, 4);
    close_to(die.area, 4e-6);
    close_to(die.reach, sqrt(2) * 1e-3);
    for (int k = 0; k < 4; k++) {
        /* Centres lie a third of the edge from the middle, a right angle apart. */
        close_to(oz_triangle_set_joint_length(&die, k), sqrt(2) * 2e-3 / 3);
        assert_true(die.joint[2 * k] < die.joint[2 * k + 1]);
        assert_true(die.joint[2 * k] != (die.joint[2 * k + 1] + 2) % 4); /* not across */
    }
    check_whole(&die);
    oz_triangle_set_free(&die);
}

static void polygons_and_stars_have_their_areas(void **state)
{
    (void)state;
    for (int n = 3; n <= 7; n++) {
        OzPopulation polygon = {
            .shape = OZ_SHAPE_POLYGON, .corners = {n, n}, .radius = {3e-3, 3e-3}};
        OzPopulation star = {
            .shape = OZ_SHAPE_STAR, .corners = {n, n}, .radius = {6e-3, 6e-3}, .depth = 0.5};
        OzTriangleSet triangle_set = make(polygon, 1);
        assert_int_equal(triangle_set.triangle_count, n);
        assert_int_equal(triangle_set.joint_count, n);
        close_to(triangle_set.area, n / 2.0 * 9e-6 * sin(2 * PI / n));
        check_whole(&triangle_set);
        oz_triangle_set_free(&triangle_set);
        triangle_set = make(star, 1);
        assert_int_equal(triangle_set.triangle_count, 2 * n);
        assert_int_equal(triangle_set.joint_count, 2 * n);
        assert_int_equal(triangle_set.outline_count, 2 * n);
        close_to(triangle_set.area, n * 6e-3 * 3e-3 * sin(PI / n));
        check_whole(&triangle_set);
        oz_triangle_set_free(&triangle_set);
    }
}

static void random_polygons_keep_to_the_limits(void **state)
{
    (void)state;
    OzPopulation population = {
        .shape = OZ_SHAPE_POLYGON, .corners = {3, 6}, .radius = {1e-3, 2e-3}, .irregularity = 0.7};
    int seen[8] = {0};
    double least_reach = 1, most_reach = 0;
    for (uint64_t seed = 0; seed < 1000; seed++) {
        OzTriangleSet triangle_set = make(population, seed), again = make(population, seed);
        check_whole(&triangle_set);
        for (int k = 0; k < triangle_set.joint_count; k++) {
            /* the limit is asked with a slack of 1e-9, for edges that are right on it */
            assert_true(oz_triangle_set_joint_length(&triangle_set, k) >= 6e-4 * (1 - 1e-9));
        }
        for (int t = 0; t < triangle_set.triangle_count; t++) {
            assert_true(oz_triangle_set_area(&triangle_set, t) >= 4e-7 * (1 - 1e-9));
        }
        assert_memory_equal(triangle_set.vertex, again.vertex,
                            2 * sizeof(double) * (size_t)triangle_set.vertex_count);
        seen[triangle_set.triangle_count]++;
        least_reach = fmin(least_reach, triangle_set.reach);
        most_reach = fmax(most_reach, triangle_set.reach);
        oz_triangle_set_free(&triangle_set);
        oz_triangle_set_free(&again);
    }
    /* Each number of corners comes, the larger the rarer within the limits; sizes spread. */
    assert_true(seen[3] > 100 && seen[4] > 100 && seen[5] > 50 && seen[6] > 10);
    assert_true(least_reach < 1.2e-3 && most_reach > 1.8e-3);
}

static void discs_are_whole(void **state)
{
    (void)state;
    OzTriangleSet disc = make((OzPopulation){.shape = OZ_SHAPE_DISC, .radius = {1e-4, 1e-4}}, 1);
    assert_int_equal(disc.triangle_count + disc.outline_count + disc.joint_count, 0);
    close_to(disc.area, PI * 1e-8);
    assert_true(disc.radius == 1e-4 && disc.reach == 1e-4);
    oz_triangle_set_free(&disc);
}

static void small_grains_are_refused_with_the_reason(void **state)
{
    (void)state;
    refuses((OzPopulation){.shape = OZ_SHAPE_SQUARE, .edge = {1.2e-3, 1.2e-3}},
            "a beam of 0.000566 m, below beams.length_min 0.0006 m: its bending stiffness");
    refuses(
        (OzPopulation){
            .shape = OZ_SHAPE_STAR, .corners = {4, 4}, .radius = {5e-3, 5e-3}, .depth = 0.05},
        "below beams.");
    refuses((OzPopulation){.shape = OZ_SHAPE_SQUARE, .edge = {1e-3, 1.2e-3}},
            "a grain, the last of 1000 drawn, has a beam of");
}

/* The backs of side and slope meet at the knee's outer corner, and nothing lies beyond the sides'.
 */
static void hoppers_have_whole_corners(void **state)
{
    (void)state;
    static const double slopes[] = {0, 30, 45, 80};
    for (size_t k = 0; k < sizeof slopes / sizeof slopes[0]; k++) {
        OzTriangleSet triangle_set;
        OzWall wall = {.kind = OZ_WALL_HOPPER,
                       .width = 6,
                       .height = 30,
                       .opening = 1,
                       .slope = slopes[k] * PI / 180,
                       .tooth_count = k % 2 ? 5 : 0,
                       .tooth_depth = 0.1,
                       .thickness = 0.4};
        double back = wall.width / 2 + wall.thickness;
        double rise = (wall.width - wall.opening) / 2 * tan(wall.slope);
        double corner = rise - wall.thickness * tan((PI / 2 - wall.slope) / 2);
        int at_corner = 0;
        assert_int_equal(oz_element_walls_make(&triangle_set, &wall, 0), OZ_OK);
        for (int v = 0; v < triangle_set.vertex_count; v++) {
            double x = fabs(triangle_set.vertex[2 * v]), y = triangle_set.vertex[2 * v + 1];
            assert_true(x < back * (1 + ROUNDING));
            at_corner += hypot(x - back, y - corner) < 100 * ROUNDING;
        }
        assert_int_equal(at_corner, 4); /* a side's and a slope's, left and right */
        oz_triangle_set_free(&triangle_set);
    }
}

/* Grains of so many millimetres, in corners or elements far above the limits. */
static OzPopulation given(double *corners, const double *numbers, int count, double scale)
{
    for (int i = 0; i < count; i++) {
        corners[i] = scale * numbers[i];
    }
    return (OzPopulation){.shape = OZ_SHAPE_VERTICES, .vertices = corners, .vertex_count = count};
}

static const double SQUARE[] = {1, 1, 3, 1, 3, 3, 1, 3};
static const double HEXAGON[] = {2, 0, 1, 1.732, -1, 1.732, -2, 0, -1, -1.732, 1, -1.732};
static const double TRIANGLE[] = {0, 0, 4, 0, 2, 3.464};
static const double SKEWED[] = {0, 0, 4, 0.5, 3.5, 3, 0.2, 2.4};
static const double U[] = {0, 0, 6, 0, 6, 5, 4.4, 5, 4.4, 1.6, 1.6, 1.6, 1.6, 5, 0, 5};

/* A square given by its corners is the square: a triangle on each edge, a ring of four equal beams,
 * the middle where it was. Cut along one diagonal, as two triangles, it is soft about that alone.
 */
static void given_corners_keep_their_symmetry(void **state)
{
    (void)state;
    double corners[16];
    OzTriangleSet die = make((OzPopulation){.shape = OZ_SHAPE_SQUARE, .edge = {2e-3, 2e-3}}, 1);
    OzTriangleSet same = make(given(corners, SQUARE, 8, 1e-3), 1);
    assert_int_equal(same.triangle_count, 4);
    assert_int_equal(same.joint_count, 4);
    for (int k = 0; k < 4; k++) {
        double a = oz_triangle_set_joint_length(&same, k),
               b = oz_triangle_set_joint_length(&die, k);
        /* the same square about another origin: last digits */
        assert_true(fabs(a - b) < 1e-14 * b);
        assert_true(fabs(oz_triangle_set_area(&same, k) - 1e-6) < 1e-20);
    }
    check_whole(&same);
    oz_triangle_set_free(&die);
    oz_triangle_set_free(&same);
    OzTriangleSet six = make(given(corners, HEXAGON, 12, 1e-3), 1); /* with four digits */
    assert_int_equal(six.triangle_count, 6);
    assert_int_equal(six.joint_count, 6);
    oz_triangle_set_free(&six);
}

/* Where the fewest triangles do, they stay. */
static void other_corners_make_the_fewest_triangles(void **state)
{
    (void)state;
    static const struct {
        const double *numbers;
        int count;
    } shapes[] = {{TRIANGLE, 6}, {SKEWED, 8}, {ARROW, 8}, {ELL, 12}, {U, 16}};
    for (int i = 0; i < 5; i++) {
        double corners[16];
        OzPopulation population = given(corners, shapes[i].numbers, shapes[i].count, 1e-3);
        OzScene scene = scene_with(&population);
        OzTriangleSet triangle_set = make(population, 1);
        assert_int_equal(triangle_set.triangle_count, shapes[i].count / 2 - 2);
        /* The U's middle lies outside it: its base must be cut along one of two like diagonals. */
        assert_int_equal(oz_shape_keeps_symmetry(&scene, &population), shapes[i].numbers != U);
        oz_triangle_set_free(&triangle_set);
    }
}

/* A square of which four triangles would be below the limit is two, and is said to be. */
static void limits_go_before_symmetry(void **state)
{
    (void)state;
    double corners[8];
    OzTriangleSet triangle_set;
    OzPopulation population = given(corners, SQUARE, 8, 1e-3);
    OzScene scene = scene_with(&population);
    OzRandom random = oz_random_stream(1, 0);
    scene.beams.area_min = 1.5e-6; /* halves have 2e-6, quarters 1e-6 m^2 */
    assert_int_equal(oz_shape_make(&triangle_set, &scene, &population, &random), OZ_OK);
    assert_int_equal(triangle_set.triangle_count, 2);
    assert_false(oz_shape_keeps_symmetry(&scene, &population));
    oz_triangle_set_free(&triangle_set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_square_is_four_triangles_in_a_ring),
        cmocka_unit_test(polygons_and_stars_have_their_areas),
        cmocka_unit_test(random_polygons_keep_to_the_limits),
        cmocka_unit_test(discs_are_whole),
        cmocka_unit_test(small_grains_are_refused_with_the_reason),
        cmocka_unit_test(hoppers_have_whole_corners),
        cmocka_unit_test(given_corners_keep_their_symmetry),
        cmocka_unit_test(other_corners_make_the_fewest_triangles),
        cmocka_unit_test(limits_go_before_symmetry),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
