/* The same bits whatever the number of threads: of the driver, which reads that number once, so
 * that each run is a program of its own; and of one process whose simulations run at once.
 * ORZO_NEEDS_DEVICE. */
#include "program.h"
#include "run_bed.h"

#include "model/insert.h"
#include "sim/read_snapshot.h"
#include "sim/reference.h"

#include <pthread.h>

/* Grains of any shape thrown into a shaken vessel; its kernels are those of the extreme cases. */
static const char flat[] =
    "model: trigrains\n"
    "time: {step: 4e-6, duration: 1.2e-2}\n"
    "gravity: [20, -200]\n"
    "integrator: gear4\n"
    "precision: double\n"
    "grains: [{kind: random, count: 12, shape: polygon, corners: [3, 5], radius: [1e-3, 2e-3]}]\n"
    "walls:\n"
    "  - {kind: vessel, width: 15e-3, height: 3e-2, motion: {frequency: 100, "
    "acceleration_ratio: 1}}\n"
    "observe: {ledger: true, interval: 1e-3}\n";

/* Too many grains for one work-group (OZ_DEVICE_SMALL_MOST): regions are spread over the threads.
 * Switched as the bed of test_lists, thrown down hard so that lists are made anew often. */
static const char many[] =
    "model: rods\n"
    "gravity: [0, 0, -100]\n"
    "integrator: euler\n"
    "time: {step: 1e-5, duration: 3e-3}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4, rolling_friction: 0.02}\n"
    "grains:\n"
    "  - {kind: random, count: 6100, diameter: [0.4e-3, 0.6e-3], aspect: [0.5, 3]}\n"
    "walls:\n"
    "  - {kind: plane, motion: {frequency: 100, acceleration_ratio: 4}}\n"
    "  - {kind: cylinder, diameter: 2e-2}\n"
    "observe: {interval: 3e-3}\n";

/* As many spheres under a lid, whose force is the sum over all of them. */
static const char pressed[] =
    "model: rods\n"
    "gravity: [0, 0, -100]\n"
    "time: {step: 1e-5, duration: 1e-3}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5}\n"
    "grains: [{kind: random, count: 6100, diameter: [0.4e-3, 0.6e-3], fill: 0.4}]\n"
    "walls:\n"
    "  - {kind: plane}\n"
    "  - {kind: cylinder, diameter: 2e-2}\n"
    "  - {kind: plane, point: [0, 0, 4.6e-3], normal: [0, 0, -1], servo: {force: 0.6, damping: "
    "0.6}}\n"
    "observe: {interval: 1e-3}\n";

static void test_few(void **state)
{
    (void)state;
    write_file("bed.yaml", "%s", bed);
    expect(0, "30 grains", "run bed.yaml -o one --device cpu --threads 1");
    expect(0, "30 grains", "run bed.yaml -o two --device cpu --threads 2");
    assert_true(same_files("one/final.csv", "two/final.csv"));
    assert_true(same_files("one/series.csv", "two/series.csv"));
}

static void test_many(void **state)
{
    (void)state;
    write_file("many.yaml", "%s", many);
    expect(0, "6100 grains", "run many.yaml -o many_one --no-video --device cpu --threads 1");
    expect(0, "6100 grains", "run many.yaml -o many_two --no-video --device cpu --threads 2");
    assert_true(same_files("many_one/final.csv", "many_two/final.csv"));
    assert_true(same_files("many_one/series.csv", "many_two/series.csv"));
    char *series = read_file("many_one/series.csv", NULL);
    const char *cell = line_of(series, 2);
    for (int column = 0; column < 19; column++) {
        cell = strchr(cell, ',') + 1;
    }
    assert_true(strtol(cell, NULL, 10) > 100); /* contact_count */
    free(series);
}

static void test_pressed(void **state)
{
    (void)state;
    write_file("pressed.yaml", "%s", pressed);
    expect(0, "6100 grains", "run pressed.yaml -o pressed_one --no-video --device cpu --threads 1");
    expect(0, "6100 grains", "run pressed.yaml -o pressed_two --no-video --device cpu --threads 2");
    assert_true(same_files("pressed_one/final.csv", "pressed_two/final.csv"));
    assert_true(same_files("pressed_one/series.csv", "pressed_two/series.csv"));
    char *series = read_file("pressed_one/series.csv", NULL);
    assert_true(atof(strrchr(line_of(series, 2), ',') + 1) > 10); /* Pa, the last column */
    free(series);
}

/* Both members in one launch on one thread, or a launch and a thread each. */
static void test_flat(void **state)
{
    (void)state;
    static const char *const files[] = {"series.csv", "final.csv"};
    char one[64], two[64];
    write_file("flat.yaml", "%s", flat);
    expect(0, "2 side by side, 1 launches at a time",
           "run flat.yaml -o flat_one --seeds 1..2 --no-video --device cpu --threads 1");
    expect(0, "2 side by side, 2 launches at a time",
           "run flat.yaml -o flat_two --seeds 1..2 --no-video --device cpu --threads 2");
    for (int k = 0; k < 4; k++) {
        snprintf(one, sizeof one, "flat_one/seed_0000%d/%s", 1 + k % 2, files[k / 2]);
        snprintf(two, sizeof two, "flat_two/seed_0000%d/%s", 1 + k % 2, files[k / 2]);
        assert_true(same_files(one, two));
    }
    char *series = read_file("flat_one/seed_00001/series.csv", NULL);
    int contacts = 0;
    assert_int_equal(sscanf(line_of(series, 13), "3000,0.012,1.2,%d", &contacts), 1);
    assert_true(contacts > 0);
    free(series);
    assert_false(same_files("flat_one/seed_00001/series.csv", "flat_one/seed_00002/series.csv"));
}

/* Rods for the host's own physics, with all that the bed has not. */
static const char rough[] =
    "model: rods\n"
    "time: {step: 2e-5, duration: 1}\n"
    "integrator: velocity-verlet\n"
    "contact: {law: hertz-mindlin, youngs_modulus: 1e6, poisson_ratio: 0.3, restitution: 0.5, "
    "friction: 0.6}\n"
    "grains: [{kind: random, count: 20, diameter: 1e-3, aspect: 3}]\n"
    "walls: [{kind: plane}, {kind: cylinder, diameter: 8e-3}]\n";

/* A simulation from its scene on, and what came of it. Threads leave no test: they say what
 * failed. */
typedef struct Job {
    const char *text;
    bool on_host;
    int stretch; /* steps between snapshots */
    pthread_barrier_t *start;
    uint64_t marks; /* of all bytes of all its snapshots */
    int64_t contacts;
    char failure[256];
} Job;

enum { STRETCHES = 12, JOBS = 4 };

static void mark(Job *job, const double *values, int64_t count)
{
    for (size_t k = 0; k < (size_t)count * sizeof *values; k++) {
        job->marks = (job->marks ^ ((const unsigned char *)values)[k]) * 0x100000001b3u;
    }
}

static void mark_snapshot(Job *job, const OzSnapshot *now)
{
    mark(job, now->position, 3 * now->count);
    mark(job, now->velocity, 3 * now->count);
    mark(job, now->angular_velocity, 3 * now->count);
    for (int64_t k = 0; k < now->contacts.count; k++) {
        mark(job, &now->contacts.entry[k].push, 4); /* and tangential */
    }
    mark(job, &now->element_ledger.beam_axial, 1);
    job->contacts += now->contacts.count;
}

static OzStatus follow_reference(Job *job, OzReference *reference, OzSnapshot *now)
{
    for (int k = 1; k <= STRETCHES; k++) {
        OZ_PASS(oz_reference_advance(reference, k * job->stretch));
        OZ_PASS(oz_reference_snapshot(reference, now));
        mark_snapshot(job, now);
    }
    return OZ_OK;
}

static OzStatus follow_sim(Job *job, OzSim *sim, OzSnapshot *now)
{
    for (int k = 1; k <= STRETCHES; k++) {
        OZ_PASS(oz_sim_advance(sim, k * job->stretch));
        OZ_PASS(oz_read_snapshot_snapshot(sim, 0, now, true));
        mark_snapshot(job, now);
    }
    return OZ_OK;
}

static OzStatus simulate(Job *job)
{
    OzStatus status = OZ_OK;
    OzScene scene = {0};
    OzGrains grains = {0};
    OzDevice device = {0};
    OzSnapshot now = {0};
    OzSim *sim = NULL;
    OzReference *reference = NULL;
    const OzMember member = {&scene, &grains};
    OZ_TRY(oz_scene_parse(&scene, "job.yaml", job->text, NULL, 0));
    OZ_TRY(oz_insert_grains(&grains, &scene));
    OZ_TRY(oz_snapshot_create(&now, &scene, &grains));
    if (job->on_host) {
        OZ_TRY(oz_reference_create(&reference, &scene, &grains));
    } else {
        OZ_TRY(oz_device_open(&device, "cpu", 1));
        OZ_TRY(oz_sim_create(&sim, &device, &member, 1, NULL));
    }
    pthread_barrier_wait(job->start);
    job->start = NULL;
    OZ_TRY(job->on_host ? follow_reference(job, reference, &now) : follow_sim(job, sim, &now));
done:
    if (job->start) {
        pthread_barrier_wait(job->start);
    }
    snprintf(job->failure, sizeof job->failure, "%s", status == OZ_OK ? "" : oz_status_text());
    oz_sim_free(sim);
    oz_reference_free(reference);
    oz_snapshot_free(&now);
    oz_device_close(&device);
    oz_grains_free(&grains);
    oz_scene_free(&scene);
    return status;
}

static void *run_job(void *job)
{
    simulate(job);
    return NULL;
}

/* Runs jobs at once, a thread each, and looks that each came to its end. */
static void run_jobs(Job *jobs, int count)
{
    pthread_barrier_t start;
    pthread_t threads[JOBS];
    assert_int_equal(pthread_barrier_init(&start, NULL, (unsigned)count), 0);
    for (int k = 0; k < count; k++) {
        jobs[k].start = &start;
        assert_int_equal(pthread_create(&threads[k], NULL, run_job, &jobs[k]), 0);
    }
    for (int k = 0; k < count; k++) {
        assert_int_equal(pthread_join(threads[k], NULL), 0);
        assert_string_equal(jobs[k].failure, "");
        assert_true(jobs[k].contacts > 0);
    }
    pthread_barrier_destroy(&start);
}

/* Both models on devices of their own and the host's physics under other switches, each in a thread
 * of one process: the same bits as alone. */
static void test_simulations_at_once(void **state)
{
    (void)state;
    Job together[JOBS] = {{.text = bed, .stretch = 300},
                          {.text = flat, .stretch = 150},
                          {.text = bed, .stretch = 200, .on_host = true},
                          {.text = rough, .stretch = 200, .on_host = true}};
    run_jobs(together, JOBS);
    for (int k = 0; k < JOBS; k++) {
        Job alone = {.text = together[k].text,
                     .on_host = together[k].on_host,
                     .stretch = together[k].stretch};
        run_jobs(&alone, 1);
        assert_true(alone.marks == together[k].marks && alone.contacts == together[k].contacts);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_few),
        cmocka_unit_test(test_many),
        cmocka_unit_test(test_pressed),
        cmocka_unit_test(test_flat),
        cmocka_unit_test(test_simulations_at_once),
    };
    return cmocka_run_group_tests(tests, enter_work, leave_work);
}
