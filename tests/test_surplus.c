/* The guard against energy from nowhere, on beds that heat up and beds that do not. */
#include "rig.h"

#include "observe/observables.h"
#include "observe/surplus.h"

/* A sphere that bounces on a plane without loss, ten steps a contact: with explicit Euler each hit
 * gives back 1.6 times the speed. Rows until the guard speaks, at most 120. */
static int rows_with(const char *integrator, const char *wall, bool contacts, const char *friction,
                     bool ledger)
{
    Rig rig;
    OzSurplus surplus = {0};
    int rows = 0;
    OzStatus status = OZ_OK;
    rig_open(&rig,
             "model: rods\ntime: {step: 1e-4, duration: 1}\nintegrator: %s\n"
             "contact: {contact_time: 1e-3, restitution: 1, %s}\nobserve: {ledger: %s}\n"
             "grains: [{kind: single, diameter: 1e-2, position: [0, 0, 6e-3]}]\nwalls: [{%s}]\n",
             integrator, friction, ledger ? "true" : "false", wall);
    rig_start(&rig);
    for (; rows < 120 && status == OZ_OK; rows++) {
        rig.now.has_contacts = contacts;
        status = oz_surplus_check(&surplus, &rig.now);
        if (status == OZ_OK) {
            rig_advance(&rig, (rows + 1) * 20);
        }
    }
    if (status != OZ_OK) {
        assert_int_equal(status, OZ_ERR_BLOWUP);
        assert_non_null(strstr(oz_status_text(), "without input"));
        assert_non_null(strstr(oz_status_text(), "time 0."));
    }
    rig_close(&rig);
    return rows;
}

static int rows_until_stopped(const char *integrator, const char *wall, bool contacts)
{
    return rows_with(integrator, wall, contacts, "friction: 0", false);
}

static void test_stops_what_heats_up(void **state)
{
    (void)state;
    int rows = rows_until_stopped("euler", "kind: plane", true);
    assert_true(rows > 40 && rows < 110);
}

/* What a sphere at rest held: nothing, whatever its height, and so much counts as given that it
 * could fall a diameter. */
static void test_height_is_no_energy_to_gain_by(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        Rig rig;
        OzSurplus surplus = {0};
        rig_open(&rig, "model: rods\ntime: {step: 1e-4, duration: 1}\ngravity: [0, 0, -10]\n"
                       "contact: {contact_time: 1e-3, restitution: 1}\n"
                       "grains: [{kind: single, diameter: 1e-2, position: [0, 0, 7]}]\n");
        rig_start(&rig);
        must(oz_surplus_check(&surplus, &rig.now));
        rig.now.velocity[0] = sqrt(2 * 10 * 1e-2 * (k ? 1.01 : 0.99));
        assert_int_equal(oz_surplus_check(&surplus, &rig.now), k ? OZ_ERR_BLOWUP : OZ_OK);
        rig_close(&rig);
    }
}

static void test_leaves_alone_what_does_not(void **state)
{
    (void)state;
    assert_int_equal(rows_until_stopped("symplectic-euler", "kind: plane", true), 120);
    assert_int_equal(rows_until_stopped("velocity-verlet", "kind: plane", true), 120);
}

/* A sphere that a floor throws up gains more than it held; nothing tells how much is the floor's.
 */
static void test_is_silent_where_input_is_unknown(void **state)
{
    (void)state;
    const char *floor = "kind: plane, motion: {frequency: 30, acceleration_ratio: 20}";
    assert_int_equal(rows_until_stopped("symplectic-euler", floor, true), 120);
    assert_int_equal(rows_until_stopped("symplectic-euler", "kind: plane", false), 120);
}

/* Something at rest without gravity holds nothing, so that any rounding is a gain: one below what
 * an overlap of 1e-8 of the size would hold (speed sqrt(k / m) times that: 3e-7 m/s here, for the
 * square 1e-6) is none, one a hundred times as fast is. */
static void test_leaves_rounding_alone(void **state)
{
    (void)state;
    static const char *const scenes[] = {
        "model: rods\nprecision: double\ngravity: [0, 0, 0]\ntime: {step: 1e-4, duration: 1}\n"
        "contact: {contact_time: 1e-3, restitution: 1}\n"
        "grains: [{kind: single, diameter: 1e-2, position: [0, 0, 0]}]\n",
        "model: trigrains\ngravity: [0, 0]\ntime: {step: 1e-6, duration: 1}\n"
        "grains: [{kind: single, shape: square, edge: 2e-3, position: [0, 0]}]\n"};
    for (int k = 0; k < 2; k++) {
        for (int fast = 0; fast < 2; fast++) {
            Rig rig;
            OzSurplus surplus = {0};
            rig_open(&rig, "%s", scenes[k]);
            must(oz_snapshot_create(&rig.now, &rig.scene, &rig.grains));
            rig.now.has_contacts = true;
            must(oz_surplus_check(&surplus, &rig.now));
            *(k ? rig.now.element_velocity : rig.now.velocity) = fast ? 1e-4 : 1e-8;
            assert_int_equal(oz_surplus_check(&surplus, &rig.now), fast ? OZ_ERR_BLOWUP : OZ_OK);
            rig_close(&rig);
        }
    }
}

static const char grazing[] =
    "model: rods\nprecision: double\ngravity: [0, 0, 0]\nintegrator: velocity-verlet\n"
    "time: {step: 5e-7, duration: 3e-3}\nobserve: {ledger: true}\n"
    "contact: {contact_time: 5e-4, restitution: 1, friction: 0.5, slip: scale}\n"
    "grains:\n  - {kind: single, diameter: 0.01, position: [0, 0, 0.005], velocity: [8, 0, -1]}\n"
    "walls: [{kind: plane}]\n";

/* A grazing hit whose spring grows while the contact slides. Half way through, the normal spring
 * holds m v^2 / 2, and the tangential one would give back mu f_n (xi - mu f_n / (2 k_t)), f_n = m v
 * pi / t_c. xi is the way slid: the contact's speed u falls by 3.5 mu v (1 - cos(pi t / t_c)).
 * Within 5 %: the hit begins without sliding. */
static void test_a_spring_grown_beyond_friction_holds_what_it_gives_back(void **state)
{
    (void)state;
    Rig rig;
    const double pi = 3.14159265358979323846, time = 5e-4, speed = 1, friction = 0.5;
    rig_open(&rig, grazing);
    rig_start(&rig);
    double m = rig.grains.mass[0], push = friction * speed * pi / time,
           slow = 3.5 * friction * speed;
    double way = time * (8 / 2.0 - slow * (0.5 - 1 / pi));
    double stiffness = 2.0 / 7 * pi * pi / (time * time);
    double expected = 0.5 * m * speed * speed + m * push * (way - push / (2 * stiffness));
    rig_advance(&rig, 500);
    /* the beginning without sliding: 0.002 */
    assert_true(fabs(rig.now.ledger.elastic / expected - 1) < 0.01);
    rig_close(&rig);
}

/* The law gives energy back, at any step: no reason to stop. The ledger misses a fifth of a step's
 * share of the start's energy, a thousandth; what the law gives back for a while is 5 % of it. */
static void test_leaves_alone_what_the_law_gives_back(void **state)
{
    (void)state;
    Rig rig;
    OzSurplus surplus = {0};
    double least = 0;
    rig_open(&rig, grazing);
    rig_start(&rig);
    double start = oz_observables_energy(&rig.now);
    for (int row = 0; row <= 120; row++) {
        rig_advance(&rig, row * 10);
        must(oz_surplus_check(&surplus, &rig.now));
        /* a fifth of a thousandth, as said above: 1.6e-4 */
        assert_true(fabs(oz_observables_energy(&rig.now) - start) < 2e-4 * start);
        least = fmin(least, rig.now.ledger.friction);
    }
    assert_true(least < -0.02 * start); /* it did give back */
    assert_true(rig.now.ledger.friction > 0 && rig.now.ledger.elastic == 0);
    rig_close(&rig);
}

/* An unstable step is found with that law too, where the ledger is on. */
static void test_stops_what_heats_up_with_any_friction(void **state)
{
    (void)state;
    assert_true(rows_with("euler", "kind: plane", true, "friction: 0.3, slip: scale", true) < 110);
    assert_int_equal(rows_with("euler", "kind: plane", true, "friction: 0.3, slip: scale", false),
                     120);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stops_what_heats_up),
        cmocka_unit_test(test_height_is_no_energy_to_gain_by),
        cmocka_unit_test(test_leaves_alone_what_does_not),
        cmocka_unit_test(test_is_silent_where_input_is_unknown),
        cmocka_unit_test(test_leaves_rounding_alone),
        cmocka_unit_test(test_a_spring_grown_beyond_friction_holds_what_it_gives_back),
        cmocka_unit_test(test_leaves_alone_what_the_law_gives_back),
        cmocka_unit_test(test_stops_what_heats_up_with_any_friction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
