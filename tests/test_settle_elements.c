/* Settling of trigrains: when it ends, who waits for whom, and what it leaves behind.
 * ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "base/log.h"
#include "report/rehearsal.h"
#include "sim/read_snapshot.h"
#include "sim/settle.h"
#include "sim/sim.h"

#include <unistd.h>

/* A die and a disc that fall into a vessel which would shake; switched as test_element_device's
 * heap, so that one program serves both. */
static const char *const drop =
    "model: trigrains\n"
    "gravity: [0, -10]\n"
    "time: {step: 2e-6, duration: 1}\n"
    "integrator: gear4\n"
    "contact: {law: hertz, hertz_stiffness: 1e5, normal_damping_rate: 500, "
    "tangential_damping_rate: 500, friction: 0.5}\n"
    "grains:\n"
    "  - {kind: single, shape: square, edge: 2e-3, position: [-2e-3, %g], angle: 10}\n"
    "  - {kind: single, shape: disc, radius: 1e-3, density: 4, position: [2e-3, %g]}\n"
    "walls:\n"
    "  - {kind: vessel, point: [0, 0], width: 2e-2, height: 6e-2, motion: {frequency: 30, "
    "acceleration_ratio: 0.1}}\n"
    "observe: {ledger: true, interval: 1e-3}\n"
    "settle: %s\n";

enum { JUDGED_EVERY = 512 }; /* steps, of trigrains */

/* Before the first look at it, after 1 ms, the energy of a fall is below the threshold; later, at
 * the 0.03 m/s that drag leaves, it is four times as large. */
#define REST "{drag: 300, threshold: 5e-3, rest_time: 0, time_max: 1}"
static const double step = 2e-6, threshold = 5e-3;

#define LOW  3e-3 /* m */
#define HIGH 6e-3

static char log_path[] = "/tmp/orzo-settle-XXXXXX";

static void open_drop(Rig *rig, double height, const char *settle)
{
    rig_open(rig, drop, height, height, settle);
}

static OzSim *start_drive(const OzMember *members, int count)
{
    OzSim *sim = NULL;
    must(oz_sim_create(&sim, &rig_device, members, count, NULL));
    return sim;
}

static OzSim *start_alone(const Rig *rig)
{
    OzMember member = {&rig->scene, &rig->grains};
    return start_drive(&member, 1);
}

/* The caller frees the snapshot. */
static OzSnapshot look(OzSim *sim, int member, const Rig *rig)
{
    OzSnapshot now;
    must(oz_snapshot_create(&now, &rig->scene, &rig->grains));
    must(oz_read_snapshot_snapshot(sim, member, &now, true));
    return now;
}

/* Kinetic energy of all elements over the sum of m g d. */
static double energy_ratio(const OzSnapshot *s)
{
    const OzElements *elements = s->grains->elements;
    double energy = 0, scale = 0;
    for (int64_t i = 0; i < elements->free_count; i++) {
        const double *v = &s->element_velocity[2 * i], w = s->element_angular_velocity[i];
        energy +=
            0.5 * (elements->mass[i] * (v[0] * v[0] + v[1] * v[1]) + elements->inertia[i] * w * w);
    }
    for (int64_t g = 0; g < s->grains->count; g++) {
        scale += s->grains->mass[g] * 10 * s->grains->diameter[g];
    }
    return energy / scale;
}

/* What a watch saw. It says no once it has been told so often, if that is not 0. */
typedef struct Watched {
    int judged, patience;
    double time, ratio; /* when the energy was last looked at, and what it was */
} Watched;

static OzStatus watch(void *context, double time, double ratio)
{
    Watched *w = context;
    if (ratio > 0) {
        w->judged++;
        w->time = time;
        w->ratio = ratio;
    }
    return w->judged == w->patience && w->patience > 0 ? OZ_ERR_INTERRUPTED : OZ_OK;
}

static void assert_close(const char *what, double gap, double tolerance)
{
    if (!(gap <= tolerance)) {
        fail_msg("%s off by %g, more than %g", what, gap, tolerance);
    }
}

static void assert_nothing_counted(const OzSim *sim)
{
    static const OzSimCounts none;
    OzSimCounts counts = oz_sim_counts(sim);
    assert_memory_equal(&counts, &none, sizeof none);
    assert_int_equal(oz_sim_step(sim), 0);
}

/* Whether the log says that settling was cut short after so long. */
static bool is_logged(const char *text)
{
    char line[256];
    bool found = false;
    FILE *file = fopen(log_path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        found |= strstr(line, text) != NULL;
    }
    fclose(file);
    return found;
}

/* This thread's lines go to log_path. */
static OzLog *begin_log(void)
{
    OzLog *log = NULL;
    must(oz_log_create(&log, NULL, false));
    must(oz_log_open(log, log_path));
    oz_log_use(log);
    return log;
}

static void end_log(OzLog *log)
{
    oz_log_use(NULL);
    oz_log_free(log);
}

/* Lying on the bottom: settled when the energy says so and not before, and then at time 0. */
static void test_comes_to_rest(void **state)
{
    (void)state;
    Rig rig;
    Watched seen = {0};
    double seconds = 0;
    open_drop(&rig, LOW, REST);
    OzSim *sim = start_alone(&rig);
    OzLog *log = begin_log();
    must(oz_settle_run(sim, &seconds, watch, &seen));
    end_log(log);
    assert_false(is_logged("still"));
    assert_true(seen.ratio < threshold);
    assert_close("looks at the energy", fabs(seen.time - seen.judged * JUDGED_EVERY * step), 1e-12);
    assert_close("time", fabs(seconds - seen.time), 1e-12);
    assert_nothing_counted(sim);
    OzSnapshot now = look(sim, 0, &rig);
    static const OzElementLedger none;
    assert_true(now.step == 0 && now.time == 0 && now.has_ledger);
    assert_memory_equal(&now.element_ledger, &none, sizeof none);
    /* the test's sum in another order */
    assert_close("ratio", fabs(energy_ratio(&now) / seen.ratio - 1), 1e-12);
    /* the disc, of radius 1e-3, and the die, turned or flat, less than a last small hop above the
     * bottom, from a start 2e-3 above it */
    assert_true(fabs(now.position[4] - 1e-3) < 1e-4);
    assert_true(now.position[1] < sqrt(2) * 1e-3 + 1e-4);
    must(oz_sim_advance(sim, 100));
    OzSnapshot later = look(sim, 0, &rig);
    assert_true(later.position[1] != now.position[1]); /* it waits no longer */
    oz_snapshot_free(&later);
    oz_snapshot_free(&now);
    oz_sim_free(sim);
    rig_close(&rig);
}

/* Cut short in mid-air, and told so; then grains fall without drag beside walls that move. */
static void test_time_max_ends_it(void **state)
{
    enum { STEPS = 5000 };
    (void)state;
    Rig rig;
    double seconds = 0, fall = STEPS * step;
    open_drop(&rig, 0.05, "{drag: 500, threshold: 1e-6, rest_time: 1e-3, time_max: 4e-3}");
    OzSim *sim = start_alone(&rig);
    OzLog *log = begin_log();
    must(oz_settle_run(sim, &seconds, NULL, NULL));
    end_log(log);
    assert_true(is_logged("N m g d after 0.004 s (threshold 1e-06)"));
    assert_close("time", fabs(seconds - 5e-3), 1e-12);
    assert_nothing_counted(sim);
    OzSnapshot start = look(sim, 0, &rig);
    must(oz_sim_advance(sim, STEPS));
    OzSnapshot now = look(sim, 0, &rig);
    int64_t floor = 2 * start.grains->elements->free_count + 1;
    /* Drag leaves of g / drag all but e^-2, rest adds g times 1e-3 s; that drag ends at once is an
     * error of about the speed of a step, 2e-5 m/s. */
    assert_close("speed", fabs(start.velocity[1] + 0.02 * (1 - exp(-2)) + 0.01), 1e-4);
    assert_close("speed", fabs(now.velocity[1] - start.velocity[1] + 10 * fall), 1e-4);
    assert_true(start.element_position[floor] == rig.grains.elements->position[floor]);
    assert_true(now.element_position[floor] != start.element_position[floor]);
    assert_int_equal(oz_sim_counts(sim).steps, STEPS);
    oz_snapshot_free(&start);
    oz_snapshot_free(&now);
    oz_sim_free(sim);
    rig_close(&rig);
}

static void assert_same_elements(OzSim *a, int member_a, OzSim *b, int member_b, const Rig *rig)
{
    OzSnapshot one = look(a, member_a, rig), other = look(b, member_b, rig);
    size_t count = (size_t)one.element_count * sizeof(double);
    assert_true(one.step == other.step);
    assert_memory_equal(one.element_position, other.element_position, 2 * count);
    assert_memory_equal(one.element_velocity, other.element_velocity, 2 * count);
    assert_memory_equal(one.element_angle, other.element_angle, count);
    assert_memory_equal(one.element_angular_velocity, other.element_angular_velocity, count);
    oz_snapshot_free(&one);
    oz_snapshot_free(&other);
}

/* Who has come to rest waits for who has farther to fall: each settles as it does alone. */
static void test_members_wait(void **state)
{
    static const double heights[] = {LOW, HIGH};
    (void)state;
    Rig rigs[2];
    OzMember members[2];
    OzSim *alone[2];
    double seconds[2], together = 0;
    for (int m = 0; m < 2; m++) {
        open_drop(&rigs[m], heights[m], REST);
        members[m] = (OzMember){&rigs[m].scene, &rigs[m].grains};
        alone[m] = start_alone(&rigs[m]);
        must(oz_settle_run(alone[m], &seconds[m], NULL, NULL));
    }
    OzSim *both = start_drive(members, 2);
    must(oz_settle_run(both, &together, NULL, NULL));
    assert_true(seconds[0] + 2 * JUDGED_EVERY * step < seconds[1]);
    assert_true(together == seconds[1]);
    for (int m = 0; m < 2; m++) {
        assert_same_elements(both, m, alone[m], 0, &rigs[m]);
    }
    must(oz_sim_advance(both, 700));
    for (int m = 0; m < 2; m++) {
        must(oz_sim_advance(alone[m], 700));
        assert_same_elements(both, m, alone[m], 0, &rigs[m]);
        oz_sim_free(alone[m]);
    }
    oz_sim_free(both);
    for (int m = 0; m < 2; m++) {
        rig_close(&rigs[m]);
    }
}

static void test_watch_ends_it(void **state)
{
    (void)state;
    Rig rig;
    Watched seen = {.patience = 3};
    double seconds = 0;
    open_drop(&rig, LOW, REST);
    OzSim *sim = start_alone(&rig);
    assert_int_equal(oz_settle_run(sim, &seconds, watch, &seen), OZ_ERR_INTERRUPTED);
    assert_int_equal(seen.judged, 3);
    assert_int_equal(oz_sim_step(sim), 3 * JUDGED_EVERY);
    oz_sim_free(sim);
    rig_close(&rig);
}

static void test_without_settle(void **state)
{
    (void)state;
    Rig rig;
    double seconds = 1;
    open_drop(&rig, LOW, "false");
    OzSim *sim = start_alone(&rig);
    must(oz_settle_run(sim, &seconds, NULL, NULL));
    OzSnapshot now = look(sim, 0, &rig);
    assert_true(seconds == 0);
    assert_memory_equal(now.element_position, rig.grains.elements->position,
                        2 * (size_t)rig.grains.elements->free_count * sizeof(double));
    oz_snapshot_free(&now);
    oz_sim_free(sim);
    rig_close(&rig);
}

/* Without grains there is nothing to wait for: walls move from the start. */
static void test_no_grains(void **state)
{
    (void)state;
    Rig rig;
    double seconds = 1;
    rig_open(&rig, "model: trigrains\n"
                   "time: {step: 1e-5, duration: 1}\n"
                   "grains:\n"
                   "  - {kind: random, count: 0, shape: square, edge: 1e-3}\n"
                   "walls:\n"
                   "  - {kind: drum, diameter: 2e-2, motion: {angular_velocity: 1}}\n"
                   "settle: {drag: 20}\n");
    OzSim *sim = start_alone(&rig);
    must(oz_settle_run(sim, &seconds, NULL, NULL));
    assert_true(seconds == 0);
    must(oz_sim_advance(sim, 1000));
    OzSnapshot now = look(sim, 0, &rig);
    const OzElements *elements = rig.grains.elements;
    assert_true(now.element_position[0] != elements->position[0]);
    oz_snapshot_free(&now);
    oz_sim_free(sim);
    rig_close(&rig);
}

/* In the first launch drivers finish their kernels, which takes seconds. A launch begins with 16
 * steps, so that of 20 at most 4 are timed. */
static void test_rehearsal_leaves_out_the_first_launch(void **state)
{
    (void)state;
    Rig rig;
    OzRehearsal rehearsal;
    open_drop(&rig, HIGH, REST);
    rig.scene.settle.present = false;
    rig.scene.duration = 20 * step;
    must(oz_rehearsal_run(&rehearsal, &rig.scene, &rig.grains, &rig_device, NULL, 0, 1e-9));
    assert_in_range(rehearsal.steps, 1, 4);
    oz_rehearsal_free(&rehearsal);
    rig_close(&rig);
}

static int open_all(void **state)
{
    int file = mkstemp(log_path);
    return file < 0 || close(file) ? -1 : open_rig_device(state);
}

static int close_all(void **state)
{
    remove(log_path);
    return close_rig_device(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_comes_to_rest),
        cmocka_unit_test(test_time_max_ends_it),
        cmocka_unit_test(test_members_wait),
        cmocka_unit_test(test_watch_ends_it),
        cmocka_unit_test(test_without_settle),
        cmocka_unit_test(test_no_grains),
        cmocka_unit_test(test_rehearsal_leaves_out_the_first_launch),
    };
    return cmocka_run_group_tests(tests, open_all, close_all);
}
