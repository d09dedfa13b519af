/* Discs' contacts, one at a time: where they meet each other and triangles, energies, and the
 * limits of what they push, pull and drag. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "sim/element_dialect.h"

#include <math.h>

static const double mass = 2e-3, away[2] = {0.6, 0.8}; /* the normal of the tests below */

static void assert_at(OzVec2 found, double x, double y)
{
    assert_true(fabs(found.x - x) < 1e-15 && fabs(found.y - y) < 1e-15); /* rounding */
}

static void test_where_discs_meet(void **state)
{
    (void)state;
    /* 5 apart along (3, 4), the first of radius 2: 2 of it up to the second's edge at 5 - 3.5 */
    OzDiscPlace place = oz_disc_meet(oz_vec2(1, 1), 2, oz_vec2(4, 5), 3.5);
    /* the distance is 5 = hypot(3, 4), right to a last digit */
    assert_at(place.normal, 0.6, 0.8);
    assert_true(fabs(place.overlap - 0.5) < 1e-15);
    assert_at(place.point, 1 + 1.75 * 0.6, 1 + 1.75 * 0.8);
}

/* Over an edge, over a corner, and inside, where the closest edge is the way out. */
static void test_where_discs_meet_triangles(void **state)
{
    (void)state;
    OzTriangle t = {{{0, 0}, {8, 0}, {0, 8}}};
    OzDiscPlace edge = oz_disc_meet_triangle(&t, oz_vec2(5, -1), 1.5);
    assert_at(edge.normal, 0, -1);
    assert_at(edge.point, 5, 0.25);
    OzDiscPlace corner = oz_disc_meet_triangle(&t, oz_vec2(-3, -4), 5.5);
    assert_at(corner.normal, -0.6, -0.8);
    /* 5 again; halves are exact */
    assert_true(fabs(corner.overlap - 0.5) < 1e-15);
    assert_at(corner.point, 0.25 * 0.6, 0.25 * 0.8);
    OzDiscPlace far_corner = oz_disc_meet_triangle(&t, oz_vec2(11, -4), 5.5);
    assert_at(far_corner.normal, 0.6, -0.8);
    OzDiscPlace inside = oz_disc_meet_triangle(&t, oz_vec2(3, 0.5), 2);
    assert_at(inside.normal, 0, -1);
    /* nothing is rounded but an edge's unit vector */
    assert_true(fabs(inside.overlap - 2.5) < 1e-15);
    assert_at(inside.point, 3, 1.25);
}

/* A contact of this overlap, whose bodies part and slide (b against a) at these speeds. */
static OzDiscForce push(const OzDiscLaw *law, double overlap, double parting, double sliding)
{
    OzDiscPlace place = {{away[0], away[1]}, {0, 0}, overlap};
    OzVec2 velocity = {parting * away[0] - sliding * away[1],
                       parting * away[1] + sliding * away[0]};
    return oz_disc_force(place, velocity, mass, *law);
}

static double along(OzDiscForce f)
{
    return f.force.x * away[0] + f.force.y * away[1];
}

static double across(OzDiscForce f)
{
    return f.force.y * away[0] - f.force.x * away[1];
}

/* What is stored is the work of the way in: k x^2 / 2 of a spring of k = mass x stiffness, 2/5 Y
 * x^(5/2) of Hertz's, which pushes with Y x^(3/2). */
static void test_energies(void **state)
{
    (void)state;
    OzDiscLaw hooke = {.stiffness = 1e6}, hertz = {.hertz = 1, .stiffness = 1e6};
    for (double x = 1e-6; x < 1e-3; x *= 3) {
        /* both sides round some products, roots and powers: 2e-16 each */
        assert_true(fabs(along(push(&hooke, x, 0, 0)) / (mass * 1e6 * x) - 1) < 2e-15);
        assert_true(fabs(push(&hooke, x, 0, 0).energy / (mass * 1e6 * x * x / 2) - 1) < 2e-15);
        assert_true(fabs(along(push(&hertz, x, 0, 0)) / (1e6 * pow(x, 1.5)) - 1) < 2e-15);
        assert_true(fabs(push(&hertz, x, 0, 0).energy / (0.4e6 * pow(x, 2.5)) - 1) < 2e-15);
    }
    OzDiscForce none = push(&hooke, -1e-6, -1, 1);
    assert_true(none.force.x == 0 && none.force.y == 0 && none.energy == 0);
    assert_true(!none.touching && none.power_normal == 0 && none.power_tangential == 0);
}

/* A dashpot resists coming as going, and takes both times; clamped it never pulls. */
static void test_dashpots(void **state)
{
    (void)state;
    OzDiscLaw law = {.stiffness = 1e6, .damping = 1e3};
    /* all to a few roundings of products: 2e-16 each */
    double spring = mass * 1e6 * 1e-5, drag = mass * 1e3 * 0.1;
    assert_true(fabs(along(push(&law, 1e-5, -0.1, 0)) / (spring + drag) - 1) < 2e-15);
    assert_true(fabs(along(push(&law, 1e-5, 0.1, 0)) / (spring - drag) - 1) < 2e-15);
    assert_true(spring < drag); /* it pulls */
    assert_true(fabs(push(&law, 1e-5, -0.1, 0).power_normal / (drag * 0.1) - 1) < 2e-15);
    assert_true(fabs(push(&law, 1e-5, 0.1, 0).power_normal / (drag * 0.1) - 1) < 2e-15);
    /* to a few roundings again, but no force is none */
    law.clamp = 1;
    assert_true(fabs(along(push(&law, 1e-5, -0.1, 0)) / (spring + drag) - 1) < 2e-15);
    assert_true(along(push(&law, 1e-5, 0.1, 0)) == 0);
    assert_true(fabs(push(&law, 1e-5, 0.1, 0).power_normal / (spring * 0.1) - 1) < 2e-15);
}

/* Friction is against sliding: a dashpot, of no more than mu times the normal force, and what it
 * takes is its force times the speed. */
static void test_friction(void **state)
{
    (void)state;
    OzDiscLaw law = {.stiffness = 1e6, .tangential_damping = 1e3, .friction = 0.5};
    double most = 0.5 * mass * 1e6 * 1e-4, slow = 0.01, fast = 10;
    for (int way = -1; way <= 1; way += 2) {
        OzDiscForce sticks = push(&law, 1e-4, 0, way * slow),
                    slips = push(&law, 1e-4, 0, way * fast);
        /* taking the direction apart and together leaves some last digits: 2e-15 */
        assert_true(fabs(across(sticks) / (-way * mass * 1e3 * slow) - 1) < 1e-14);
        assert_true(fabs(across(slips) / (-way * most) - 1) < 1e-14);
        assert_true(fabs(sticks.power_tangential / (mass * 1e3 * slow * slow) - 1) < 1e-14);
        /* nothing but products here */
        assert_true(fabs(slips.power_tangential / (most * fast) - 1) < 2e-15);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_where_discs_meet), cmocka_unit_test(test_where_discs_meet_triangles),
        cmocka_unit_test(test_energies),         cmocka_unit_test(test_dashpots),
        cmocka_unit_test(test_friction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
