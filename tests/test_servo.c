/* Walls that hold a pressure: closed forms of pistons on a few spheres, on the host reference, and
 * a crowd on the device beside it, by both of its ways. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "model/servo_nature.h"

static const double PI = 3.14159265358979323846, G = 9.81, T_C = 2e-4;

/* Spheres of 1 mm under a lid; `more` of the scene, its grains, its walls. */
#define SPHERES                                                                                    \
    "model: rods\nprecision: double\ngravity: [0, 0, %g]\ntime: {step: 2e-6, duration: 10}\n"      \
    "integrator: %s\nobserve: {ledger: true}\n"                                                    \
    "contact: {contact_time: 2e-4, restitution: %g, friction: 0}\ngrains:\n%s\nwalls:\n%s\n"

static void assert_within(double a, double b, double most)
{
    if (!(fabs(a - b) <= most)) {
        fail_msg("%.12g is not %.12g within %g", a, b, most);
    }
}

/* N/m: of two spheres of this mass, whose effective mass is half of it; at a wall twice that. */
static double pair_stiffness(double mass, double restitution)
{
    return 0.5 * mass * (PI * PI + log(restitution) * log(restitution)) / (T_C * T_C);
}

/* Energy that is there now: grains', springs', pistons'; less what came in. */
static double balance(const Rig *rig)
{
    const OzLedger *l = &rig->now.ledger;
    double sum = mechanical_energy(&rig->now) + l->elastic;
    for (int w = 0; w < rig->scene.wall_count; w++) {
        double v = rig->now.wall_velocity[w];
        bool is_piston = rig->scene.walls[w].servo.present;
        sum += is_piston ? 0.5 * oz_servo_nature_of(&rig->scene, &rig->grains, w).mass * v * v : 0;
    }
    return sum + l->dissipated + l->friction - l->work_walls;
}

/* A lid of 20 times a sphere's weight is pressed on three that stand on each other: it comes to
 * rest where the four overlaps, of walls and pairs, bear what lies above each. */
static void a_piston_rests_where_springs_bear_it(void **state)
{
    (void)state;
    for (int k = 1; k < INTEGRATORS; k++) {
        Rig rig;
        rig_open(&rig, SPHERES, -G, integrator_names[k], 0.3,
                 "  - {kind: single, diameter: 1e-3, position: [0, 0, 0.5e-3]}\n"
                 "  - {kind: single, diameter: 1e-3, position: [0, 0, 1.5e-3]}\n"
                 "  - {kind: single, diameter: 1e-3, position: [0, 0, 2.5e-3]}",
                 "  - {kind: plane}\n"
                 "  - {kind: plane, point: [0, 0, 3.1e-3], normal: [0, 0, -1], "
                 "servo: {force: 1e-3, mass: 2e-5, weight: true}}");
        rig_start(&rig);
        double m = rig.grains.mass[0], k_n = pair_stiffness(m, 0.3), lid = 1e-3 + 2e-5 * G;
        double overlaps = (lid + m * G) / k_n + (lid + 2 * m * G) / k_n + lid / (2 * k_n) +
                          (lid + 3 * m * G) / (2 * k_n);
        rig_advance(&rig, 40000);
        /* the slowest swing has decayed by then, which takes 2 ms */
        assert_within(rig.now.wall_offset[1], 0.1e-3 + overlaps, 1e-7 * overlaps);
        assert_within(rig.now.wall_velocity[1], 0, 1e-9);
        assert_within(-rig.now.wall_push[1], lid, 1e-7 * lid);
        rig_close(&rig);
    }
}

/* A heavy piston on four light spheres, each between two springs in series of 2 k: M on 4 k. Their
 * mass m is felt as m / 4 each. It is pressed from where they touch, and swings between that and
 * twice its rest. */
static void a_piston_swings_as_a_mass_on_springs(void **state)
{
    (void)state;
    for (int k = 1; k < INTEGRATORS; k++) {
        Rig rig;
        rig_open(&rig, SPHERES, 0.0, integrator_names[k], 1.0,
                 "  - {kind: lattice, cells: [2, 2, 1], spacing: [2e-3, 2e-3, 1], diameter: 1e-3, "
                 "position: [0, 0, 0.5e-3]}",
                 "  - {kind: plane}\n"
                 "  - {kind: plane, point: [0, 0, 1e-3], normal: [0, 0, -1], "
                 "servo: {force: 1e-3, mass: 1e-3, damping: 0}}");
        rig_start(&rig);
        double m = rig.grains.mass[0], stiffness = 4 * pair_stiffness(m, 1);
        double period = 2 * PI * sqrt((1e-3 + m) / stiffness), back = 0, before = balance(&rig);
        double rest = 1e-3 / stiffness, deepest = 0;
        int turns = 0;
        for (int64_t step = 100; turns < 3; step += 100) {
            double was = rig.now.wall_velocity[1];
            rig_advance(&rig, step);
            double v = rig.now.wall_velocity[1];
            deepest = fmax(deepest, rig.now.wall_offset[1]);
            if (was < 0 && v >= 0) { /* back at the top: a whole period, to a line between looks */
                turns++;
                back = rig.now.time - 100 * 2e-6 * v / (v - was);
            }
        }
        /* spheres are shaken by the start: their mass is 1/200 of the piston's; symplectic Euler's
         * energy is off by half a step's share of the swing */
        assert_within(back / turns, period, 1e-4 * period);
        assert_within(deepest, 2 * rest, 2e-3 * rest);
        assert_within(balance(&rig), before, PI * 2e-6 / period * 1e-3 * rest);
        rig_close(&rig);
    }
}

/* Nothing in its way: M dv/dt = F + M g - c v. The dashpot takes what force and weight give. */
static void a_free_piston_goes_as_its_dashpot_lets_it(void **state)
{
    (void)state;
    for (int k = 0; k < INTEGRATORS; k++) {
        Rig rig;
        rig_open(&rig, SPHERES, -G, integrator_names[k], 0.5,
                 "  - {kind: single, diameter: 1e-3, position: [0, 0, 0.5e-3]}",
                 "  - {kind: plane}\n"
                 "  - {kind: plane, point: [0, 0, 1], normal: [0, 0.6, -0.8], "
                 "servo: {force: 2e-3, mass: 1e-3, damping: 0.1, weight: true}}");
        rig.grains.position[2] = 0.5e-3;
        rig_start(&rig);
        double drive = 2e-3 + 1e-3 * G * 0.8, most = drive / 0.1, tau = 1e-3 / 0.1;
        for (int64_t step = 500; step <= 10000; step *= 3) {
            rig_advance(&rig, step);
            double gone = exp(-rig.now.time / tau), first = k == 2 ? 1e-7 : 1.1e-4;
            /* of first order in a step of tau / 5000, of second with velocity-verlet */
            assert_within(rig.now.wall_velocity[1], most * (1 - gone), first * most);
            assert_within(rig.now.wall_offset[1], most * (rig.now.time - tau * (1 - gone)),
                          first * most * tau);
            double given = drive * rig.now.wall_offset[1];
            double kinetic = 0.5e-3 * pow(rig.now.wall_velocity[1], 2);
            /* the ledger adds up half steps' forces: 2e-4 of what is given at first */
            assert_within(rig.now.ledger.work_walls, given, 2e-3 * given);
            assert_within(rig.now.ledger.dissipated, given - kinetic, 2e-3 * given);
        }
        rig_close(&rig);
    }
}

static double area_of(const char *walls, int wall)
{
    Rig rig;
    OzServoArea area;
    double offsets[8] = {0};
    rig_open(&rig,
             "model: rods\ntime: {step: 1e-6, duration: 1}\n"
             "contact: {contact_time: 1e-4, restitution: 0.5}\n"
             "grains: [{kind: single, diameter: 1e-3, position: [0, 0, 1e-3]}]\n%s",
             walls);
    bool is_found = oz_servo_area_find(&area, &rig.scene, wall);
    double found = is_found ? oz_servo_area_now(&area, &rig.scene, offsets) : -1;
    rig_close(&rig);
    return found;
}

#define LID "{kind: plane, point: [0, 0, 9e-3], normal: [0, 0, -1]}"

static void the_area_is_what_the_walls_leave(void **state)
{
    (void)state;
    assert_within(area_of("walls: [" LID ", {kind: cylinder, diameter: 8e-3}]", 0), PI / 4 * 64e-6,
                  1e-15);
    assert_within(area_of("walls: [" LID ", {kind: box, size: [3e-3, 5e-3, 9e-3]}]", 0), 15e-6,
                  1e-15);
    assert_within(area_of("walls: [{kind: disc, diameter: 2e-3, point: [0, 0, 9e-3]}]", 0),
                  PI * 1e-6, 1e-15);
    assert_within(area_of("walls: [{kind: rectangle, size: [2e-3, 3e-3]}]", 0), 6e-6, 1e-15);
    assert_within(area_of("boundary: {x: periodic, y: periodic, size: [6e-3, 4e-3, 0]}\n"
                          "walls: [" LID "]",
                          0),
                  24e-6, 1e-15);
    /* the nearest of two planes counts; one pair of sides is a period */
    assert_within(area_of("boundary: {y: periodic, size: [0, 4e-3, 0]}\nwalls: [" LID
                          ", {kind: plane, normal: [1, 0, 0], point: [-1e-3, 0, 0]}"
                          ", {kind: plane, normal: [1, 0, 0], point: [-3e-3, 0, 0]}"
                          ", {kind: plane, normal: [-1, 0, 0], point: [2e-3, 0, 0]}]",
                          0),
                  12e-6, 1e-15);
    /* a shaft that leans */
    assert_within(area_of("walls: [{kind: plane, normal: [0, 0.6, 0.8]}"
                          ", {kind: plane, normal: [1, 0, 0], point: [-1e-3, 0, 0]}"
                          ", {kind: plane, normal: [-1, 0, 0], point: [1e-3, 0, 0]}"
                          ", {kind: plane, normal: [0, 0.8, -0.6], point: [0, 0, 2e-3]}"
                          ", {kind: plane, normal: [0, -0.8, 0.6], point: [0, 2e-3, 0]}]",
                          0),
                  2e-3 * (2e-3 * 0.6 + 2e-3 * 0.8), 1e-15);
    assert_true(area_of("walls: [" LID "]", 0) < 0);
}

/* A cube of eight spheres on a square lattice between six pistons, pressed alike from its sides,
 * and from above and below twice as much: it comes to rest with four overlaps' force on each, whose
 * areas are those between the pistons as they stand. */
static void six_pistons_hold_their_pressures(void **state)
{
    (void)state;
    Rig rig;
    rig_open(
        &rig, SPHERES, 0.0, "velocity-verlet", 0.2,
        "  - {kind: lattice, cells: [2, 2, 2], spacing: [1e-3, 1e-3, 1e-3], diameter: 1e-3, "
        "position: [0, 0, 0]}",
        "  - {kind: plane, point: [-0.53e-3, 0, 0], normal: [1, 0, 0], servo: {pressure: 200}}\n"
        "  - {kind: plane, point: [1.5e-3, 0, 0], normal: [-1, 0, 0], servo: {pressure: 200}}\n"
        "  - {kind: plane, point: [0, -0.5e-3, 0], normal: [0, 1, 0], servo: {pressure: 200}}\n"
        "  - {kind: plane, point: [0, 1.5e-3, 0], normal: [0, -1, 0], servo: {pressure: 200}}\n"
        "  - {kind: plane, point: [0, 0, -0.5e-3], servo: {pressure: 400}}\n"
        "  - {kind: plane, point: [0, 0, 1.5e-3], normal: [0, 0, -1], servo: {pressure: 400}}");
    rig_start(&rig);
    double before = balance(&rig), k_n = pair_stiffness(rig.grains.mass[0], 0.2), way[3];
    rig_advance(&rig, 20000);
    for (int k = 0; k < 3; k++) {
        way[k] = rig.now.wall_offset[2 * k] + rig.now.wall_offset[2 * k + 1];
    }
    const double built[3] = {2.03e-3, 2e-3, 2e-3}, pressure[3] = {200, 200, 400};
    for (int k = 0; k < 3; k++) {
        int l = (k + 1) % 3, m = (k + 2) % 3;
        double area = (built[l] - way[l]) * (built[m] - way[m]), force = pressure[k] * area;
        /* at rest: a thousand times better than the percent that is promised */
        assert_within(-rig.now.wall_push[2 * k], force, 1e-5 * force);
        assert_within(-rig.now.wall_push[2 * k + 1], force, 1e-5 * force);
        /* a pair and two walls of twice its stiffness in each of four rows */
        assert_within(2e-3 - (built[k] - way[k]), force / 4 * 2 / k_n, 1e-5 * force / k_n);
    }
    assert_within(balance(&rig), before, 2e-3 * rig.now.ledger.work_walls);
    rig_close(&rig);
}

/* Rods and spheres thrown about in a shaken drum whose lid and side come down on them. */
static const char crowd[] =
    "model: rods\ntime: {step: 1e-5, duration: 1}\nintegrator: velocity-verlet\n"
    "observe: {ledger: true}\nguards: {overlap: {stop: 2}}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4}\ngrains:\n"
    "  - {kind: random, count: 40, diameter: 0.6e-3, aspect: 2, fill: 0.2}\n"
    "  - {kind: random, count: 60, diameter: 0.6e-3, fill: 0.2}\n"
    "walls:\n"
    "  - {kind: plane, point: [0, 0, 6.6e-3], normal: [0, 0, -1], servo: {pressure: 300}}\n"
    "  - {kind: plane, motion: {frequency: 100, acceleration_ratio: 4}}\n"
    "  - {kind: cylinder, diameter: 5e-3}\n"
    "  - {kind: plane, point: [2.4e-3, 0, 0], normal: [-1, 0, 0], servo: {force: 3e-3, mass: "
    "2e-5, damping: 0.01}}\n"
    "  - {kind: disc, point: [0, 0, 6e-3], diameter: 2e-3, servo: {force: -1e-3, mass: 1e-5, "
    "damping: 1e-3, weight: true}, until: 1.1e-3}\n";

enum { STEPS = 150 };

static void assert_same_pistons(const OzSnapshot *a, const OzSnapshot *b)
{
    size_t walls = (size_t)a->scene->wall_count * sizeof(double);
    assert_same_bits(a, b);
    assert_memory_equal(a->wall_offset, b->wall_offset, walls);
    assert_memory_equal(a->wall_velocity, b->wall_velocity, walls);
    assert_memory_equal(a->wall_push, b->wall_push, walls);
}

/* By the way of small scenes and by that of large ones, tile by tile and in two launches, with the
 * same bits. Rounding in float grows a thousandfold in 150 steps with hits. */
static void the_device_does_as_the_reference(void **state)
{
    (void)state;
    const double most = 1e-3;
    Rig rig;
    OzDevice device = rig_device;
    rig_open(&rig, "%s", crowd);
    throw_grains(&rig.grains, 0.8, 20);
    OzSnapshot small = state_after(&rig, NATIVE, STEPS);
    device.small_most = 0;
    OzSim *sim = start_sim(&rig, &device);
    must(oz_sim_advance(sim, STEPS / 3));
    OzSnapshot large = state_at(&rig, sim, STEPS);
    assert_same_pistons(&small, &large);
    rig_start(&rig);
    rig_advance(&rig, STEPS);
    for (int w = 0; w < rig.scene.wall_count; w++) {
        double push = rig.now.wall_push[w], way = rig.now.wall_offset[w];
        assert_within(small.wall_offset[w], way, most * fabs(way));
        assert_within(small.wall_velocity[w], rig.now.wall_velocity[w], most);
        assert_within(small.wall_push[w], push, 10 * most * fmax(fabs(push), 1e-3));
    }
    assert_true(rig.now.wall_push[0] < 0 || rig.now.wall_push[3] < 0);
    assert_true(farthest(small.velocity, rig.now.velocity, 3 * small.count) < most);
    assert_true(farthest(small.position, rig.now.position, 3 * small.count) < most * 1e-3);
    const OzLedger *there = &small.ledger, *here = &rig.now.ledger;
    assert_within(there->work_walls, here->work_walls, 1e-2 * fabs(here->work_walls));
    assert_within(there->dissipated, here->dissipated, 1e-2 * here->dissipated);
    oz_snapshot_free(&small);
    oz_snapshot_free(&large);
    oz_sim_free(sim);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_piston_rests_where_springs_bear_it),
        cmocka_unit_test(a_piston_swings_as_a_mass_on_springs),
        cmocka_unit_test(a_free_piston_goes_as_its_dashpot_lets_it),
        cmocka_unit_test(the_area_is_what_the_walls_leave),
        cmocka_unit_test(six_pistons_hold_their_pressures),
        cmocka_unit_test(the_device_does_as_the_reference),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
