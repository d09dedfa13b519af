/* Starts that are not sound: overlaps by their pair, depth and stored energy, and grains that
 * nothing will catch. */
#include "rig.h"

#include "run/members.h"
#include "sim/start.h"

#include <glob.h>

static const double diameter = 1e-2, contact_time = 1e-3;

/* k of two spheres without loss: m* pi^2 / t_c^2. */
static double stiffness(const Rig *rig, double share_of_mass)
{
    return share_of_mass * rig->grains.mass[0] * 9.869604401089358 / (contact_time * contact_time);
}

/* Spheres of 1 cm in a row, so far apart, a height above a plane; gravity as given. */
static void open_row(Rig *rig, int count, double apart, double height, double gravity)
{
    rig_open(
        rig,
        "model: rods\nprecision: double\ngravity: [0, 0, %g]\ntime: {step: 1e-5, duration: 1}\n"
        "contact: {contact_time: 1e-3, restitution: 1}\n"
        "grains:\n  - {kind: lattice, cells: [%d, 1, 1], spacing: [%.17g, 1, 1], diameter: 1e-2,\n"
        "     position: [0, 0, %.17g]}\nwalls: [{kind: plane}]\n",
        gravity, count, apart, height);
}

static void test_two_spheres(void **state)
{
    (void)state;
    Rig rig;
    OzStart start;
    double depth = 0.3 * diameter / 2;
    open_row(&rig, 2, diameter - depth, 1, 0);
    must(oz_start_look(&start, &rig.scene, &rig.grains));
    assert_int_equal(start.count, 1);
    assert_int_equal(start.refused, 0);
    assert_int_equal(start.worst.a, 0);
    assert_int_equal(start.worst.b, 1);
    double energy = 0.5 * stiffness(&rig, 0.5) * depth * depth;
    assert_true(fabs(start.worst.depth / depth - 1) < 1e-9); /* rounding of 1 m + 1 cm */
    assert_true(fabs(start.worst.energy / energy - 1) < 1e-9);
    assert_true(fabs(start.worst.share - 0.3) < 1e-9);
    must(oz_members_judge(&rig.scene, &rig.grains, false));
    rig_close(&rig);
}

static void must_refuse(const Rig *rig, const char *words)
{
    assert_int_equal(oz_members_judge(&rig->scene, &rig->grains, false), OZ_ERR_INPUT);
    if (!strstr(oz_status_text(), words)) {
        fail_msg("\"%s\" does not tell \"%s\"", oz_status_text(), words);
    }
    must(oz_members_judge(&rig->scene, &rig->grains, true));
}

static void test_more_than_half_a_radius_is_refused(void **state)
{
    (void)state;
    Rig rig;
    open_row(&rig, 3, diameter - 0.6 * diameter / 2, 1, 0);
    must_refuse(&rig,
                "grain 0 overlaps grain 1 at the start by 0.003 m, 0.6 of the smaller radius");
    assert_non_null(strstr(oz_status_text(), "of 2 such overlaps"));
    rig_close(&rig);
    open_row(&rig, 1, 1, 0.4 * diameter / 2, 0);
    must_refuse(&rig, "grain 0 overlaps walls.0 at the start by 0.003 m");
    rig_close(&rig);
    open_row(&rig, 2, 1, -0.1, 0);
    must_refuse(&rig, "grain 0 starts behind walls.0, 0.105 m deep");
    rig_close(&rig);
}

/* What beds are made of is no fault: neighbours that touch to rounding, spheres that lie on the
 * floor as deep as their weight presses them, overlaps of a bed that was read, however deep up to
 * where it would stop. */
static void test_beds_are_left_alone(void **state)
{
    (void)state;
    Rig rig;
    OzStart start;
    open_row(&rig, 4, diameter * (1 - 4e-4), diameter / 2, 0);
    must(oz_start_look(&start, &rig.scene, &rig.grains));
    assert_int_equal(start.count, 0);
    rig_close(&rig);
    double softly = 9.81 * 400; /* else a weight presses less deep than rounding */
    open_row(&rig, 4, 1, diameter / 2, -softly);
    rig.grains.position[2] -= rig.grains.mass[0] * softly / stiffness(&rig, 1);
    rig.grains.position[5] -= 4 * rig.grains.mass[0] * softly / stiffness(&rig, 1);
    must(oz_start_look(&start, &rig.scene, &rig.grains));
    assert_int_equal(start.count,
                     1); /* the second's four weights are more than a bed of one layer bears */
    assert_int_equal(start.worst.a, 1);
    rig_close(&rig);
    open_row(&rig, 2, diameter - 0.7 * diameter / 2, 1, 0);
    rig.scene.populations[0].kind = OZ_GRAINS_FILE;
    must(oz_start_look(&start, &rig.scene, &rig.grains));
    assert_int_equal(start.count, 1);
    assert_int_equal(start.refused, 0);
    rig_close(&rig);
}

/* A square that stands on its corner, d deep in the floor: its corner is shared by two triangles,
 * each half of the right angle, which hold Y d^3 / 3 together, twice their energy over their force
 * being 2 d / 3. */
static void test_a_corner_in_the_floor(void **state)
{
    (void)state;
    Rig rig;
    OzStart start;
    double depth = 1e-4;
    rig_open(
        &rig,
        "model: trigrains\ngravity: [0, 0]\ntime: {step: 1e-6, duration: 1}\n"
        "grains:\n  - {kind: single, shape: square, edge: 2e-3, angle: 45, position: [0, %.17g]}\n"
        "walls: [{kind: vessel, width: 32e-3, height: 20e-3, thickness: 2e-3}]\n",
        sqrt(2) * 1e-3 - depth);
    must(oz_start_look(&start, &rig.scene, &rig.grains));
    assert_int_equal(start.count, 1);
    assert_int_equal(start.refused, 0);
    assert_int_equal(start.worst.wall, 0);
    assert_true(fabs(start.worst.depth / (2 * depth / 3) - 1) < 1e-6); /* rounding, cubed */
    assert_true(fabs(start.worst.energy / (2e6 * depth * depth * depth / 3) - 1) < 1e-6);
    rig_close(&rig);
}

/* A square and a vessel of 32 x 20 mm about x = 0, its bottom at y = 0. */
static void open_vessel(Rig *rig, double x, double y)
{
    rig_open(rig,
             "model: trigrains\ntime: {step: 1e-6, duration: 1}\n"
             "grains:\n  - {kind: single, shape: square, edge: 2e-3, position: [%g, %g]}\n"
             "walls: [{kind: vessel, width: 32e-3, height: 20e-3, thickness: 2e-3}]\n",
             x, y);
}

static void test_a_square_in_the_floor(void **state)
{
    (void)state;
    Rig rig;
    open_vessel(&rig, 0, 2e-4);
    must_refuse(&rig, "grain 0 overlaps walls.0 at the start");
    rig_close(&rig);
    open_vessel(&rig, 0, 1.1e-3);
    OzStart start;
    must(oz_start_look(&start, &rig.scene, &rig.grains));
    assert_int_equal(start.count, 0);
    rig_close(&rig);
}

static void test_what_nothing_will_catch_is_named(void **state)
{
    (void)state;
    static const struct {
        double x, y;
        int outside;
    } at[] = {{0, 5e-3, 0}, {0.01, 0.5, 0}, {0.03, 5e-3, 1}, {0, -0.01, 1}, {-0.0168, 0.03, 0}};
    for (size_t k = 0; k < sizeof at / sizeof at[0]; k++) {
        Rig rig;
        OzStart start;
        open_vessel(&rig, at[k].x, at[k].y);
        must(oz_start_look(&start, &rig.scene, &rig.grains));
        assert_int_equal(start.outside, at[k].outside);
        rig_close(&rig);
    }
}

/* A small and a large sphere a third of a radius into each other, above a floor in which the large
 * one stands: what was in the floor rises out of it, and the two part by their depth, their common
 * centre of mass where it was. */
static void test_settling_may_part_grains(void **state)
{
    (void)state;
    Rig rig;
    OzStart start;
    rig_open(
        &rig,
        "model: rods\nprecision: double\ntime: {step: 1e-5, duration: 1}\n"
        "contact: {contact_time: 1e-3, restitution: 1}\nsettle: {drag: 70, overlaps: remove}\n"
        "grains:\n  - {kind: single, diameter: 1e-2, position: [0, 0, 1]}\n"
        "  - {kind: single, diameter: 2e-2, position: [1.3e-2, 0, 1]}\n"
        "  - {kind: single, diameter: 2e-2, position: [1, 0, 2e-3]}\nwalls: [{kind: plane}]\n");
    must_refuse(&rig, "overlap");
    oz_grains_free(&rig.grains);
    must(oz_members_place(&rig.grains, &rig.scene));
    must(oz_start_look(&start, &rig.scene, &rig.grains));
    assert_int_equal(start.count, 0);
    const double *x = rig.grains.position;
    assert_true(fabs(x[3] - x[0] - 1.5e-2) <
                1e-3 * 5e-3); /* to rounding's share of the smaller radius */
    assert_true(fabs(x[0] + 8 * x[3] - 8 * 1.3e-2) < 1e-9);
    assert_true(fabs(x[8] - 1e-2) < 1e-3 * 1e-2);
    rig_close(&rig);
}

/* Squares in each other and in the floor, one of them wholly: all come out of it, and none is moved
 * that was free. */
static void test_settling_may_part_squares(void **state)
{
    (void)state;
    Rig rig;
    OzStart start;
    rig_open(
        &rig,
        "model: trigrains\ntime: {step: 1e-6, duration: 1}\n"
        "settle: {drag: 70, overlaps: remove}\ngrains:\n"
        "  - {kind: single, shape: square, edge: 2e-3, position: [0, 6e-3]}\n"
        "  - {kind: single, shape: square, edge: 2e-3, position: [1.7e-3, 6.3e-3], angle: 20}\n"
        "  - {kind: single, shape: square, edge: 2e-3, position: [-8e-3, 2e-4], angle: 10}\n"
        "  - {kind: single, shape: square, edge: 2e-3, position: [9e-3, 9e-3]}\n"
        "  - {kind: single, shape: square, edge: 5e-4, position: [9.1e-3, 9.3e-3]}\n"
        "  - {kind: single, shape: square, edge: 2e-3, position: [-8e-3, 9e-3]}\n"
        "beams: {length_min: 0, area_min: 0}\n"
        "walls: [{kind: vessel, width: 32e-3, height: 20e-3, thickness: 2e-3}]\n");
    oz_grains_free(&rig.grains);
    must(oz_members_place(&rig.grains, &rig.scene));
    must(oz_start_look(&start, &rig.scene, &rig.grains));
    assert_int_equal(start.count, 0);
    const double *x = rig.grains.position;
    assert_true(x[7] > 1e-3); /* half its edge, and more as it leans */
    assert_true(x[15] == -8e-3 && x[16] == 9e-3);
    rig_close(&rig);
}

static void test_grains_without_room_are_refused(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig,
             "model: rods\nprecision: double\ntime: {step: 1e-5, duration: 1}\n"
             "contact: {contact_time: 1e-3, restitution: 1}\n"
             "settle: {drag: 70, overlaps: remove}\n"
             "grains: [{kind: single, diameter: 1e-2, position: [0, 0, 4e-3]}]\n"
             "walls: [{kind: plane}, {kind: plane, point: [0, 0, 8e-3], normal: [0, 0, -1]}]\n");
    oz_grains_free(&rig.grains);
    assert_int_equal(oz_members_place(&rig.grains, &rig.scene), OZ_ERR_INPUT);
    assert_non_null(strstr(oz_status_text(), "cannot be moved apart"));
    rig_close(&rig);
}

/* No word about any scene that comes with the program but those that start so on purpose. */
static void test_scenes_start_soundly(void **state)
{
    (void)state;
    glob_t found;
    assert_int_equal(glob(ORZO_SCENES "/*.yaml", 0, NULL, &found), 0);
    assert_int_equal(glob(ORZO_SCENES "/report/*.yaml", GLOB_APPEND, NULL, &found), 0);
    for (size_t k = 0; k < found.gl_pathc; k++) {
        Rig rig = {0};
        OzStart start;
        must(oz_scene_load(&rig.scene, found.gl_pathv[k], NULL, 0));
        must(oz_insert_grains(&rig.grains, &rig.scene));
        must(oz_start_look(&start, &rig.scene, &rig.grains));
        bool pressed = strstr(found.gl_pathv[k], "/aligned.yaml") ||
                       strstr(found.gl_pathv[k], "/shear_cell.yaml");
        if ((start.count > 0) != pressed || start.outside > 0) {
            fail_msg("%s: %lld overlaps, %lld outside", found.gl_pathv[k], (long long)start.count,
                     (long long)start.outside);
        }
        rig_close(&rig);
    }
    globfree(&found);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two_spheres),
        cmocka_unit_test(test_more_than_half_a_radius_is_refused),
        cmocka_unit_test(test_beds_are_left_alone),
        cmocka_unit_test(test_a_corner_in_the_floor),
        cmocka_unit_test(test_a_square_in_the_floor),
        cmocka_unit_test(test_what_nothing_will_catch_is_named),
        cmocka_unit_test(test_settling_may_part_grains),
        cmocka_unit_test(test_settling_may_part_squares),
        cmocka_unit_test(test_grains_without_room_are_refused),
        cmocka_unit_test(test_scenes_start_soundly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
