/* The stiffest swing of a grain at a wall, beside closed forms. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "model/contact.h"
#include "model/insert.h"
#include "scene/scene.h"
#include "sim/stiffness.h"

#include <math.h>

/* Without friction a rod lying at a wall bounces on two contacts, and tilts m a^2 / I times as
 * stiffly. With it a sphere rolls there by its tangential spring over 1/m + r^2 / I. */
static void test_stiffness_at_a_wall(void **state)
{
    (void)state;
    const char *text =
        "model: rods\ntime: {step: 1e-5, duration: 1}\n"
        "contact: {contact_time: 1e-3, restitution: 0.5, friction: 0}\n"
        "grains:\n"
        "  - {kind: single, diameter: 5e-3, position: [0, 0, 9e-2]}\n"
        "  - {kind: single, diameter: 5e-3, aspect: 8, position: [0, 0, 5e-2]}\n"
        "walls:\n  - {kind: plane}\n  - {kind: plane, contact: {contact_time: 5e-4}}\n";
    OzScene scene = {0};
    OzGrains grains = {0};
    OzStiffness at[2];
    assert_int_equal(OZ_OK, oz_scene_parse(&scene, "bed", text, NULL, 0));
    assert_int_equal(OZ_OK, oz_insert_grains(&grains, &scene));
    double arm = 0.5 * grains.length[1], share = grains.mass[1] * arm * arm / grains.inertia[1];
    for (int w = 0; w < 2; w++) {
        OzContactConstants wall = oz_contact_constants(&scene.walls[w].contact);
        assert_int_equal(OZ_OK, oz_stiffness_at_wall(&at[w], &scene, &grains, w));
        assert_int_equal(2, at[w].contacts);
        /* a hundred rounds part two swings that are a factor of two apart to rounding */
        assert_true(fabs(at[w].stiffness / (2 * share * wall.stiffness) - 1) < 1e-12);
        assert_true(fabs(at[w].damping / (2 * share * wall.damping) - 1) < 1e-12);
    }
    assert_true(fabs(at[0].largest_step / at[1].largest_step - 2) < 1e-9);
    grains.count = 1;
    scene.walls[0].contact.friction = 0.5;
    OzContactConstants wall = oz_contact_constants(&scene.walls[0].contact);
    double rolls = 3.5 * wall.tangential_stiffness; /* 1 + m r^2 / I of a sphere */
    assert_int_equal(OZ_OK, oz_stiffness_at_wall(&at[0], &scene, &grains, 0));
    assert_int_equal(1, at[0].contacts);
    assert_true(fabs(at[0].stiffness / fmax(rolls, wall.stiffness) - 1) < 1e-2);
    grains.count = 2;
    oz_grains_free(&grains);
    oz_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_stiffness_at_a_wall)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
