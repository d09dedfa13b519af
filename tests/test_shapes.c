/* Shapes of grains: their areas against formulas, their outlines closed, their beams; polygons cut
 * into triangles whatever their corners; what is refused, with its reason; and a hopper's corners.
 */
#include "model/piece_walls.h"
#include "model/shape.h"
#include "model/triangulation.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

/* Sums of some tens of products. */
#define ROUNDING 1e-13

static OzScene scene_with(OzPopulation *population)
{
    population->line = 7;
    return (OzScene){.path = (char *)(uintptr_t) "grains.yaml",
                     .beams = {.length_min = 6e-4, .area_min = 4e-7},
                     .populations = population,
                     .population_count = 1};
}

static OzPatch make(OzPopulation population, uint64_t seed)
{
    OzPatch patch;
    OzScene scene = scene_with(&population);
    OzRandom random = oz_random_stream(seed, 0);
    if (oz_shape_make(&patch, &scene, &population, &random) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    return patch;
}

static void refuses(OzPopulation population, const char *words)
{
    OzPatch patch;
    OzScene scene = scene_with(&population);
    OzRandom random = oz_random_stream(1, 0);
    assert_int_equal(oz_shape_make(&patch, &scene, &population, &random), OZ_ERR_INPUT);
    assert_int_equal(patch.triangle_count, 0);
    if (!strstr(oz_status_text(), words) || !strstr(oz_status_text(), "grains.yaml:7: ")) {
        fail_msg("%s", oz_status_text());
    }
}

static void close_to(double a, double b)
{
    if (!(fabs(a - b) <= ROUNDING * fabs(b))) {
        fail_msg("%.17g is not %.17g", a, b);
    }
}

/* Area inside the outline alone, and how far its edges, laid end to end, are from closing. */
static double outline_area(const OzPatch *patch, double gap[2])
{
    double area = 0, c[6];
    gap[0] = gap[1] = 0;
    for (int k = 0; k < patch->outline_count; k++) {
        oz_patch_corners(patch, patch->outline[2 * k], c);
        int side = patch->outline[2 * k + 1];
        const double *a = c + 2 * side, *b = c + 2 * ((side + 1) % 3);
        area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
        gap[0] += b[0] - a[0];
        gap[1] += b[1] - a[1];
    }
    return area;
}

/* What holds for every grain: triangles fill the outline, which closes, about the centre of mass.
 */
static void check_whole(const OzPatch *patch)
{
    double gap[2], moment[2] = {0, 0}, c[6], sum = 0;
    close_to(outline_area(patch, gap), patch->area);
    assert_true(hypot(gap[0], gap[1]) <= ROUNDING * patch->reach);
    for (int t = 0; t < patch->triangle_count; t++) {
        oz_patch_corners(patch, t, c);
        double area = 0.5 * ((c[2] - c[0]) * (c[5] - c[1]) - (c[4] - c[0]) * (c[3] - c[1]));
        assert_true(area > 0);
        sum += area;
        moment[0] += area * (c[0] + c[2] + c[4]) / 3;
        moment[1] += area * (c[1] + c[3] + c[5]) / 3;
    }
    close_to(sum, patch->area);
    assert_true(hypot(moment[0], moment[1]) <= ROUNDING * patch->area * patch->reach);
}

static void a_square_is_four_triangles_in_a_ring(void **state)
{
    (void)state;
    OzPatch die = make((OzPopulation){.shape = OZ_SHAPE_SQUARE, .edge = {2e-3, 2e-3}}, 1);
    assert_int_equal(die.triangle_count, 4);
    assert_int_equal(die.joint_count, 4);
    assert_int_equal(die.outline_count, 4);
    close_to(die.area, 4e-6);
    close_to(die.reach, sqrt(2) * 1e-3);
    for (int k = 0; k < 4; k++) {
        /* Centres lie a third of the edge from the middle, a right angle apart. */
        close_to(oz_patch_joint_length(&die, k), sqrt(2) * 2e-3 / 3);
        assert_true(die.joint[2 * k] < die.joint[2 * k + 1]);
        assert_true(die.joint[2 * k] != (die.joint[2 * k + 1] + 2) % 4); /* not across */
    }
    check_whole(&die);
    oz_patch_free(&die);
}

static void polygons_and_stars_have_their_areas(void **state)
{
    (void)state;
    for (int n = 3; n <= 7; n++) {
        OzPopulation polygon = {
            .shape = OZ_SHAPE_POLYGON, .corners = {n, n}, .radius = {3e-3, 3e-3}};
        OzPopulation star = {
            .shape = OZ_SHAPE_STAR, .corners = {n, n}, .radius = {6e-3, 6e-3}, .depth = 0.5};
        OzPatch patch = make(polygon, 1);
        assert_int_equal(patch.triangle_count, n);
        assert_int_equal(patch.joint_count, n);
        close_to(patch.area, n / 2.0 * 9e-6 * sin(2 * PI / n));
        check_whole(&patch);
        oz_patch_free(&patch);
        patch = make(star, 1);
        assert_int_equal(patch.triangle_count, 2 * n);
        assert_int_equal(patch.joint_count, 2 * n);
        assert_int_equal(patch.outline_count, 2 * n);
        close_to(patch.area, n * 6e-3 * 3e-3 * sin(PI / n));
        check_whole(&patch);
        oz_patch_free(&patch);
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
        OzPatch patch = make(population, seed), again = make(population, seed);
        check_whole(&patch);
        for (int k = 0; k < patch.joint_count; k++) {
            assert_true(oz_patch_joint_length(&patch, k) >= 6e-4 * (1 - 1e-9));
        }
        for (int t = 0; t < patch.triangle_count; t++) {
            assert_true(oz_patch_area(&patch, t) >= 4e-7 * (1 - 1e-9));
        }
        assert_memory_equal(patch.vertex, again.vertex,
                            2 * sizeof(double) * (size_t)patch.vertex_count);
        seen[patch.triangle_count]++;
        least_reach = fmin(least_reach, patch.reach);
        most_reach = fmax(most_reach, patch.reach);
        oz_patch_free(&patch);
        oz_patch_free(&again);
    }
    /* Each number of corners comes, the larger the rarer within the limits; sizes spread. */
    assert_true(seen[3] > 100 && seen[4] > 100 && seen[5] > 50 && seen[6] > 10);
    assert_true(least_reach < 1.2e-3 && most_reach > 1.8e-3);
}

static void discs_are_whole(void **state)
{
    (void)state;
    OzPatch disc = make((OzPopulation){.shape = OZ_SHAPE_DISC, .radius = {1e-4, 1e-4}}, 1);
    assert_int_equal(disc.triangle_count + disc.outline_count + disc.joint_count, 0);
    close_to(disc.area, PI * 1e-8);
    assert_true(disc.radius == 1e-4 && disc.reach == 1e-4);
    oz_patch_free(&disc);
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

/* Comb of four teeth, spiral, arrow, L, thin quadrilateral; each as x y of its corners. */
static const double COMB[] = {0, 0, 7, 0, 7, 3, 6, 3, 6, 1, 5, 1, 5, 3, 4, 3,
                              4, 1, 3, 1, 3, 3, 2, 3, 2, 1, 1, 1, 1, 3, 0, 3};
static const double SPIRAL[] = {0, 0, 6, 0, 6, 6, 1, 6, 1, 2, 4, 2, 4, 4,
                                3, 4, 3, 3, 2, 3, 2, 5, 5, 5, 5, 1, 0, 1};
static const double ARROW[] = {0, 0, 4, 2, 0, 4, 1, 2};
static const double ELL[] = {0, 0, 3, 0, 3, 1, 1, 1, 1, 3, 0, 3};
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

static bool holds(const OzPatch *patch, int t, double x, double y)
{
    double c[6];
    oz_patch_corners(patch, t, c);
    for (int k = 0; k < 3; k++) {
        const double *a = c + 2 * k, *b = c + 2 * ((k + 1) % 3);
        if ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1]) <= 0) {
            return false;
        }
    }
    return true;
}

/* No point is in two triangles; with equal areas that makes a tiling. */
static void check_tiling(const OzPatch *patch)
{
    OzRandom random = oz_random_stream(3, 0);
    for (int i = 0; i < 500; i++) {
        double x = oz_random_uniform(&random, -10, 10), y = oz_random_uniform(&random, -1, 7);
        int count = 0;
        for (int t = 0; t < patch->triangle_count; t++) {
            count += holds(patch, t, x, y);
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
            OzPatch patch;
            assert_int_equal(
                oz_triangulation_make(&patch, way ? turned : awkward[i].corners, n, "here"), OZ_OK);
            assert_int_equal(patch.triangle_count, n - 2);
            assert_int_equal(patch.joint_count, n - 3);
            assert_int_equal(patch.outline_count, n);
            close_to(patch.area, fabs(shoelace(awkward[i].corners, n)));
            double gap[2];
            close_to(outline_area(&patch, gap), patch.area);
            check_tiling(&patch);
            oz_patch_free(&patch);
        }
    }
}

/* Of the kite's diagonals the short one gives the fatter triangles. */
static void cuts_across_the_short_way(void **state)
{
    (void)state;
    OzPatch patch;
    assert_int_equal(oz_triangulation_make(&patch, KITE, 4, "here"), OZ_OK);
    close_to(oz_patch_joint_length(&patch, 0), 20.0 / 3);
    oz_patch_free(&patch);
}

/* The angle at a triangle's corner that the other one has not. */
static double angle_across(const OzPatch *patch, int t, int other)
{
    const int *own = patch->triangle + 3 * t, *its = patch->triangle + 3 * other;
    int k = 0;
    while (k < 2 && (own[k] == its[0] || own[k] == its[1] || own[k] == its[2])) {
        k++;
    }
    const double *a = patch->vertex + 2 * own[k], *b = patch->vertex + 2 * own[(k + 1) % 3],
                 *c = patch->vertex + 2 * own[(k + 2) % 3];
    double sine = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    double cosine = (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1]);
    return atan2(sine, cosine);
}

/* Angles across an edge add up to half a turn at most, or the other diagonal would be better. */
static void check_delaunay(const OzPatch *patch)
{
    for (int k = 0; k < patch->joint_count; k++) {
        int a = patch->joint[2 * k], b = patch->joint[2 * k + 1];
        assert_true(angle_across(patch, a, b) + angle_across(patch, b, a) <= PI + 1e-9);
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
        OzPatch patch;
        assert_int_equal(oz_triangulation_make(&patch, corners, n, "here"), OZ_OK);
        assert_true(fabs(patch.area - shoelace(corners, n)) <= ROUNDING * n);
        assert_int_equal(patch.joint_count, n - 3);
        check_delaunay(&patch);
        oz_patch_free(&patch);
    }
}

static void refuse_corners(const double *corners, int count, const char *text)
{
    OzPatch patch;
    assert_int_equal(oz_triangulation_make(&patch, corners, count, "grains.yaml:7"), OZ_ERR_INPUT);
    assert_string_equal(oz_status_text(), text);
    assert_null(patch.vertex);
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

/* The backs of side and slope meet at the knee's outer corner, and nothing lies beyond the sides'.
 */
static void hoppers_have_whole_corners(void **state)
{
    (void)state;
    static const double slopes[] = {0, 30, 45, 80};
    for (size_t k = 0; k < sizeof slopes / sizeof slopes[0]; k++) {
        OzPatch patch;
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
        assert_int_equal(oz_piece_walls_make(&patch, &wall, 0), OZ_OK);
        for (int v = 0; v < patch.vertex_count; v++) {
            double x = fabs(patch.vertex[2 * v]), y = patch.vertex[2 * v + 1];
            assert_true(x < back * (1 + ROUNDING));
            at_corner += hypot(x - back, y - corner) < 100 * ROUNDING;
        }
        assert_int_equal(at_corner, 4); /* a side's and a slope's, left and right */
        oz_patch_free(&patch);
    }
}

/* Grains of so many millimetres, in corners or pieces far above the limits. */
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
    OzPatch die = make((OzPopulation){.shape = OZ_SHAPE_SQUARE, .edge = {2e-3, 2e-3}}, 1);
    OzPatch same = make(given(corners, SQUARE, 8, 1e-3), 1);
    assert_int_equal(same.triangle_count, 4);
    assert_int_equal(same.joint_count, 4);
    for (int k = 0; k < 4; k++) {
        double a = oz_patch_joint_length(&same, k), b = oz_patch_joint_length(&die, k);
        assert_true(fabs(a - b) < 1e-12 * b);
        assert_true(fabs(oz_patch_area(&same, k) - 1e-6) < 1e-18);
    }
    check_whole(&same);
    oz_patch_free(&die);
    oz_patch_free(&same);
    OzPatch six = make(given(corners, HEXAGON, 12, 1e-3), 1); /* with four digits */
    assert_int_equal(six.triangle_count, 6);
    assert_int_equal(six.joint_count, 6);
    oz_patch_free(&six);
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
        OzPatch patch = make(population, 1);
        assert_int_equal(patch.triangle_count, shapes[i].count / 2 - 2);
        /* The U's middle lies outside it: its base must be cut along one of two like diagonals. */
        assert_int_equal(oz_shape_keeps_symmetry(&scene, &population), shapes[i].numbers != U);
        oz_patch_free(&patch);
    }
}

/* A square of which four triangles would be below the limit is two, and is said to be. */
static void limits_go_before_symmetry(void **state)
{
    (void)state;
    double corners[8];
    OzPatch patch;
    OzPopulation population = given(corners, SQUARE, 8, 1e-3);
    OzScene scene = scene_with(&population);
    OzRandom random = oz_random_stream(1, 0);
    scene.beams.area_min = 1.5e-6; /* halves have 2e-6, quarters 1e-6 m^2 */
    assert_int_equal(oz_shape_make(&patch, &scene, &population, &random), OZ_OK);
    assert_int_equal(patch.triangle_count, 2);
    assert_false(oz_shape_keeps_symmetry(&scene, &population));
    oz_patch_free(&patch);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_square_is_four_triangles_in_a_ring),
        cmocka_unit_test(polygons_and_stars_have_their_areas),
        cmocka_unit_test(random_polygons_keep_to_the_limits),
        cmocka_unit_test(discs_are_whole),
        cmocka_unit_test(small_grains_are_refused_with_the_reason),
        cmocka_unit_test(cuts_awkward_polygons),
        cmocka_unit_test(cuts_across_the_short_way),
        cmocka_unit_test(cuts_random_polygons),
        cmocka_unit_test(refuses_what_is_no_simple_polygon),
        cmocka_unit_test(hoppers_have_whole_corners),
        cmocka_unit_test(given_corners_keep_their_symmetry),
        cmocka_unit_test(other_corners_make_the_fewest_triangles),
        cmocka_unit_test(limits_go_before_symmetry),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
