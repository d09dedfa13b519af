/* Trigrains on the device: against the host reference, in float too, the same bits however the work
 * is cut up, guards. */
#include "device_rig.h"

#include "model/beam_limits.h"
#include "sim/batch_fit.h"
#include "sim/element_reference.h"
#include "sim/read_snapshot.h"
#include "sim/sim.h"

/* Two dice that meet at once. */
static const char *const two_dice =
    "model: trigrains\n"
    "gravity: [0, 0]\n"
    "time: {step: %g, duration: 1}\n"
    "integrator: %s\n"
    "grains:\n"
    "  - {kind: single, shape: square, edge: 2e-3, position: [0, 0], velocity: [0.5, 0], angle: "
    "30}\n"
    "  - {kind: single, shape: square, edge: 2e-3, position: [2.2e-3, 0.3e-3], angle: 30}\n"
    "observe: {ledger: true, interval: 1e-3}\n";

/* A heap of all shapes and discs that falls into a shaken vessel. */
static const char *const heap =
    "model: trigrains\n"
    "seed: 5\n"
    "gravity: [5, -30]\n"
    "time: {step: 1e-6, duration: 1}\n"
    "integrator: %s\n"
    "contact: {law: hertz, hertz_stiffness: 1e5, normal_damping_rate: 500, "
    "tangential_damping_rate: 500, friction: 0.5}\n"
    "grains:\n"
    "  - {kind: random, count: 40, shape: polygon, corners: [3, 5], radius: [1.5e-3, 2.5e-3], "
    "irregularity: 0.2}\n"
    "  - {kind: random, count: %d, shape: disc, radius: 1e-3, density: 4}\n"
    "walls:\n"
    "  - {kind: vessel, point: [0, 0], width: 2.5e-2, height: 6e-2, motion: {frequency: 30, "
    "acceleration_ratio: 0.1}}\n"
    "observe: {ledger: true, interval: 1e-3}\n";

/* A drum that turns, with a die and a disc on a floor that is taken away. */
static const char *const drum =
    "model: trigrains\n"
    "gravity: [3, -20]\n"
    "time: {step: 1e-6, duration: 1}\n"
    "contact: {law: hertz, hertz_stiffness: 1e5, normal_damping_rate: 500, "
    "tangential_damping_rate: 100, friction: 0.3}\n"
    "grains:\n"
    "  - {kind: single, shape: square, edge: 2e-3, position: [0, 1.6e-3], angle: 10}\n"
    "  - {kind: single, shape: disc, radius: 1e-3, density: 4, position: [-3e-3, 1.2e-3]}\n"
    "walls:\n"
    "  - {kind: segment, from: [-9e-3, 0], to: [9e-3, 0], until: 8e-3}\n"
    "  - {kind: drum, point: [0, 0], diameter: 1.2e-2, teeth: 20, tooth_depth: 5e-4, "
    "motion: {angular_velocity: 20}}\n"
    "observe: {ledger: true, interval: 1e-3}\n";

/* Two dice that meet, one of them over the end of a floor that moves; the switches are those of the
 * extreme cases, whose kernels serve this too. */
static const char *const float_dice =
    "model: trigrains\n"
    "gravity: [0, 0]\n"
    "time: {step: 4e-6, duration: 1}\n"
    "integrator: gear4\n"
    "grains:\n"
    "  - {kind: single, shape: square, edge: 2e-3, position: [0, 0], velocity: [0.5, 0], angle: "
    "30}\n"
    "  - {kind: single, shape: square, edge: 2e-3, position: [2.2e-3, 0.3e-3], velocity: [0, "
    "-0.5], "
    "angle: 30}\n"
    "walls:\n"
    "  - {kind: floor, width: 2e-2, point: [1.15e-2, -1.1e-3], motion: {frequency: 100, amplitude: "
    "1e-4}}\n"
    "observe: {ledger: true, interval: 1e-3}\n"
    "precision: %s\n";

typedef struct Scene {
    OzScene scene;
    OzGrains grains;
} Scene;

static void open_scene(Scene *s, const char *format, ...)
{
    char text[4096];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    memset(s, 0, sizeof *s);
    must(oz_scene_parse(&s->scene, "piece.yaml", text, NULL, 0));
    must(oz_insert_grains(&s->grains, &s->scene));
}

static void close_scene(Scene *s)
{
    oz_grains_free(&s->grains);
    oz_scene_free(&s->scene);
}

/* The state at a step, and what it cost. */
static OzSnapshot run_device(const Scene *s, const OzDevice *device, int64_t step,
                             OzSimCounts *counts)
{
    OzSim *sim = NULL;
    OzSnapshot now;
    OzMember member = {&s->scene, &s->grains};
    must(oz_sim_create(&sim, device, &member, 1, NULL));
    must(oz_sim_advance(sim, step));
    must(oz_snapshot_create(&now, &s->scene, &s->grains));
    must(oz_read_snapshot_snapshot(sim, 0, &now, true));
    *counts = oz_sim_counts(sim);
    oz_sim_free(sim);
    return now;
}

static OzSnapshot run_reference(const Scene *s, int64_t step)
{
    OzElementReference *reference = NULL;
    OzSnapshot now;
    must(oz_element_reference_create(&reference, &s->scene, &s->grains));
    must(oz_element_reference_advance(reference, step));
    must(oz_snapshot_create(&now, &s->scene, &s->grains));
    must(oz_element_reference_snapshot(reference, &now));
    oz_element_reference_free(reference);
    return now;
}

static double largest_gap(const double *a, const double *b, int64_t count)
{
    double gap = 0;
    for (int64_t i = 0; i < count; i++) {
        gap = fmax(gap, fabs(a[i] - b[i]));
    }
    return gap;
}

static void assert_close(const char *what, double gap, double tolerance)
{
    if (!(gap <= tolerance)) {
        fail_msg("%s differ by %g, more than %g", what, gap, tolerance);
    }
}

static void assert_same_kinds(const OzSnapshot *a, const OzSnapshot *b)
{
    OzContactSums one = oz_contact_list_sum(&a->contacts), two = oz_contact_list_sum(&b->contacts);
    assert_memory_equal(one.kinds, two.kinds, sizeof one.kinds);
}

/* Rounding differs in the last digit of every sum and grows with the steps; contacts of stiff
 * elements make it grow faster than the square root of their number. 1e-11 of a grain's size and
 * speed (1e-3 m, 1 m/s) is a thousand times what was seen, a millionth of what a wrong term of any
 * force gives. */
static void assert_same_state(const OzSnapshot *a, const OzSnapshot *b)
{
    int64_t count = a->element_count;
    assert_close("positions", largest_gap(a->element_position, b->element_position, 2 * count),
                 1e-13);
    assert_close("angles", largest_gap(a->element_angle, b->element_angle, count), 1e-11);
    assert_close("velocities", largest_gap(a->element_velocity, b->element_velocity, 2 * count),
                 1e-11);
    assert_close("spins",
                 largest_gap(a->element_angular_velocity, b->element_angular_velocity, count),
                 1e-8);
    assert_same_kinds(a, b);
}

/* Sums over thousands of steps: 1e-9 of the scale (J), as for the state, is far above rounding and
 * a millionth of what a wrong term gives. */
static void assert_same_ledger(const OzElementLedger *a, const OzElementLedger *b, double scale)
{
    assert_close("axial losses", fabs(a->beam_axial - b->beam_axial), 1e-9 * scale);
    assert_close("bending losses", fabs(a->beam_bending - b->beam_bending), 1e-9 * scale);
    assert_close("disc damping", fabs(a->disc_damping - b->disc_damping), 1e-9 * scale);
    assert_close("disc friction", fabs(a->disc_friction - b->disc_friction), 1e-9 * scale);
    assert_close("walls' work", fabs(a->work_walls - b->work_walls), 1e-9 * scale);
}

static void compare_with_reference(const Scene *s, int64_t step)
{
    OzSimCounts counts;
    OzSnapshot device = run_device(s, &rig_device, step, &counts), host = run_reference(s, step);
    assert_true(host.contacts.count > 0);
    assert_same_state(&device, &host);
    assert_int_equal(device.deep_count, host.deep_count);
    assert_same_ledger(&device.element_ledger, &host.element_ledger, 1e-5);
    oz_snapshot_free(&device);
    oz_snapshot_free(&host);
}

static void test_two_dice(void **state)
{
    (void)state;
    Scene s;
    open_scene(&s, two_dice, 1e-6, "velocity-verlet\nguards: {overlap: {warn: 1e-3}}");
    OzSnapshot host = run_reference(&s, 400);
    assert_true(host.deep_count > 0); /* and as many on the device: */
    oz_snapshot_free(&host);
    compare_with_reference(&s, 400);
    close_scene(&s);
}

static void test_substeps(void **state)
{
    (void)state;
    Scene s;
    open_scene(&s, two_dice, 2e-6, "velocity-verlet\nbeams: {substeps: 3}");
    compare_with_reference(&s, 250);
    close_scene(&s);
}

static void test_heap(void **state)
{
    (void)state;
    Scene s;
    open_scene(&s, heap, "gear4", 20);
    compare_with_reference(&s, 14000);
    close_scene(&s);
}

/* Before and after the floor goes. */
static void test_walls(void **state)
{
    (void)state;
    Scene s;
    open_scene(&s, drum);
    compare_with_reference(&s, 7000);
    compare_with_reference(&s, 30000);
    close_scene(&s);
}

/* In float each of 125 steps rounds a coordinate below 2^-8 m by 2^-33 m at most: elements go
 * astray by 1.5e-8 m, and turn by that over 0.3 mm, the least distance of a triangle's edge from
 * its centre, besides 2^-25 rad a step, the rounding of angles below 1. An element that is astray
 * swings at the fastest rate of its grain. A hundredth more of a contact's force, of a beam's or of
 * its damping takes elements 4e-8 m astray or more. */
static void test_float(void **state)
{
    enum { STEPS = 125 };
    (void)state;
    Scene coarse, fine;
    OzSimCounts counts;
    OzBeamLimit limit;
    open_scene(&coarse, float_dice, "float");
    open_scene(&fine, float_dice, "double");
    must(oz_beam_limits_find(&limit, &coarse.scene, &coarse.grains));
    double way = STEPS * ldexp(1, -33), turn = way / 3e-4 + STEPS * ldexp(1, -25);
    OzSnapshot a = run_device(&coarse, &rig_device, STEPS, &counts),
               b = run_reference(&fine, STEPS);
    int64_t count = a.element_count;
    double gap = largest_gap(a.element_position, b.element_position, 2 * count);
    assert_true(gap > 1e-12); /* ten times what double may differ by: it was float */
    assert_close("positions", gap, way);
    assert_close("angles", largest_gap(a.element_angle, b.element_angle, count), turn);
    assert_close("velocities", largest_gap(a.element_velocity, b.element_velocity, 2 * count),
                 limit.rate * way);
    assert_close("spins",
                 largest_gap(a.element_angular_velocity, b.element_angular_velocity, count),
                 limit.rate * turn);
    assert_same_kinds(&a, &b);
    oz_snapshot_free(&a);
    oz_snapshot_free(&b);
    close_scene(&coarse);
    close_scene(&fine);
}

static void assert_same_element_bits(const OzSnapshot *a, const OzSnapshot *b)
{
    size_t count = (size_t)a->element_count * sizeof(double);
    assert_memory_equal(a->element_position, b->element_position, 2 * count);
    assert_memory_equal(a->element_velocity, b->element_velocity, 2 * count);
    assert_memory_equal(a->element_angle, b->element_angle, count);
    assert_memory_equal(a->element_angular_velocity, b->element_angular_velocity, count);
}

/* However wide the lanes, however many the work-items, however far the lists reach, small or grown.
 */
static void test_same_bits(void **state)
{
    static const struct {
        Shape shape;
        double skin;
        bool grows;
    } ways[] = {{SCALAR, 0, false},
                {GROUP, 0, false},
                {NATIVE, 1e-4, false},
                {NATIVE, 2e-2, true},
                {GROUP, 2e-2, true}};
    enum { STEPS = 16000 };
    (void)state;
    Scene s;
    OzSimCounts counts;
    open_scene(&s, heap, "gear4", 20);
    OzSnapshot one = run_device(&s, &rig_device, STEPS, &counts);
    assert_true(counts.rebuilds > 1 && counts.refreshes > 2 * counts.rebuilds);
    for (size_t k = 0; k < sizeof ways / sizeof ways[0]; k++) {
        OzDevice device = shaped_device(ways[k].shape);
        s.scene.skin = ways[k].skin;
        OzSnapshot other = run_device(&s, &device, STEPS, &counts);
        assert_same_element_bits(&one, &other);
        assert_int_equal(counts.growths > 0, ways[k].grows);
        oz_snapshot_free(&other);
    }
    oz_snapshot_free(&one);
    close_scene(&s);
}

/* Side by side as alone, with other numbers of elements beside. */
static void test_members(void **state)
{
    enum { STEPS = 9000 };
    static const int discs[] = {20, 5};
    (void)state;
    Scene s[2];
    OzMember members[2];
    OzSim *sim = NULL;
    OzSnapshot now;
    OzSimCounts counts;
    for (int k = 0; k < 2; k++) {
        open_scene(&s[k], heap, "gear4", discs[k]);
        members[k] = (OzMember){&s[k].scene, &s[k].grains};
    }
    assert_true(oz_batch_fit_agrees(&rig_device, &members[0], &members[1]));
    must(oz_sim_create(&sim, &rig_device, members, 2, NULL));
    must(oz_sim_advance(sim, STEPS));
    for (int k = 0; k < 2; k++) {
        OzSnapshot alone = run_device(&s[k], &rig_device, STEPS, &counts);
        must(oz_snapshot_create(&now, &s[k].scene, &s[k].grains));
        must(oz_read_snapshot_snapshot(sim, k, &now, true));
        assert_same_element_bits(&alone, &now);
        assert_memory_equal(&alone.element_ledger, &now.element_ledger, sizeof now.element_ledger);
        oz_snapshot_free(&alone);
        oz_snapshot_free(&now);
    }
    oz_sim_free(sim);
    for (int k = 0; k < 2; k++) {
        close_scene(&s[k]);
    }
}

static void speed_up(Scene *s)
{
    s->grains.elements->velocity[0] = 1e3;
}

static void fling(Scene *s)
{
    for (int i = 0; i < 4; i++) {
        s->grains.elements->velocity[2 * i] = 1e13;
    }
}

static void lose_number(Scene *s)
{
    s->grains.elements->velocity[1] = NAN;
}

static void stretch(Scene *s)
{
    s->grains.elements->beam_length[0] *= 2.5;
}

static void bend(Scene *s)
{
    s->grains.elements->beam_rest_a[1] += 1.5;
}

static void fold(Scene *s)
{
    s->grains.elements->beam_rest_a[1] += 3.14159265358979;
    s->grains.elements->beam_rest_b[1] += 3.14159265358979;
}

static void press(Scene *s)
{
    for (int i = 4; i < 8; i++) {
        s->grains.elements->position[2 * i] -= 0.7e-3;
    }
}

static void swallow(Scene *s)
{
    OzElements *elements = s->grains.elements;
    for (int k = 0; k < 6; k++) {
        elements->corner[6 * 4 + k] *= 1e-2;
    }
    memcpy(&elements->position[2 * 4], &elements->position[0], 2 * sizeof(double));
}

/* Each guard speaks up by its name within a step, and says what is to blame: a step only where it
 * is. */
static void test_guards(void **state)
{
    static const struct {
        void (*spoil)(Scene *s);
        const char *text, *advice;
    } guards[] = {{lose_number, "not a number", "`orzo check`"},
                  {fling, "left its container", "try a smaller time.step"},
                  {swallow, "wholly inside another", "; triangles.stiffness "},
                  {press, "by more than half", "; triangles.stiffness "},
                  {stretch, "shorter than half", "; beams.stiffness "},
                  {bend, "bent by more than 1 rad", "; beams.second_moment "},
                  {fold, "bent by more than 1 rad", "; beams.second_moment "},
                  {speed_up, "more than half its thickness", "try a smaller time.step"}};
    (void)state;
    for (size_t k = 0; k < sizeof guards / sizeof guards[0]; k++) {
        Scene s;
        OzSim *sim = NULL;
        open_scene(&s, two_dice, 1e-6, "velocity-verlet");
        guards[k].spoil(&s);
        OzMember member = {&s.scene, &s.grains};
        OzStatus status = oz_sim_create(&sim, &rig_device, &member, 1, NULL);
        status = status == OZ_OK ? oz_sim_advance(sim, 3) : status;
        if (status != OZ_ERR_BLOWUP || !strstr(oz_status_text(), guards[k].text) ||
            !strstr(oz_status_text(), guards[k].advice)) {
            fail_msg("expected '%s' and '%s' in: %s", guards[k].text, guards[k].advice,
                     oz_status_text());
        }
        oz_sim_free(sim);
        close_scene(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two_dice), cmocka_unit_test(test_substeps),
        cmocka_unit_test(test_heap),     cmocka_unit_test(test_walls),
        cmocka_unit_test(test_float),    cmocka_unit_test(test_same_bits),
        cmocka_unit_test(test_members),  cmocka_unit_test(test_guards),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
