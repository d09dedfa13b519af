/* Sheared periodic cells: where the origin lies does not show, what flies free flies straight,
 * nothing jumps where the lattice turns, energy adds up, a crowd on the device is that of the
 * reference, and stress is what the shear's work says. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "model/motion.h"
#include "observe/observables.h"
#include "observe/stress.h"
#include "scene/boundary.h"
#include "sim/sim_state.h"
#include "sim/take_over.h"

/* A rod and a sphere that hit off centre, in a flow. */
static const char hit[] =
    "model: rods\nprecision: double\nintegrator: %s\ngravity: [0, 0, 0]\n"
    "time: {step: 1e-6, duration: 1}\n"
    "contact: {contact_time: 1e-4, restitution: 0.6, friction: 0.3}\n"
    "boundary: {x: periodic, y: periodic, z: periodic, size: [8e-3, 7e-3, 6e-3], "
    "shear_rate: 150}\n"
    "grains:\n"
    "  - {kind: single, diameter: 1e-3, aspect: 1.5, axis: [1, 0, 0], position: [%.17g, %.17g, "
    "0.1e-3], velocity: [0.1, 0.5, 0], spin: [0, 0, 40]}\n"
    "  - {kind: single, diameter: 0.8e-3, position: [%.17g, %.17g, 0], velocity: [0, -0.3, 0]}\n";

enum { HIT_STEPS = 1500 };

/* The same two across the border of y, and of x as well; the strain grows to 0.225. */
static void where_the_origin_lies_does_not_show(void **state)
{
    (void)state;
    const double shifts[][2] = {{0, 0}, {0.4e-3, 3.3e-3}, {3.9e-3, -3.4e-3}};
    for (int k = 0; k < INTEGRATORS; k++) {
        Rig rig[3];
        for (int s = 0; s < 3; s++) {
            double x = shifts[s][0], y = shifts[s][1];
            rig_open(&rig[s], hit, integrator_names[k], x, y - 0.6e-3, x + 0.1e-3, y + 0.6e-3);
            rig_start(&rig[s]);
            rig_advance(&rig[s], HIT_STEPS);
            assert_true(rig[s].now.velocity[4] > 0); /* they did meet */
            assert_true(farthest(rig[s].now.velocity, rig[0].now.velocity, 6) < 1e-9);
            assert_true(farthest(rig[s].now.angular_velocity, rig[0].now.angular_velocity, 6) <
                        1e-5);
        }
        for (int s = 0; s < 3; s++) {
            rig_close(&rig[s]);
        }
    }
}

/* The hit in the flow is that of the same velocities without one, where the walls are far: all
 * that the flow does is in the velocities, its gradient is not on the grains. */
static void a_hit_is_that_of_the_true_velocities(void **state)
{
    (void)state;
    const double rate = 150;
    for (int k = 0; k < INTEGRATORS; k++) {
        Rig rig, open;
        rig_open(&rig, hit, integrator_names[k], 0.0, -0.6e-3, 0.1e-3, 0.6e-3);
        rig_open(&open, hit, integrator_names[k], 0.0, -0.6e-3, 0.1e-3, 0.6e-3);
        open.scene.boundary.is_sheared = false;
        open.scene.boundary.shear_rate = 0;
        for (int i = 0; i < 2; i++) {
            open.grains.velocity[3 * i] += rate * open.grains.position[3 * i + 1];
        }
        rig_start(&rig);
        rig_start(&open);
        rig_advance(&rig, HIT_STEPS);
        rig_advance(&open, HIT_STEPS);
        for (int i = 0; i < 2; i++) {
            rig.now.velocity[3 * i] += rate * rig.now.position[3 * i + 1];
        }
        /* rounding, of velocities of 0.5 m/s and positions of 1e-3 m */
        assert_true(farthest(rig.now.velocity, open.now.velocity, 6) < 1e-9);
        assert_true(farthest(rig.now.position, open.now.position, 6) < 1e-12);
        assert_true(farthest(rig.now.angular_velocity, open.now.angular_velocity, 6) < 1e-5);
        rig_close(&rig);
        rig_close(&open);
    }
}

/* Spheres of 2^-11 m at random, in a cell that is longer than it is wide. */
static const char crowd[] =
    "model: rods\nprecision: %s\ngravity: [0, 0, 0]\n"
    "time: {step: 1e-5, duration: 1}\nintegrator: %s\nobserve: {ledger: true}\n"
    "contact: {contact_time: 3e-4, restitution: 0.8%s}\n"
    "boundary: {x: periodic, y: periodic, z: periodic, size: [5e-3, 4e-3, 3.3e-3], "
    "shear_rate: %g}\ngrains:\n"
    "  - {kind: random, count: 40, diameter: 0.00048828125, aspect: 1, fill: 0.25}\n"
    "  - {kind: random, count: 60, diameter: 0.00048828125, fill: 0.25}\n";

static const char rough[] = ", friction: 0.4, rolling_friction: 0.1";

enum { STEPS = 300 };

/* Rounding grows a thousandfold in so many steps with hits; the lattice turns twice (strain 3, of
 * 1.25 each, the first at 0.625). Small scenes and tiles give the same bits. */
static void the_device_does_as_the_reference(void **state)
{
    (void)state;
    const char *const precisions[] = {"double", "float", "float"};
    const OzDevice *devices[] = {&large_device, &large_device, &rig_device};
    const double tolerances[] = {1e-9, 1e-3, 1e-3};
    OzSnapshot seen[3];
    Rig rig[3];
    for (int k = 0; k < 3; k++) {
        rig_open(&rig[k], crowd, precisions[k], k ? "symplectic-euler" : "velocity-verlet", rough,
                 1000.0);
        throw_grains(&rig[k].grains, 0.4, 20);
        OzSim *sim = start_sim(&rig[k], devices[k]);
        seen[k] = state_at(&rig[k], sim, STEPS);
        oz_sim_free(sim);
        rig_start(&rig[k]);
        rig_advance(&rig[k], STEPS);
        int64_t numbers = 3 * seen[k].count;
        const OzSnapshot *now = &rig[k].now;
        assert_true(farthest(seen[k].velocity, now->velocity, numbers) < tolerances[k]);
        assert_true(farthest(seen[k].position, now->position, numbers) < 1e-3 * tolerances[k]);
        double work = seen[k].ledger.work_walls / now->ledger.work_walls;
        assert_true(fabs(work - 1) < tolerances[k]);
        assert_true(seen[k].contacts.count > 5);
        assert_int_equal(seen[k].contacts.count, now->contacts.count);
    }
    assert_same_bits(&seen[1], &seen[2]);
    for (int k = 0; k < 3; k++) {
        oz_snapshot_free(&seen[k]);
        rig_close(&rig[k]);
    }
}

/* Few grains of the crowd's kinds, which meet nobody. */
static const char few[] =
    "model: rods\nprecision: float\ngravity: [0, 0, 0]\n"
    "time: {step: 1e-5, duration: 1}\nintegrator: symplectic-euler\nobserve: {ledger: true}\n"
    "contact: {contact_time: 3e-4, restitution: 0.8, friction: 0.4, rolling_friction: 0.1}\n"
    "boundary: {x: periodic, y: periodic, z: periodic, size: [5e-3, 4e-3, 3.3e-3], "
    "shear_rate: 1000}\ngrains:\n"
    "  - {kind: single, diameter: 0.00048828125, aspect: 1, position: [1e-3, 1.7e-3, -1e-3], "
    "velocity: [0.2, 0.6, 0]}\n"
    "  - {kind: single, diameter: 0.00048828125, position: [-2e-3, 0.9e-3, 0]}\n"
    "  - {kind: single, diameter: 0.00048828125, position: [2e-3, -1.6e-3, 1e-3], "
    "velocity: [-3, -0.4, 0]}\n";

/* What flies free goes straight on, whatever the lattice does: x = x0 + (c + G y0) t. It turns at
 * steps 63, 188 and 313, and the grains cross the borders on the way. Rounding of velocities to
 * 2^-24 at each step, 400 times in one sense at most, and of places. */
static void what_flies_free_flies_straight(void **state)
{
    (void)state;
    const double rate = 1000;
    Rig rig;
    rig_open(&rig, "%s", few);
    OzSim *sim = start_sim(&rig, &rig_device);
    for (int step = 60; step <= 400; step += step < 66 ? 1 : 67) {
        OzSnapshot now = state_at(&rig, sim, step);
        for (int i = 0; i < 3; i++) {
            const double *x = &rig.grains.position[3 * i], *c = &rig.grains.velocity[3 * i];
            double time = step * 1e-5, flow = rate * x[1];
            double y = x[1] + c[1] * time;
            assert_true(fabs(now.position[3 * i] - (x[0] + (c[0] + flow) * time)) < 3e-8);
            assert_true(fabs(now.position[3 * i + 1] - y) < 1e-8);
            assert_true(fabs(now.velocity[3 * i] + rate * (y - x[1]) - c[0]) < 4e-5);
        }
        oz_snapshot_free(&now);
    }
    oz_sim_free(sim);
    rig_close(&rig);
}

/* Frictionless spheres that lose a part in each hit: what the shear puts in is there, or lost. The
 * stress at each step, times rate and volume, is that power: by the trapezoidal rule, whose error
 * is that of the contacts' ten steps and more. */
static void energy_adds_up(void **state)
{
    (void)state;
    const double rate = 1000, volume = 5e-3 * 4e-3 * 3.3e-3;
    double work = 0, before = 0;
    Rig rig;
    rig_open(&rig, crowd, "double", "velocity-verlet", "", rate);
    throw_grains(&rig.grains, 0.4, 0);
    rig_start(&rig);
    double start = oz_observables_energy(&rig.now);
    for (int step = 0; step <= 600; step++) {
        rig_advance(&rig, step);
        double power = -rate * volume * oz_stress_part(&rig.now, 3);
        work += step > 0 ? 1e-5 * (power + before) / 2 : 0;
        before = power;
    }
    const OzLedger *ledger = &rig.now.ledger;
    assert_true(ledger->work_walls > 3 * start && ledger->dissipated > start);
    assert_true(fabs(oz_observables_energy(&rig.now) - start) < 2e-3 * ledger->work_walls);
    assert_true(fabs(work / ledger->work_walls - 1) < 5e-3);
    rig_close(&rig);
}

/* Two spheres that press each other across the borders of x and y, at rest: force times the way
 * from one to the other, over the volume. */
static void a_contact_is_the_stress(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, "model: rods\nprecision: double\ngravity: [0, 0, 0]\n"
                   "time: {step: 1e-6, duration: 1}\n"
                   "contact: {contact_time: 1e-4, restitution: 1}\n"
                   "boundary: {x: periodic, y: periodic, z: periodic, size: [8e-3, 7e-3, 6e-3]}\n"
                   "grains:\n  - {kind: single, diameter: 1e-3, position: [3.9e-3, 3.3e-3, 0]}\n"
                   "  - {kind: single, diameter: 1e-3, position: [-3.5e-3, -3.0e-3, 0]}\n");
    rig_start(&rig);
    const double way[3] = {0.6e-3, 0.7e-3, 0}, distance = sqrt(0.85) * 1e-3;
    double push = rig.now.contacts.entry[0].push, volume = 8e-3 * 7e-3 * 6e-3;
    assert_true(push > 0 && rig.now.contacts.count == 1);
    double expected[OZ_STRESS_PARTS] = {way[0] * way[0], way[1] * way[1], 0, way[0] * way[1]};
    for (int part = 0; part < OZ_STRESS_PARTS; part++) {
        double stress = push * expected[part] / distance / volume;
        assert_true(fabs(oz_stress_part(&rig.now, part) - stress) < 1e-9 * push * 1e-3 / volume);
    }
    rig_close(&rig);
}

/* A rate that changes on the way: the strain goes on from where it is, the grains do, and a state
 * that is loaded again leads to the same bits; without its strain it does not. */
static void a_rate_changes_and_a_state_knows(void **state)
{
    (void)state;
    Rig rig, next;
    OzState saved = {0};
    rig_open(&rig, crowd, "float", "symplectic-euler", rough, 1000.0);
    rig_open(&next, crowd, "float", "symplectic-euler", rough, -400.0);
    throw_grains(&rig.grains, 0.4, 20);
    throw_grains(&next.grains, 0.4, 20);
    OzSim *sim = start_sim(&rig, &large_device), *other = start_sim(&next, &large_device);
    OzSnapshot then = state_at(&rig, sim, 150);
    const OzScene *scenes[] = {&next.scene};
    oz_motion_take_over(&next.scene, &rig.scene, oz_sim_time(sim));
    must(oz_take_over_apply(sim, scenes));
    OzSnapshot now = state_at(&next, sim, 150);
    assert_true(fabs(oz_snapshot_cell(&now).strain - 1.5) < 1e-12);
    assert_memory_equal(now.position, then.position, 3 * (size_t)now.count * sizeof(double));
    assert_memory_equal(now.velocity, then.velocity, 3 * (size_t)now.count * sizeof(double));
    must(oz_sim_advance(sim, 180));
    OzStateVisit save = oz_state_save(&saved), load = oz_state_load(&saved);
    must(oz_sim_state_visit(sim, &save));
    OzSnapshot end = state_at(&next, sim, 250);
    assert_true(fabs(oz_snapshot_cell(&end).strain - 1.1) < 1e-12);
    must(oz_sim_state_visit(other, &load));
    OzSnapshot again = state_at(&next, other, 250);
    assert_same_bits(&end, &again);
    *(double *)oz_state_find(&saved, "sim/member_0/strain")->data = 0;
    load = oz_state_load(&saved);
    must(oz_sim_state_visit(other, &load));
    OzSnapshot lost = state_at(&next, other, 250);
    assert_true(farthest(lost.velocity, end.velocity, 3 * end.count) > 1e-3);
    OzSnapshot *all[] = {&then, &now, &end, &again, &lost};
    for (int k = 0; k < 5; k++) {
        oz_snapshot_free(all[k]);
    }
    oz_state_free(&saved);
    oz_sim_free(sim);
    oz_sim_free(other);
    rig_close(&rig);
    rig_close(&next);
}

static void what_has_no_sense_is_refused(void **state)
{
    (void)state;
    rig_refuses(
        "grains: []\nboundary: {x: periodic, z: periodic, size: [1, 1, 1], shear_rate: 1}\n",
        "open along x or y");
    rig_refuses("grains: []\ngravity: [0, -9.81, 0]\n"
                "boundary: {x: periodic, y: periodic, size: [1, 1, 1], shear_rate: 1}\n",
                "gravity along x or y");
    rig_refuses(
        "grains: []\nboundary: {x: periodic, y: periodic, size: [1, 1, 1], shear_rate: 1e4}\n",
        "strains the cell by 0.1 in a step");
    rig_refuses("grains: []\nbroadphase: sort_axis\n"
                "boundary: {x: periodic, y: periodic, size: [1, 1, 1], shear_rate: 1}\n",
                "knows no shear");
    rig_refuses("grains: []\nobserve: {order: true}\n"
                "boundary: {x: periodic, y: periodic, size: [1, 1, 1], shear_rate: 1}\n",
                "order in a sheared cell");
    rig_refuses("grains: []\nfields: {interval: 0.1, cells: [1, 4, 1]}\n"
                "boundary: {x: periodic, y: periodic, size: [1, 1, 1], shear_rate: 1}\n",
                "fields of a sheared cell");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(where_the_origin_lies_does_not_show),
        cmocka_unit_test(a_hit_is_that_of_the_true_velocities),
        cmocka_unit_test(the_device_does_as_the_reference),
        cmocka_unit_test(what_flies_free_flies_straight),
        cmocka_unit_test(energy_adds_up),
        cmocka_unit_test(a_contact_is_the_stress),
        cmocka_unit_test(a_rate_changes_and_a_state_knows),
        cmocka_unit_test(what_has_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
