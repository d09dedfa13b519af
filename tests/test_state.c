/* A run that is left and taken up again in memory gives the files of one that was not, to the byte:
 * rows, frames and last states, whatever the model, the integrator, the precision and the size. And
 * nothing that is kept for this is superfluous. ORZO_NEEDS_DEVICE. */
#include "state_run.h"
#include "state_scenes.h"

#include "base/memory.h"
#include "sim/branch.h"
#include "sim/settle.h"
#include "sim/sim_private.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* The shaken bed of test_lists, whose kernels these are: integrator, precision, broadphase. */
static const char rods[] =
    "model: rods\n"
    "integrator: %s\nprecision: %s\nbroadphase: %s\ngravity: [0, 0, -100]\n"
    "time: {step: 1e-5, duration: 1.2e-2}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4, rolling_friction: 0.02}\n"
    "grains:\n"
    "  - {kind: random, count: 20, diameter: 0.6e-3}\n"
    "  - {kind: random, count: 20, diameter: 0.5e-3, aspect: 3}\n"
    "  - {kind: random, count: 21, diameter: [0.3e-3, 1e-3], aspect: [0.5, 3]}\n"
    "walls:\n"
    "  - {kind: plane, motion: {frequency: 250, acceleration_ratio: 4}}\n"
    "  - {kind: cylinder, diameter: 5e-3}\n"
    "movie: {fps: 10, length: 2}\n"
    "observe: {ledger: %s, interval_taps: 0.25, samples_per_tap: 8, walls: true}\n"
    "contacts: {interval: 3.1e-4}\n"
    "fields: {cells: [2, 1, 3], width: 1e-3, interval: 2.9e-4, mean_from: 2e-3, vtk: true}\n";

/* Grains of any shape thrown into a shaken vessel, of test_threads: integrator. */
static const char flat[] =
    "model: trigrains\n"
    "time: {step: 4e-6, duration: 4.8e-3}\n"
    "gravity: [20, -200]\n"
    "integrator: %s\n"
    "precision: %s\n"
    "grains: [{kind: random, count: 12, shape: polygon, corners: [3, 5], radius: [1e-3, 2e-3]}]\n"
    "walls:\n"
    "  - {kind: vessel, width: 15e-3, height: 3e-2, motion: {frequency: 500, "
    "acceleration_ratio: 1}}\n"
    "movie: {fps: 10, length: 2}\n"
    "observe: {ledger: true, interval: 2e-4, samples_per_tap: 8, walls: mean}\n"
    "contacts: {}\n";

/* Grains that break against a floor which has just come up, and go on breaking. */
static const char breaking[] =
    "model: trigrains\n"
    "time: {step: 2e-6, duration: 8e-3}\n"
    "gravity: [20, -200]\n"
    "triangles: {overlap: field}\n"
    "beams: {strength: {tension: 8e-3, compression: 0.02, moment: 4e-7, criterion: quadratic}, "
    "yield: {moment: 3e-7}}\n"
    "grains: [{kind: random, count: 12, shape: polygon, corners: [3, 5], radius: [1e-3, 2e-3]}]\n"
    "walls:\n"
    "  - {kind: vessel, width: 15e-3, height: 3e-2, motion: {frequency: 500, "
    "acceleration_ratio: 1}}\n"
    "  - {kind: segment, from: [-7e-3, 3e-4], to: [7e-3, 3e-4]}\n"
    "movie: {fps: 10, length: 2}\n"
    "observe: {ledger: true, interval: 2e-4, walls: mean}\n"
    "contacts: {}\n";

/* A lid that is let down on some grains. */
static const char pressed[] =
    "{model: rods, integrator: %s, precision: %s, broadphase: %s, gravity: [0, 0, -100], "
    "time: {step: 1e-5, duration: 1.2e-2}, movie: {fps: 10, length: 2}, "
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4}, "
    "grains: [{kind: random, count: 40, diameter: 0.6e-3, aspect: 1}], "
    "walls: [{kind: plane}, {kind: cylinder, diameter: 4e-3}, {kind: plane, point: [0, 0, 4e-3], "
    "normal: [0, 0, -1], servo: {pressure: 900, damping: 0.05}}], "
    "observe: {ledger: %s, interval: 1e-3, walls: true}}\n";

typedef struct Case {
    const char *text;
    const char *integrator, *precision, *broadphase, *ledger;
    int members;
    bool large;
} Case;

static const Case cases[] = {
    {rods, "euler", "float", "hash", "false", 2, false},
    {rods, "euler", "float", "sort_axis", "false", 1, false},
    {rods, "euler", "float", "hash", "false", 1, true},
    {rods, "velocity-verlet", "float", "hash", "false", 1, true},
    {rods, "velocity-verlet", "double", "hash", "true", 2, false},
    {rods, "symplectic-euler", "float", "hash", "true", 1, true},
    {sheared, "symplectic-euler", "float", "hash", "true", 1, true},
    {flat, "gear4", "double", "", "", 2, false},
    {flat, "velocity-verlet", "float", "", "", 1, false},
    {drum, "", "", "", "", 1, false},
    {breaking, "", "", "", "", 2, false},
    {pressed, "symplectic-euler", "float", "hash", "true", 2, false},
};
enum { CASES = sizeof cases / sizeof *cases };

static char folder[] = "/tmp/orzo-state-XXXXXX", text[4096];

static void open_case(Run *run, const Case *c, const char *name, bool goes_on)
{
    char path[64];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    snprintf(text, sizeof text, c->text, c->integrator, c->precision, c->broadphase, c->ledger);
    open_run(run, text, c->members, c->large ? &large_device : &rig_device, path, goes_on);
}

static void assert_same_files(const Case *c, const char *a, const char *b)
{
    static const char *const names[] = {"series.csv",   "final.csv",  "frames.bin",
                                        "contacts.csv", "fields.csv", "fields_mean.csv"};
    static const char *const asked[] = {"", "", "movie", "contacts:", "fields:", "fields:"};
    char one[64], other[64];
    snprintf(one, sizeof one, "%s/%s", folder, a);
    snprintf(other, sizeof other, "%s/%s", folder, b);
    for (int k = 0; k < 6 * c->members; k++) {
        if (strstr(c->text, asked[k % 6]) && !same_in_folders(one, other, k / 6, names[k % 6])) {
            fail_msg("case %d, member %d: %s of the runs %s and %s differ", (int)(c - cases), k / 6,
                     names[k % 6], a, b);
        }
    }
}

/* Left between two events, where lists have some age, and at one; what was left goes on a while, so
 * that there are rows and frames to cut off. */
static void check_case(const Case *c)
{
    Run straight, left, resumed;
    OzState state = {0};
    open_case(&straight, c, "straight", false);
    end_run(&straight);
    close_run(&straight);
    open_case(&left, c, "left", false);
    int64_t last = left.worker.schedule.last_step;
    walk_run(&left, last * 5 / 12 + 7);
    save_run(&left, &state);
    walk_run(&left, last * 3 / 4);
    close_run(&left);
    open_case(&resumed, c, "left", true);
    load_run(&resumed, &state);
    oz_state_free(&state);
    walk_run(&resumed, last * 3 / 4);
    look_at_event(&resumed);
    save_run(&resumed, &state);
    close_run(&resumed);
    open_case(&resumed, c, "left", true);
    load_run(&resumed, &state);
    end_run(&resumed);
    close_run(&resumed);
    oz_state_free(&state);
    assert_same_files(c, "straight", "left");
}

static void test_left_and_taken_up(void **state)
{
    (void)state;
    for (int k = 0; k < CASES; k++) {
        check_case(&cases[k]);
    }
}

/* Steps made after a load by those who look for what a lost entry changes. */
enum { STEPS_LEFT = 150 };

typedef struct Probe {
    Run run;
    OzState state;
    OzSnapshot now[2]; /* after the state as it is, and with one entry zeroed */
} Probe;

/* The state that comes of a loaded one, rows of contacts and ledger included; false when it cannot
 * be loaded or a guard speaks. */
static bool go_on(Probe *probe, OzSnapshot *now)
{
    OzSim *sim = probe->run.worker.sim;
    OzStateVisit visit = oz_state_load(&probe->state);
    OzStatus status = oz_worker_state_visit(&probe->run.worker, &visit);
    if (status == OZ_OK) {
        status = oz_sim_advance(sim, oz_sim_step(sim) + STEPS_LEFT);
    }
    return status == OZ_OK && oz_read_snapshot_snapshot(sim, 0, now, true) == OZ_OK;
}

static bool same_bits(const OzSnapshot *a, const OzSnapshot *b)
{
    size_t three = 3 * (size_t)a->count * sizeof(double);
    return a->step == b->step && memcmp(a->position, b->position, three) == 0 &&
           memcmp(a->velocity, b->velocity, three) == 0 &&
           memcmp(a->angular_velocity, b->angular_velocity, three) == 0 &&
           memcmp(a->wall_impulse, b->wall_impulse,
                  (size_t)a->scene->wall_count * sizeof *a->wall_impulse) == 0 &&
           memcmp(&a->ledger, &b->ledger, sizeof a->ledger) == 0 &&
           memcmp(&a->element_ledger, &b->element_ledger, sizeof a->element_ledger) == 0;
}

/* What is zeroed without a trace in so few steps, and why. */
static const char *const unseen[] = {
    "wall_active", /* clears springs of ends that have left a wall, which few do               */
    "slot_of",     /* small scenes never change slots; made anew with the order of large ones  */
};

static bool may_be_unseen(const char *name, const char *also)
{
    if (also && strstr(name, also)) {
        return true;
    }
    for (size_t k = 0; k < sizeof unseen / sizeof *unseen; k++) {
        if (strstr(name, unseen[k])) {
            return true;
        }
    }
    return false;
}

/* Zeroes each entry of the first member's arrays in turn; also: one more that may be unseen. */
static void check_nothing_is_superfluous(const Case *c, const char *also)
{
    Probe probe = {0};
    int tried = 0, superfluous = 0;
    open_case(&probe.run, c, "probe", false);
    walk_run(&probe.run, probe.run.worker.schedule.last_step / 2 + 3);
    save_run(&probe.run, &probe.state);
    for (int k = 0; k < 2; k++) {
        must(oz_snapshot_create(&probe.now[k], &probe.run.members[0]->scene,
                                &probe.run.members[0]->grains));
    }
    assert_true(go_on(&probe, &probe.now[0]));
    for (int64_t i = 0; i < probe.state.count; i++) {
        OzStateEntry *entry = &probe.state.entries[i];
        size_t bytes = (size_t)entry->count * oz_state_kind_bytes(entry->kind);
        if (!strstr(entry->name, "sim/member_0/") || may_be_unseen(entry->name, also)) {
            continue;
        }
        void *kept = entry->data;
        entry->data = calloc(bytes + 1, 1);
        bool any = memcmp(kept, entry->data, bytes) != 0;
        if (any && go_on(&probe, &probe.now[1]) && same_bits(&probe.now[0], &probe.now[1])) {
            print_error("%s is superfluous\n", entry->name);
            superfluous++;
        }
        tried += any;
        free(entry->data);
        entry->data = kept;
    }
    assert_true(go_on(&probe, &probe.now[1]) && same_bits(&probe.now[0], &probe.now[1]));
    oz_snapshot_free(&probe.now[0]);
    oz_snapshot_free(&probe.now[1]);
    oz_state_free(&probe.state);
    close_run(&probe.run);
    assert_true(tried > 5);
    assert_int_equal(superfluous, 0);
}

static void test_nothing_is_superfluous(void **state)
{
    (void)state;
    check_nothing_is_superfluous(&cases[0], NULL);
    check_nothing_is_superfluous(&cases[4], "record"); /* written by the moves before the forces */
    check_nothing_is_superfluous(&cases[9], "0/wall"); /* of the drum, which nothing touches yet */
    check_nothing_is_superfluous(&cases[10], "record");
    check_nothing_is_superfluous(&cases[11], NULL);
}

/* Settling that is left at one of its looks. */
typedef struct Settling {
    OzSim *sim;
    OzState *state;
    int looks_left; /* before it is saved and given up; negative: never */
} Settling;

static OzStatus watch_settling(void *context, double time, double ratio)
{
    Settling *settling = context;
    (void)time, (void)ratio;
    if (settling->looks_left-- != 0) {
        return OZ_OK;
    }
    OzStateVisit visit = oz_state_save(settling->state);
    must(oz_sim_state_visit(settling->sim, &visit));
    return OZ_ERR_INTERRUPTED;
}

/* Settles and goes on a little. */
static OzSnapshot settle(const Rig *rig, OzState *load, Settling settling)
{
    OzSnapshot now = {0};
    double seconds = 0;
    settling.sim = start_sim(rig, &rig_device);
    if (load) {
        OzStateVisit visit = oz_state_load(load);
        must(oz_sim_state_visit(settling.sim, &visit));
    }
    OzStatus status = oz_settle_run(settling.sim, &seconds, watch_settling, &settling);
    if (status == OZ_OK) {
        now = state_at(rig, settling.sim, 100);
    }
    oz_sim_free(settling.sim);
    return now;
}

static void test_settling_goes_on(void **state)
{
    (void)state;
    Rig rig;
    snprintf(text, sizeof text, rods, "euler", "float", "hash", "false");
    strcat(text, "settle: {drag: 70, time_max: 6e-3, rest_time: 6e-3}\n");
    rig_open(&rig, "%s", text);
    OzSnapshot straight = settle(&rig, NULL, (Settling){.looks_left = -1});
    for (int look = 2; look < 8; look += 4) { /* with drag, and after */
        OzState saved = {0};
        settle(&rig, NULL, (Settling){.state = &saved, .looks_left = look});
        OzSnapshot resumed = settle(&rig, &saved, (Settling){.looks_left = -1});
        assert_same_bits(&straight, &resumed);
        oz_snapshot_free(&resumed);
        oz_state_free(&saved);
    }
    oz_snapshot_free(&straight);
    rig_close(&rig);
}

/* The state of a bed after some steps; wider: of lists that have become longer than they must. */
static void save_bed(const Rig *rig, const OzDevice *device, bool wider, OzState *state)
{
    OzSim *sim = start_sim(rig, device);
    OzSizesHead *sizes = NULL;
    size_t bytes = sim->model->sizes_bytes;
    must(oz_sim_advance(sim, 400));
    must(oz_memory_new((void **)&sizes, bytes, 1, "sizes"));
    memcpy(sizes, sim->arrays.sizes, bytes);
    sizes->outer_capacity += wider ? 64 : 0;
    sizes->inner_capacity += wider ? 32 : 0;
    sizes->back_capacity += wider ? 16 : 0;
    must(oz_sim_state_save_springs(sim));
    must(oz_arrays_resize(&sim->arrays, sizes));
    must(oz_sim_state_renew(sim));
    OzStateVisit visit = oz_state_save(state);
    must(oz_sim_state_visit(sim, &visit));
    free(sizes);
    oz_sim_free(sim);
}

/* Two that begin with the same bed, but for lists, do the same. */
static void check_unequal_lists(const Rig *rig, const OzDevice *device)
{
    OzState states[2] = {0};
    OzSim *sim = NULL;
    OzSnapshot now[2];
    const OzMember members[2] = {{&rig->scene, &rig->grains}, {&rig->scene, &rig->grains}};
    const OzBranchSource sources[2] = {{&states[0], "", 0, 0}, {&states[1], "", 0, 0}};
    save_bed(rig, device, false, &states[0]);
    save_bed(rig, device, true, &states[1]);
    must(oz_sim_create(&sim, device, members, 2, NULL));
    must(oz_branch_take(sim, sources));
    must(oz_sim_advance(sim, 100));
    for (int m = 0; m < 2; m++) {
        must(oz_snapshot_create(&now[m], &rig->scene, &rig->grains));
        must(oz_read_snapshot_snapshot(sim, m, &now[m], true));
    }
    assert_true(now[0].contacts.count > 10);
    assert_same_bits(&now[0], &now[1]);
    for (int m = 0; m < 2; m++) {
        oz_snapshot_free(&now[m]);
        oz_state_free(&states[m]);
    }
    oz_sim_free(sim);
}

static void test_branches_of_unequal_lists(void **state)
{
    (void)state;
    Rig rig;
    snprintf(text, sizeof text, rods, "euler", "float", "hash", "false");
    rig_open(&rig, "%s", text);
    const OzDevice device = shaped_device(GROUP); /* a row of springs for each work-item */
    check_unequal_lists(&rig, &device);
    rig_close(&rig);
}

/* A state is taken by the run that it is of. */
static void test_other_runs_are_refused(void **state)
{
    (void)state;
    static const struct {
        int from, into;
        const char *words;
    } pairs[] = {
        {0, 3, "kernel switch"}, {0, 6, "kernel switch"}, {4, 0, "kernel switch DOUBLE was 1"}};
    for (size_t k = 0; k < sizeof pairs / sizeof *pairs; k++) {
        Run from, into;
        OzState saved = {0};
        open_case(&from, &cases[pairs[k].from], "from", false);
        save_run(&from, &saved);
        open_case(&into, &cases[pairs[k].into], "into", false);
        OzStateVisit visit = oz_state_load(&saved);
        assert_int_equal(oz_worker_state_visit(&into.worker, &visit), OZ_ERR_INPUT);
        if (!strstr(oz_status_text(), pairs[k].words)) {
            fail_msg("\"%s\" does not tell \"%s\"", oz_status_text(), pairs[k].words);
        }
        close_run(&from);
        close_run(&into);
        oz_state_free(&saved);
    }
}

static int open_all(void **state)
{
    return mkdtemp(folder) ? open_rig_device(state) : -1;
}

static int close_all(void **state)
{
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return system(command) + close_rig_device(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_left_and_taken_up),
        cmocka_unit_test(test_nothing_is_superfluous),
        cmocka_unit_test(test_settling_goes_on),
        cmocka_unit_test(test_branches_of_unequal_lists),
        cmocka_unit_test(test_other_runs_are_refused),
    };
    return cmocka_run_group_tests(tests, open_all, close_all);
}
