/* The host reference on whole beds: its pair lists against all pairs, its energy ledger, its
 * guards. */
#include "rig.h"

#include "base/random.h"
#include "brute.h"
#include "model/contact.h"
#include "sim/pair_list.h"

#include <stdlib.h>

static const OzBoundary open_space;

static OzCapsule capsule_of(const OzGrains *grains, const double *position, const double *axis,
                            int64_t i)
{
    OzCapsule capsule = {.radius = grains->diameter[i] / 2};
    for (int c = 0; c < 3; c++) {
        capsule.centre[c] = position[3 * i + c];
        capsule.half_shaft[c] = axis[3 * i + c] * grains->length[i] / 2;
    }
    return capsule;
}

static double gap_between(const OzGrains *grains, const double *position, const double *axis,
                          int64_t i, int64_t j)
{
    OzCapsule a = capsule_of(grains, position, axis, i), b = capsule_of(grains, position, axis, j);
    return brute_distance(&a, &b) - a.radius - b.radius;
}

enum { CROWD = 120 };

/* Grains of all sizes, spheres among them, thrown into a box so that many overlap. */
static void throw_crowd(OzGrains *grains, double *axis, uint64_t seed)
{
    OzRandom random = oz_random_stream(seed, 0);
    must(oz_grains_create(grains, CROWD));
    for (int i = 0; i < CROWD; i++) {
        grains->diameter[i] = i % 4 ? oz_random_uniform(&random, 0.2, 1) : 0.5;
        grains->length[i] = i % 4 ? oz_random_uniform(&random, 0, 4) : 0;
        oz_random_direction(&random, &axis[3 * i]);
        for (int c = 0; c < 3; c++) {
            grains->position[3 * i + c] = oz_random_uniform(&random, 0, 5);
        }
    }
}

static bool comes_first(const OzGrains *grains, int a, int b)
{
    double reach_a = grains->diameter[a] + grains->length[a];
    double reach_b = grains->diameter[b] + grains->length[b];
    return reach_a != reach_b ? reach_a > reach_b : a < b;
}

static void test_sort_axis_lists_every_near_pair_in_order(void **state)
{
    (void)state;
    OzPairs list = {0};
    double axis[3 * CROWD];
    for (uint64_t seed = 0; seed < 6; seed++) {
        OzGrains grains;
        int64_t found = 0;
        double skin = seed < 3 ? 0 : 0.4;
        throw_crowd(&grains, axis, seed);
        must(oz_sort_axis_pairs(&list, &grains, grains.position, axis, skin, &open_space));
        for (int a = 0; a < CROWD; a++) {
            for (int b = 0; b < CROWD; b++) {
                bool near = a != b && comes_first(&grains, a, b) &&
                            gap_between(&grains, grains.position, axis, a, b) < skin;
                if (near) {
                    assert_true(found < list.count);
                    assert_true(list.pair[found].a == a && list.pair[found].b == b);
                    found++;
                }
            }
        }
        assert_int_equal(list.count, found);
        assert_true(found > CROWD);
        oz_grains_free(&grains);
    }
    oz_sort_axis_free(&list);
}

static void test_sort_axis_of_few(void **state)
{
    (void)state;
    OzPairs list = {0};
    for (int64_t count = 0; count < 2; count++) {
        OzGrains grains;
        double axis[3] = {0, 0, 1};
        must(oz_grains_create(&grains, count));
        must(oz_sort_axis_pairs(&list, &grains, grains.position, axis, 1, &open_space));
        assert_int_equal(list.count, 0);
        oz_grains_free(&grains);
    }
    oz_sort_axis_free(&list);
}

/* Three spheres in a row, 1 apart; the third comes near only later. */
static void test_springs_outlive_the_list(void **state)
{
    (void)state;
    OzPairList near = {0};
    OzGrains grains;
    bool renewed;
    double position[9] = {0, 0, 0, 0, 0, 1, 0, 0, 3}, axis[9] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
    must(oz_grains_create(&grains, 3));
    grains.diameter[0] = grains.diameter[1] = grains.diameter[2] = 1;
    must(oz_pair_list_renew(&near, &renewed, &grains, position, axis, &open_space));
    assert_true(renewed && near.pairs.count == 1);
    near.memory[0].stretch = oz_vec3(1, 2, 3);
    position[0] = 0.4 * near.skin;
    must(oz_pair_list_renew(&near, &renewed, &grains, position, axis, &open_space));
    assert_false(renewed);
    position[8] = -1; /* now before the pair that touched, by ids */
    must(oz_pair_list_renew(&near, &renewed, &grains, position, axis, &open_space));
    assert_true(renewed && near.pairs.count == 2);
    assert_true(near.pairs.pair[0].b == 1 && near.memory[0].stretch.y == 2);
    assert_true(near.pairs.pair[1].b == 2 && near.memory[1].stretch.y == 0);
    position[5] = 2; /* parted */
    must(oz_pair_list_renew(&near, &renewed, &grains, position, axis, &open_space));
    assert_true(renewed && near.pairs.count == 1 && near.memory[0].stretch.y == 0);
    oz_pair_list_free(&near);
    oz_grains_free(&grains);
}

static void test_a_sphere_among_rods_touches_once(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, "model: rods\ntime: {step: 1e-5, duration: 1}\n"
                   "contact: {contact_time: 1e-3, restitution: 0.5}\ngrains:\n"
                   "  - {kind: single, diameter: 1e-3, aspect: 0, position: [0, 0, 0.499e-3]}\n"
                   "  - {kind: single, diameter: 1e-3, aspect: 2, axis: [1, 0, 0],"
                   " position: [5e-3, 0, 0.499e-3]}\n"
                   "walls: [{kind: plane, point: [0, 0, 0], normal: [0, 0, 1]}]\n");
    rig_start(&rig);
    assert_int_equal(oz_contact_list_sum(&rig.now.contacts).walls, 3);
    rig_advance(&rig, 1);
    OzContactConstants c = oz_contact_constants(&rig.scene.contact);
    /* one spring, and a dashpot that has nothing to damp yet: rounding alone */
    double expected = (c.stiffness * 1e-6 - 9.81) * 1e-5;
    assert_true(fabs(rig.now.velocity[2] / expected - 1) < 1e-9);
    assert_true(fabs(rig.now.velocity[5] / (expected + c.stiffness * 1e-11) - 1) < 1e-9);
    rig_close(&rig);
}

/* Rods and spheres falling on a shaken floor in a cylinder. */
static void open_bed(Rig *rig, int integrator, double step)
{
    rig_open(rig,
             "model: rods\nseed: 3\ntime: {step: %.17g, duration: 1}\nintegrator: %s\n"
             "contact: {contact_time: 6e-4, restitution: 0.5, friction: 0.3}\n"
             "grains:\n  - {kind: random, count: 24, diameter: 1e-3, aspect: [2, 4], fill: 0.2}\n"
             "  - {kind: random, count: 12, diameter: [0.8e-3, 1.5e-3], aspect: 0, fill: 0.2}\n"
             "walls:\n  - {kind: cylinder, diameter: 7e-3}\n"
             "  - {kind: plane, point: [0, 0, 0], normal: [0, 0, 1],"
             " motion: {frequency: 30, acceleration_ratio: 3}}\n"
             "observe: {ledger: true}\n",
             step, integrator_names[integrator]);
}

static void test_a_shaken_bed_misses_no_pair(void **state)
{
    (void)state;
    Rig rig;
    int64_t most = 0;
    open_bed(&rig, OZ_INTEGRATOR_SYMPLECTIC_EULER, 2e-5);
    rig_start(&rig);
    for (int64_t step = 0; step <= 5000; step += 100) {
        int64_t touching = 0;
        rig_advance(&rig, step);
        for (int64_t a = 0; a < rig.now.count; a++) {
            for (int64_t b = 0; b < a; b++) {
                touching +=
                    gap_between(&rig.grains, rig.now.position, rig.now.axis, a, b) < 0 ? 1 : 0;
            }
        }
        assert_int_equal(oz_contact_list_sum(&rig.now.contacts).pairs, touching);
        most = touching > most ? touching : most;
    }
    assert_true(most > 30);
    rig_close(&rig);
}

/* What the ledger does not account for after three periods, over what was put in: what the floor
 * did and the weight that fell, all of it lost to dashpots and friction by then but for the motion
 * left. */
static double ledger_error(int integrator, double step)
{
    Rig rig;
    open_bed(&rig, integrator, step);
    rig_start(&rig);
    double before = mechanical_energy(&rig.now) + rig.now.ledger.elastic;
    rig_advance(&rig, (int64_t)round(0.1 / step));
    const OzLedger *l = &rig.now.ledger;
    double after = mechanical_energy(&rig.now) + l->elastic;
    double residual = after - before + l->dissipated + l->friction - l->work_walls;
    double put_in = l->dissipated + l->friction;
    assert_true(rig.now.has_ledger && l->dissipated > 0 && l->friction > 0 && l->elastic > 0);
    rig_close(&rig);
    return fabs(residual) / put_in;
}

/* A hundredth is what users are promised. */
static void test_ledger_closes(void **state)
{
    (void)state;
    /* 0.003 is left at 30 steps a contact */
    assert_true(ledger_error(OZ_INTEGRATOR_SYMPLECTIC_EULER, 2e-5) < 0.005);
    assert_true(ledger_error(OZ_INTEGRATOR_VELOCITY_VERLET, 2e-5) < 0.005);
}

/* What explicit Euler gains in each contact is of first order in the step. The two beds have other
 * contacts after a while, so a quarter of the step gives a quarter of the error only on average. */
static void test_ledger_of_euler_closes_linearly_with_the_step(void **state)
{
    (void)state;
    double coarse = ledger_error(OZ_INTEGRATOR_EULER, 5e-6);
    double fine = ledger_error(OZ_INTEGRATOR_EULER, 1.25e-6);
    /* 4, to a quarter for other contacts; second order would be 16 */
    assert_true(coarse / fine > 3 && coarse / fine < 5.5);
}

/* Advances until the reference refuses, and checks what it says. */
static void must_blow_up(Rig *rig, const char *words)
{
    assert_int_equal(oz_reference_advance(rig->reference, 10000), OZ_ERR_BLOWUP);
    if (!strstr(oz_status_text(), words) || !strstr(oz_status_text(), "in step ")) {
        fail_msg("\"%s\" does not tell \"%s\"", oz_status_text(), words);
    }
    rig_close(rig);
}

static void open_lone(Rig *rig, const char *state, const char *walls)
{
    rig_open(rig,
             "model: rods\ntime: {step: 1e-5, duration: 1}\nintegrator: velocity-verlet\n"
             "gravity: [0, 0, 0]\ncontact: {contact_time: 1e-3, restitution: 0.5}\n"
             "grains:\n  - {kind: single, diameter: 1e-3, aspect: 0, position: [0, 0, 2e-3]%s}\n%s",
             state, walls);
}

static void test_guards_name_the_grain(void **state)
{
    (void)state;
    const char *floor_wall = "walls: [{kind: plane, point: [0, 0, 0], normal: [0, 0, 1]}]\n";
    const char *other = "  - {kind: single, diameter: 1e-3, aspect: 0, position: [0, 0, 0]}\n";
    Rig rig;
    open_lone(&rig, ", velocity: [0, 0, -8]", floor_wall);
    rig_start(&rig);
    must_blow_up(&rig, "grain 0 overlaps a wall so far that its centre lies behind it");
    open_lone(&rig, "", floor_wall);
    rig.grains.position[2] = -1e-3;
    rig_start(&rig);
    must_blow_up(&rig, "grain 0 is through a wall");
    open_lone(&rig, ", velocity: [0, 0, -60]", "");
    rig_start(&rig);
    must_blow_up(&rig, "grain 0 moves an end farther than half its radius");
    open_lone(&rig, ", velocity: [0, 0, -10]", other);
    rig_start(&rig);
    must_blow_up(&rig, "grain 0 overlaps grain 1 so far that their shafts meet");
    open_lone(&rig, "", "");
    rig.grains.velocity[1] = NAN;
    rig_start(&rig);
    must_blow_up(&rig, "grain 0 is no number");
}

static void test_steps_are_absolute(void **state)
{
    (void)state;
    Rig once, twice;
    open_bed(&once, OZ_INTEGRATOR_VELOCITY_VERLET, 2e-5);
    open_bed(&twice, OZ_INTEGRATOR_VELOCITY_VERLET, 2e-5);
    rig_start(&once);
    rig_start(&twice);
    rig_advance(&once, 700);
    rig_advance(&twice, 300);
    rig_advance(&twice, 300);
    rig_advance(&twice, 700);
    size_t bytes = 3 * (size_t)once.now.count * sizeof(double);
    assert_memory_equal(once.now.position, twice.now.position, bytes);
    assert_memory_equal(once.now.angular_velocity, twice.now.angular_velocity, bytes);
    assert_true(once.now.ledger.dissipated == twice.now.ledger.dissipated);
    rig_close(&once);
    rig_close(&twice);
}

static void test_free_of_nothing(void **state)
{
    (void)state;
    OzPairs list = {0};
    oz_reference_free(NULL);
    oz_sort_axis_free(&list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sort_axis_lists_every_near_pair_in_order),
        cmocka_unit_test(test_sort_axis_of_few),
        cmocka_unit_test(test_springs_outlive_the_list),
        cmocka_unit_test(test_a_sphere_among_rods_touches_once),
        cmocka_unit_test(test_a_shaken_bed_misses_no_pair),
        cmocka_unit_test(test_ledger_closes),
        cmocka_unit_test(test_ledger_of_euler_closes_linearly_with_the_step),
        cmocka_unit_test(test_guards_name_the_grain),
        cmocka_unit_test(test_steps_are_absolute),
        cmocka_unit_test(test_free_of_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
