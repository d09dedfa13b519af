/* Walls that go on at a velocity: closed forms of one sphere, on the host reference and on the
 * device. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

/* A sphere of 1 mm that has just been put onto a plane which moves so. */
#define ONE                                                                                        \
    "model: rods\nprecision: %s\ngravity: [0, 0, -9.81]\n"                                         \
    "time: {step: 2e-6, duration: 10}\nintegrator: velocity-verlet\n"                              \
    "contact: {contact_time: 2e-4, restitution: 0.3, friction: 0.5}\n"                             \
    "grains: [{kind: single, diameter: 1e-3, position: [0, 0, 0.5e-3]}]\n"                         \
    "walls: [{kind: plane, motion: {velocity: %s, from: 0.02, until: 0.1}}]\n"

static const double R = 0.5e-3;
enum { STEPS_PER_MS = 500 };

static void assert_within(double a, double b, double most)
{
    if (!(fabs(a - b) <= most)) {
        fail_msg("%.9g is not %.9g within %g", a, b, most);
    }
}

/* A belt of V drags a sphere until it rolls, with the spin about the centre against it: friction
 * does m v = F t and (2/5) m R w = F t, and v + R w = V, so v = (2/7) V. Overlaps, 2e-5 R, shorten
 * the lever by as much. Slipping takes V (2/7) / (mu g) = 6 ms of the 80 that the belt goes. */
static void assert_rolls(const OzSnapshot *now)
{
    const double V = 0.1;
    assert_within(now->velocity[0], 2.0 / 7 * V, 1e-4 * V);
    assert_within(R * now->angular_velocity[1], -5.0 / 7 * V, 1e-4 * V);
    assert_within(now->velocity[1], 0, 1e-9 * V);
}

static void a_belt_makes_a_sphere_roll(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, ONE, "double", "[0.1, 0, 0]");
    rig_start(&rig);
    rig_advance(&rig, 90 * STEPS_PER_MS);
    assert_rolls(&rig.now);
    rig_close(&rig);
}

static void the_same_on_the_device(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, ONE, "float", "[0.1, 0, 0]");
    OzSnapshot now = state_after(&rig, NATIVE, 90 * STEPS_PER_MS);
    assert_rolls(&now);
    assert_within(now.wall_offset[0], 0.07 * 0.1, 1e-9);
    oz_snapshot_free(&now);
    rig_close(&rig);
}

/* A lift carries it, 80 ms of 0.1 m/s, and stops; then it rests 8 mm higher. At its start and its
 * stop it throws the sphere by v^2 / 2 g at most, 0.5 mm, which has died away 100 ms later. */
static void a_lift_carries_a_sphere(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, ONE, "double", "[0, 0, 0.1]");
    rig_start(&rig);
    rig_advance(&rig, 10 * STEPS_PER_MS);
    double rest = rig.now.position[2];
    rig_advance(&rig, 190 * STEPS_PER_MS);
    assert_within(rig.now.position[2] - rest, 8e-3,
                  1e-9); /* of a way of 8 mm, to rounding's sums */
    assert_within(rig.now.velocity[2], 0, 1e-7);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_belt_makes_a_sphere_roll),
        cmocka_unit_test(the_same_on_the_device),
        cmocka_unit_test(a_lift_carries_a_sphere),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
