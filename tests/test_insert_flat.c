/* The start of trigrains: whatever the container, no triangle overlaps another's grain or a wall
 * and all lie inside; walls have no gaps; the same seed gives the same bits; and elements carry
 * their grains' mass, motion and beams. */
#include "base/random.h"
#include "model/insert.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

/* Sums of some tens of products. */
#define ROUNDING 1e-12

#define HEAD "model: trigrains\ntime: {step: 1e-6, duration: 1}\n"
#define LOW  "beams: {length_min: 1e-4, area_min: 1e-8}\n"
#define STONES                                                                                     \
    "grains:\n"                                                                                    \
    "  - {kind: random, shape: polygon, radius: [1e-3, 2e-3], corners: [3, 6], irregularity: 0.5," \
    " count: 120}\n"                                                                               \
    "  - {kind: random, shape: star, radius: [2e-3, 3e-3], corners: [4, 5], count: 20}\n"
#define HOPPER                                                                                     \
    "  - {kind: hopper, width: 0.06, height: 0.05, opening: 0.005, slope: 50, teeth: 12,"          \
    " tooth_depth: 5e-4, point: [0.01, 0.02]}\n"
#define DRUM   "  - {kind: drum, diameter: 0.06, teeth: 50, tooth_depth: 5e-4, point: [0.01, 0.02]}\n"
#define VESSEL "  - {kind: vessel, width: 0.05, height: 0.03, point: [0.01, 0.02]}\n"
#define FLOOR  "  - {kind: floor, width: 0.05, teeth: 9, tooth_depth: 1e-3, point: [0.01, 0.02]}\n"

typedef struct Bed {
    OzScene scene;
    OzGrains grains;
} Bed;

static Bed bed_of(const char *text, char *seed)
{
    Bed bed;
    if (oz_scene_parse(&bed.scene, "bed.yaml", text, seed ? &seed : NULL, seed ? 1 : 0) != OZ_OK ||
        oz_insert_grains(&bed.grains, &bed.scene) != OZ_OK) {
        fail_msg("%s", oz_status_text());
    }
    return bed;
}

static void bed_free(Bed *bed)
{
    oz_grains_free(&bed->grains);
    oz_scene_free(&bed->scene);
}

static void corners_of(const OzElements *elements, int64_t i, double c[6])
{
    oz_elements_corners(elements, i, elements->position + 2 * i, elements->angle[i], c);
}

/* How deep triangle b lies behind a's edges: <= 0 when one edge of a separates them. */
static double depth_behind(const double a[6], const double b[6])
{
    double least = INFINITY;
    for (int k = 0; k < 3; k++) {
        const double *p = a + 2 * k, *q = a + 2 * ((k + 1) % 3);
        double length = hypot(q[0] - p[0], q[1] - p[1]), deepest = -INFINITY;
        for (int j = 0; j < 3; j++) {
            double across =
                (q[0] - p[0]) * (b[2 * j + 1] - p[1]) - (b[2 * j] - p[0]) * (q[1] - p[1]);
            deepest = fmax(deepest, across / length);
        }
        least = fmin(least, deepest);
    }
    return least;
}

static int count_overlaps(const OzElements *elements)
{
    int count = 0;
    double a[6], b[6];
    for (int64_t i = 0; i < elements->free_count; i++) {
        corners_of(elements, i, a);
        for (int64_t j = i + 1; j < elements->count; j++) {
            corners_of(elements, j, b);
            count += elements->body[i] != elements->body[j] && depth_behind(a, b) > 0 &&
                     depth_behind(b, a) > 0;
        }
    }
    return count;
}

/* The least distance from any grain's corner to the container's free boundary, m. */
static double least_inside(const OzElements *elements, double (*inside)(double x, double y))
{
    double least = INFINITY, c[6];
    for (int64_t i = 0; i < elements->free_count; i++) {
        corners_of(elements, i, c);
        for (int k = 0; k < 3; k++) {
            least = fmin(least, inside(c[2 * k] - 0.01, c[2 * k + 1] - 0.02));
        }
    }
    return least;
}

static double inside_hopper(double x, double y)
{
    double angle = 50 * PI / 180;
    double slope = y * cos(angle) - (fabs(x) - 0.0025) * sin(angle);
    return fmin(fmin(slope, 0.03 - fabs(x)), y);
}

static double inside_drum(double x, double y)
{
    return 0.03 - hypot(x, y);
}

static double inside_vessel(double x, double y)
{
    return fmin(y, 0.025 - fabs(x));
}

static double above_floor(double x, double y)
{
    (void)x;
    return y - 1e-3;
}

static const struct {
    const char *text;
    double (*inside)(double x, double y);
} containers[] = {
    {HEAD STONES "walls:\n" HOPPER, inside_hopper},
    {HEAD STONES "walls:\n" DRUM, inside_drum},
    {HEAD STONES "walls:\n" VESSEL, inside_vessel},
    {HEAD STONES "walls:\n" FLOOR, above_floor},
};

static void grains_lie_apart_and_inside(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof containers / sizeof *containers; i++) {
        Bed bed = bed_of(containers[i].text, NULL);
        assert_int_equal(bed.grains.count, 140);
        assert_int_equal(count_overlaps(bed.grains.elements), 0);
        assert_true(least_inside(bed.grains.elements, containers[i].inside) > 0);
        bed_free(&bed);
    }
}

static int count_of_dice(char *setting)
{
    Bed bed = bed_of(HEAD "grains:\n"
                          "  - {kind: single, shape: square, edge: 2e-3, position: [0, 0]}\n"
                          "  - {kind: single, shape: square, edge: 2e-3, position: [0, 1e-4]}\n",
                     setting);
    int count = count_overlaps(bed.grains.elements);
    bed_free(&bed);
    return count;
}

static void overlaps_are_seen(void **state)
{
    (void)state;
    assert_true(count_of_dice("grains.1.position.0=1.99e-3") > 0);
    assert_int_equal(count_of_dice("grains.1.position.0=2.01e-3"), 0);
}

static bool is_in_wall(const OzElements *elements, double x, double y)
{
    double c[6], point[6] = {x, y, x, y, x, y};
    for (int64_t i = elements->free_count; i < elements->count; i++) {
        corners_of(elements, i, c);
        if (depth_behind(c, point) >= 0) {
            return true;
        }
    }
    return false;
}

/* Along a face from a to b, its free side on the left: wall close behind it, none close before. */
static void check_face(const OzElements *elements, double ax, double ay, double bx, double by)
{
    double length = hypot(bx - ax, by - ay), near = 1e-6;
    double x = (bx - ax) / length, y = (by - ay) / length;
    for (int i = 1; i < 500; i++) {
        double along = length * i / 500;
        double px = ax + along * x, py = ay + along * y;
        assert_true(is_in_wall(elements, px + near * y, py - near * x));
        assert_false(is_in_wall(elements, px - near * y, py + near * x));
    }
}

static void walls_have_no_gaps(void **state)
{
    (void)state;
    Bed bed =
        bed_of(HEAD "grains: []\nwalls:\n  - {kind: hopper, width: 0.06, height: 0.05, opening: "
                    "0.01, slope: 45}\n",
               NULL);
    const OzElements *elements = bed.grains.elements;
    assert_int_equal(elements->count, 8);
    check_face(elements, -0.03, 0.05, -0.03, 0.025);
    check_face(elements, -0.03, 0.025, -0.005, 0);
    check_face(elements, 0.005, 0, 0.03, 0.025);
    check_face(elements, 0.03, 0.025, 0.03, 0.05);
    bed_free(&bed);
    bed = bed_of(HEAD "grains: []\nwalls:\n" VESSEL, NULL);
    check_face(bed.grains.elements, -0.015, 0.05, -0.015, 0.02);
    check_face(bed.grains.elements, -0.015, 0.02, 0.035, 0.02);
    check_face(bed.grains.elements, 0.035, 0.02, 0.035, 0.05);
    /* A grain pressed into the corner finds both walls, also straight behind the corner. */
    for (double back = 1e-6; back < 1e-3; back *= 2) {
        assert_true(is_in_wall(bed.grains.elements, -0.015 - back, 0.02 - back));
    }
    bed_free(&bed);
    bed = bed_of(HEAD "grains: []\nwalls:\n  - {kind: segment, from: [0, 1], to: [3, 5]}\n", NULL);
    check_face(bed.grains.elements, 0, 1, 3, 5);
    bed_free(&bed);
}

/* Around the drum: at each tooth's middle it stands in by its depth, between teeth not at all. */
static void drums_have_their_teeth(void **state)
{
    (void)state;
    Bed bed = bed_of(HEAD "grains: []\nwalls:\n" DRUM, NULL);
    assert_int_equal(bed.grains.elements->count, 150);
    for (int i = 0; i < 200; i++) {
        double angle = 2 * PI * i / 200, c = cos(angle), s = sin(angle);
        /* Quarters of a sector: 0 and 0.5 of the way up a tooth, its tip, and 0.5 again. */
        double chord = 0.03 * cos(PI / 50) / cos(PI / 100), low = i % 2 ? chord : 0.03;
        double top = i % 4 == 2 ? 0.03 - 5e-4 : i % 4 == 0 ? 0.03 : 0.5 * (low + 0.03 - 5e-4);
        double before = top - (i % 2 ? 3e-5 : 1e-6);
        assert_true(is_in_wall(bed.grains.elements, 0.01 + 0.0301 * c, 0.02 + 0.0301 * s));
        assert_true(
            is_in_wall(bed.grains.elements, 0.01 + (top + 3e-5) * c, 0.02 + (top + 3e-5) * s));
        assert_false(is_in_wall(bed.grains.elements, 0.01 + before * c, 0.02 + before * s));
    }
    bed_free(&bed);
}

static void same_seed_same_grains(void **state)
{
    (void)state;
    Bed a = bed_of(HEAD STONES "walls:\n" HOPPER, NULL),
        b = bed_of(HEAD STONES "walls:\n" HOPPER, NULL);
    Bed c = bed_of(HEAD STONES "walls:\n" HOPPER, "seed=2");
    size_t size = 2 * sizeof(double) * (size_t)a.grains.elements->free_count;
    assert_int_equal(a.grains.elements->count, b.grains.elements->count);
    assert_memory_equal(a.grains.elements->position, b.grains.elements->position, size);
    assert_true(a.grains.diameter[0] != c.grains.diameter[0]);
    bed_free(&a);
    bed_free(&b);
    bed_free(&c);
}

/* A grain's shape does not depend on what else there is. */
static void shapes_are_their_own(void **state)
{
    (void)state;
    Bed a = bed_of(HEAD STONES "walls:\n" HOPPER, "grains.0.count=10");
    Bed b = bed_of(HEAD STONES "walls:\n" VESSEL, NULL);
    for (int i = 0; i < 10; i++) {
        assert_true(a.grains.diameter[i] == b.grains.diameter[i]);
        assert_true(a.grains.quaternion[4 * i] == b.grains.quaternion[4 * i]);
    }
    bed_free(&a);
    bed_free(&b);
}

static void close_to(double a, double b, double scale)
{
    if (!(fabs(a - b) <= ROUNDING * scale)) {
        fail_msg("%.17g is not %.17g", a, b);
    }
}

/* A die of edge e: m = density e^2, inertia m e^2 / 6, rigid motion, four beams. */
static void dice_are_whole(void **state)
{
    (void)state;
    Bed bed = bed_of(HEAD "grains: [{kind: single, shape: square, edge: 2e-3, position: [0.3, 0.4],"
                          " angle: 30, velocity: [0.1, -0.2], spin: 5}]\n",
                     NULL);
    const OzGrains *grains = &bed.grains;
    const OzElements *elements = grains->elements;
    close_to(grains->mass[0], 1.6e-5, 1.6e-5);
    close_to(grains->inertia[0], 1.6e-5 * 4e-6 / 6, 1e-11);
    close_to(grains->diameter[0], 2e-3 * sqrt(2), 2e-3);
    close_to(2 * atan2(grains->quaternion[3], grains->quaternion[0]), PI / 6, 1);
    assert_int_equal(elements->beam_count, 4);
    assert_int_equal(elements->first[0], 0);
    assert_int_equal(elements->first[1], 4);
    for (int i = 0; i < 4; i++) {
        double x = elements->position[2 * i] - 0.3, y = elements->position[2 * i + 1] - 0.4;
        close_to(hypot(x, y), 2e-3 / 3, 1);
        close_to(elements->velocity[2 * i], 0.1 - 5 * y, 1);
        close_to(elements->velocity[2 * i + 1], -0.2 + 5 * x, 1);
        close_to(elements->mass[i], 4e-6, 4e-6);
        assert_true(elements->angular_velocity[i] == 5 && elements->angle[i] == 0);
        close_to(cos(4 * (atan2(y, x) - PI / 6)), 1, 1);
    }
    bed_free(&bed);
}

static void elements_are_in_order(void **state)
{
    (void)state;
    Bed bed =
        bed_of(HEAD LOW STONES
               "  - {kind: lattice, shape: disc, radius: 1e-3, cells: [3, 2], spacing: [0.1, 0.2],"
               " position: [1, 2], velocity: [0, 1]}\n"
               "  - {kind: lattice, shape: vertices, vertices: [0, 0, 4, 2, 0, 4, 1, 2],"
               " cells: [2, 1], spacing: [9, 9], position: [20, 20]}\n"
               "contact: {contact_time: 1e-4, restitution: 0.5}\nwalls:\n" HOPPER VESSEL,
               NULL);
    const OzElements *elements = bed.grains.elements;
    assert_int_equal(elements->grain_count, 148);
    assert_int_equal(elements->wall_count, 2);
    assert_int_equal(elements->first[150], elements->count);
    assert_int_equal(elements->first[148], elements->free_count);
    for (int64_t i = 0; i < elements->count; i++) {
        int body = elements->body[i];
        assert_true(i >= elements->first[body] && i < elements->first[body + 1]);
        assert_int_equal(elements->mass[i] > 0, i < elements->free_count);
    }
    for (int64_t k = 0; k < elements->beam_count; k++) {
        int a = elements->beam_a[k], b = elements->beam_b[k];
        assert_true(a < b && elements->body[a] == elements->body[b] &&
                    elements->beam_length[k] > 0);
        assert_true(k == 0 || a > elements->beam_a[k - 1] ||
                    (a == elements->beam_a[k - 1] && b > elements->beam_b[k - 1]));
    }
    int64_t disc = elements->first[144];
    assert_true(elements->radius[disc] == 1e-3);
    close_to(elements->position[2 * disc], 1.1, 2);
    close_to(elements->position[2 * disc + 1], 2.2, 2);
    assert_int_equal(elements->first[147] - elements->first[146], 2);
    bed_free(&bed);
}

static void refuses_what_does_not_fit(void **state)
{
    (void)state;
    OzScene scene;
    OzGrains grains;
    char *settings[] = {"grains.0.count=2000"};
    assert_int_equal(oz_scene_parse(&scene, "bed.yaml", HEAD STONES "walls:\n" DRUM, settings, 1),
                     OZ_OK);
    assert_int_equal(oz_insert_grains(&grains, &scene), OZ_ERR_INPUT);
    assert_non_null(strstr(oz_status_text(), "bed.yaml:4: the random grains do not fit"));
    assert_null(grains.mass);
    oz_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grains_lie_apart_and_inside),
        cmocka_unit_test(overlaps_are_seen),
        cmocka_unit_test(walls_have_no_gaps),
        cmocka_unit_test(drums_have_their_teeth),
        cmocka_unit_test(same_seed_same_grains),
        cmocka_unit_test(shapes_are_their_own),
        cmocka_unit_test(dice_are_whole),
        cmocka_unit_test(elements_are_in_order),
        cmocka_unit_test(refuses_what_does_not_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
