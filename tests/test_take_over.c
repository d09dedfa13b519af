/* Scenes that take over from a running one, against closed forms and against runs that need no
 * change. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "model/motion.h"
#include "sim/take_over.h"

/* The shaken bed of test_state, whose kernels these are: integrator, precision, further keys. */
static const char bed[] =
    "model: rods\n"
    "integrator: %s\n"
    "precision: %s\n"
    "gravity: [0, 0, -100]\n"
    "time: {step: 1e-5, duration: 1.2e-2}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4}\n"
    "grains:\n"
    "  - {kind: random, count: 20, diameter: 0.6e-3}\n"
    "  - {kind: random, count: 20, diameter: 0.5e-3, aspect: 3}\n"
    "  - {kind: random, count: 21, diameter: [0.3e-3, 1e-3], aspect: [0.5, 3]}\n"
    "walls:\n"
    "  - {kind: plane, motion: {frequency: 250, acceleration_ratio: %g}}\n"
    "  - {kind: cylinder, diameter: 5e-3}\n";

static const char flat[] =
    "model: trigrains\n"
    "time: {step: %g, duration: 4.8e-3}\n"
    "gravity: [20, -200]\n"
    "integrator: gear4\n"
    "precision: %s\n"
    "grains: [{kind: random, count: 12, shape: polygon, corners: [3, 5], radius: [1e-3, 2e-3]}]\n"
    "walls:\n"
    "  - {kind: vessel, width: 15e-3, height: 3e-2, motion: {frequency: 500, "
    "acceleration_ratio: 1}}\n"
    "observe: {ledger: true}\n";

/* How the scene is taken over in mid-run. */
typedef enum How { NOT, APPLY, REBUILD } How;

/* Gives the rig's simulation the scene of `next`, whose motions go on. */
static void take(OzSim **sim, const Rig *now, Rig *next, How how)
{
    OzSim *built = NULL;
    const OzScene *scenes[] = {&next->scene};
    oz_motion_take_over(&next->scene, &now->scene, oz_sim_time(*sim));
    if (how == APPLY) {
        must(oz_take_over_apply(*sim, scenes));
    } else if (how == REBUILD) {
        must(oz_take_over_build(&built, *sim, &rig_device, scenes, NULL));
        must(oz_take_over_swap(built, *sim, scenes));
        oz_sim_free(*sim);
        *sim = built;
    }
}

/* The state at `last` of a run whose scene is taken over, in that way, at `step`. */
static OzSnapshot run_over(Rig *now, Rig *next, How how, int64_t step, int64_t last)
{
    OzSim *sim = start_sim(now, &rig_device);
    must(oz_sim_advance(sim, step));
    take(&sim, now, next, how);
    OzSnapshot end = state_at(how == NOT ? now : next, sim, last);
    oz_sim_free(sim);
    return end;
}

static void open_kind(Rig *rig, int kind)
{
    if (kind < 4) {
        rig_open(rig, bed, kind % 2 ? "velocity-verlet" : "euler", kind / 2 ? "double" : "float",
                 4.0);
        throw_grains(&rig->grains, 0.3, 50);
    } else {
        rig_open(rig, flat, 4e-6, kind == 4 ? "float" : "double");
    }
}

/* Lists are made anew and springs carried over; nothing else may happen. 733 is no multiple of
 * anything that lists go by. */
static void test_change_of_nothing(void **state)
{
    (void)state;
    for (int kind = 0; kind < 6; kind++) {
        Rig now, next;
        open_kind(&now, kind);
        open_kind(&next, kind);
        OzSnapshot straight = run_over(&now, &next, NOT, 733, 1500);
        for (How how = APPLY; how <= REBUILD; how++) {
            OzSnapshot over = run_over(&now, &next, how, 733, 1500);
            assert_same_bits(&straight, &over);
            oz_snapshot_free(&over);
        }
        oz_snapshot_free(&straight);
        rig_close(&now);
        rig_close(&next);
    }
}

/* Springs are there to be lost: without them the bed ends elsewhere. */
static void test_springs_matter(void **state)
{
    (void)state;
    Rig now, other;
    open_kind(&now, 0);
    open_kind(&other, 0);
    other.scene.contact.friction = 0.1;
    OzSnapshot straight = run_over(&now, &other, NOT, 733, 1500);
    OzSnapshot over = run_over(&now, &other, APPLY, 733, 1500);
    assert_true(straight.contacts.count > 0);
    assert_memory_not_equal(straight.position, over.position,
                            3 * (size_t)over.count * sizeof(double));
    oz_snapshot_free(&straight);
    oz_snapshot_free(&over);
    rig_close(&now);
    rig_close(&other);
}

/* A floor that changes on the way is the floor that was written so from the start, to the bit. */
static void test_floor_as_given(void **state)
{
    (void)state;
    for (int kind = 0; kind < 2; kind++) {
        Rig now, next, given;
        const char *precision = kind ? "double" : "float";
        rig_open(&now, bed, "euler", precision, 4.0);
        rig_open(&next, bed, "euler", precision, 9.0);
        rig_open(&given, bed, "euler", precision, 9.0);
        oz_motion_take_over(&given.scene, &now.scene, 500 * now.scene.step);
        OzSim *sim = start_sim(&given, &rig_device);
        OzSnapshot expected = state_at(&given, sim, 1500);
        OzSnapshot over = run_over(&now, &next, APPLY, 500, 1500);
        assert_true(oz_motion_since(&next.scene) == 0.006); /* the third half period's end */
        assert_same_bits(&expected, &over);
        oz_snapshot_free(&expected);
        oz_snapshot_free(&over);
        oz_sim_free(sim);
        rig_close(&now);
        rig_close(&next);
        rig_close(&given);
    }
}

static const char ball[] = "model: rods\n"
                           "precision: %s\n"
                           "gravity: [0, 0, %g]\n"
                           "time: {step: %g, duration: 1}\n"
                           "contact: {contact_time: 1e-3, restitution: 0.3, friction: 0}\n"
                           "grains: [{kind: single, diameter: 1e-2, position: [0, 0, 5e-3]}]\n"
                           "walls: [{kind: plane}]\n";

/* A sphere at rest under twice the gravity lies m g / k deep (k = m (pi^2 + ln^2 e) / t^2), and is
 * at rest again. */
static void test_sphere_sinks(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        Rig now, next;
        rig_open(&now, ball, k ? "double" : "float", -10.0, 2e-5);
        rig_open(&next, ball, k ? "double" : "float", -20.0, 2e-5);
        OzSim *sim = start_sim(&now, &rig_device);
        OzSnapshot rest = state_at(&now, sim, 1000);
        double first = oz_contact_list_sum(&rest.contacts).overlap_max;
        oz_snapshot_free(&rest);
        take(&sim, &now, &next, APPLY);
        rest = state_at(&next, sim, 2000);
        double damping = log(0.3), time = 1e-3;
        double depth = 20 * time * time / (acos(-1) * acos(-1) + damping * damping);
        /* 20 contact times of decay at restitution 0.3 leave 0.3^20 of it; the rest is what a float
         * keeps of an overlap, 1e-4 of it here */
        assert_true(fabs(oz_contact_list_sum(&rest.contacts).overlap_max / depth - 1) < 1e-3);
        assert_true(fabs(first / depth - 0.5) < 1e-3);
        oz_snapshot_free(&rest);
        oz_sim_free(sim);
        rig_close(&now);
        rig_close(&next);
    }
}

/* A square in flight, of test_element_device's kernels: integrator, step. */
static const char thrown[] =
    "model: trigrains\n"
    "integrator: %s\n"
    "time: {step: %g, duration: 1}\n"
    "gravity: [3, -20]\n"
    "grains: [{kind: single, shape: square, edge: 2e-3, position: [0, 0.5], velocity: [1, 2]}]\n"
    "walls: [{kind: segment, from: [-1, 0], to: [1, 0]}]\n"
    "observe: {ledger: true}\n";

/* Where a free flight is after so long. */
static void assert_flown(const OzSnapshot *now, double time)
{
    /* Constant acceleration is exact for every integrator; what is left is rounding of 1000 steps,
     * each of 2^-53 of a position of order one. */
    const double rounding = 1e-12;
    assert_true(fabs(now->position[0] - (time + 1.5 * time * time)) < rounding);
    assert_true(fabs(now->position[1] - (0.5 + 2 * time - 10 * time * time)) < rounding);
    assert_true(fabs(now->velocity[1] - (2 - 20 * time)) < 100 * rounding);
}

/* States are counted in powers of the step, five of them or three: a parabola stays one. */
static void test_steps_and_integrators_of_elements(void **state)
{
    (void)state;
    static const struct {
        const char *first, *then;
        How how;
    } rows[] = {{"gear4", "gear4", APPLY},
                {"gear4", "gear4", REBUILD},
                {"gear4", "velocity-verlet", REBUILD},
                {"velocity-verlet", "gear4", REBUILD}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        Rig now, next;
        OzTakeOver asked;
        rig_open(&now, thrown, rows[k].first, 2e-6);
        rig_open(&next, thrown, rows[k].then, 5e-6);
        OzSim *sim = start_sim(&now, &rig_device);
        must(oz_sim_advance(sim, 500));
        must(oz_take_over_compare(&asked, &rig_device, &now.grains, &now.scene, &next.scene));
        assert_int_equal(asked == OZ_TAKE_OVER_REBUILD, strcmp(rows[k].first, rows[k].then) != 0);
        take(&sim, &now, &next, rows[k].how);
        OzSnapshot end = state_at(&next, sim, 1000);
        assert_true(fabs(end.time - 3.5e-3) < 1e-15);
        assert_flown(&end, 3.5e-3);
        oz_snapshot_free(&end);
        oz_sim_free(sim);
        rig_close(&now);
        rig_close(&next);
    }
}

/* Beams in substeps want contacts' loads, which a run without does not keep. */
static void test_state_that_is_not_there(void **state)
{
    (void)state;
    Rig now, next;
    OzTakeOver asked;
    rig_open(&now, thrown, "velocity-verlet", 2e-6);
    rig_open(&next, thrown, "velocity-verlet", 2e-6);
    next.scene.beams.substeps = 4;
    OzSim *sim = start_sim(&now, &rig_device);
    assert_int_equal(
        oz_take_over_compare(&asked, &rig_device, &now.grains, &now.scene, &next.scene),
        OZ_ERR_INPUT);
    assert_string_equal(oz_status_text(),
                        "rig.yaml: it needs slow_load of the grains, which the running scene does "
                        "not keep; expected another run");
    oz_sim_free(sim);
    rig_close(&now);
    rig_close(&next);
}

/* What asks for another program, and what for other numbers alone. */
static void test_what_a_change_asks(void **state)
{
    (void)state;
    Rig now, next;
    OzTakeOver asked;
    rig_open(&now, bed, "euler", "float", 4.0);
    rig_open(&next, bed, "euler", "float", 4.0);
    OzSim *sim = start_sim(&now, &rig_device);
    next.scene.contact.friction = 0.2;
    next.scene.gravity[2] = -120;
    next.scene.step = 2e-5;
    next.scene.walls[0].motion.amplitude *= 2;
    must(oz_take_over_compare(&asked, &rig_device, &now.grains, &now.scene, &next.scene));
    assert_int_equal(asked, OZ_TAKE_OVER_APPLY);
    next.scene.contact.friction = 0;
    must(oz_take_over_compare(&asked, &rig_device, &now.grains, &now.scene, &next.scene));
    assert_int_equal(asked, OZ_TAKE_OVER_APPLY); /* the walls still have friction */
    next.scene.walls[0].contact.friction = next.scene.walls[1].contact.friction = 0;
    must(oz_take_over_compare(&asked, &rig_device, &now.grains, &now.scene, &next.scene));
    assert_int_equal(asked, OZ_TAKE_OVER_REBUILD);
    next.scene.walls[0].contact.friction = 0.4;
    next.scene.contact.parallel = OZ_PARALLEL_LINE;
    must(oz_take_over_compare(&asked, &rig_device, &now.grains, &now.scene, &next.scene));
    assert_int_equal(asked, OZ_TAKE_OVER_REBUILD);
    oz_sim_free(sim);
    rig_close(&now);
    rig_close(&next);
}

/* From verlet to euler and back under another gravity: the first accelerations are made anew, and a
 * sphere in flight feels the new gravity from the first half step on. */
static void test_integrators_of_rods(void **state)
{
    (void)state;
    Rig now, next, back;
    rig_open(&now, bed, "velocity-verlet", "double", 4.0);
    rig_open(&next, bed, "euler", "double", 4.0);
    rig_open(&back, bed, "velocity-verlet", "double", 4.0);
    double *x = now.grains.position, first[3] = {0, 0, 0.1}; /* far above all others */
    memcpy(x, first, sizeof first);
    OzSim *sim = start_sim(&now, &rig_device);
    must(oz_sim_advance(sim, 100));
    take(&sim, &now, &next, REBUILD);
    must(oz_sim_advance(sim, 200));
    back.scene.gravity[2] = -200;
    take(&sim, &next, &back, REBUILD);
    OzSnapshot end = state_at(&back, sim, 300);
    double fallen = 50 * 4e-6 + 0.2 * 1e-3 + 100 * 1e-6;
    /* euler is off by its first order, g dt t / 2 in t = 1e-3 s; velocities by rounding alone */
    assert_true(fabs(end.position[2] - (0.1 - fallen)) < 1.01 * 50 * 1e-5 * 1e-3);
    assert_true(fabs(end.velocity[2] + 0.4) < 1e-12);
    oz_snapshot_free(&end);
    oz_sim_free(sim);
    rig_close(&now);
    rig_close(&next);
    rig_close(&back);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_change_of_nothing),
        cmocka_unit_test(test_springs_matter),
        cmocka_unit_test(test_floor_as_given),
        cmocka_unit_test(test_sphere_sinks),
        cmocka_unit_test(test_steps_and_integrators_of_elements),
        cmocka_unit_test(test_state_that_is_not_there),
        cmocka_unit_test(test_what_a_change_asks),
        cmocka_unit_test(test_integrators_of_rods),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
