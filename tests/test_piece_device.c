/* Trigrains on the device: against the host reference, the same bits however the work is cut up,
 * guards. */
#include "device_rig.h"

#include "compute/drive.h"
#include "compute/piece_private.h"
#include "compute/piece_reference.h"

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
    must(oz_place_grains(&s->grains, &s->scene));
}

static void close_scene(Scene *s)
{
    oz_grains_free(&s->grains);
    oz_scene_free(&s->scene);
}

static OzSnapshot run_device(const Scene *s, const OzDevice *device, int64_t step)
{
    OzDrive *drive = NULL;
    OzSnapshot now;
    OzMember member = {&s->scene, &s->grains};
    must(oz_drive_create(&drive, device, &member, 1, NULL));
    must(oz_drive_advance(drive, step));
    must(oz_snapshot_create(&now, &s->scene, &s->grains));
    must(oz_drive_capture(drive, 0, &now, true));
    oz_drive_free(drive);
    return now;
}

static OzSnapshot run_reference(const Scene *s, int64_t step)
{
    OzPieceReference *reference = NULL;
    OzSnapshot now;
    must(oz_piece_reference_create(&reference, &s->scene, &s->grains));
    must(oz_piece_reference_advance(reference, step));
    must(oz_snapshot_create(&now, &s->scene, &s->grains));
    must(oz_piece_reference_snapshot(reference, &now));
    oz_piece_reference_free(reference);
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

/* Rounding differs in the last digit of every sum and grows with the steps; contacts of stiff
 * pieces make it grow faster than the square root of their number. 1e-11 of a grain's size and
 * speed (1e-3 m, 1 m/s) is a thousand times what was seen, a millionth of what a wrong term of any
 * force gives. */
static void assert_same_state(const OzSnapshot *a, const OzSnapshot *b)
{
    int64_t count = a->piece_count;
    assert_close("positions", largest_gap(a->piece_position, b->piece_position, 2 * count), 1e-13);
    assert_close("angles", largest_gap(a->piece_angle, b->piece_angle, count), 1e-11);
    assert_close("velocities", largest_gap(a->piece_velocity, b->piece_velocity, 2 * count), 1e-11);
    assert_close("spins", largest_gap(a->piece_spin, b->piece_spin, count), 1e-8);
    assert_memory_equal(a->pieces.touches, b->pieces.touches, sizeof a->pieces.touches);
}

static void assert_same_ledger(const OzPieceLedger *a, const OzPieceLedger *b, double scale)
{
    assert_close("axial losses", fabs(a->beam_axial - b->beam_axial), 1e-9 * scale);
    assert_close("bending losses", fabs(a->beam_bending - b->beam_bending), 1e-9 * scale);
    assert_close("disc damping", fabs(a->disc_damping - b->disc_damping), 1e-9 * scale);
    assert_close("disc friction", fabs(a->disc_friction - b->disc_friction), 1e-9 * scale);
    assert_close("walls' work", fabs(a->work_walls - b->work_walls), 1e-9 * scale);
}

static void compare_with_reference(const Scene *s, int64_t step)
{
    OzSnapshot device = run_device(s, &rig_device, step), host = run_reference(s, step);
    int64_t touches = 0;
    for (int k = 0; k < OZ_TOUCH_KINDS; k++) {
        touches += host.pieces.touches[k];
    }
    assert_true(touches > 0);
    assert_same_state(&device, &host);
    assert_same_ledger(&device.piece_ledger, &host.piece_ledger, 1e-5);
    oz_snapshot_free(&device);
    oz_snapshot_free(&host);
}

static void test_two_dice(void **state)
{
    static const char *const integrators[] = {"gear4", "velocity-verlet"};
    (void)state;
    for (int k = 0; k < 2; k++) {
        Scene s;
        open_scene(&s, two_dice, 1e-6, integrators[k]);
        compare_with_reference(&s, 400);
        close_scene(&s);
    }
}

static void test_heap(void **state)
{
    (void)state;
    Scene s;
    open_scene(&s, heap, "gear4", 20);
    compare_with_reference(&s, 14000);
    close_scene(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two_dice),
        cmocka_unit_test(test_heap),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
