/* Neighbour lists must not change a bit, however they are made: while a bed of all sizes is shaken,
 * runs with other lists are compared with the run with none but all pairs, and so are runs by the
 * way of large scenes, in which grains change places. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "sim/rods_private.h"

enum { STEPS = 2000, GRAINS = 61 };

/* Integrator, broadphase, skin. */
static const char bed[] =
    "model: rods\n"
    "integrator: %s\n"
    "broadphase: %s\n"
    "skin: %g\n"
    "time: {step: 1e-5, duration: 1}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4, rolling_friction: 0.02}\n"
    "grains:\n"
    "  - {kind: random, count: 20, diameter: 0.6e-3}\n"
    "  - {kind: random, count: 20, diameter: 0.5e-3, aspect: 3}\n"
    "  - {kind: random, count: 21, diameter: [0.3e-3, 1e-3], aspect: [0.5, 3]}\n"
    "walls:\n"
    "  - {kind: plane, motion: {frequency: 100, acceleration_ratio: 4}}\n"
    "  - {kind: cylinder, diameter: 5e-3}\n";

typedef struct Bed {
    Rig rig;
    OzSim *sim;
    OzSnapshot end;
} Bed;

static void open_bed_by(Bed *b, const char *integrator, const char *broadphase, double skin,
                        const OzDevice *device)
{
    memset(b, 0, sizeof *b);
    rig_open(&b->rig, bed, integrator, broadphase, skin);
    throw_grains(&b->rig.grains, 0.3, 100);
    for (int64_t i = 0; i < GRAINS; i++) { /* down onto the floor at once */
        b->rig.grains.velocity[3 * i + 2] -= 1;
    }
    b->sim = start_sim(&b->rig, device);
}

static void open_bed(Bed *b, const char *broadphase, double skin, const OzDevice *device)
{
    open_bed_by(b, "euler", broadphase, skin, device);
}

static void run_bed(Bed *b)
{
    b->end = state_at(&b->rig, b->sim, STEPS);
    assert_true(oz_contact_list_sum(&b->end.contacts).pairs > 0);
    assert_true(oz_sim_counts(b->sim).rebuilds > 5);
}

static void close_bed(Bed *b)
{
    oz_snapshot_free(&b->end);
    oz_sim_free(b->sim);
    rig_close(&b->rig);
}

/* What every other run must give, bit by bit. */
static Bed by_all_pairs;

static void check_bed(Bed *b)
{
    run_bed(b);
    assert_same_bits(&b->end, &by_all_pairs.end);
    close_bed(b);
}

static void check_rows(const char *broadphase, double skin, const OzDevice *device)
{
    Bed b;
    open_bed(&b, broadphase, skin, device);
    assert_int_equal(oz_rods_switches(b.sim)->resort, device == &large_device);
    check_bed(&b);
}

static void test_twice(void **state)
{
    (void)state;
    check_rows("all_pairs", 0, &rig_device);
}

static void test_hash(void **state)
{
    (void)state;
    check_rows("hash", 0, &rig_device);
}

static void test_sort_axis(void **state)
{
    (void)state;
    check_rows("sort_axis", 0, &rig_device);
}

/* Springs survive rebuilds: rare or frequent ones, the bits are the same. */
static void test_other_skins(void **state)
{
    (void)state;
    check_rows("hash", 5e-5, &rig_device);
    check_rows("hash", 2e-3, &rig_device);
    check_rows("sort_axis", 1e-4, &rig_device);
}

/* Every rebuilding puts the grains in another order, springs and all. */
static void test_large(void **state)
{
    (void)state;
    check_rows("hash", 0, &large_device);
    check_rows("hash", 5e-5, &large_device);
    check_rows("hash", 2e-3, &large_device);
    check_rows("sort_axis", 0, &large_device);
}

/* velocity-verlet moves before the forces: lists that its moves have used up must be made anew in
 * between, or the skin would show. */
static void test_large_moves_first(void **state)
{
    (void)state;
    static const double skins[] = {4e-6, 0};
    Bed whole, b;
    open_bed_by(&whole, "velocity-verlet", "hash", 2e-2, &large_device);
    whole.end = state_at(&whole.rig, whole.sim, STEPS);
    for (size_t k = 0; k < sizeof skins / sizeof skins[0]; k++) {
        open_bed_by(&b, "velocity-verlet", "hash", skins[k], &large_device);
        run_bed(&b);
        assert_same_bits(&b.end, &whole.end);
        close_bed(&b);
    }
    close_bed(&whole);
}

/* Begins again with lists that hold next to nothing. */
static void shrink_lists(OzSim *sim)
{
    OzSizes tiny = *oz_rods_sizes(sim);
    tiny.outer_capacity = oz_rods_switches(sim)->lanes;
    tiny.inner_capacity = oz_rods_switches(sim)->lanes;
    tiny.back_capacity = 1;
    must(oz_arrays_resize(&sim->arrays, &tiny));
    oz_rods_control(sim, 0)->truth = OZ_SPRINGS_AT_NONE;
}

static void check_growth(const char *broadphase, const OzDevice *device)
{
    Bed b;
    open_bed(&b, broadphase, 0, device);
    shrink_lists(b.sim);
    run_bed(&b);
    assert_true(oz_sim_counts(b.sim).growths >= 3);
    assert_same_bits(&b.end, &by_all_pairs.end);
    close_bed(&b);
}

static void test_full_lists_grow(void **state)
{
    (void)state;
    check_growth("hash", &rig_device);
    check_growth("sort_axis", &rig_device);
    check_growth("hash", &large_device);
}

/* Looking at the bed in between changes nothing. */
static void look_often(Bed *b)
{
    for (int64_t step = 0; step < STEPS; step += 37) {
        OzSnapshot now = state_at(&b->rig, b->sim, step);
        oz_snapshot_free(&now);
    }
}

static void check_launches(const OzDevice *device)
{
    Bed b;
    open_bed(&b, "hash", 0, device);
    look_often(&b);
    check_bed(&b);
}

static void test_many_launches(void **state)
{
    (void)state;
    check_launches(&rig_device);
    check_launches(&large_device);
}

/* The same of a small scene, whose one launch makes lists in between: lists that are full, and
 * launches that end, when places are moved and forces are not yet felt must not add a force twice
 * or lose one. */
static void test_moves_first(void **state)
{
    (void)state;
    Bed whole, full, looked_at;
    open_bed_by(&whole, "velocity-verlet", "hash", 2e-2, &rig_device);
    whole.end = state_at(&whole.rig, whole.sim, STEPS);
    open_bed_by(&full, "velocity-verlet", "hash", 0, &rig_device);
    shrink_lists(full.sim);
    run_bed(&full);
    assert_true(oz_sim_counts(full.sim).growths >= 3);
    assert_same_bits(&full.end, &whole.end);
    open_bed_by(&looked_at, "velocity-verlet", "hash", 0, &rig_device);
    look_often(&looked_at);
    run_bed(&looked_at);
    assert_same_bits(&looked_at.end, &whole.end);
    close_bed(&looked_at);
    close_bed(&full);
    close_bed(&whole);
}

static int open_all(void **state)
{
    if (open_rig_device(state) != 0) {
        return -1;
    }
    open_bed(&by_all_pairs, "all_pairs", 0, &rig_device);
    run_bed(&by_all_pairs);
    return 0;
}

static int close_all(void **state)
{
    close_bed(&by_all_pairs);
    return close_rig_device(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_twice),           cmocka_unit_test(test_hash),
        cmocka_unit_test(test_sort_axis),       cmocka_unit_test(test_other_skins),
        cmocka_unit_test(test_large),           cmocka_unit_test(test_large_moves_first),
        cmocka_unit_test(test_full_lists_grow), cmocka_unit_test(test_many_launches),
        cmocka_unit_test(test_moves_first),
    };
    return cmocka_run_group_tests(tests, open_all, close_all);
}
