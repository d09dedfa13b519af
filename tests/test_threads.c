/* The same bits whatever the number of threads. A driver reads that number once, so each run is a
 * program of its own. ORZO_NEEDS_DEVICE. */
#include "program.h"
#include "run_bed.h"

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
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4}\n"
    "grains:\n"
    "  - {kind: random, count: 6100, diameter: [0.4e-3, 0.6e-3], aspect: [0.5, 3]}\n"
    "walls:\n"
    "  - {kind: plane, motion: {frequency: 100, acceleration_ratio: 4}}\n"
    "  - {kind: cylinder, diameter: 2e-2}\n"
    "observe: {interval: 3e-3}\n";

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_few),
        cmocka_unit_test(test_many),
        cmocka_unit_test(test_flat),
    };
    return cmocka_run_group_tests(tests, enter_work, leave_work);
}
