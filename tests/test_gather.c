/* An ensemble in parts: each is a run of its own, and the tables of all are those of one run, to
 * the byte. ORZO_NEEDS_DEVICE. */
#include "program.h"
#include "run_bed.h"

#define SWEPT "--no-video --seeds 1..5 --set 'sweep={contact.friction: [0.1, 0.4]}'"

static void assert_same_tables(const char *one, const char *other)
{
    char a[64], b[64];
    for (int k = 0; k < 2; k++) {
        snprintf(a, sizeof a, "%s/%s.csv", one, k ? "members" : "ensemble");
        snprintf(b, sizeof b, "%s/%s.csv", other, k ? "members" : "ensemble");
        assert_true(count_lines(a) > 5);
        assert_true(same_files(a, b));
    }
}

static void test_parts_are_the_whole(void **state)
{
    (void)state;
    write_file("bed.yaml", "%s", bed);
    expect(0, "10 members of about", "run bed.yaml -o whole " SWEPT);
    expect(0, "4 members of about", "run bed.yaml -o parts " SWEPT " --part 1/2");
    expect(0, "6 members of about", "run bed.yaml -o parts " SWEPT " --part 2/2");
    assert_true(is_there("parts/part_00002/friction_0.4_seed_00005/final.csv"));
    expect(0, "10 members of 2 parts in parts", "gather parts");
    assert_same_tables("whole", "parts");
    expect(0, "10 members of 2 parts", "gather parts/part_00002 parts/part_00001 -o all");
    assert_same_tables("whole", "all");
    expect(0, "10 members of 2 parts in parts", "gather parts"); /* again */
    expect(0, "parts/plot.png", "plot parts angle");             /* without members' own curves */
    assert_false(contains("said", "annot find"));
}

static void expect_process(int rank, int count, int status, const char *text, const char *arguments)
{
    char number[16];
    snprintf(number, sizeof number, "%d", rank);
    setenv("OMPI_COMM_WORLD_RANK", number, 1);
    snprintf(number, sizeof number, "%d", count);
    setenv("OMPI_COMM_WORLD_SIZE", number, 1);
    expect(status, text, arguments);
    unsetenv("OMPI_COMM_WORLD_RANK");
    unsetenv("OMPI_COMM_WORLD_SIZE");
}

/* As mpirun -n 3 starts them, whichever ends last; one has no seed, the tables are those of all. */
static void test_processes_share_the_seeds(void **state)
{
    (void)state;
    expect(0, "2 members of about", "run bed.yaml -o one --no-video --seeds 1..2");
    expect_process(1, 3, 0, "1 of 2 parts have ended",
                   "run bed.yaml -o ranks --no-video --seeds 1..2");
    expect_process(2, 3, 0, "process 3 of 3 has no seed",
                   "run bed.yaml -o ranks --no-video --seeds 1..2");
    assert_false(is_there("ranks/members.csv"));
    expect_process(0, 3, 0, "2 members of 2 parts in ranks",
                   "run bed.yaml -o ranks --no-video --seeds 1..2");
    assert_true(is_there("ranks/part_00002/seed_00002/final.csv"));
    assert_true(same_files("one/ensemble.csv", "ranks/ensemble.csv"));
    expect_process(0, 3, 2, "process 1 of 3 without --seeds", "run bed.yaml -o single --no-video");
    assert_false(is_there("single"));
    expect_process(0, 1, 0, "2 members of about", "run bed.yaml -o alone --no-video --seeds 1..2");
    assert_true(is_there("alone/seed_00001/final.csv"));
}

static void test_refusals(void **state)
{
    (void)state;
    expect(2, "--part K/M, as in 3/20", "run bed.yaml --seeds 1..5 --part 3/2");
    expect(2, "--part K/M, as in 3/20", "run bed.yaml --seeds 1..5 --part 0/2");
    expect(2, "--part K/M, as in 3/20", "run bed.yaml --seeds 1..5 --part 1");
    expect(2, "expected --seeds with it", "run bed.yaml --part 1/2");
    expect(2, "part 1 of 20 has none of 5 seeds", "run bed.yaml --seeds 1..5 --part 1/20");
    expect(2, "there is no members.csv", "gather nothing -o all");
    expect(2, "-o is missing", "gather parts/part_00001 parts/part_00002");
    expect(2, "both have friction_0.1_seed_00001",
           "gather parts/part_00001 parts/part_00001 -o twice");
    expect(2, "is one of the parts", "gather parts/part_00001 -o parts/part_00001");
    expect(0, "2 members of about", "run bed.yaml -o first --no-video --seeds 1..2");
    expect(0, "1 members of about", "run bed.yaml -o last --no-video --seeds 6..6");
    expect(0, "no part has seeds 3 to 5", "gather first last -o gap");
    expect(2, "sweeps other keys than", "gather first parts/part_00001 -o mixed");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parts_are_the_whole),
        cmocka_unit_test(test_processes_share_the_seeds),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, enter_work, leave_work);
}
