/* Deep contacts: what is counted, what ends a run, and whether the advice given then is right.
 * Closed forms: a hit of two spheres without loss at a speed v goes v t_c / pi deep, and is deeper
 * than a share s of that for t_c (1 - 2 asin(s) / pi). ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "sim/advice.h"

static const double PI = 3.14159265358979323846;
static const double radius = 1e-3, contact_time = 1e-3, step = 2e-6;

/* Two spheres of the given radii along x that meet, the first at rest; keys of the scene's own. */
static const char hit[] = "model: rods\nprecision: double\ngravity: [0, 0, 0]\n"
                          "integrator: velocity-verlet\ntime: {step: %g, duration: 1}\n"
                          "contact: {contact_time: %g, restitution: 1, friction: 0}\n%s"
                          "grains:\n  - {kind: single, diameter: 2e-3, position: [0, 0, 0]}\n"
                          "  - {kind: single, diameter: 2e-3, position: [2.0001e-3, 0, 0],\n"
                          "     velocity: [%.17g, 0, 0]}\n";

/* The same for one sphere and a wall. */
static const char bounce[] =
    "model: rods\nprecision: double\ngravity: [0, 0, 0]\n"
    "integrator: velocity-verlet\ntime: {step: %g, duration: 1}\n"
    "contact: {contact_time: %g, restitution: 1, friction: 0}\n%s"
    "grains:\n  - {kind: single, diameter: 2e-3, position: [0, 0, 1.0001e-3],\n"
    "     velocity: [0, 0, %.17g]}\nwalls: [{kind: plane}]\n";

/* The speed of a hit that goes so many radii deep, towards -x or -z. */
static double speed_to(double depth)
{
    return -depth * radius * PI / contact_time;
}

/* A hit without loss hands its speed on, or turns it round: 1e-3 is what velocity-verlet's entry
 * into and exit from a contact between two steps costs. */
static void assert_handed_on(const OzSnapshot *now, const double *start)
{
    int64_t last = 3 * (now->count - 1);
    double before = start[last] + start[last + 2];
    double after = now->velocity[0] - now->velocity[2];
    /* hundreds of steps a hit, entry and exit included: 2e-8 */
    assert_true(fabs(after / before - 1) < 1e-6);
}

/* Runs a hit to its end on the device or the reference; returns the count of deep contacts. */
static int64_t count_deep(const char *scene, const char *keys, double depth, bool on_device)
{
    Rig rig;
    int64_t last = (int64_t)(1.2 * contact_time / step), count;
    rig_open(&rig, scene, step, contact_time, keys, speed_to(depth));
    if (on_device) {
        OzSnapshot now = state_after(&rig, NATIVE, last);
        count = now.deep_count;
        assert_handed_on(&now, rig.grains.velocity);
        oz_snapshot_free(&now);
    } else {
        rig_start(&rig);
        rig_advance(&rig, last);
        count = rig.now.deep_count;
        assert_handed_on(&rig.now, rig.grains.velocity);
    }
    rig_close(&rig);
    return count;
}

/* One count more or less: where the crossings lie between steps, and a phase error of
 * velocity-verlet, which shortens a hit by (pi dt / t_c)^2 / 24 = 2e-6 of it. */
static void assert_count(const char *scene, const char *keys, double depth, double warn)
{
    double share = warn / depth;
    double expected = share < 1 ? contact_time * (1 - 2 * asin(share) / PI) / step : 0;
    for (int device = 0; device < 2; device++) {
        int64_t count = count_deep(scene, keys, depth, device);
        if (fabs((double)count - expected) > (share < 1 ? 1 : 0)) {
            fail_msg("depth %g, warn at %g: %lld counted, expected %.1f", depth, warn,
                     (long long)count, expected);
        }
    }
}

static void test_hits_deeper_than_a_radius_go_on_and_are_counted(void **state)
{
    (void)state;
    assert_count(hit, "", 0.95, 1);
    assert_count(hit, "", 1.5, 1);
    assert_count(hit, "", 1.9, 1);
    assert_count(hit, "guards: {overlap: {warn: 0.5}}\n", 1.2, 0.5);
    assert_count(bounce, "", 0.45, 0.5);
    assert_count(bounce, "", 0.7, 0.5);
}

/* Starts a hit on the device and expects it to stop with these words. */
static void assert_stop(const char *scene, const char *keys, double time, double speed,
                        const char *words)
{
    Rig rig;
    rig_open(&rig, scene, step, time, keys, speed);
    OzSim *sim = start_sim(&rig, &rig_device);
    OzStatus status = oz_sim_advance(sim, 10000);
    assert_int_equal(status, OZ_ERR_BLOWUP);
    if (!strstr(oz_status_text(), words)) {
        fail_msg("\"%s\" does not tell \"%s\"", oz_status_text(), words);
    }
    oz_sim_free(sim);
    rig_close(&rig);
}

/* The deepest overlap in so many seconds, m, by 100 looks; fails where the run stops. */
static double deepest(const char *scene, double time, double speed, double seconds)
{
    Rig rig;
    double worst = 0;
    rig_open(&rig, scene, step * time / contact_time, time, "", speed);
    OzSim *sim = start_sim(&rig, &rig_device);
    for (int k = 1; k <= 100; k++) {
        OzSnapshot now = state_at(&rig, sim, (int64_t)(k * seconds / 100 / rig.scene.step));
        worst = fmax(worst, oz_contact_list_sum(&now.contacts).overlap_max);
        oz_snapshot_free(&now);
    }
    oz_sim_free(sim);
    rig_close(&rig);
    return worst;
}

/* The contact time that the last message asks for. */
static double advised_time(void)
{
    const char *key = strstr(oz_status_text(), " contact.contact_time ");
    double time = 0;
    if (!key || sscanf(key, " contact.contact_time %lf s", &time) != 1) {
        fail_msg("\"%s\" names no contact time", oz_status_text());
    }
    return time;
}

/* A hit 3 radii deep would send one shaft through the other. The advice is for one radius, from the
 * energy, which is exact here: within its two digits and the 5 % that keep rounding on the safe
 * side. */
static void test_the_advice_after_a_hit_holds(void **state)
{
    (void)state;
    assert_stop(hit, "", contact_time, speed_to(3), "shafts meet");
    double depth = deepest(hit, advised_time(), speed_to(3), contact_time) / radius;
    print_message("two spheres: %.3g radii\n", depth);
    /* one radius less 5 %, two digits of a time have 5 % at most */
    assert_true(depth > 0.9 && depth < 1);
    assert_stop(bounce, "", contact_time, speed_to(1.5), "behind a wall");
    depth = deepest(bounce, advised_time(), speed_to(1.5), contact_time) / radius;
    print_message("a wall: %.3g radii\n", depth);
    /* half of that at a wall */
    assert_true(depth > 0.45 && depth < 0.5);
}

static void test_a_limit_of_ones_own_ends_a_run(void **state)
{
    (void)state;
    const char *keys = "guards: {overlap: {warn: 0.5, stop: 1.2}}\n";
    assert_stop(hit, keys, contact_time, speed_to(1.5), "more than guards.overlap.stop");
    assert_stop(bounce, keys, contact_time, speed_to(0.7), "more than guards.overlap.stop");
}

/* A sphere 40 times as large, let go on a small one: too soft whatever the step. The advice is for
 * half a radius at the wall, less its 5 % of time and what the upper contact, twice as soft, takes
 * of the fall. */
static void test_the_advice_for_a_size_ratio_holds(void **state)
{
    (void)state;
    static const char column[] =
        "model: rods\nprecision: double\nintegrator: velocity-verlet\n"
        "time: {step: %g, duration: 1}\ncontact: {contact_time: %g, restitution: 1, friction: "
        "0}\n%s"
        "grains:\n  - {kind: single, diameter: 2e-4, position: [0, 0, 1e-4]}\n"
        "  - {kind: single, diameter: 8e-3, position: [0, 0, 4.2e-3], velocity: [0, 0, %g]}\n"
        "walls: [{kind: plane}]\n";
    assert_stop(column, "", contact_time, 0, "a smaller time.step does not help");
    double time = advised_time(), depth = deepest(column, time, 0, 0.01) / 1e-4;
    print_message("contact time %.3g s: %.3g radii\n", time, depth);
    /* 5 % and two digits, and as much for the upper contact's part */
    assert_true(depth < 0.5 && depth > 0.43);
}

/* Where the step is the cause it is said, with the one that is stable: t_c 2 / pi for a contact
 * without loss by velocity-verlet. */
static void test_an_unstable_step_is_to_blame(void **state)
{
    (void)state;
    Rig rig;
    char text[320], expected[64];
    rig_open(&rig, hit, 0.7 * contact_time, contact_time, "", 0.0);
    rig.grains.position[3] = 1.5e-3;
    rig_start(&rig);
    oz_advice_write(text, sizeof text, &rig.now, 0);
    snprintf(expected, sizeof expected, "expected below %.3g s", contact_time * 2 / PI);
    assert_non_null(strstr(text, expected));
    assert_null(strstr(text, "too soft"));
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hits_deeper_than_a_radius_go_on_and_are_counted),
        cmocka_unit_test(test_the_advice_after_a_hit_holds),
        cmocka_unit_test(test_a_limit_of_ones_own_ends_a_run),
        cmocka_unit_test(test_the_advice_for_a_size_ratio_holds),
        cmocka_unit_test(test_an_unstable_step_is_to_blame),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
