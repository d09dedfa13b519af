/* Timing the parts of a step leaves a simulation as it was: it goes on with the bits of one that
 * was never measured. velocity-verlet, which carries accelerations from step to step, on a moving
 * floor, with springs at walls and between grains; a pile of trigrains. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "sim/models.h"
#include "sim/stage_timing.h"

/* The floor has gone far from where the last launch began, and every launch ends between samples.
 */
enum { MEASURED = 800, LATER = 1000 };

static const char bed[] =
    "model: rods\n"
    "integrator: velocity-verlet\n"
    "time: {step: 1e-5, duration: 1}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4, rolling_friction: 0.02}\n"
    "grains:\n"
    "  - {kind: random, count: 20, diameter: 0.6e-3}\n"
    "  - {kind: random, count: 20, diameter: 0.5e-3, aspect: 3}\n"
    "  - {kind: random, count: 21, diameter: [0.3e-3, 1e-3], aspect: [0.5, 3]}\n"
    "walls:\n"
    "  - {kind: plane, motion: {frequency: 100, acceleration_ratio: 4}}\n"
    "  - {kind: cylinder, diameter: 5e-3}\n";

/* Dice on the floor and on each other, which bounce a little. */
static const char dice[] =
    "model: trigrains\n"
    "time: {step: 1e-6, duration: 1}\n"
    "grains:\n"
    "  - {kind: lattice, shape: square, edge: 2e-3, cells: [1, 3], spacing: [3e-3, 1.9999e-3], "
    "position: [0, 0.9999e-3]}\n"
    "walls:\n"
    "  - {kind: floor, width: 20e-3, thickness: 5e-3, point: [0, 0]}\n";

static void open_bed(Rig *rig, const char *scene)
{
    rig_open(rig, "%s", scene);
    if (!rig->grains.elements) {
        throw_grains(&rig->grains, 0.3, 100);
    }
    for (int64_t i = 0; i < rig->grains.count && !rig->grains.elements; i++) {
        rig->grains.velocity[3 * i + 2] -= 1; /* down onto the floor at once */
    }
}

static void measure(OzSim *sim, const OzModel *model)
{
    double seconds[OZ_TIMED_MOST];
    must(oz_stage_timing_measure(seconds, sim, NULL));
    for (int i = 0; i < model->stage_count; i++) {
        assert_true(isfinite(seconds[i]));
        if (model->stages[i].less == OZ_TIMED_NONE) {
            assert_true(seconds[i] > 0);
        }
    }
}

/* Measures on the way when asked. The caller frees the snapshot. */
static OzSnapshot run_bed(const Rig *rig, const OzDevice *device, bool measured)
{
    OzSim *sim = start_sim(rig, device);
    OzSnapshot there = state_at(rig, sim, MEASURED);
    assert_true(oz_contact_list_sum(&there.contacts).pairs > 0);
    assert_true(oz_contact_list_sum(&there.contacts).walls > 0);
    if (measured) {
        measure(sim, oz_models_of(&rig->scene));
    }
    OzSnapshot end = state_at(rig, sim, LATER);
    oz_snapshot_free(&there);
    oz_sim_free(sim);
    return end;
}

static void check_measuring(const OzDevice *device, const char *scene)
{
    Rig rig;
    open_bed(&rig, scene);
    OzSnapshot whole = run_bed(&rig, device, false), measured = run_bed(&rig, device, true);
    assert_same_bits(&measured, &whole);
    oz_snapshot_free(&whole);
    oz_snapshot_free(&measured);
    rig_close(&rig);
}

static void test_small(void **state)
{
    (void)state;
    check_measuring(&rig_device, bed);
    check_measuring(&rig_device, dice);
}

static void test_large(void **state)
{
    (void)state;
    OzDevice large = rig_device;
    large.small_most = 0;
    check_measuring(&large, bed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_small),
        cmocka_unit_test(test_large),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
