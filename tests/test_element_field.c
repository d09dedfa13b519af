/* Grains whose contacts have a potential, stepped: two stars keep their energy in a hit where the
 * kinds of contact lose some, sums of forces and torques are nothing, energy comes from walls'
 * work alone, and the device does what the host reference does. */
#include "element_rig.h"

#include "model/insert.h"
#include "observe/observables.h"
#include "sim/element_forces.h"
#include "sim/read_snapshot.h"
#include "sim/sim.h"
#include "sim/trial.h"

#include <stdlib.h>

/* Two stars that hit, tip against flank; nothing damps. */
static const char stars[] =
    "model: trigrains\ngravity: [0, 0]\nintegrator: velocity-verlet\n"
    "time: {step: %g, duration: 1}\ntriangles: {overlap: %s}\n"
    "beams: {damping: 0, damping_shear: balanced, length_min: 4e-4}\n"
    "observe: {ledger: true}\n"
    "grains:\n"
    "  - {kind: single, shape: star, radius: 2.5e-3, corners: 5, depth: 0.5, position: [0, 0],"
    " angle: 20, velocity: [0.5, 0]}\n"
    "  - {kind: single, shape: star, radius: 2.5e-3, corners: 5, depth: 0.5,"
    " position: [5.2e-3, 0.3e-3]}\n";

/* Polygons and angles, which have triangles of one to three and of no outer edges, in a vessel that
 * goes up and down. */
static const char heap[] =
    "model: trigrains\nseed: 4\ngravity: [20, -120]\nintegrator: velocity-verlet\n"
    "time: {step: 1e-6, duration: 1}\ntriangles: {overlap: field}\n"
    "beams: {second_moment: 1e-9}\nobserve: {ledger: true}\n"
    "grains:\n"
    "  - {kind: random, count: 12, shape: polygon, corners: [3, 6], radius: [1.5e-3, 2.5e-3],"
    " irregularity: 0.2}\n"
    "  - {kind: random, count: 10, shape: vertices, vertices: [0,0, 4e-3,0, 4e-3,1.5e-3,"
    " 1.5e-3,1.5e-3, 1.5e-3,4e-3, 0,4e-3]}\n"
    "  - {kind: random, count: 6, shape: vertices, vertices: [2e-3,0, 1e-3,1.7e-3, -1e-3,1.7e-3,"
    " -2e-3,0, -1e-3,-1.7e-3, 1e-3,-1.7e-3]}\n"
    "walls:\n"
    "  - {kind: vessel, width: 2.5e-2, height: 6e-2, motion: {frequency: 30,"
    " acceleration_ratio: 0.1}}\n";

enum { STEPS = 12000 };

static void open_rig(ElementRig *rig, const char *format, ...)
{
    char text[4096];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    *rig = (ElementRig){0};
    must(oz_scene_parse(&rig->scene, "rig.yaml", text, NULL, 0));
    must(oz_insert_grains(&rig->grains, &rig->scene));
    rig_start(rig);
}

/* The largest change of energy in 6 ms, looked at every 0.1 ms, over the energy; and the largest of
 * angular momentum, kg m^2/s. */
static double change_of_energy(const char *overlap, double step, double *turned)
{
    ElementRig rig;
    double before[3], after[3], worst = 0;
    open_rig(&rig, stars, step, overlap);
    double start = oz_observables_energy(&rig.now);
    rig_momentum(&rig.now, before);
    int met = 0;
    for (int k = 1; k <= 60; k++) {
        rig_advance(&rig, (int64_t)(k * 1e-4 / step + 0.5));
        worst = fmax(worst, fabs(oz_observables_energy(&rig.now) - start));
        met += oz_contact_list_sum(&rig.now.contacts).kinds[OZ_CONTACT_II] > 0;
    }
    rig_momentum(&rig.now, after);
    *turned = fabs(after[2] - before[2]);
    assert_true(met > 0);
    rig_close(&rig);
    return worst / start;
}

/* Second order in the step: a quarter of the change at half of it, a half at the most where
 * contacts begin between steps. Angular momentum, of some 1e-9 kg m^2/s, to rounding. */
static void test_stars_keep_their_energy(void **state)
{
    (void)state;
    double turned, unused;
    double coarse = change_of_energy("field", 2e-6, &unused);
    double fine = change_of_energy("field", 1e-6, &turned);
    double kinds = change_of_energy("kinds", 1e-6, &unused);
    print_message("energy changes by %.1e, at half the step by %.1e; by kinds %.1e\n", coarse, fine,
                  kinds);
    assert_true(fine < 1e-5 && fine < 0.5 * coarse);
    assert_true(kinds > 5e-3);
    assert_true(turned < 1e-20);
}

/* No wall, no gravity: all forces and torques sum to nothing, and there are many. */
static void test_sums(void **state)
{
    (void)state;
    ElementRig rig;
    OzElementForces forces;
    open_rig(&rig, heap);
    OzElements *p = rig.grains.elements;
    rig.scene.wall_count = 0;
    memset(rig.scene.gravity, 0, sizeof rig.scene.gravity);
    for (int64_t i = 0; i < p->free_count; i++) { /* together in the middle */
        p->position[2 * i] *= 0.6;
        p->position[2 * i + 1] *= 0.6;
    }
    OzElementState now = {p->position, p->angle, p->velocity, p->angular_velocity, 0, false};
    must(oz_element_forces_create(&forces, &rig.scene, &rig.grains));
    must(oz_element_forces_touch(&forces, &now));
    double sum[3] = {0}, size = 0;
    int64_t pushed = 0;
    for (int64_t i = 0; i < p->free_count; i++) {
        const double *f = &forces.force[2 * i], *x = &p->position[2 * i];
        sum[0] += f[0];
        sum[1] += f[1];
        sum[2] += x[0] * f[1] - x[1] * f[0] + forces.torque[i];
        size += hypot(f[0], f[1]);
        pushed += f[0] != 0 || f[1] != 0;
    }
    print_message("%lld elements pushed, forces sum to %.1e of theirs\n", (long long)pushed,
                  hypot(sum[0], sum[1]) / size);
    assert_true(pushed > 20);
    /* a hundred forces, each exact to 1e-16 of itself, at some centimetres */
    assert_true(hypot(sum[0], sum[1]) < 1e-14 * size);
    assert_true(fabs(sum[2]) < 1e-16 * size);
    oz_element_forces_free(&forces);
    rig_close(&rig);
}

/* A heap that falls into a shaken vessel. Energy comes from the walls' work alone, whatever edges
 * cross: second order where contacts begin leaves 1e-4 of the work. */
static void test_energy_in_a_heap(void **state)
{
    (void)state;
    ElementRig rig;
    open_rig(&rig, heap);
    double start = oz_observables_energy(&rig.now);
    rig_advance(&rig, STEPS);
    double kinetic = rig_kinetic(&rig.now), change = oz_observables_energy(&rig.now) - start;
    print_message("energy changes by %.1e of what is kinetic\n", change / kinetic);
    assert_true(rig.now.contacts.count > 5);
    assert_true(fabs(change) < 1e-4 * kinetic);
    rig_close(&rig);
}

static double largest_gap(const double *a, const double *b, int64_t count)
{
    double gap = 0;
    for (int64_t i = 0; i < count; i++) {
        gap = fmax(gap, fabs(a[i] - b[i]));
    }
    return gap;
}

/* The same on the device. Rounding grows with the steps: to 2e-11 of a speed of 1 m/s, with the
 * kinds as well. 1e-10 is a hundred-thousandth of what a thousandth more of a force gives. */
static void test_device(void **state)
{
    (void)state;
    ElementRig rig;
    OzDevice device;
    OzSim *sim = NULL;
    OzSnapshot now;
    open_rig(&rig, heap);
    must(oz_device_open(&device, NULL, 0));
    OzMember member = {&rig.scene, &rig.grains};
    must(oz_sim_create(&sim, &device, &member, 1, NULL));
    must(oz_sim_advance(sim, STEPS));
    must(oz_snapshot_create(&now, &rig.scene, &rig.grains));
    must(oz_read_snapshot_snapshot(sim, 0, &now, true));
    rig_advance(&rig, STEPS);
    OzContactSums one = oz_contact_list_sum(&now.contacts);
    OzContactSums two = oz_contact_list_sum(&rig.now.contacts);
    int64_t count = now.element_count;
    assert_true(one.pairs > 2 && one.walls > 2);
    assert_memory_equal(one.kinds, two.kinds, sizeof one.kinds);
    assert_true(largest_gap(now.element_position, rig.now.element_position, 2 * count) < 1e-12);
    assert_true(largest_gap(now.element_angle, rig.now.element_angle, count) < 1e-10);
    assert_true(largest_gap(now.element_velocity, rig.now.element_velocity, 2 * count) < 1e-10);
    assert_true(largest_gap(now.element_angular_velocity, rig.now.element_angular_velocity, count) <
                1e-7);
    assert_int_equal(now.deep_count, rig.now.deep_count);
    oz_snapshot_free(&now);
    oz_sim_free(sim);
    oz_device_close(&device);
    rig_close(&rig);
}

/* A die in the middle of a larger one's triangle is too deep for a run, as it is for the kinds. */
static void test_swallowed(void **state)
{
    (void)state;
    ElementRig rig;
    open_rig(&rig, "model: trigrains\ngravity: [0, 0]\nintegrator: velocity-verlet\n"
                   "time: {step: 1e-7, duration: 1}\ntriangles: {overlap: field}\n"
                   "beams: {length_min: 1e-5, area_min: 1e-9}\n"
                   "grains:\n  - {kind: single, shape: square, edge: 4e-3, position: [0, 0]}\n"
                   "  - {kind: single, shape: square, edge: 4e-4, position: [1.4e-3, 1e-5]}\n");
    assert_int_equal(oz_element_reference_advance(rig.reference, 1), OZ_ERR_BLOWUP);
    assert_non_null(strstr(oz_status_text(), "overlaps by more than half an element"));
    rig_close(&rig);
}

/* How far a hit of 0.1 m/s at a floor bends the second star, its outline copied along. */
static double bend_of(const char *overlap)
{
    ElementRig rig;
    OzTrial trial;
    open_rig(&rig, stars, 1e-6, overlap);
    must(oz_trial_hit(&trial, &rig.scene, &rig.grains, 1, 0.1));
    rig_close(&rig);
    return trial.bend;
}

/* A tip is softer than by kinds (test_triangle_field.c, test_corner) and bends less; with a depth
 * that did not know the outline it would bend more, 1.04 of the kinds'. */
static void test_trial(void **state)
{
    (void)state;
    double field = bend_of("field"), kinds = bend_of("kinds");
    print_message("a hit bends by %.4g rad, by kinds %.4g\n", field, kinds);
    assert_true(field < 0.97 * kinds && field > 0.8 * kinds);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stars_keep_their_energy),
        cmocka_unit_test(test_sums),
        cmocka_unit_test(test_energy_in_a_heap),
        cmocka_unit_test(test_swallowed),
        cmocka_unit_test(test_trial),
        cmocka_unit_test(test_device),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
