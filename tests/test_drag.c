/* Drag and wind in the host reference: single grains against their closed forms. */
#include "rig.h"

static const double gravity = 9.81, diameter = 1e-3, density = 2500;

static void open_grain(Rig *rig, double aspect, const char *drag)
{
    rig_open(rig,
             "model: rods\ntime: {step: 1e-4, duration: 10}\nintegrator: velocity-verlet\n"
             "observe: {ledger: true}\ncontact: {contact_time: 1e-2, restitution: 0.5}\n"
             "grains: [{kind: single, diameter: 1e-3, aspect: %g, position: [0, 0, 0],"
             " spin: [0, 0, 5]}]\ndrag: {%s}\n",
             aspect, drag);
    rig_start(rig);
}

/* Stokes: v = v_t (1 - exp(-t / tau)) with tau = rho d^2 / (18 eta), v_t = g tau, and a spin that
 * decays with I / (pi eta d^3) = rho d^2 / (60 eta). */
static void test_a_slow_sphere_falls_as_stokes_says(void **state)
{
    (void)state;
    const double eta = 0.01, tau = density * diameter * diameter / (18 * eta);
    Rig rig;
    open_grain(&rig, 0, "viscosity: 0.01");
    for (int64_t step = 50; step <= 3000; step *= 4) {
        rig_advance(&rig, step);
        double t = rig.now.time, expected = -gravity * tau * (1 - exp(-t / tau));
        /* second order of a step of tau / 139: 1e-4 of what decays, a fifth of it */
        assert_true(fabs(rig.now.velocity[2] / expected - 1) < 2e-5);
        assert_true(fabs(rig.now.angular_velocity[2] - 5 * exp(-t * 60 / (18 * tau))) < 2e-4 * 5);
    }
    /* what gravity gave and it does not have, the fluid has, but for the half of the last step's
     * force that velocity-verlet applies in the next: 1e-4 s / 2 of 8 tau */
    double start = 0.5 * rig.grains.inertia_axis[0] * 25;
    double gone = start - mechanical_energy(&rig.now);
    assert_true(fabs(rig.now.ledger.dissipated / gone - 1) < 2e-3);
    rig_close(&rig);
}

/* The square alone: v = v_t tanh(g t / v_t), v_t^2 = 4/3 rho g d / (rho_f C_d). */
static void test_a_fast_sphere_falls_as_the_square_says(void **state)
{
    (void)state;
    const double most = sqrt(4.0 / 3 * density * gravity * diameter / (1000 * 0.5));
    Rig rig;
    open_grain(&rig, 0, "coefficient: 0.5, density: 1000");
    for (int64_t step = 50; step <= 1000; step *= 4) {
        rig_advance(&rig, step);
        double expected = -most * tanh(gravity * rig.now.time / most);
        /* second order of a step of v_t / g / 260 */
        assert_true(fabs(rig.now.velocity[2] / expected - 1) < 1e-5);
    }
    assert_true(rig.now.angular_velocity[2] == 5); /* which only viscosity slows */
    rig_close(&rig);
}

/* A rod falls as the sphere of its volume would: of aspect 4, d^3 is (1 + 3/2 4) times its
 * diameter's. */
static void test_a_rod_falls_as_a_sphere_of_its_volume(void **state)
{
    (void)state;
    const double size = diameter * cbrt(7), tau = density * size * size / (18 * 0.1);
    Rig rig;
    open_grain(&rig, 4, "viscosity: 0.1");
    rig_advance(&rig, (int64_t)(20 * tau / 1e-4));
    /* exp(-20) is left */
    assert_true(fabs(rig.now.velocity[2] / (-gravity * tau) - 1) < 1e-7);
    rig_close(&rig);
}

/* A grain goes with the wind in the end, beside its fall. What the wind gives is in the ledger. */
static void test_the_wind_takes_a_grain_along(void **state)
{
    (void)state;
    const double tau = density * diameter * diameter / (18 * 0.05);
    Rig rig;
    open_grain(&rig, 0, "viscosity: 0.05, wind: [2, -1, 0.5]");
    rig_advance(&rig, (int64_t)(30 * tau / 1e-4));
    const double expected[3] = {2, -1, 0.5 - gravity * tau};
    for (int c = 0; c < 3; c++) {
        assert_true(fabs(rig.now.velocity[c] - expected[c]) < 1e-9);
    }
    double start = 0.5 * rig.grains.inertia_axis[0] * 25;
    double lost = start - mechanical_energy(&rig.now);
    /* second order of a step of tau / 28 */
    assert_true(fabs(rig.now.ledger.dissipated - lost) < 1e-3 * fabs(lost));
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_slow_sphere_falls_as_stokes_says),
        cmocka_unit_test(test_a_fast_sphere_falls_as_the_square_says),
        cmocka_unit_test(test_a_rod_falls_as_a_sphere_of_its_volume),
        cmocka_unit_test(test_the_wind_takes_a_grain_along),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
