/* Periodic cells: hits across their borders, a crowd on the device beside the host reference, and
 * the same bits wherever the origin lies. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "observe/basin.h"
#include "scene/boundary.h"

static const char hit[] =
    "model: rods\nprecision: double\ngravity: [0, 0, 0]\ntime: {step: 1e-6, duration: 1}\n"
    "contact: {contact_time: 1e-4, restitution: 0.6, friction: 0.3}\n%s"
    "grains:\n"
    "  - {kind: single, diameter: 1e-3, aspect: %g, axis: [0, 1, 0], position: [%g, 0, 0.1e-3], "
    "velocity: [0.5, 0, 0], spin: [0, 0, 40]}\n"
    "  - {kind: single, diameter: 0.8e-3, position: [%g, 0.2e-3, 0], velocity: [-0.3, 0, 0]}\n";

/* What meets across the border is thrown back as it would be in open space. Positions are read as
 * paths, which go on beyond the cell; they differ by rounding. */
static void what_meets_across_the_border_bounces(void **state)
{
    (void)state;
    const double period = 8e-3;
    for (int rods = 0; rods < 2; rods++) {
        Rig rig, open;
        rig_open(&rig, hit, "boundary: {x: periodic, z: periodic, size: [8e-3, 1, 6e-3]}\n",
                 rods ? 1.5 : 0.0, 3.4e-3, -3.6e-3);
        rig_open(&open, hit, "", rods ? 1.5 : 0.0, 3.4e-3, period - 3.6e-3);
        rig_start(&rig);
        rig_start(&open);
        rig_advance(&rig, 1500);
        rig_advance(&open, 1500);
        assert_true(open.now.velocity[0] < 0.4 && open.now.velocity[3] > 0); /* they did meet */
        assert_true(farthest(rig.now.velocity, open.now.velocity, 6) < 1e-9);
        assert_true(fabs(rig.now.position[0] - open.now.position[0]) < 1e-12);
        assert_true(fabs(rig.now.position[3] + period - open.now.position[3]) < 1e-12);
        rig_close(&rig);
        rig_close(&open);
    }
}

/* Rods and spheres of 2^-11 m fall sideways through a cell between a floor and a lid. Units of a
 * place are then powers of two, and so are the shifts below. */
static const char crowd[] =
    "model: rods\nprecision: %s\ngravity: [6, 3, -9.81]\n"
    "time: {step: 1e-5, duration: 1}\nintegrator: %s\nobserve: {ledger: true}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4, rolling_friction: 0.1, "
    "surface_energy: 1e-3}\ndrag: {viscosity: 1e-3}\n"
    "boundary: {x: periodic, y: periodic, size: [4e-3, 3.3e-3, 0]}\ngrains:\n"
    "  - {kind: random, count: 50, diameter: 0.00048828125, aspect: %d, fill: 0.25}\n"
    "  - {kind: random, count: 50, diameter: 0.00048828125, fill: 0.25}\n"
    "walls:\n"
    "  - {kind: plane}\n"
    "  - {kind: plane, point: [0, 0, 5e-3], normal: [0, 0, -1]}\n";

enum { STEPS = 300 };

static void throw_crowd(Rig *rig)
{
    throw_grains(&rig->grains, 0.4, 20);
    for (int64_t i = 0; i < rig->grains.count; i++) {
        rig->grains.velocity[3 * i] += 1.5; /* all leave the cell */
    }
}

/* Rounding grows a thousandfold in so many steps with hits. */
static void the_device_does_as_the_reference(void **state)
{
    (void)state;
    const char *const precisions[] = {"double", "float"};
    const double tolerances[] = {1e-9, 2e-3};
    for (int k = 0; k < 2; k++) {
        Rig rig;
        rig_open(&rig, crowd, precisions[k], k ? "symplectic-euler" : "velocity-verlet", 2);
        throw_crowd(&rig);
        OzSnapshot seen = state_after(&rig, NATIVE, STEPS);
        rig_start(&rig);
        rig_advance(&rig, STEPS);
        assert_true(farthest(seen.velocity, rig.now.velocity, 3 * seen.count) < tolerances[k]);
        assert_true(farthest(seen.position, rig.now.position, 3 * seen.count) < tolerances[k]);
        assert_true(seen.position[0] > 3e-3 && seen.contacts.count > 5);
        assert_int_equal(seen.contacts.count, rig.now.contacts.count);
        oz_snapshot_free(&seen);
        rig_close(&rig);
    }
}

/* The crowd moved by whole units of a place. */
static OzSnapshot shifted(Rig *rig, const double shift[3], const OzDevice *device)
{
    rig_open(rig, crowd, "float", "symplectic-euler", 2);
    throw_crowd(rig);
    for (int64_t i = 0; i < 3 * rig->grains.count; i++) {
        rig->grains.position[i] =
            ldexp(rint(ldexp(rig->grains.position[i], 32)), -32) + shift[i % 3];
    }
    OzSim *sim = start_sim(rig, device);
    OzSnapshot now = state_at(rig, sim, STEPS);
    oz_sim_free(sim);
    return now;
}

/* Sums are in the order of ids, differences of places are whole numbers: where grains are counted
 * from, and how they are sorted into cells and tiles does not show in a bit. */
static void bits_do_not_depend_on_the_origin(void **state)
{
    (void)state;
    const double shifts[][3] = {{3 * 0x1p-11, 0, 0}, {-0x1p-9, 0x1p-10, 0}, {0x1p-12, -0x1p-9, 0}};
    const OzDevice *devices[] = {&rig_device, &large_device, &large_device};
    Rig rig, other;
    OzSnapshot first = shifted(&rig, (const double[]){0, 0, 0}, &rig_device);
    size_t bytes = 3 * (size_t)first.count * sizeof(double);
    for (int k = 0; k < 3; k++) {
        OzSnapshot now = shifted(&other, shifts[k], devices[k]);
        assert_memory_equal(now.velocity, first.velocity, bytes);
        assert_memory_equal(now.angular_velocity, first.angular_velocity, bytes);
        for (int64_t i = 0; i < 3 * now.count; i++) {
            assert_true(fabs(now.position[i] - shifts[k][i % 3] - first.position[i]) < 1e-15);
        }
        oz_snapshot_free(&now);
        rig_close(&other);
    }
    oz_snapshot_free(&first);
    rig_close(&rig);
}

/* Grains placed at random touch nobody, images included, and stick out of the cell; what one pair
 * gives the other takes, so that all momentum stays. */
static void a_gas_keeps_its_momentum(void **state)
{
    (void)state;
    Rig rig;
    double before[3] = {0}, after[3] = {0};
    int outside = 0;
    rig_open(&rig, "model: rods\nprecision: double\ngravity: [0, 0, 0]\n"
                   "time: {step: 1e-5, duration: 1}\n"
                   "contact: {contact_time: 3e-4, restitution: 0.7, friction: 0.4}\n"
                   "boundary: {x: periodic, y: periodic, z: periodic, size: [5e-3, 4e-3, 4.5e-3]}\n"
                   "grains:\n  - {kind: random, count: 60, diameter: 0.5e-3, aspect: 2}\n");
    throw_grains(&rig.grains, 1, 100);
    rig_start(&rig);
    assert_int_equal(rig.now.contacts.count, 0);
    for (int64_t i = 0; i < rig.grains.count; i++) {
        for (int c = 0; c < 3; c++) {
            double half = rig.grains.length[i] / 2 * fabs(rig.now.axis[3 * i + c]);
            outside += fabs(rig.grains.position[3 * i + c]) + half > rig.scene.boundary.size[c] / 2;
            before[c] += rig.grains.mass[i] * rig.grains.velocity[3 * i + c];
        }
    }
    assert_true(outside > 5);
    rig_advance(&rig, 1000);
    for (int64_t i = 0; i < rig.grains.count; i++) {
        for (int c = 0; c < 3; c++) {
            after[c] += rig.grains.mass[i] * rig.now.velocity[3 * i + c];
        }
    }
    assert_true(mechanical_energy(&rig.now) < 0.8 * 60 * 0.5 * rig.grains.mass[0]); /* it met */
    assert_true(farthest(before, after, 3) < 1e-12 * 60 * rig.grains.mass[0]);
    rig_close(&rig);
}

/* Velocities are normal: means of squares and fourth powers within five of their own deviations
 * (sqrt(2/n) and sqrt(32/3/n) of them), and all together have no momentum. */
static void random_velocities_are_normal(void **state)
{
    (void)state;
    const double spread = 0.3, count = 3000;
    Rig rig;
    double sum[3] = {0};
    rig_open(&rig, "model: rods\ntime: {step: 1e-5, duration: 1}\n"
                   "contact: {contact_time: 3e-4, restitution: 0.7}\n"
                   "boundary: {x: periodic, y: periodic, z: periodic, size: [0.03, 0.03, 0.03]}\n"
                   "grains:\n  - {kind: random, count: 3000, diameter: [0.5e-3, 1e-3], "
                   "velocity_spread: 0.3}\n");
    for (int k = 0; k < 3; k++) {
        double square = 0, fourth = 0;
        for (int64_t i = 0; i < rig.grains.count; i++) {
            double v = rig.grains.velocity[3 * i + k] / spread;
            sum[k] += rig.grains.mass[i] * v / (count * rig.grains.mass[0]);
            square += v * v / count;
            fourth += v * v * v * v / 3 / count;
        }
        assert_true(fabs(square - 1) < 5 * sqrt(2 / count));
        assert_true(fabs(fourth - 1) < 5 * sqrt(32.0 / 3 / count));
        assert_true(fabs(sum[k]) < 1e-14);
    }
    rig_close(&rig);
}

static void what_has_no_sense_is_refused(void **state)
{
    (void)state;
    rig_refuses("boundary: {size: [1, 1, 1]}\ngrains: []\n", "no periodic direction");
    rig_refuses("boundary: {x: periodic, size: [0, 1, 1]}\ngrains: []\n", "is 0 m along x");
    rig_refuses("boundary: {y: periodic, size: [1, 1, 1]}\n"
                "grains: [{kind: random, count: 3, diameter: 0.1, aspect: 4}]\n",
                "two images");
    rig_refuses("boundary: {z: periodic, size: [1, 1, 1]}\ngrains: []\nwalls: [{kind: plane}]\n",
                "walls.0 is not the same in every cell");
    rig_refuses("boundary: {x: periodic, size: [1, 1, 1]}\ngrains: []\n"
                "walls: [{kind: box, size: [1, 1, 1]}]\n",
                "walls.0 is not the same in every cell");
}

/* The sizes of grains of a file are known when they have been read. */
static void long_grains_of_a_file_are_refused(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, hit, "boundary: {x: periodic, z: periodic, size: [8e-3, 1, 6e-3]}\n", 0.0,
             3.4e-3, -3.6e-3);
    rig.grains.length[0] = 2.2e-3; /* with its ends of 0.5e-3 each: 3.2 mm, of the cell's 6 */
    assert_int_equal(oz_reference_create(&rig.reference, &rig.scene, &rig.grains), OZ_ERR_INPUT);
    assert_non_null(strstr(oz_status_text(), "0.0032 m long would meet two images"));
    rig_close(&rig);
}

/* What densities are measured over: a column of the cell, where it has one. */
static void a_cell_has_an_area(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, crowd, "float", "euler", 1);
    assert_true(fabs(oz_basin_area(&rig.scene) - 4e-3 * 3.3e-3) < 1e-15);
    assert_int_equal(oz_basin_floor(&rig.scene), 0);
    rig_close(&rig);
    rig_open(&rig, hit, "boundary: {x: periodic, z: periodic, size: [8e-3, 1, 6e-3]}\n", 0.0,
             3.4e-3, -3.6e-3);
    assert_true(oz_basin_area(&rig.scene) == 0);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_meets_across_the_border_bounces),
        cmocka_unit_test(the_device_does_as_the_reference),
        cmocka_unit_test(bits_do_not_depend_on_the_origin),
        cmocka_unit_test(a_gas_keeps_its_momentum),
        cmocka_unit_test(random_velocities_are_normal),
        cmocka_unit_test(long_grains_of_a_file_are_refused),
        cmocka_unit_test(what_has_no_sense_is_refused),
        cmocka_unit_test(a_cell_has_an_area),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
