/* Grains and walls of several materials in kernels, against the host reference. ORZO_NEEDS_DEVICE
 */
#include "mixture_rig.h"

#include "scene/mixing.h"
#include "sim/sim_state.h"

static const char mindlin[] =
    "law: hertz-mindlin, restitution: 0.5, youngs_modulus: 3e6, poisson_ratio: 0.3";

/* Rounding of one step, a thousand times larger after some hits: 1e-16 of a velocity in double,
 * 3e-8 in float. A wrong constant shows in the first digits. */
static void check_mixture(const char *precision, const char *contact, const char *key,
                          const char *value, Shape shape, double tolerance)
{
    enum { STEPS = 300 };
    Rig rig;
    open_mixture(&rig, precision, contact, key, value);
    OzSnapshot seen = state_after(&rig, shape, STEPS);
    rig_start(&rig);
    rig_advance(&rig, STEPS);
    double off = farthest(seen.velocity, rig.now.velocity, 3 * seen.count);
    if (!(off < tolerance)) {
        fail_msg("%s: off by %g", contact, off);
    }
    assert_true(oz_contact_list_sum(&seen.contacts).pairs > 0 && seen.ledger.dissipated > 0);
    assert_true(fabs(seen.ledger.elastic / rig.now.ledger.elastic - 1) < 1e3 * tolerance);
    assert_true(fabs(seen.ledger.friction / rig.now.ledger.friction - 1) < 1e3 * tolerance);
    oz_snapshot_free(&seen);
    rig_close(&rig);
}

static void test_device_against_host(void **state)
{
    (void)state;
    check_mixture("float", hooke, "contact_time", "2e-4", NATIVE, 1e-2);
    check_mixture("double", mindlin, "youngs_modulus", "5e6", GROUP, 1e-9);
}

/* Tiles of a large scene, whose slots are not numbers of grains. */
static void test_large_scene_is_the_same(void **state)
{
    (void)state;
    Rig rig;
    open_mixture(&rig, "float", hooke, "contact_time", "2e-4");
    OzDevice large = rig_device;
    large.small_most = 10;
    OzSnapshot one = state_after(&rig, NATIVE, 200);
    OzSim *sim = start_sim(&rig, &large);
    OzSnapshot other = state_at(&rig, sim, 200);
    assert_same_bits(&one, &other);
    oz_snapshot_free(&one);
    oz_snapshot_free(&other);
    oz_sim_free(sim);
    rig_close(&rig);
}

/* One material by three names, and the same scene without any. The kernels are those of the
 * mixture. */
static void test_names_alone_change_nothing(void **state)
{
    (void)state;
    OzSnapshot seen[2];
    Rig rig[2];
    const char values[] = "contact_time: 3e-4, restitution: 0.5, friction: 0.4, "
                          "rolling_friction: 0.1, surface_energy: 1e-4";
    for (int named = 0; named < 2; named++) {
        char text[2000];
        if (named) {
            snprintf(text, sizeof text,
                     "materials: [{name: a, %s}, {name: b, %s}, {name: c, %s}]\n" GRAINS(
                         ", material: a", ", material: b", ", material: c"),
                     values, values, values);
        } else {
            snprintf(text, sizeof text, "contact: {%s}\n" GRAINS("", "", ""), values);
        }
        const char *a = named ? ", material: a" : "", *c = named ? ", material: c" : "";
        rig_open(&rig[named], SHAKEN, "float", text, a, c, a);
        throw_grains(&rig[named].grains, 0.4, 20);
        seen[named] = state_after(&rig[named], NATIVE, 300);
        assert_int_equal(oz_mixing_count(&rig[named].scene), named ? 3 : 1);
    }
    assert_true(seen[0].contacts.count > 0);
    assert_same_bits(&seen[0], &seen[1]);
    for (int named = 0; named < 2; named++) {
        oz_snapshot_free(&seen[named]);
        rig_close(&rig[named]);
    }
}

/* A simulation that takes up the state of another one goes on to the same bits. */
static void test_goes_on_to_the_same_bits(void **state)
{
    (void)state;
    Rig rig;
    OzState kept = {0};
    open_mixture(&rig, "float", hooke, "contact_time", "2e-4");
    OzSim *sim = start_sim(&rig, &rig_device), *next = start_sim(&rig, &rig_device);
    must(oz_sim_advance(sim, 150));
    OzStateVisit save = oz_state_save(&kept), load = oz_state_load(&kept);
    must(oz_sim_state_visit(sim, &save));
    must(oz_sim_state_visit(next, &load));
    OzSnapshot one = state_at(&rig, sim, 300), other = state_at(&rig, next, 300);
    assert_same_bits(&one, &other);
    oz_snapshot_free(&one);
    oz_snapshot_free(&other);
    oz_sim_free(sim);
    oz_sim_free(next);
    oz_state_free(&kept);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names_alone_change_nothing),
        cmocka_unit_test(test_device_against_host),
        cmocka_unit_test(test_large_scene_is_the_same),
        cmocka_unit_test(test_goes_on_to_the_same_bits),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
