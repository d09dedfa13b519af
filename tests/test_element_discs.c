/* Discs among elements, stepped by the host reference: their laws against closed forms, and at rest
 * on a wall's triangle. */
#include "element_rig.h"

#include "sim/element_laws.h"

static const double pi = 3.14159265358979323846;

static const char *const hooke = "contact: {contact_time: 1e-4, restitution: 0.6, friction: 0}";

/* Two discs that meet head on; the first flies. */
static void open_discs(ElementRig *rig, const char *contact, double step, double aside)
{
    rig_read(rig,
             "gravity: [0, 0]\nintegrator: gear4\nobserve: {ledger: true}\n"
             "time: {step: %g, duration: 1}\n%s",
             step, contact);
    OzElements *p = rig_grains(rig, 2, 1, 0);
    oz_elements_set_disc(p, 0, (double[2]){0, 0}, 1e-3, 4);
    oz_elements_set_disc(p, 1, (double[2]){2e-3, aside}, 1e-3, 4);
    p->velocity[0] = 0.1;
    rig_start(rig);
}

/* The asked restitution, up to where first touch falls in a step: 1e-3 at 500 steps a hit. */
static void test_disc_restitution(void **state)
{
    (void)state;
    ElementRig rig;
    open_discs(&rig, hooke, 2e-7, 1e-5);
    rig_advance(&rig, 1000);
    double after = rig.now.velocity[3] - rig.now.velocity[0];
    /* first touch falls between two of 500 steps: 3e-5 here */
    assert_true(fabs(after / 0.1 - 0.6) < 1e-4);
    assert_true(fabs(rig.now.angular_velocity[2]) < 1e-14); /* rounding; a roll would be 100 */
    double start = 0.5 * rig.grains.elements->mass[0] * 0.01;
    OzElementLedger ledger = rig.now.element_ledger;
    assert_true(ledger.disc_friction == 0);
    /* likewise: 1e-5 */
    assert_true(fabs(rig_energy(&rig.now) + ledger.disc_damping - start) < 1e-4 * start);
    rig_close(&rig);
}

/* Hertz without damping: the deepest overlap (5 m* v^2 / (4 Y))^(2/5). What the discs lose of their
 * motion on the way is in the contact: 2/5 Y xi^(5/2). */
static void test_disc_hertz(void **state)
{
    (void)state;
    ElementRig rig;
    double deepest = 0, stored = 0, start;
    open_discs(&rig,
               "contact: {law: hertz, hertz_stiffness: 1e6, normal_damping_rate: 0, "
               "tangential_damping_rate: 0}",
               2e-7, 0);
    start = rig_energy(&rig.now);
    for (int64_t step = 1; step < 2000; step += 5) {
        rig_advance(&rig, step);
        stored = fmax(stored, oz_contact_list_sum(&rig.now.contacts).energy);
        /* thousands of steps a hit; where it begins gear4 loses order: 4e-8 */
        assert_true(fabs(rig_energy(&rig.now) / start - 1) < 1e-6);
        const double *x = rig.now.element_position;
        deepest = fmax(deepest, 2e-3 - hypot(x[2] - x[0], x[3] - x[1]));
    }
    double mass = rig.grains.elements->mass[0] / 2;
    double expected = pow(5 * mass * 0.01 / (4 * 1e6), 0.4);
    /* seen every fifth step, to the square of what that is of the hit: 5e-6 */
    assert_true(fabs(deepest / expected - 1) < 1e-5);
    assert_true(fabs(stored / (0.5 * start) - 1) < 2e-5); /* half is the common motion's */
    assert_true(fabs(rig.now.velocity[3] - 0.1) < 1e-8);
    rig_close(&rig);
}

/* A hit without damping of two discs (radius 1 mm, 0.1 m/s) goes v t_c / pi deep: with a contact
 * time for 0.8 mm, 0.4 of the diameter, it is beyond a share s for t_c (1 - 2 asin(s / 0.4) / pi),
 * and ends at the speed it had. A count more or less lies between two steps. */
static void test_deep_discs_are_counted(void **state)
{
    (void)state;
    ElementRig rig;
    const double time = 0.8e-3 * pi / 0.1, step = 1e-5;
    char contact[128];
    snprintf(contact, sizeof contact, "contact: {contact_time: %.17g, restitution: 1, friction: 0}",
             time);
    open_discs(&rig, contact, step, 0);
    rig_advance(&rig, (int64_t)(1.2 * time / step));
    double expected = time * (1 - 2 * asin(0.25 / 0.4) / pi) / step;
    /* 2500 steps a hit: 5e-8 of the speed is lost where it begins and ends */
    assert_true(fabs((double)rig.now.deep_count - expected) <= 1);
    assert_true(fabs(rig.now.velocity[3] - 0.1) < 1e-7);
    rig_close(&rig);
}

/* A fast graze slides all the way: the impulse across is friction times that along the normal,
 * against the sliding: the second disc, which is passed by on its lower left, is dragged along to
 * the lower right, and both are turned counter-clockwise, by 2 / (m r) of it. */
static void test_disc_friction(void **state)
{
    (void)state;
    ElementRig rig;
    double before[3], after[3];
    open_discs(&rig,
               "contact: {law: hertz, hertz_stiffness: 1e9, normal_damping_rate: 0, "
               "tangential_damping_rate: 1e6, friction: 0.01}",
               5e-8, 0.5e-3);
    double before_energy = rig_energy(&rig.now);
    rig_momentum(&rig.now, before);
    rig_advance(&rig, 16000);
    rig_momentum(&rig.now, after);
    for (int k = 0; k < 3; k++) {
        /* rounding of 16000 steps; about the origin at an arm of a millimetre */
        assert_true(fabs(after[k] - before[k]) < 1e-12 * before[0] * (k == 2 ? 1e-3 : 1) + 1e-25);
    }
    const double *v = &rig.now.velocity[3];
    double mass = rig.grains.elements->mass[1], angular_velocity = rig.now.angular_velocity[5];
    double normal[2] = {sqrt(1 - 0.0625), 0.25}; /* at first touch, 2 mm apart */
    double along = mass * (v[0] * normal[0] + v[1] * normal[1]);
    double across = mass * (v[1] * normal[0] - v[0] * normal[1]);
    /* the normal turns by 1e-4 during the hit, a hundredth of the friction */
    assert_true(along > 0 && fabs(across / along / -0.01 - 1) < 0.02);
    assert_true(fabs(angular_velocity / (-2 * across / (mass * 1e-3)) - 1) < 0.02);
    /* alike discs, alike torques */
    assert_true(fabs(rig.now.angular_velocity[2] / angular_velocity - 1) < 1e-14);
    /* what is not left of the motion went into sliding: its dashpot has nothing to do with the ends
     */
    double lost = rig.now.element_ledger.disc_friction;
    /* the ledger's powers are those at the ends of steps: 1e-4 */
    assert_true(lost > 0 && fabs((before_energy - rig_energy(&rig.now)) / lost - 1) < 1e-3);
    rig_close(&rig);
}

/* A disc at rest over a wall's triangle: it sinks by m g / k, over an edge or over a corner. */
static void check_rest(const double corners[6])
{
    ElementRig rig;
    rig_read(&rig, "gravity: [0, -10]\nintegrator: rk4\ntime: {step: 1e-6, duration: 1}\n"
                   "contact: {contact_time: 2e-4, restitution: 0.1}\n"
                   "walls:\n  - {kind: segment, from: [1, 0], to: [-1, 0]}");
    OzElements *p = rig_grains(&rig, 1, 1, 0);
    double sunk = 10 / oz_element_laws_disc(&rig.scene, 0).stiffness;
    oz_elements_set_disc(p, 0, (double[2]){0, 1e-3 - 0.5 * sunk}, 1e-3, 4);
    must(oz_elements_set_triangle(p, 1, corners, 0));
    rig_start(&rig);
    rig_advance(&rig, 5000);
    /* sunk is 3e-8 m of a coordinate whose last digit is 2e-19: 1e-11; what swung is gone after 25
     * contact times */
    assert_true(fabs((1e-3 - rig.now.element_position[1]) / sunk - 1) < 1e-9);
    const OzContactEntry *e = rig.now.contacts.entry;
    assert_true(rig.now.contacts.count == 1 && e->a == 0 && e->b == -1);
    assert_true(e->kind == OZ_CONTACT_DISC && e->normal[1] == -1);
    /* its weight, as exactly as it sank */
    assert_true(fabs(e->push / (10 * rig.grains.elements->mass[0]) - 1) < 1e-9);
    rig_close(&rig);
}

static void test_disc_on_triangle(void **state)
{
    (void)state;
    check_rest((double[6]){-2e-3, 0, 0, -3e-3, 3e-3, 0});
    check_rest((double[6]){0, 0, -2e-3, -3e-3, 2e-3, -3e-3});
}

/* A disc at rest that is thrown along a floor slips, and the floor feels all of friction; rolling,
 * it does not. */
static void test_disc_slips_until_it_rolls(void **state)
{
    (void)state;
    ElementRig rig;
    rig_read(&rig, "gravity: [0, -10]\nintegrator: velocity-verlet\n"
                   "time: {step: 2e-6, duration: 1}\n"
                   "contact: {contact_time: 2e-4, restitution: 0.1, friction: 0.5}\n"
                   "walls:\n  - {kind: segment, from: [1, 0], to: [-1, 0]}");
    OzElements *p = rig_grains(&rig, 1, 1, 0);
    oz_elements_set_disc(p, 0, (double[2]){0, 1e-3}, 1e-3, 4);
    must(oz_elements_set_triangle(p, 1, (double[6]){-0.05, 0, 0, -0.05, 0.05, 0}, 0));
    p->velocity[0] = 0.1;
    rig_start(&rig);
    rig_advance(&rig, 1000);
    const OzContactEntry *e = rig.now.contacts.entry;
    double force[1][3];
    oz_contact_list_push_walls(&rig.now.contacts, force, 1);
    assert_true(rig.now.contacts.count == 1 && e->slips);
    /* rounding */
    assert_true(fabs(e->tangential[0] / (0.5 * e->push) - 1) < 1e-12);
    assert_true(force[0][0] == e->tangential[0] && force[0][1] == -e->push);
    rig_advance(&rig, 10000); /* 0.1 m/s / 3 / (0.5 x 10 m/s^2) are 6.7 ms, 3300 steps */
    e = rig.now.contacts.entry;
    assert_true(rig.now.contacts.count == 1 && !e->slips);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_disc_restitution),
        cmocka_unit_test(test_disc_hertz),
        cmocka_unit_test(test_deep_discs_are_counted),
        cmocka_unit_test(test_disc_friction),
        cmocka_unit_test(test_disc_on_triangle),
        cmocka_unit_test(test_disc_slips_until_it_rolls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
