/* The guard against energy from nowhere, on beds that heat up and beds that do not. */
#include "rig.h"

#include "observe/surplus.h"

/* A sphere that bounces on a plane without loss, ten steps a contact: with explicit Euler each hit
 * gives back 1.6 times the speed. Rows until the guard speaks, at most 120. */
static int rows_until_stopped(const char *integrator, const char *wall, bool contacts)
{
    Rig rig;
    OzSurplus surplus = {0};
    int rows = 0;
    OzStatus status = OZ_OK;
    rig_open(&rig,
             "model: rods\ntime: {step: 1e-4, duration: 1}\nintegrator: %s\n"
             "contact: {contact_time: 1e-3, restitution: 1, friction: 0}\n"
             "grains: [{kind: single, diameter: 1e-2, position: [0, 0, 6e-3]}]\nwalls: [{%s}]\n",
             integrator, wall);
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

static void test_stops_what_heats_up(void **state)
{
    (void)state;
    int rows = rows_until_stopped("euler", "kind: plane", true);
    assert_true(rows > 40 && rows < 110);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stops_what_heats_up),
        cmocka_unit_test(test_leaves_alone_what_does_not),
        cmocka_unit_test(test_is_silent_where_input_is_unknown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
