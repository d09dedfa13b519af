/* Shafts at walls with edges: closed forms of one rod on the host reference, and rods in a hopper
 * on the device beside it. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

/* A rod of 1 mm and a shaft of 4 mm. */
#define ONE                                                                                        \
    "model: rods\nprecision: double\ngravity: [0, 0, %g]\ntime: {step: 2e-6, duration: 10}\n"      \
    "integrator: velocity-verlet\n"                                                                \
    "contact: {contact_time: 2e-4, restitution: %g, friction: %g}\n"                               \
    "grains: [{kind: single, diameter: 1e-3, aspect: 4, axis: [%g, %g, %g],"                       \
    " position: [%g, %g, %g]}]\n"                                                                  \
    "walls:\n%s"

static const double G = 9.81, R = 0.5e-3;
enum { STEPS_PER_MS = 500 };

static void assert_within(double a, double b, double most)
{
    if (!(fabs(a - b) <= most)) {
        fail_msg("%.9g is not %.9g within %g", a, b, most);
    }
}

/* A contact of a rod at rest: where along x, and its share of the weight. */
typedef struct Rest {
    double x, share;
} Rest;

/* A rod along x whose middle is at x lies so by the law of the lever; both contacts may be at one
 * place. Overlaps at rest are 1e-4 radii, by which it tilts; dashpots have died away after 40 ms,
 * 200 contact times. */
static void expect_rest(const char *walls, double x, double y, const Rest rests[2])
{
    Rig rig;
    double found[2] = {0, 0};
    rig_open(&rig, ONE, -G, 0.3, 0.5, 1.0, 0.0, 0.0, x, y, R, walls);
    rig_start(&rig);
    rig_advance(&rig, 40 * STEPS_PER_MS);
    double weight = rig.grains.mass[0] * G;
    for (int64_t i = 0; i < rig.now.contacts.count; i++) {
        const OzContactEntry *e = &rig.now.contacts.entry[i];
        int k = fabs(e->point[0] - rests[1].x) < fabs(e->point[0] - rests[0].x);
        assert_within(e->point[0], rests[k].x, 1e-3 * R);
        found[k] += e->push / weight;
        for (int64_t j = 0; j < i; j++) { /* where walls join one bears the rod */
            const OzContactEntry *o = &rig.now.contacts.entry[j];
            assert_true(o->b == e->b || fabs(o->point[0] - e->point[0]) > R);
        }
    }
    assert_within(found[0], rests[0].share, 1e-3);
    assert_within(found[1], rests[1].share, 1e-3);
    assert_within(rig.now.position[2], R, 1e-3 * R);
    rig_close(&rig);
}

static void rods_lie_on_edges(void **state)
{
    (void)state;
    /* balanced on the upper edge of an upright wall */
    expect_rest("  - {kind: rectangle, normal: [1, 0, 0], edge: [0, 1, 0], point: [0, 0, -2e-3],"
                " size: [6e-3, 4e-3]}\n",
                0, 0, (Rest[]){{0, 1}, {9, 0}});
    /* across a beam of 2 mm */
    expect_rest("  - {kind: rectangle, size: [2e-3, 4e-3]}\n", 0.3e-3, 0,
                (Rest[]){{-1e-3, 0.35}, {1e-3, 0.65}});
    /* on a table's edge: an end, and the shaft at the edge */
    expect_rest("  - {kind: rectangle, size: [4e-3, 4e-3], point: [-2e-3, 0, 0]}\n", -1.3e-3, 0,
                (Rest[]){{-3.3e-3, 1.3 / 3.3}, {0, 2 / 3.3}});
    /* on the rim of a disc, and on a pipe's mouth, off the middle */
    double half = sqrt(1.5 * 1.5 - 0.2 * 0.2), right = 0.5 + 0.5 * 0.3 / half;
    const Rest on_rim[] = {{-half * 1e-3, 1 - right}, {half * 1e-3, right}};
    expect_rest("  - {kind: disc, diameter: 3e-3}\n", 0.3e-3, 0.2e-3, on_rim);
    expect_rest("  - {kind: cylinder, diameter: 3e-3, length: 9e-3, point: [0, 0, -9e-3]}\n",
                0.3e-3, 0.2e-3, on_rim);
    expect_rest("  - {kind: cone, diameter: [1e-3, 3e-3], length: 3e-3, point: [0, 0, -3e-3]}\n",
                0.3e-3, 0.2e-3, on_rim);
    /* on a ridge of two roofs, which join there */
    expect_rest("  - {kind: rectangle, normal: [1, 0, 2], edge: [0, 1, 0], size: [9e-3, 2e-3],"
                " point: [0.8944271909999159e-3, 0, -0.4472135954999579e-3]}\n"
                "  - {kind: rectangle, normal: [-1, 0, 2], edge: [0, 1, 0], size: [9e-3, 2e-3],"
                " point: [-0.8944271909999159e-3, 0, -0.4472135954999579e-3]}\n",
                0, 0, (Rest[]){{0, 1}, {9, 0}});
}

/* Pushes up and their moment on a rod that is moved along x over a wall, tilted and turned. In
 * steps of 2 um an overlap of 50 um grows by a 70th of itself and less where a cap comes over an
 * edge (slope root(2 overlap / R)); a contact that came or went at once would be a third of the
 * force. */
static void expect_no_jump(const char *walls, double tilt, double turn, double from)
{
    Rig rig;
    double last[2] = {0, 0}, peak = 0;
    rig_open(&rig, ONE, 0.0, 0.3, 0.0, cos(tilt) * cos(turn), cos(tilt) * sin(turn), sin(tilt), 0.0,
             0.1e-3, 0.9 * R, walls);
    for (int i = 0; i <= 600; i++) {
        double force[1][3], torque[1][3];
        const double about[1][3] = {{0, 0, 0}};
        rig.grains.position[0] = from + 2e-6 * i;
        rig_start(&rig);
        oz_contact_list_push_walls(&rig.now.contacts, force, 1);
        oz_contact_list_turn_walls(&rig.now.contacts, about, torque, 1);
        peak = fmax(peak, fabs(force[0][2]));
        assert_true(i == 0 || fabs(force[0][2] - last[0]) < 0.04 * peak);
        assert_true(i == 0 || fabs(torque[0][1] - last[1]) < 0.04 * peak * 2e-3);
        last[0] = force[0][2];
        last[1] = torque[0][1];
    }
    assert_true(peak > 0);
    rig_close(&rig);
}

static void forces_do_not_jump(void **state)
{
    (void)state;
    const char *table = "  - {kind: rectangle, size: [5e-3, 4e-3], point: [-2.5e-3, 0, 0]}\n";
    const char *pipe = "  - {kind: cylinder, diameter: 3e-3, length: 9e-3, point: [0, 0, -9e-3]}\n";
    /* an end comes off, the middle goes over the edge, the other end comes off */
    for (int at = -1; at <= 1; at++) {
        expect_no_jump(table, 0, 0, 2e-3 * at - 0.6e-3);
        expect_no_jump(table, 0.01, 0.2, 2e-3 * at - 0.6e-3);
        expect_no_jump(pipe, 0.005, 0.1, 2e-3 * at - 0.6e-3);
    }
}

/* Without loss and friction rods that fall on edges, as they may lie, leave with the energy that
 * they came with: to a thousandth, as on a plane, with 100 steps in a contact. */
static void expect_energy_kept(const char *walls, double x, double slope)
{
    Rig rig;
    rig_open(&rig, ONE, 0.0, 1.0, 0.0, 1.0, 0.0, slope, x, 0.1e-3, 0.7e-3, walls);
    rig.grains.velocity[2] = -0.3;
    rig_start(&rig);
    double before = mechanical_energy(&rig.now), least = before;
    for (int k = 1; k <= 60; k++) {
        rig_advance(&rig, k * 100);
        least = fmin(least, mechanical_energy(&rig.now));
    }
    assert_true(least < 0.9 * before); /* it has hit */
    assert_int_equal(rig.now.contacts.count, 0);
    assert_within(mechanical_energy(&rig.now), before, 1e-3 * before);
    rig_close(&rig);
}

static void edges_give_back(void **state)
{
    (void)state;
    const char *table = "  - {kind: rectangle, size: [4e-3, 4e-3], point: [-2e-3, 0, 0]}\n";
    expect_energy_kept(table, 0.5e-3, 0.02);
    expect_energy_kept(table, -1e-3, 0);
    expect_energy_kept(table, -0.6e-3, -0.002);
    expect_energy_kept(table, 0.2e-3, 0.001);
    expect_energy_kept("  - {kind: rectangle, size: [1.6e-3, 4e-3]}\n", 0.3e-3, 0.001);
    expect_energy_kept("  - {kind: cylinder, diameter: 3e-3, length: 9e-3, point: [0, 0, -9e-3]}\n",
                       0.5e-3, 0.01);
}

/* A rod that rolls and slides down a slope over joints of rectangles does as on one plane: see
 * test_sheets. Its ends cross them one after the other. */
static void joints_are_not_felt(void **state)
{
    (void)state;
    const char *walls[] = {"  - {kind: plane}\n",
                           "  - {kind: rectangle, point: [4e-3, 0, 0], size: [8e-3, 9e-3]}\n"
                           "  - {kind: rectangle, point: [-4e-3, 2e-3, 0], size: [8e-3, 4e-3]}\n"
                           "  - {kind: rectangle, point: [-4e-3, -2e-3, 0], size: [8e-3, 4e-3]}\n"};
    Rig rigs[2];
    for (int k = 0; k < 2; k++) {
        rig_open(&rigs[k], ONE, -G, 0.3, 0.2, 0.6, 0.8, 0.0, -1.5e-3, 0.1e-3, R, walls[k]);
        rigs[k].grains.velocity[0] = 0.2;
        rig_start(&rigs[k]);
        rig_advance(&rigs[k], 25 * STEPS_PER_MS);
    }
    assert_true(rigs[0].now.position[0] > 1.5e-3);
    for (int c = 0; c < 3; c++) {
        assert_within(rigs[1].now.position[c], rigs[0].now.position[c], 1e-6 * 3e-3);
        assert_within(rigs[1].now.velocity[c], rigs[0].now.velocity[c], 1e-5 * 0.2);
        assert_within(rigs[1].now.axis[c], rigs[0].now.axis[c], 1e-6);
    }
    rig_close(&rigs[0]);
    rig_close(&rigs[1]);
}

/* A cross of two beams stands in a hopper; rods and spheres fall on it and on rims. */
static const char hopper[] =
    "model: rods\nprecision: %s\ntime: {step: 1e-5, duration: 1}\nintegrator: velocity-verlet\n"
    "observe: {ledger: true}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4}\ngrains:\n"
    "  - {kind: random, count: 50, diameter: 0.6e-3, aspect: 3, fill: 0.15}\n"
    "  - {kind: random, count: 20, diameter: 0.6e-3, fill: 0.15}\n"
    "walls:\n"
    "  - {kind: cone, diameter: [2e-3, 6e-3], length: 3e-3}\n"
    "  - {kind: cylinder, diameter: 6e-3, point: [0, 0, 3e-3], length: 7e-3}\n"
    "  - {kind: rectangle, point: [0, 0, 5e-3], size: [6e-3, 0.4e-3],"
    " motion: {direction: [1, 0, 1], frequency: 200, amplitude: 5e-5}}\n"
    "  - {kind: rectangle, point: [0, 0, 5e-3], normal: [1, 0, 0], edge: [0, 1, 0],"
    " size: [6e-3, 1e-3]}\n"
    "  - {kind: disc, diameter: 2e-3, motion: {angular_velocity: 100}}\n";

enum { STEPS = 250 };

static void the_device_does_as_the_reference(void **state)
{
    (void)state;
    const char *const precisions[] = {"double", "float"};
    const double tolerances[] = {1e-9, 1e-3};
    for (int k = 0; k < 2; k++) {
        Rig rig;
        int at_shafts = 0;
        rig_open(&rig, hopper, precisions[k]);
        throw_grains(&rig.grains, 0.8, 20);
        OzSnapshot seen = state_after(&rig, NATIVE, STEPS);
        rig_start(&rig);
        for (int step = STEPS / 50; step <= STEPS; step += STEPS / 50) {
            rig_advance(&rig, step);
            for (int64_t i = 0; i < rig.now.contacts.count; i++) {
                at_shafts += rig.now.contacts.entry[i].part_a >= 2 * 5;
            }
        }
        assert_true(at_shafts > 10);
        assert_true(farthest(seen.velocity, rig.now.velocity, 3 * seen.count) < tolerances[k]);
        assert_true(farthest(seen.position, rig.now.position, 3 * seen.count) < tolerances[k]);
        assert_int_equal(oz_contact_list_sum(&seen.contacts).walls,
                         oz_contact_list_sum(&rig.now.contacts).walls);
        double work = rig.now.ledger.work_walls;
        assert_true(fabs(work) > 1e-10 &&
                    fabs(seen.ledger.work_walls - work) < 1e2 * tolerances[k] * fabs(work));
        oz_snapshot_free(&seen);
        rig_close(&rig);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rods_lie_on_edges),
        cmocka_unit_test(forces_do_not_jump),
        cmocka_unit_test(edges_give_back),
        cmocka_unit_test(joints_are_not_felt),
        cmocka_unit_test(the_device_does_as_the_reference),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
