/* The same bed from a nanometre to kilometres: lengths by powers of two, times by the root of them
 * under the same gravity, so that no number is rounded another way and the scaled motion must be
 * the same bit for bit. Guards must be the same too: a step that turns a small rod too far stops
 * it. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "sim/read_snapshot.h"
#include "sim/sim.h"

/* Of lengths, 2^exponent, from grains of 1.4 nm to a vessel of 3 km; a metre is first, and the
 * others are compared with it. */
static const int exponents[] = {0, -30, -20, -10, 8};
enum { SCALES = 5, STEPS = 2000 };

/* 1.5 m rods and spheres of several sizes, thrown together on a shaken floor. */
static const char rods[] =
    "model: rods\n"
    "seed: 3\n"
    "precision: %s\n"
    "integrator: velocity-verlet\n"
    "time: {step: %.17g, duration: %.17g}\n"
    "contact: {contact_time: %.17g, restitution: 0.4, friction: 0.3}\n"
    "grains:\n"
    "  - {kind: random, count: 30, diameter: [%.17g, %.17g], aspect: 3, density: 2500}\n"
    "  - {kind: random, count: 10, diameter: %.17g, aspect: 0, density: 1000}\n"
    "walls:\n"
    "  - {kind: plane, motion: {frequency: %.17g, amplitude: %.17g}}\n"
    "  - {kind: cylinder, diameter: %.17g}\n";

/* Squares and polygons on a shaken floor: what they are made of is the paper's, scaled. */
static const char elements[] =
    "model: trigrains\n"
    "seed: 3\n"
    "precision: %s\n"
    "time: {step: %.17g, duration: %.17g}\n"
    "triangles: {stiffness: %.17g}\n"
    "beams: {stiffness: %.17g, second_moment: %.17g, damping: %.17g, length_min: %.17g, area_min: "
    "%.17g}\n"
    "grains:\n"
    "  - {kind: random, count: 8, shape: square, edge: [%.17g, %.17g]}\n"
    "  - {kind: random, count: 8, shape: polygon, corners: [4, 6], radius: %.17g}\n"
    "walls:\n"
    "  - {kind: vessel, width: %.17g, height: %.17g, motion: {frequency: %.17g, amplitude: "
    "%.17g}}\n";

static OzSim *start_sim_of(const Rig *rig)
{
    OzSim *sim = NULL;
    OzMember member = {&rig->scene, &rig->grains};
    must(oz_sim_create(&sim, &rig_device, &member, 1, NULL));
    return sim;
}

/* The bed at a step, in metres and seconds of the unscaled one. Contacts are not asked for: rods'
 * overlaps would have to be scaled as well. */
static OzSnapshot scaled_state(Rig *rig, int64_t step, double length, double time)
{
    OzSnapshot now;
    OzSim *sim = start_sim_of(rig);
    must(oz_sim_advance(sim, step));
    must(oz_snapshot_create(&now, &rig->scene, &rig->grains));
    must(oz_read_snapshot_snapshot(sim, 0, &now, false));
    oz_sim_free(sim);
    for (int64_t k = 0; k < 3 * now.count; k++) {
        now.position[k] /= length;
        now.velocity[k] /= length / time;
        now.angular_velocity[k] *= time;
    }
    return now;
}

static void open_rods(Rig *rig, double s, double t, const char *precision)
{
    rig_open(rig, rods, precision, 1e-3 * t, 10 * t, 0.03 * t, 1.5 * s, 2 * s, 2 * s, 0.5 / t,
             0.25 * s, 12 * s);
    throw_grains(&rig->grains, 3 * s / t, 2 / t);
}

/* A thousand times the paper's lengths at the metre; times by the root of that. */
static void open_elements(Rig *rig, double s, double t, const char *precision)
{
    rig_open(rig, elements, precision, 6e-5 * t, 10 * t, 2e6, 1e5 * s, 0.05 * s * s * s,
             284 * s * s / t, 0.6 * s, 0.4 * s * s, 1.8 * s, 2.5 * s, 1.5 * s, 20 * s, 40 * s,
             0.5 / t, 0.25 * s);
}

static void assert_same_motion(const OzSnapshot *a, const OzSnapshot *b)
{
    assert_memory_equal(a->position, b->position, 3 * (size_t)a->count * sizeof(double));
    assert_memory_equal(a->velocity, b->velocity, 3 * (size_t)a->count * sizeof(double));
    assert_memory_equal(a->angular_velocity, b->angular_velocity,
                        3 * (size_t)a->count * sizeof(double));
}

static void compare_scales(void (*open)(Rig *rig, double s, double t, const char *precision),
                           const char *precision)
{
    OzSnapshot metre = {0};
    for (int k = 0; k < SCALES; k++) {
        Rig rig;
        double s = ldexp(1, exponents[k]), t = ldexp(1, exponents[k] / 2);
        open(&rig, s, t, precision);
        OzSnapshot now = scaled_state(&rig, STEPS, s, t);
        if (k > 0) {
            print_message("2^%d m in %s\n", exponents[k], precision);
            assert_same_motion(&metre, &now);
            oz_snapshot_free(&now);
        } else {
            metre = now;
        }
        rig_close(&rig);
    }
    oz_snapshot_free(&metre);
}

static void test_rods(void **state)
{
    (void)state;
    compare_scales(open_rods, "float");
    compare_scales(open_rods, "double");
}

static void test_trigrains(void **state)
{
    (void)state;
    compare_scales(open_elements, "double");
    compare_scales(open_elements, "float");
}

/* Half a radius is the most that an end may go in a step; this one goes 16. */
static void test_fast_turns_are_seen(void **state)
{
    (void)state;
    for (int k = 0; k < SCALES; k++) {
        Rig rig;
        double s = ldexp(1, exponents[k]), t = ldexp(1, exponents[k] / 2);
        open_rods(&rig, s, t, "float");
        double *angular_velocity = rig.grains.angular_velocity, radius = rig.grains.diameter[0] / 2;
        double rate = 16 * radius / (rig.grains.length[0] / 2) / rig.scene.step, axis[3];
        oz_grains_axis(rig.grains.quaternion, axis);
        angular_velocity[0] = rate * axis[1]; /* across the shaft, about a level line */
        angular_velocity[1] = -rate * axis[0];
        angular_velocity[2] = 0;
        OzSim *sim = start_sim_of(&rig);
        assert_int_equal(oz_sim_advance(sim, 10), OZ_ERR_BLOWUP);
        assert_non_null(strstr(oz_status_text(), "step 1,"));
        assert_non_null(strstr(oz_status_text(), "moves more than"));
        oz_sim_free(sim);
        rig_close(&rig);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rods),
        cmocka_unit_test(test_trigrains),
        cmocka_unit_test(test_fast_turns_are_seen),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
