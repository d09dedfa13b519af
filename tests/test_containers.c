/* Containers and how they move: closed forms of one sphere on the host reference, and a crowd in
 * all of them at once on the device beside it. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

static const double PI = 3.14159265358979323846;

/* A sphere of 1 mm and 1 mg or so in one wall; friction enough never to slip. */
#define ONE                                                                                        \
    "model: rods\nprecision: double\ngravity: [%g, %g, %g]\ntime: {step: 2e-6, duration: 10}\n"    \
    "integrator: velocity-verlet\n"                                                                \
    "contact: {contact_time: 2e-4, restitution: 0.3, friction: 5}\n"                               \
    "grains: [{kind: single, diameter: 1e-3, position: [%g, %g, %g]}]\n"                           \
    "walls: [{%s}]\n"

static const double G = 9.81, R = 0.5e-3;
enum { STEPS_PER_MS = 500 };

static void assert_within(double a, double b, double most)
{
    if (!(fabs(a - b) <= most)) {
        fail_msg("%.9g is not %.9g within %g", a, b, most);
    }
}

static void start(Rig *rig, const double at[3], const char *wall)
{
    rig_open(rig, ONE, 0.0, 0.0, -G, at[0], at[1], at[2], wall);
}

/* The force of the sphere on its wall is its weight: whatever way a container lies. Dashpots have
 * died away to 1e-9 of it after 40 ms, that is 200 contact times of restitution 0.3. */
static void expect_weight(const char *wall, const double gravity[3], const double at[3])
{
    Rig rig;
    double force[1][3];
    rig_open(&rig, ONE, gravity[0], gravity[1], gravity[2], at[0], at[1], at[2], wall);
    rig_start(&rig);
    rig_advance(&rig, 40 * STEPS_PER_MS);
    oz_contact_list_push_walls(&rig.now.contacts, force, 1);
    double weight = rig.grains.mass[0] * sqrt(dot3(gravity, gravity));
    for (int k = 0; k < 3; k++) {
        if (!(fabs(force[0][k] - rig.grains.mass[0] * gravity[k]) < 1e-7 * weight)) {
            fail_msg("%s: force %g along %d, expected %g", wall, force[0][k], k,
                     rig.grains.mass[0] * gravity[k]);
        }
    }
    rig_close(&rig);
}

static void a_sphere_at_rest_bears_its_weight(void **state)
{
    (void)state;
    const double down[3] = {0, 0, -G}, aslant[3] = {-3, -4, -6};
    expect_weight("kind: cylinder, axis: [3, 4, 0], diameter: 8e-3, point: [1, 2, 3]", down,
                  (double[]){1, 2, 3 - 3.5e-3});
    expect_weight("kind: cylinder, axis: [0, 1, 0], diameter: 8e-3, length: 3e-3, ends: closed",
                  (double[]){0, -3, -6}, (double[]){0, 0.5e-3, -3.5e-3});
    expect_weight("kind: cylinder, axis: [0, 1, 0], diameter: 8e-3, side: outside", down,
                  (double[]){0, -3, 4.5e-3});
    expect_weight("kind: sphere, diameter: 8e-3, point: [0, 0, 1e-3]", down,
                  (double[]){0, 0, -2.5e-3});
    expect_weight("kind: box, size: [4e-3, 6e-3, 8e-3], point: [1e-3, 0, 0]", aslant,
                  (double[]){-0.5e-3, -2.5e-3, 0.5e-3});
}

/* Contact lies within half an overlap, 2e-5 radii here, of the undeformed surface: what rolls does
 * so to that and to what the tangential spring gives way, a few times as much. */
static const double ROLLS = 2e-4;

/* A ball that rolls on a turning table runs in a circle at 2/7 of the table's rate, wherever it is:
 * dv/dt = 2/7 Omega x v. */
static void a_ball_on_a_turntable_circles(void **state)
{
    (void)state;
    Rig rig;
    const double rate = 20, x = 4e-3, v[2] = {0.03, 0.01}, time = 0.1;
    start(&rig, (double[]){x, 0, R}, "kind: plane, motion: {angular_velocity: 20}");
    rig.grains.velocity[0] = v[0];
    rig.grains.velocity[1] = v[1];
    rig.grains.angular_velocity[0] = -(v[1] - rate * x) / R;
    rig.grains.angular_velocity[1] = v[0] / R;
    rig_start(&rig);
    rig_advance(&rig, (int64_t)(1e3 * time) * STEPS_PER_MS);
    double turn = 2.0 / 7 * rate * time, c = cos(turn), s = sin(turn), speed = hypot(v[0], v[1]);
    double most =
        50 * ROLLS * speed; /* of a path of eight circumferences, sinking in at the start */
    assert_within(rig.now.velocity[0], c * v[0] - s * v[1], most);
    assert_within(rig.now.velocity[1], s * v[0] + c * v[1], most);
    rig_close(&rig);
}

/* In a drum that turns, a ball stays at the bottom when its surface goes with the drum's. */
static void a_ball_in_a_drum_stays(void **state)
{
    (void)state;
    Rig rig;
    const double rate = 30, drum = 4e-3;
    start(&rig, (double[]){0, 0, -(drum - R)},
          "kind: cylinder, axis: [0, 1, 0], diameter: 8e-3, motion: {angular_velocity: 30}");
    rig.grains.angular_velocity[1] = rate * drum / R;
    rig_start(&rig);
    rig_advance(&rig, 100 * STEPS_PER_MS);
    assert_within(rig.now.position[0], 0, 10 * ROLLS * R);
    assert_within(rig.now.angular_velocity[1], rate * drum / R, ROLLS * rate * drum / R);
    rig_close(&rig);
}

/* A ball on a plate that is shaken sideways goes 2/7 of its way. */
static void a_ball_on_a_plate_follows(void **state)
{
    (void)state;
    Rig rig;
    const double amplitude = 1e-3, frequency = 12.5, omega = 2 * PI * frequency;
    start(&rig, (double[]){0, 0, R},
          "kind: plane, motion: {direction: [3, 4, 0], frequency: 12.5, amplitude: 1e-3}");
    for (int k = 0; k < 2; k++) { /* as if it had rolled before */
        double along = k ? 0.8 : 0.6;
        rig.grains.velocity[k] = 2.0 / 7 * along * amplitude * omega;
        rig.grains.angular_velocity[1 - k] = (k ? 1 : -1) * 5.0 / 7 * along * amplitude * omega / R;
    }
    rig_start(&rig);
    rig_advance(&rig, 100 * STEPS_PER_MS); /* a period and a quarter */
    assert_within(rig.now.position[0], 0.6 * 2.0 / 7 * amplitude, 10 * ROLLS * amplitude);
    assert_within(rig.now.position[1], 0.8 * 2.0 / 7 * amplitude, 10 * ROLLS * amplitude);
    rig_close(&rig);
}

/* A ball that rolls in a bowl swings like a pendulum of 7/5 (R - r): through the middle after a
 * quarter of its period; at 0.05 rad that is longer by 0.05^2 / 16. */
static void a_ball_in_a_bowl_swings(void **state)
{
    (void)state;
    Rig rig;
    const double bowl = 20e-3, way = bowl - R, angle = 0.05;
    start(&rig, (double[]){way * sin(angle), 0, -way * cos(angle)},
          "kind: sphere, diameter: 40e-3");
    rig_start(&rig);
    double quarter = 0.5 * PI * sqrt(7 * way / (5 * G)) * (1 + angle * angle / 16);
    rig_advance(&rig, llround(quarter / 2e-6));
    assert_within(rig.now.position[0], 0, 10 * ROLLS * way * angle);
    rig_close(&rig);
}

/* A ball that slides from the top of a smooth sphere leaves it where it has fallen by a third of
 * the way between the middles. Until it does its speed is that of its fall. */
static void a_ball_leaves_a_dome_at_two_thirds(void **state)
{
    (void)state;
    Rig rig;
    const double way = 10e-3 + R, angle = 0.2;
    rig_open(&rig, ONE, 0.0, 0.0, -G, way * sin(angle), 0.0, way * cos(angle),
             "kind: sphere, diameter: 20e-3, side: outside, contact: {friction: 0}");
    rig_start(&rig);
    double last = 0;
    while (rig.now.position[2] > 0) {
        rig_advance(&rig, rig.now.step + STEPS_PER_MS / 5);
        last = rig.now.contacts.count > 0 ? rig.now.position[2] : last;
    }
    double left = 2.0 / 3 * way * cos(angle);
    assert_within(last, left, 0.02 * way); /* it goes 0.015 of the way between two looks */
    rig_close(&rig);
}

static const char crowd[] =
    "model: rods\nprecision: %s\ntime: {step: 1e-5, duration: 1}\nintegrator: velocity-verlet\n"
    "observe: {ledger: true}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4}\ngrains:\n"
    "  - {kind: random, count: 40, diameter: 0.6e-3, aspect: 2, fill: 0.2}\n"
    "  - {kind: random, count: 20, diameter: 0.6e-3, fill: 0.2}\n"
    "walls:\n"
    "  - {kind: box, size: [5e-3, 5e-3, 8e-3], point: [0, 0, -4e-3],"
    " motion: {direction: [1, 0, 1], frequency: 200, amplitude: 1e-4}}\n"
    "  - {kind: cylinder, diameter: 6e-3, axis: [0, 1, 0.2], point: [0, -2.4e-3, 0], length: 5e-3,"
    " ends: closed, motion: {angular_velocity: 40}}\n"
    "  - {kind: sphere, diameter: 7e-3, motion: {angular_velocity: -30, axis: [1, 1, 0]}}\n";

enum { STEPS = 200 };

/* After 200 steps with hits rounding has grown a thousandfold; a wrong term shows in the first
 * digits. */
static void the_device_does_as_the_reference(void **state)
{
    (void)state;
    const char *const precisions[] = {"double", "float"};
    const double tolerances[] = {1e-9, 1e-3};
    for (int k = 0; k < 2; k++) {
        Rig rig;
        rig_open(&rig, crowd, precisions[k]);
        throw_grains(&rig.grains, 0.8, 20);
        OzSnapshot seen = state_after(&rig, NATIVE, STEPS);
        rig_start(&rig);
        rig_advance(&rig, STEPS);
        assert_true(farthest(seen.velocity, rig.now.velocity, 3 * seen.count) < tolerances[k]);
        assert_true(farthest(seen.position, rig.now.position, 3 * seen.count) < tolerances[k]);
        assert_true(oz_contact_list_sum(&seen.contacts).walls > 5);
        assert_int_equal(oz_contact_list_sum(&seen.contacts).walls,
                         oz_contact_list_sum(&rig.now.contacts).walls);
        double work = rig.now.ledger.work_walls;
        assert_true(fabs(work) > 1e-9 &&
                    fabs(seen.ledger.work_walls - work) < 1e2 * tolerances[k] * fabs(work));
        oz_snapshot_free(&seen);
        rig_close(&rig);
    }
}

/* What walls put in is what grains gain and lose: the ledger closes in the limit of small steps. */
static void the_work_of_turning_walls_is_accounted_for(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, crowd, "double");
    rig.scene.step = 1e-6;
    throw_grains(&rig.grains, 0.4, 20);
    rig_start(&rig);
    double before = mechanical_energy(&rig.now);
    rig_advance(&rig, 3000);
    const OzLedger *ledger = &rig.now.ledger;
    double gained = mechanical_energy(&rig.now) + ledger->elastic - before;
    double left = gained + ledger->dissipated + ledger->friction - ledger->work_walls;
    assert_true(fabs(ledger->work_walls) > 0.01 * before);
    assert_true(fabs(left) <
                2e-3 * fabs(ledger->work_walls)); /* 300 steps a contact: 1 / 300 of what
                                                     a hit moves, in both directions */
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_at_rest_bears_its_weight),
        cmocka_unit_test(a_ball_on_a_turntable_circles),
        cmocka_unit_test(a_ball_in_a_drum_stays),
        cmocka_unit_test(a_ball_on_a_plate_follows),
        cmocka_unit_test(a_ball_in_a_bowl_swings),
        cmocka_unit_test(a_ball_leaves_a_dome_at_two_thirds),
        cmocka_unit_test(the_work_of_turning_walls_is_accounted_for),
        cmocka_unit_test(the_device_does_as_the_reference),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
