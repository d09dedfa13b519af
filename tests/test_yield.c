/* Beams that yield, on the host: two triangles and a beam against the closed forms of an elastic,
 * perfectly plastic spring, and energy through it. */
#include "element_rig.h"

/* Two triangles alike, mirrored about the y axis, and an undamped beam along x. No gravity. */
static OzElements *open_pair(ElementRig *rig, const char *integrator, const char *limits,
                             double step)
{
    rig_read(rig,
             "gravity: [0, 0]\nintegrator: %s\nobserve: {ledger: true}\n"
             "time: {step: %.17g, duration: 1}\nbeams: {damping: 0, yield: {%s}}",
             integrator, step, limits);
    return rig_pair(rig);
}

/* A mass on a spring, hit to a speed, whose force yields at `limit`: what it then has left is
 * braked by that force alone. The way that stays, (mass / 2) speed^2 / limit less what the spring
 * holds. */
static double lasting(double mass, double stiffness, double speed, double limit)
{
    return 0.5 * mass * speed * speed / limit - 0.5 * limit / stiffness;
}

/* Both ends turn by 0.17 rad, and yield at six tenths of the moment: each is J on a spring of 2 E I
 * / L.
 */
static void check_bent(const char *integrator, double tolerance)
{
    const double spin = 400, limit = 1.1e-6;
    ElementRig rig;
    OzElements *elements = open_pair(&rig, integrator, "moment: 1.1e-6", 1e-6);
    elements->angular_velocity[0] = spin;
    elements->angular_velocity[1] = -spin;
    double bending =
        rig.scene.beams.stiffness * rig.scene.beams.second_moment / elements->beam_length[0];
    double angle = lasting(elements->inertia[0], 2 * bending, spin, limit);
    rig_start(&rig);
    double energy = rig_energy(&rig.now), most = 0;
    for (int64_t step = 10; step <= 4000; step += 10) {
        rig_advance(&rig, step);
        most =
            fmax(most, fabs(rig_energy(&rig.now) + rig.now.element_ledger.beam_yielded - energy));
    }
    const double *rest = rig.now.wear.rest;
    double a = rest[1] - elements->beam_rest_a[0], b = rest[2] - elements->beam_rest_b[0];
    print_message("%s: bent for good by %.6g and %.6g rad of %.6g rad, unaccounted %.2g\n",
                  integrator, a, b, angle, most / energy);
    /* two yields are a step apart in time at most: of second order in the 700 steps of bending */
    assert_true(fabs(a - angle) < tolerance * angle && fabs(b + angle) < tolerance * angle);
    assert_true(fabs(rest[0] / elements->beam_length[0] - 1) < 1e-14);
    assert_true(fabs(rig.now.element_ledger.beam_yielded - 2 * limit * angle) <
                tolerance * 2 * limit * angle);
    assert_true(most < tolerance * energy);
    rig_close(&rig);
}

static void test_bent(void **state)
{
    (void)state;
    check_bent("gear4", 1e-3);
    check_bent("velocity-verlet", 1e-3);
    check_bent("rk4", 1e-2); /* sees shapes at rest at the begin of a step alone */
}

/* Pulled, and pressed, beyond what it yields at: half a triangle's mass on a spring of E. */
static void check_axial(double sign, const char *limits, double limit)
{
    const double u = 0.4;
    ElementRig rig;
    OzElements *elements = open_pair(&rig, "velocity-verlet", limits, 2e-7);
    elements->velocity[0] = -sign * u / 2;
    elements->velocity[2] = sign * u / 2;
    double way = lasting(0.5 * elements->mass[0], rig.scene.beams.stiffness, u, limit);
    rig_start(&rig);
    double energy = rig_energy(&rig.now);
    rig_advance(&rig, 5000);
    double grown = rig.now.wear.rest[0] - elements->beam_length[0];
    double all = rig_energy(&rig.now) + rig.now.element_ledger.beam_yielded;
    print_message("%s: longer for good by %.6g m of %.6g m, unaccounted %.2g\n", limits, grown,
                  sign * way, all / energy - 1);
    assert_true(fabs(grown - sign * way) < 1e-3 * way);
    assert_true(fabs(all / energy - 1) < 1e-3);
    rig_close(&rig);
}

static void test_pulled_and_pressed(void **state)
{
    (void)state;
    check_axial(1, "tension: 5e-3, compression: 0.1", 5e-3);
    check_axial(-1, "tension: 0.1, compression: 5e-3", 5e-3);
}

/* A square in wild motion: what it loses is booked, its shape follows, its momentum stays. */
static void test_square(void **state)
{
    (void)state;
    ElementRig rig;
    double before[3], after[3];
    rig_read(&rig,
             "gravity: [0, 0]\nintegrator: velocity-verlet\nobserve: {ledger: true}\n"
             "time: {step: 2e-7, duration: 1}\nbeams: {damping: 1e-3, damping_shear: balanced, "
             "yield: {tension: 4e-3, compression: 4e-3, moment: 2e-7}}");
    rig_wild_square(&rig, 300);
    rig_start(&rig);
    rig_momentum(&rig.now, before);
    double energy = rig_energy(&rig.now);
    rig_advance(&rig, 10000);
    rig_momentum(&rig.now, after);
    OzElementLedger l = rig.now.element_ledger;
    double all = rig_energy(&rig.now) + l.beam_axial + l.beam_bending + l.beam_yielded;
    print_message("yielding took %.2g of the energy; unaccounted %.2g\n", l.beam_yielded / energy,
                  all / energy - 1);
    assert_true(l.beam_yielded > 0.1 * energy);
    /* second order in a step of the fastest vibration's 700 */
    assert_true(fabs(all / energy - 1) < 1e-4);
    for (int k = 0; k < 2; k++) {
        assert_true(fabs(after[k] - before[k]) < 1e-12 * hypot(before[0], before[1]));
    }
    assert_int_equal(rig.now.count, 1);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bent),
        cmocka_unit_test(test_pulled_and_pressed),
        cmocka_unit_test(test_square),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
