/* Kernels against the host reference, which runs the same physics headers; the energy ledger; the
 * guards. ORZO_NEEDS_DEVICE. Each pair of features and precision is a program of its own, which
 * takes seconds to compile: tests share them. */
#include "device_rig.h"

#include "sim/settle.h"

enum { STEPS = 400 };

/* A crowd thrown about in a shaken cylinder: precision, step, other keys, populations. */
static const char overlap_grid[] =
    "model: rods\n"
    "precision: %s\n"
    "time: {step: %g, duration: 1}\n"
    "gravity: [0.3, 0, -9.81]\n"
    "%s\n"
    "grains:\n%s\n"
    "walls:\n"
    "  - {kind: plane, motion: {frequency: 300, amplitude: 1e-4}}\n"
    "  - {kind: cylinder, diameter: 6e-3, contact: {restitution: 0.6}}\n"
    "  - {kind: plane, point: [0, 0, 0.011], normal: [0.1, 0, -1]}\n";

#define RODS    "  - {kind: random, count: 61, diameter: 0.5e-3, aspect: 3, fill: 0.2}"
#define SPHERES "  - {kind: random, count: %d, diameter: 0.8e-3, fill: 0.2}"
#define MIXTURE                                                                                    \
    "  - {kind: random, count: 20, diameter: 0.6e-3, fill: 0.2}\n"                                 \
    "  - {kind: random, count: 20, diameter: 0.5e-3, aspect: 3, fill: 0.2}\n"                      \
    "  - {kind: random, count: 21, diameter: [0.4e-3, 0.8e-3], aspect: [0.5, 3], fill: 0.2}"
#define CONTACT "contact: {contact_time: 3e-4, restitution: 0.5, "

/* The paper's choices, the opposite ones, and every integrator. */
#define PAPER                                                                                      \
    "observe: {ledger: true}\nintegrator: euler\ngyroscopic: false\n" CONTACT                      \
    "friction: 0.2, contact_point: surfaces}"
#define OTHER  "observe: {ledger: true}\n" CONTACT "friction: 0.4, slip: scale, attraction: clamp}"
#define VERLET "observe: {ledger: true}\nintegrator: velocity-verlet\n" CONTACT "friction: 0.4}"
#define SMOOTH CONTACT "friction: 0}"

static void assert_close(double a, double b, double part)
{
    if (!(fabs(a - b) <= part * fmax(fabs(a), fabs(b)))) {
        fail_msg("%.17g is not %.17g within %g of it", a, b, part);
    }
}

/* What hits make of the rounding of one step: positions in m, velocities in m/s and axes. */
typedef struct Tolerance {
    double position, others;
} Tolerance;

/* A unit in the last place is 1e-16 of a velocity or an axis and 1e-18 m of a place; some hits
 * later differences are a thousand times larger. A wrong term shows in the first digits. */
static const Tolerance in_double = {1e-12, 1e-9};

/* Places are kept to 1e-10 m, velocities to 3e-8: the same factor of growth. */
static const Tolerance in_float = {2e-6, 3e-3};

static void assert_states_close(const OzSnapshot *a, const OzSnapshot *b, Tolerance tolerance)
{
    int64_t n = 3 * a->count;
    double place = farthest(a->position, b->position, n);
    double velocity = farthest(a->velocity, b->velocity, n), axis = farthest(a->axis, b->axis, n);
    if (!(place < tolerance.position && velocity < tolerance.others && axis < tolerance.others)) {
        fail_msg("device and reference differ by %g m, %g m/s, axes by %g", place, velocity, axis);
    }
}

static void assert_contacts_close(const OzSnapshot *a, const OzSnapshot *b)
{
    assert_int_equal(oz_contact_list_sum(&a->contacts).pairs,
                     oz_contact_list_sum(&b->contacts).pairs);
    assert_int_equal(oz_contact_list_sum(&a->contacts).walls,
                     oz_contact_list_sum(&b->contacts).walls);
    assert_close(oz_contact_list_sum(&a->contacts).overlap_max,
                 oz_contact_list_sum(&b->contacts).overlap_max, 1e-6);
    assert_close(oz_contact_list_sum(&a->contacts).overlap_sum,
                 oz_contact_list_sum(&b->contacts).overlap_sum, 1e-6);
}

static void assert_ledgers_close(const OzSnapshot *a, const OzSnapshot *b, double part)
{
    assert_int_equal(a->has_ledger, b->has_ledger);
    if (a->has_ledger) {
        assert_close(a->ledger.elastic, b->ledger.elastic, part);
        assert_close(a->ledger.dissipated, b->ledger.dissipated, part);
        assert_close(a->ledger.friction, b->ledger.friction, part);
        assert_close(a->ledger.work_walls, b->ledger.work_walls, part);
    }
}

/* Runs the crowd on both and compares. */
static void check_crowd(const char *precision, const char *keys, const char *grains, Shape shape)
{
    Rig rig;
    bool wide = precision[0] == 'd';
    rig_open(&rig, overlap_grid, precision, 1e-5, keys, grains);
    throw_grains(&rig.grains, 0.4, 200);
    OzSnapshot seen = state_after(&rig, shape, STEPS);
    rig_start(&rig);
    rig_advance(&rig, STEPS);
    assert_true(seen.has_contacts && seen.contacts.count > 5);
    assert_states_close(&seen, &rig.now, wide ? in_double : in_float);
    if (wide) { /* in float a contact may begin or end a step apart */
        assert_contacts_close(&seen, &rig.now);
    }
    assert_ledgers_close(&seen, &rig.now, wide ? 1e-6 : 1e-2);
    oz_snapshot_free(&seen);
    rig_close(&rig);
}

static void test_equal_rods_as_in_the_paper(void **state)
{
    (void)state;
    check_crowd("double", PAPER, RODS, NATIVE);
    check_crowd("float", PAPER, RODS, NATIVE);
}

static void test_mixture_with_the_other_choices(void **state)
{
    (void)state;
    check_crowd("double", OTHER, MIXTURE, NATIVE);
    check_crowd("float", OTHER, MIXTURE, NATIVE);
}

static void test_mixture_by_verlet(void **state)
{
    (void)state;
    check_crowd("double", VERLET, MIXTURE, NATIVE);
}

static void test_one_lane(void **state)
{
    (void)state;
    check_crowd("double", VERLET, MIXTURE, SCALAR);
}

/* No grain (which takes the kernels of rods), one, a whole block of lanes, and one more. */
static void test_few_spheres(void **state)
{
    (void)state;
    static const int counts[] = {0, 1, 16, 17, 61};
    char grains[128];
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        Rig rig;
        snprintf(grains, sizeof grains, SPHERES, counts[k]);
        rig_open(&rig, overlap_grid, "double", 1e-5, counts[k] > 0 ? SMOOTH : PAPER, grains);
        throw_grains(&rig.grains, 0.4, 0);
        OzSnapshot seen = state_after(&rig, NATIVE, STEPS);
        rig_start(&rig);
        rig_advance(&rig, STEPS);
        assert_int_equal(seen.count, counts[k]);
        assert_int_equal(seen.step, STEPS);
        assert_states_close(&seen, &rig.now, in_double);
        assert_contacts_close(&seen, &rig.now);
        oz_snapshot_free(&seen);
        rig_close(&rig);
    }
}

/* Work-items that share a launch add in the same order as one alone. */
static void test_work_items_give_the_same_bits(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, overlap_grid, "double", 1e-5, VERLET, MIXTURE);
    throw_grains(&rig.grains, 0.4, 200);
    OzSnapshot one = state_after(&rig, SCALAR, STEPS), many = state_after(&rig, GROUP, STEPS);
    assert_same_bits(&one, &many);
    oz_snapshot_free(&one);
    oz_snapshot_free(&many);
    rig_close(&rig);
}

/* Residual of the ledger over the energy put in, from the start to a time. */
static double residual(const char *keys, const char *grains, double step, double time)
{
    Rig rig;
    rig_open(&rig, overlap_grid, "double", step, keys, grains);
    throw_grains(&rig.grains, 0.4, 200);
    OzSnapshot start = state_after(&rig, NATIVE, 0);
    OzSnapshot end = state_after(&rig, NATIVE, llround(time / step));
    const OzLedger *ledger = &end.ledger;
    double gained = mechanical_energy(&end) - mechanical_energy(&start) + ledger->elastic;
    double lost = ledger->dissipated + ledger->friction;
    double put_in = fabs(ledger->work_walls) + lost;
    assert_true(start.has_ledger && start.ledger.elastic == 0 && start.ledger.friction == 0);
    assert_true(ledger->dissipated > 0 && ledger->friction > 0 && ledger->work_walls != 0);
    double share = (gained + lost - ledger->work_walls) / put_in;
    oz_snapshot_free(&start);
    oz_snapshot_free(&end);
    rig_close(&rig);
    return share;
}

static void test_ledger_closes(void **state)
{
    (void)state;
    double other = residual(OTHER, MIXTURE, 1e-5, 0.02);
    double verlet = residual(VERLET, MIXTURE, 1e-5, 0.02);
    print_message("residual: symplectic-euler %.4f, velocity-verlet %.5f\n", other, verlet);
    /* a hundredth is what users are promised; 0.002 at 30 steps a contact */
    assert_true(fabs(other) < 0.005);
    assert_true(fabs(verlet) < 0.005);
}

static void test_ledger_of_euler_shrinks_with_the_step(void **state)
{
    (void)state;
    double coarse = residual(PAPER, RODS, 1e-5, 4e-3), fine = residual(PAPER, RODS, 2.5e-6, 4e-3);
    print_message("residual: euler %.4f, a quarter of the step %.4f\n", coarse, fine);
    assert_close(coarse / fine, 4, 0.25);
}

/* A settled bed starts with nothing added up, although its springs are loaded. */
static void test_ledger_starts_after_settling(void **state)
{
    (void)state;
    Rig rig;
    double seconds;
    rig_open(&rig, overlap_grid, "double", 1e-5, OTHER "\nsettle: {drag: 70, time_max: 0.1}",
             MIXTURE);
    OzSim *sim = start_sim(&rig, &rig_device);
    must(oz_settle_run(sim, &seconds, NULL, NULL));
    /* the default of settle.rest_time, which comes after the drag */
    assert_true(seconds >= 0.2);
    OzSnapshot start = state_at(&rig, sim, 0);
    assert_true(oz_contact_list_sum(&start.contacts).pairs > 30 && start.ledger.elastic > 0);
    assert_true(start.ledger.dissipated == 0 && start.ledger.work_walls == 0);
    assert_close(start.ledger.friction + start.ledger.elastic, start.ledger.elastic, 1e-12);
    oz_snapshot_free(&start);
    oz_sim_free(sim);
    rig_close(&rig);
}

/* Advances a few steps and expects a guard to say this of grain 3. */
static void expect_guard(Rig *rig, const char *reason)
{
    OzSim *sim = start_sim(rig, &rig_device);
    OzStatus status = oz_sim_advance(sim, 50);
    assert_int_equal(status, OZ_ERR_BLOWUP);
    const char *text = oz_status_text();
    if (!strstr(text, reason) || !strstr(text, "grain 3:") ||
        !strstr(text, "step 1, time 1e-05 s")) {
        fail_msg("\"%s\" does not say that grain 3 stopped in step 1: %s", text, reason);
    }
    assert_int_equal(oz_sim_step(sim), 1);
    oz_sim_free(sim);
    rig_close(rig);
}

static void open_guarded(Rig *rig)
{
    rig_open(rig, overlap_grid, "float", 1e-5, PAPER, RODS);
}

static void test_guards_name_grain_step_and_time(void **state)
{
    (void)state;
    Rig rig;
    open_guarded(&rig);
    rig.grains.velocity[3 * 3 + 1] = NAN;
    expect_guard(&rig, "not a number");
    open_guarded(&rig);
    rig.grains.velocity[3 * 3 + 1] = 60;
    expect_guard(&rig, "more than half its radius in one step");
    open_guarded(&rig);
    rig.grains.position[3 * 3 + 2] = -0.05;
    expect_guard(&rig, "left its container");
    open_guarded(&rig);
    for (int c = 0; c < 3; c++) {
        rig.grains.position[3 * 3 + c] = rig.grains.position[3 * 9 + c];
    }
    expect_guard(&rig, "overlaps another body");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equal_rods_as_in_the_paper),
        cmocka_unit_test(test_mixture_with_the_other_choices),
        cmocka_unit_test(test_mixture_by_verlet),
        cmocka_unit_test(test_one_lane),
        cmocka_unit_test(test_few_spheres),
        cmocka_unit_test(test_work_items_give_the_same_bits),
        cmocka_unit_test(test_ledger_closes),
        cmocka_unit_test(test_ledger_of_euler_shrinks_with_the_step),
        cmocka_unit_test(test_ledger_starts_after_settling),
        cmocka_unit_test(test_guards_name_grain_step_and_time),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
