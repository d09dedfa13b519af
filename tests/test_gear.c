/* The orders of the reference's integrators, seen on a grain that bends and turns with damping, and
 * what Gear's start is worth. */
#include "element_rig.h"

#define OZ_HOST
#include "kernels/gear.h"

static const double rest[2] = {0, 0};

/* A square whose triangles start with rates of their own, after 1 ms. */
static void run_square(const char *integrator, double step, double place[12])
{
    ElementRig rig;
    rig_read(&rig, "gravity: [0, 0]\nintegrator: %s\ntime: {step: %.17g, duration: 1}", integrator,
             step);
    rig_grains(&rig, 1, 4, 4);
    rig_square(&rig, 0, 2e-3, rest, 0.3, rest, 4);
    for (int i = 0; i < 4; i++) {
        rig.grains.elements->velocity[2 * i] = 0.2 * cos(3 * i);
        rig.grains.elements->velocity[2 * i + 1] = 0.2 * sin(2 * i + 1);
        rig.grains.elements->angular_velocity[i] = 300 * cos(5 * i + 1);
    }
    rig_start(&rig);
    rig_advance(&rig, (int64_t)(1e-3 / step + 0.5));
    for (int i = 0; i < 4; i++) {
        memcpy(&place[3 * i], &rig.now.element_position[2 * i], 2 * sizeof(double));
        place[3 * i + 2] = 1e-3 * rig.now.element_angle[i];
    }
    rig_close(&rig);
}

static double distance(const double *a, const double *b, int count)
{
    double sum = 0;
    for (int k = 0; k < count; k++) {
        sum += (a[k] - b[k]) * (a[k] - b[k]);
    }
    return sqrt(sum);
}

/* Half the step divides the error by 2^order, up to the next order's part: within 0.3 of it. */
static void check_order(const char *integrator, double step, double order)
{
    double exact[12], coarse[12], fine[12];
    run_square("rk4", 1.25e-7, exact);
    run_square(integrator, step, coarse);
    run_square(integrator, step / 2, fine);
    double found = log2(distance(coarse, exact, 12) / distance(fine, exact, 12));
    print_message("%s: error %.2g m at %g s, order %.2f\n", integrator, distance(coarse, exact, 12),
                  step, found);
    /* the next order's part: some hundredths at these steps */
    assert_true(fabs(found - order) < 0.1);
}

static void test_orders(void **state)
{
    (void)state;
    check_order("gear4", 2e-6, 4);
    check_order("velocity-verlet", 2e-6, 2);
    check_order("rk4", 4e-6, 4);
}

/* x'' = -x - x' / 4 from x = 1, x' = 0 for about a period, with correct or zero third and fourth
 * derivatives at the start. */
static double oscillator_error(int steps, int started)
{
    const double damping = 0.25, end = 6;
    double rate = sqrt(1 - damping * damping / 4), dt = end / steps;
    double exact =
        exp(-damping * end / 2) * (cos(rate * end) + damping / (2 * rate) * sin(rate * end));
    double third = started ? damping : 0, fourth = started ? 1 - damping * damping : 0;
    OzGear gear = oz_gear_start(1, 0, -1, third, fourth, dt);
    for (int i = 0; i < steps; i++) {
        gear = oz_gear_predict(gear);
        double force = -gear.value[0] - damping * gear.value[1] / dt;
        gear = oz_gear_correct(gear, force, 0.5 * dt * dt);
    }
    return fabs(gear.value[0] - exact);
}

static void test_start(void **state)
{
    (void)state;
    double started = log2(oscillator_error(400, 1) / oscillator_error(800, 1));
    double zero = log2(oscillator_error(400, 0) / oscillator_error(800, 0));
    print_message("gear4 with its start: order %.2f; started from zeros: %.2f\n", started, zero);
    /* the next order's part: two hundredths */
    assert_true(fabs(started - 4) < 0.1);
    assert_true(fabs(zero - 2) < 0.1);
}

/* Motion as the fourth power of time is what five values hold: started from its derivatives at 1,
 * each prediction is its Taylor series. Halves and quarters: exact in double. */
static void test_fourth_power(void **state)
{
    (void)state;
    double dt = 0.5;
    OzGear gear = oz_gear_predict(oz_gear_start(1, 4, 12, 24, 24, dt));
    assert_true(gear.value[0] == 1.5 * 1.5 * 1.5 * 1.5);
    assert_true(gear.value[1] == 4 * 1.5 * 1.5 * 1.5 * dt);
    assert_true(gear.value[2] == 12 * 1.5 * 1.5 * dt * dt / 2);
    assert_true(gear.value[3] == 24 * 1.5 * dt * dt * dt / 6);
    assert_true(gear.value[4] == dt * dt * dt * dt);
}

/* Motion as the fifth power of time, in steps of 1: what five values cannot hold makes the third
 * and fourth derivative lag, and with Gear's coefficients by -20/3 and -5 (times dt^n / n!) for
 * good, while position and velocity stay exact. That is what 19/90 and 3/4 are for: position is as
 * true as the velocity that forces depend on (Gear 1966). 19/120, for forces that do not, would be
 * off by 19/6 a step. Whole numbers up to 1e5 and thirds: rounding alone. */
static void test_fifth_power(void **state)
{
    (void)state;
    OzGear gear = {{0, 0, 0, -20.0 / 3, -5}};
    for (int n = 1; n <= 10; n++) {
        double cube = (double)n * n * n;
        gear = oz_gear_correct(oz_gear_predict(gear), 20 * cube, 0.5);
        /* a last digit of 1e5 is 1.5e-11 */
        assert_true(fabs(gear.value[0] - cube * n * n) < 1e-10);
        assert_true(fabs(gear.value[1] - 5 * cube * n) < 1e-10);
        assert_true(fabs(gear.value[3] - (10.0 * n * n - 20.0 / 3)) < 1e-10);
        assert_true(fabs(gear.value[4] - (5.0 * n - 5)) < 1e-10);
    }
}

/* The derivatives that gear4 starts from, of two triangles' axial vibration: x'' = a, x''' and
 * x'''' follow from the linear equation. Their differences' error is of fourth order in 1e-7 s
 * times 1e4/s; rounding is divided by the step squared. */
static void test_derivatives(void **state)
{
    (void)state;
    ElementRig rig;
    double second[6], third[6], fourth[6];
    rig_read(&rig, "gravity: [0, 0]\nintegrator: gear4\ntime: {step: 1e-6, duration: 1}");
    OzElements *elements = rig_grains(&rig, 1, 2, 1);
    must(
        oz_elements_set_triangle(elements, 0, (double[6]){-2e-3, 0, -4e-4, -1e-3, -4e-4, 1e-3}, 4));
    must(oz_elements_set_triangle(elements, 1, (double[6]){2e-3, 0, 4e-4, -1e-3, 4e-4, 1e-3}, 4));
    elements->beam_b[0] = 1;
    oz_elements_rest_beam(elements, 0);
    elements->velocity[2] = 0.1;
    rig_start(&rig);
    must(oz_element_reference_start_derivatives(&rig.now, false, second, third, fourth));
    /* relative motion: y'' = -2 d y' - w y */
    double d = rig.scene.beams.damping / elements->mass[1], v = 0.1;
    double w = 2 * rig.scene.beams.stiffness / elements->mass[1];
    double a = -2 * d * v, j = -2 * d * a - w * v, s = -2 * d * j - w * a;
    /* rounding; then divided by the step once and twice: 1e-11 and 2e-10; both elements alike */
    assert_true(fabs(second[3] / (a / 2) - 1) < 1e-12);
    assert_true(fabs(third[3] / (j / 2) - 1) < 1e-9);
    assert_true(fabs(fourth[3] / (s / 2) - 1) < 1e-9);
    assert_true(fabs(third[0] + third[3]) < 1e-12 * fabs(third[3]));
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_orders),       cmocka_unit_test(test_start),
        cmocka_unit_test(test_fourth_power), cmocka_unit_test(test_fifth_power),
        cmocka_unit_test(test_derivatives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
