/* Beams that break and yield on the device: against the host reference, the same bits however the
 * work is cut up, and frames that keep who is of which piece. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "observe/frame_reader.h"
#include "sim/element_reference.h"
#include "sim/read_snapshot.h"

#include <unistd.h>

/* Grains of any shape thrown into a shaken vessel, hard enough for some to break: integrator. */
static const char *const thrown =
    "model: trigrains\n"
    "time: {step: 2e-6, duration: 1}\n"
    "gravity: [20, -200]\n"
    "integrator: %s\n"
    "precision: %s\n"
    "triangles: {overlap: %s}\n"
    "beams: {substeps: %d, strength: {tension: 8e-3, compression: 0.02, moment: 4e-7, criterion: "
    "quadratic}, yield: {moment: 3.8e-7}}\n"
    "grains: [{kind: random, count: 12, shape: polygon, corners: [3, 5], radius: [1e-3, 2e-3]}]\n"
    "walls:\n"
    "  - {kind: vessel, width: 15e-3, height: 3e-2, motion: {frequency: 500, "
    "acceleration_ratio: 1}}\n"
    "observe: {ledger: true, interval: 1e-3}\n";

enum { STEPS = 2500 }; /* 1.4 ms after the first break */

static OzSnapshot run_reference(const Rig *rig, int64_t step)
{
    OzElementReference *reference = NULL;
    OzSnapshot now;
    must(oz_element_reference_create(&reference, &rig->scene, &rig->grains));
    must(oz_element_reference_advance(reference, step));
    must(oz_snapshot_create(&now, &rig->scene, &rig->grains));
    must(oz_element_reference_snapshot(reference, &now));
    oz_element_reference_free(reference);
    return now;
}

static void assert_same_wear(const OzSnapshot *a, const OzSnapshot *b)
{
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->wear.whole, b->wear.whole, (size_t)a->wear.beam_count * sizeof(double));
    assert_memory_equal(a->grains->elements->body, b->grains->elements->body,
                        (size_t)a->element_count * sizeof(int));
}

/* Rounding grows with the steps: as in test_element_device. */
static void test_reference(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, thrown, "gear4", "double", "field", 1);
    OzSnapshot device = state_after(&rig, NATIVE, STEPS), host = run_reference(&rig, STEPS);
    int64_t count = device.element_count, scars = 0;
    print_message("%d grains of %d, %d broken beams\n", (int)device.count, (int)rig.grains.count,
                  (int)oz_wear_broken(&device.wear));
    assert_true(device.count > rig.grains.count + 1);
    assert_same_wear(&device, &host);
    assert_true(farthest(device.element_position, host.element_position, 2 * count) < 1e-13);
    assert_true(farthest(device.element_velocity, host.element_velocity, 2 * count) < 1e-10);
    for (int64_t k = 0; k < device.wear.scar_count; k++) {
        scars += host.wear.scar[k] > 0;
        assert_true(fabs(device.wear.scar[k] - host.wear.scar[k]) < 1e-11);
    }
    assert_true(scars > 0);
    double lost = host.element_ledger.beam_broken;
    assert_true(lost > 0 && fabs(device.element_ledger.beam_broken - lost) < 1e-9 * lost);
    lost = host.element_ledger.beam_yielded;
    assert_true(lost > 0 && fabs(device.element_ledger.beam_yielded - lost) < 1e-9 * lost);
    assert_true(farthest(device.wear.rest, host.wear.rest, 3 * host.wear.beam_count) < 1e-10);
    assert_true(fabs(device.element_ledger.beam_axial - host.element_ledger.beam_axial) < 1e-13);
    oz_snapshot_free(&device);
    oz_snapshot_free(&host);
    rig_close(&rig);
}

/* However wide the lanes and many the work-items, one launch or many, small or large scene. */
static void test_same_bits(void **state)
{
    static const struct {
        Shape shape;
        bool large;
    } ways[] = {{GROUP, false}, {NATIVE, true}};
    (void)state;
    Rig rig;
    rig_open(&rig, thrown, "gear4", "double", "field", 1);
    OzSnapshot one = state_after(&rig, NATIVE, STEPS);
    for (size_t k = 0; k < sizeof ways / sizeof *ways; k++) {
        OzDevice device = shaped_device(ways[k].shape);
        device.small_most = ways[k].large ? 0 : device.small_most;
        OzSim *sim = start_sim(&rig, &device);
        for (int64_t step = 7; step < STEPS; step += 531) {
            must(oz_sim_advance(sim, step));
        }
        OzSnapshot other = state_at(&rig, sim, STEPS);
        assert_same_wear(&one, &other);
        assert_same_bits(&one, &other);
        assert_memory_equal(one.wear.scar, other.wear.scar,
                            (size_t)one.wear.scar_count * sizeof(double));
        assert_memory_equal(one.wear.rest, other.wear.rest,
                            3 * (size_t)one.wear.beam_count * sizeof(double));
        assert_true(one.element_ledger.beam_broken == other.element_ledger.beam_broken);
        assert_true(one.element_ledger.beam_yielded == other.element_ledger.beam_yielded);
        oz_snapshot_free(&other);
        oz_sim_free(sim);
    }
    oz_snapshot_free(&one);
    rig_close(&rig);
}

/* In float the first beams break as in double on the host, before the paths part; beams in
 * substeps. A beam may break a substep sooner or later, in a load that rises within some ten. */
static void test_float(void **state)
{
    (void)state;
    Rig coarse, fine;
    int64_t step = 1600;
    rig_open(&coarse, thrown, "velocity-verlet", "float", "kinds", 3);
    rig_open(&fine, thrown, "velocity-verlet", "double", "kinds", 3);
    OzSnapshot now = run_reference(&fine, step);
    while (oz_wear_broken(&now.wear) == 0 && step < STEPS) {
        oz_snapshot_free(&now);
        now = run_reference(&fine, step += 20);
    }
    OzSnapshot other = state_after(&coarse, NATIVE, step);
    assert_true(oz_wear_broken(&now.wear) > 0);
    assert_same_wear(&now, &other);
    double lost = now.element_ledger.beam_broken;
    print_message("lost %g J of %g J\n", other.element_ledger.beam_broken, lost);
    assert_true(fabs(other.element_ledger.beam_broken - lost) < 0.1 * lost);
    oz_snapshot_free(&now);
    oz_snapshot_free(&other);
    rig_close(&coarse);
    rig_close(&fine);
}

/* Frames tell the pieces, whose places follow from their triangles (in float). */
static void test_frames(void **state)
{
    (void)state;
    Rig rig;
    OzFrames *frames = NULL;
    OzGrains grains;
    OzSnapshot read;
    char path[] = "/tmp/orzo-break-XXXXXX";
    int purpose = 0, file = mkstemp(path);
    bool more = false;
    assert_true(file >= 0);
    close(file);
    rig_open(&rig, thrown, "gear4", "double", "field", 1);
    OzSnapshot whole = state_after(&rig, NATIVE, 0), now = state_after(&rig, NATIVE, STEPS);
    must(oz_frames_create(&frames, path, &rig.scene, &rig.grains));
    must(oz_frames_add(frames, &now, OZ_FRAME_EXPORT));
    must(oz_frames_add(frames, &whole, OZ_FRAME_MOVIE));
    must(oz_frames_finish(frames));
    must(oz_frame_reader_open(&frames, path, &grains));
    must(oz_snapshot_create(&read, &rig.scene, &grains));
    must(oz_frame_reader_next(frames, &read, &purpose, &more));
    assert_true(more);
    assert_same_wear(&now, &read);
    assert_int_equal(read.contacts.count, now.contacts.count);
    assert_int_equal(read.grains->elements->outline_count, now.grains->elements->outline_count);
    assert_true(now.grains->elements->outline_count > rig.grains.elements->outline_count);
    assert_true(farthest(read.position, now.position, 3 * now.count) < 1e-8);
    must(oz_frame_reader_next(frames, &read, &purpose, &more));
    assert_int_equal(read.count, rig.grains.count);
    must(oz_frames_finish(frames));
    oz_snapshot_free(&read);
    oz_snapshot_free(&whole);
    oz_snapshot_free(&now);
    oz_grains_free(&grains);
    rig_close(&rig);
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reference),
        cmocka_unit_test(test_same_bits),
        cmocka_unit_test(test_float),
        cmocka_unit_test(test_frames),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
