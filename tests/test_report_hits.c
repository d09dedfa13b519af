/* Counting hits: spans of touching by hand, and `orzo report --hits` on dice at a coarse step. */
#include "program.h"

#include "observe/hits.h"

#include <math.h>

#define DICE                                                                                       \
    "model: trigrains\ngravity: [0, 0]\ntime: {step: 4e-6, duration: 0.08}\n"                      \
    "beams: {stiffness: 100, second_moment: 1e-10, damping: 9e-3}\n"                               \
    "triangles: {stiffness: 2e6}\ngrains:\n"                                                       \
    "  - {kind: single, shape: square, edge: 2e-3, position: [0, 0], angle: 30, "                  \
    "velocity: [%s, 0]}\n"                                                                         \
    "  - {kind: single, shape: square, edge: 2e-3, position: [2.9e-3, 3e-4], angle: 30}\n%s"

/* Two grains of 2 and 6 kg, the first with this speed along x, both falling alike. */
static void look(OzHits *hits, bool touching, double speed)
{
    double mass[2] = {2, 6};
    double velocity[6] = {speed + 1, -9 * (double)hits->looks, 0, 1, -9 * (double)hits->looks, 0};
    OzGrains grains = {.count = 2, .mass = mass};
    OzContactEntry entry = {.b = 1};
    OzSnapshot snapshot = {.grains = &grains, .velocity = velocity, .has_contacts = true};
    snapshot.contacts = (OzContactList){&entry, touching, touching};
    oz_hits_look(hits, &snapshot);
}

/* 1.5 kg of reduced mass. The speed while touching must not matter. */
static void test_spans(void **state)
{
    (void)state;
    OzHits hits = {0};
    const struct {
        bool touching;
        double speed;
    } looks[] = {{false, 8}, {true, 7},    {true, 3}, {false, 2},  {false, 2},
                 {true, 1},  {false, 1.9}, {true, 1}, {false, -1}, {true, -2}};
    for (size_t i = 0; i < sizeof looks / sizeof looks[0]; i++) {
        look(&hits, looks[i].touching, looks[i].speed);
    }
    assert_int_equal(hits.span_count, 3);
    assert_true(hits.touching);
    /* rounding of a few numbers */
    assert_true(fabs(hits.impulse[0] - 1.5 * 6) < 1e-14);
    assert_true(fabs(hits.impulse[1] - 1.5 * 0.1) < 1e-14);
    assert_true(fabs(oz_hits_share(&hits, 2) - 2.9 / 9) < 1e-14);
    /* shares 2/3, 1/90, 29/90 */
    assert_int_equal(oz_hits_count(&hits, 0.5), 1);
    assert_int_equal(oz_hits_count(&hits, OZ_HITS_SHARE), 2);
    assert_int_equal(oz_hits_count(&hits, 0.012), 2);
    assert_int_equal(oz_hits_count(&hits, 0.01), 3);
}

/* One strong hit between 150 grazes, more than are kept: it is still there, and nothing of the
 * total is lost. */
static void test_many_grazes(void **state)
{
    (void)state;
    OzHits hits = {0};
    double speed = 0;
    look(&hits, false, speed);
    for (int i = 0; i < 150; i++) {
        look(&hits, true, 0);
        speed += i == 5 ? 100 : 0.003 * (i + 1);
        look(&hits, false, speed);
    }
    assert_int_equal(hits.span_count, OZ_HITS_SPANS);
    assert_int_equal(oz_hits_count(&hits, OZ_HITS_SHARE), 1);
    /* 150 sums' rounding */
    assert_true(fabs(hits.total / (1.5 * speed) - 1) < 1e-13);
    int greatest = 0;
    for (int i = 0; i < OZ_HITS_SPANS; i++) {
        greatest = hits.impulse[i] > hits.impulse[greatest] ? i : greatest;
    }
    assert_int_equal(greatest, 0); /* in order of time: all others kept came later */
}

/* The paper's answer at a coarse step: two hits and little spin when slow, one and more when fast.
 */
static void test_command(void **state)
{
    (void)state;
    double speed, angular_velocity[2][2];
    int hits[2], touching[2];
    write_file("dice.yaml", DICE, "1", "sweep: {grains.0.velocity.0: [0.2, 1.0]}\n");
    expect(0, "hits change from 2 to 1 between grains.0.velocity.0 = 0.2 and 1.0",
           "report --hits dice.yaml -o found");
    char *text = read_file("found/hits.csv", NULL);
    assert_non_null(
        strstr(text, "grains.0.velocity.0,seed,speed,hits,touching,spin_0,spin_1,shares\n"));
    char *row = strchr(text, '\n') + 1;
    for (int i = 0; i < 2; i++, row = strchr(row, '\n') + 1) {
        assert_int_equal(sscanf(strchr(row, ',') + 1, "1,%lf,%d,%d,%lf,%lf", &speed, &hits[i],
                                &touching[i], &angular_velocity[i][0], &angular_velocity[i][1]),
                         5);
        /* as it was written, in some digits */
        assert_true(fabs(speed - (i ? 1 : 0.2)) < 1e-12);
        assert_int_equal(touching[i], 0);
    }
    free(text);
    assert_int_equal(hits[0], 2);
    assert_int_equal(hits[1], 1);
    /* spins in edges over speeds: 0.017 after two hits, 0.56 after one */
    assert_true(fabs(angular_velocity[0][0]) < 0.05 && fabs(angular_velocity[1][0]) > 0.3);
    assert_true(fabs(angular_velocity[0][1]) < 0.05 && fabs(angular_velocity[1][1]) > 0.3);
}

/* Slow dice share the impulse of two hits as 5 to 3 or so: counted from 45 % on only one is left.
 */
static void test_share(void **state)
{
    (void)state;
    write_file("share.yaml", DICE, "1", "sweep: {grains.0.velocity.0: [0.2, 1.0]}\n");
    expect(0, "counted from 45 % of the impulse: hits do not change over grains.0.velocity.0",
           "report --hits share.yaml -o share --share 0.45");
    char *said = read_file("said", NULL);
    const char *const others[] = {"from 3 %", "from 5 %", "from 10 %"};
    for (int k = 0; k < 3; k++) {
        char line[128];
        snprintf(line, sizeof line,
                 "counted %s of the impulse: hits change from 2 to 1 between "
                 "grains.0.velocity.0 = 0.2 and 1.0, 0.2 and 1 m/s",
                 others[k]);
        assert_non_null(strstr(said, line));
    }
    free(said);
    expect(2, "expected --share with a number from 0.01 to 1",
           "report --hits share.yaml --share 0.001");
    expect(2, "expected --share with a number from 0.01 to 1",
           "report --hits share.yaml --share nan");
}

static void test_ends_too_early(void **state)
{
    (void)state;
    write_file("short.yaml", DICE, "1", "");
    expect(0, "still touching at the end",
           "report --hits short.yaml -o short --set time.duration=9e-4");
}

static void test_refusals(void **state)
{
    (void)state;
    write_file("wall.yaml", DICE, "1", "walls:\n  - {kind: floor, width: 1, point: [0, -1]}\n");
    expect(2, "no walls", "report --hits wall.yaml");
    write_file("still.yaml", DICE, "0", "");
    expect(2, "one velocity", "report --hits still.yaml");
    expect(2, "expected one", "report --hits wall.yaml still.yaml");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_spans),    cmocka_unit_test(test_many_grazes),
        cmocka_unit_test(test_command),  cmocka_unit_test(test_ends_too_early),
        cmocka_unit_test(test_refusals), cmocka_unit_test(test_share),
    };
    return cmocka_run_group_tests(tests, enter_work, leave_work);
}
