/* `parallel: line`: force and torque against the gradient of the stored energy, continuous in the
 * angle where the single contact jumps, the spheres' for short shafts, the single contact's for
 * skew ones; energy over a slow turn and in collisions. */
#include "rig.h"

#include "report/report_parallel.h"

#include "sim/dialect.h"

static const double radius = 0.5e-3, half = 2e-3;
static const OzLawConstants elastic = {.stiffness = 1e8};

/* A pair by its place and rotation vectors, from two upright rods side by side, 1 % of d in
 * overlap. */
typedef struct Pose {
    double shift[3], turn_a[3], turn_b[3];
    double half_a, half_b; /* m */
} Pose;

static OzVec3 turned(OzVec3 v, const double by[3])
{
    OzVec3 angle = oz_dialect_load3(by);
    double size = sqrt(oz_dot(angle, angle));
    OzVec3 k = oz_scale(angle, size > 0 ? 1 / size : 0);
    OzVec3 across = oz_scale(oz_cross(k, v), sin(size));
    return oz_add(oz_along(oz_scale(v, cos(size)), oz_dot(k, v) * (1 - cos(size)), k), across);
}

static OzPairForce touch(const Pose *pose, OzLawConstants law)
{
    OzVec3 none = {0};
    OzMemory memory = {.stretch = {0, 0, 0}};
    OzVec3 a = turned(oz_vec3(0, 0, pose->half_a), pose->turn_a);
    OzVec3 b = turned(oz_vec3(0, 0, pose->half_b), pose->turn_b);
    OzGrain one = {{0, 0, 0}, a, none, none, radius, 2e-6, 1e6};
    OzGrain other = {{1.98 * radius + pose->shift[0], pose->shift[1], pose->shift[2]},
                     b,
                     none,
                     none,
                     radius,
                     2e-6,
                     1e6};
    return oz_rods_pair(one, other, (OzSpace){.unit = 1}, law, &memory, 1e-6, 0.5);
}

static void use_line(int line)
{
    oz_host_switches_rods(&(OzSwitches){.line = line});
}

static double energy(Pose pose)
{
    return touch(&pose, elastic).parts.energy;
}

/* Component i of -dU/d(shift, turn_a, turn_b) by central differences. The kinks of U's second
 * derivative lie among the poses: the step is small against the softness of the ends, 4e-6 m. */
static double slope(Pose pose, int i, double step)
{
    double *x = i < 3 ? &pose.shift[i] : i < 6 ? &pose.turn_a[i - 3] : &pose.turn_b[i - 6];
    double at = *x;
    *x = at + step;
    double above = energy(pose);
    *x = at - step;
    return (above - energy(pose)) / (2 * -step);
}

/* Rotation vectors add to rotations only at none: the pose is turned as a whole so that the axis in
 * question starts from the upright. */
static void check_gradient(const Pose *pose)
{
    OzPairForce now = touch(pose, elastic);
    double force[3], scale = sqrt(oz_dot(now.force, now.force));
    oz_dialect_store3(force, now.force);
    for (int i = 0; i < 3; i++) {
        /* a kink within the step leaves step / softness = 2.5e-5; without one 3e-9 */
        assert_true(fabs(slope(*pose, i, 1e-10) - force[i]) < 5e-5 * scale);
    }
    if (pose->turn_a[0] == 0 && pose->turn_a[1] == 0) {
        /* the ends move by 2e-10 m: 5e-5 at a kink */
        assert_true(fabs(slope(*pose, 3, 1e-7) - now.torque_a.x) < 1e-4 * scale * half);
        assert_true(fabs(slope(*pose, 4, 1e-7) - now.torque_a.y) < 1e-4 * scale * half);
    }
    if (pose->turn_b[0] == 0 && pose->turn_b[1] == 0) {
        /* as above */
        assert_true(fabs(slope(*pose, 6, 1e-7) - now.torque_b.x) < 1e-4 * scale * half);
        assert_true(fabs(slope(*pose, 7, 1e-7) - now.torque_b.y) < 1e-4 * scale * half);
    }
}

/* Evenly spread numbers of -1..1. */
static double spread(int n, int k)
{
    static const double step[] = {0.7548776662, 0.5698402910, 0.8191725134,
                                  0.6710436067, 0.4301597090, 0.2245512977};
    double x = n * step[k % 6];
    return 2 * (x - floor(x)) - 1;
}

/* Staggered, unequal, crossing and opening pairs around the parallel, one of both upright. */
static void test_force_is_the_gradient(void **state)
{
    (void)state;
    int touched = 0;
    use_line(1);
    for (int n = 1; n < 2000; n++) {
        double tilt = n % 5 ? 0.02 : 0.2;
        Pose pose = {{5e-6 * spread(n, 0), 1e-4 * spread(n, 1), n % 3 ? 4e-3 * spread(n, 2) : 0},
                     {0},
                     {0},
                     half,
                     n % 4 ? half : half * 0.5};
        double *turn = n % 2 ? pose.turn_a : pose.turn_b;
        turn[0] = tilt * spread(n, 3);
        turn[1] = 0.3 * tilt * spread(n, 4);
        if (touch(&pose, elastic).contact.touching) {
            touched++;
            check_gradient(&pose);
        }
    }
    assert_true(touched > 500);
}

/* The greatest change of torque on b from one angle to the next, over k xi S: a crosses or opens
 * (axis x or y) through zero, with the other angle fixed. */
static double jump(int axis, double other, double stagger, double step)
{
    Pose pose = {{0, 0, stagger}, {0}, {0}, half, half};
    double worst = 0, scale = 1e8 * 1e-6 * 0.02 * radius * half;
    OzVec3 last = {0}, last_force = {0};
    for (int i = -200; i <= 200; i++) {
        pose.turn_b[axis] = i * step;
        pose.turn_b[1 - axis] = other;
        OzPairForce now = touch(&pose, elastic);
        OzVec3 change = oz_minus(now.torque_b, last), push = oz_minus(now.force, last_force);
        if (i > -200) {
            worst = fmax(worst, sqrt(oz_dot(change, change)) / scale);
            worst = fmax(worst, sqrt(oz_dot(push, push)) * half / scale);
        }
        last = now.torque_b;
        last_force = now.force;
    }
    return worst;
}

static void test_no_jump_through_zero(void **state)
{
    (void)state;
    for (int k = 0; k < 18; k++) {
        double other = k % 3 * 5e-3, stagger = k / 3 % 3 * 0.9e-3;
        use_line(1);
        double coarse = jump(k / 9, other, stagger, 1e-6), fine = jump(k / 9, other, stagger, 1e-7);
        /* A steepest slope of S / (overlap) = 400 a radian, tenfold for the softened choice of
         * ends. */
        if (!(coarse < 4e-3 && fine < 0.2 * coarse + 1e-9)) {
            fail_msg("axis %d, other %g, stagger %g: %g, %g", k / 9, other, stagger, coarse, fine);
        }
    }
    use_line(0);
    assert_true(jump(1, 0, 0, 1e-7) > 0.9); /* the single contact jumps by the whole torque */
}

static void test_short_shafts_are_spheres(void **state)
{
    (void)state;
    Pose sphere = {{1e-6, 2e-5, -1e-5}, {0}, {0}, 0, 0};
    use_line(0);
    OzPairForce round = touch(&sphere, elastic);
    use_line(1);
    for (double length = 1e-6; length > 1e-11; length *= 0.1) {
        for (int n = 1; n < 50; n++) {
            Pose pose = {{1e-6, 2e-5, -1e-5},
                         {3 * spread(n, 0), 3 * spread(n, 1), 0},
                         {3 * spread(n, 2), 3 * spread(n, 3), 0},
                         length,
                         n % 2 ? length : 0};
            OzVec3 off = oz_minus(touch(&pose, elastic).force, round.force);
            /* both ends move by the length, the overlap is 1e-5 m; twice for the couple */
            double bound = 4 * length / 1e-5 * sqrt(oz_dot(round.force, round.force));
            assert_true(sqrt(oz_dot(off, off)) < bound);
        }
    }
    OzPairForce line = touch(&sphere, elastic);
    /* of shafts of no length nothing is left but rounding */
    assert_true(fabs(line.force.x - round.force.x) < 1e-14 * fabs(round.force.x));
}

/* A rod looks the same from both ends: its axis turned round changes nothing but the order of sums.
 */
static void test_rods_have_no_head(void **state)
{
    (void)state;
    int touched = 0;
    use_line(1);
    for (int n = 1; n < 200; n++) {
        Pose pose = {{0, 1e-4 * spread(n, 1), 2e-3 * spread(n, 2)},
                     {0.02 * spread(n, 3), 0.005 * spread(n, 4), 0},
                     {0},
                     half,
                     n % 4 ? half : half * 0.5};
        OzPairForce now = touch(&pose, elastic);
        pose.half_b = -pose.half_b;
        OzPairForce turned_round = touch(&pose, elastic);
        OzVec3 force = oz_minus(now.force, turned_round.force);
        OzVec3 torque = oz_minus(now.torque_b, turned_round.torque_b);
        double size = sqrt(oz_dot(now.force, now.force));
        /* rounding of sums in another order */
        assert_true(sqrt(oz_dot(force, force)) <= 1e-14 * size);
        assert_true(sqrt(oz_dot(torque, torque)) <= 1e-14 * size * half);
        touched += now.contact.touching;
    }
    assert_true(touched > 50);
}

static void test_skew_shafts_touch_once(void **state)
{
    (void)state;
    for (int n = 1; n < 100; n++) {
        Pose pose = {
            {0, 0, 1e-3 * spread(n, 0)}, {0}, {0.11 + 1.4 * fabs(spread(n, 1)), 0, 0}, half, half};
        use_line(0);
        OzPairForce single = touch(&pose, elastic);
        use_line(1);
        OzPairForce line = touch(&pose, elastic);
        /* weights of one and none: rounding */
        assert_true(fabs(single.force.x - line.force.x) < 1e-14 * fabs(single.force.x));
        assert_true(fabs(single.torque_b.y - line.torque_b.y) <
                    1e-14 * fabs(single.force.x) * half);
    }
}

/* Work around a loop in the two angles that encloses the parallel, over the stored energy: none.
 * The trapezoidal rule on 4000 elements of a periodic function of bounded slope leaves far less
 * than 1e-4; the single contact's force is a gradient as well but for its jumps, so only the first
 * assertion can tell. */
static void test_a_slow_loop_gives_no_energy(void **state)
{
    (void)state;
    enum { ELEMENTS = 4000 };
    double work = 0;
    use_line(1);
    for (int i = 0; i < ELEMENTS; i++) {
        double phase = 2 * 3.14159265358979 * (i + 0.5) / ELEMENTS;
        Pose pose = {{0, 0, 0.3e-3}, {0}, {2e-3 * cos(phase), 2e-3 * sin(phase), 0}, half, half};
        Pose next = pose, before = pose;
        next.turn_b[0] = 2e-3 * cos(phase + 3.14159265358979 / ELEMENTS);
        next.turn_b[1] = 2e-3 * sin(phase + 3.14159265358979 / ELEMENTS);
        before.turn_b[0] = 2e-3 * cos(phase - 3.14159265358979 / ELEMENTS);
        before.turn_b[1] = 2e-3 * sin(phase - 3.14159265358979 / ELEMENTS);
        OzVec3 u = turned(oz_vec3(0, 0, 1), before.turn_b),
               v = turned(oz_vec3(0, 0, 1), next.turn_b);
        work += oz_dot(touch(&pose, elastic).torque_b, oz_cross(u, v));
    }
    Pose start = {{0, 0, 0.3e-3}, {0}, {2e-3, 0, 0}, half, half};
    /* rounding of 4000 terms: 2e-14 */
    assert_true(fabs(work) < 1e-11 * energy(start));
}

/* What dashpots take in is their force on the centres' motion and their torques on the spins; the
 * ledger gets it as a force at the mean point and a couple. The law is linear: the dashpots' part
 * is what the contact gives with them less what it gives without. */
static void test_power_of_dashpots(void **state)
{
    (void)state;
    OzLawConstants damped = elastic;
    damped.damping = 1e3;
    use_line(1);
    for (int n = 1; n < 50; n++) {
        OzVec3 u = turned(oz_vec3(0, 0, half), (double[3]){0, 0.002 * spread(n, 0), 0});
        OzMemory none = {.stretch = {0, 0, 0}};
        OzGrain a = {.half_shaft = {0, 0, half}, .radius = radius, .mass = 2e-6};
        OzGrain b = {.position = {1.97 * radius, 0, 1e-3 * spread(n, 1)}, .half_shaft = u};
        b.radius = radius;
        b.mass = 2e-6;
        b.velocity = oz_vec3(0.01 * spread(n, 2), 0.01 * spread(n, 3), 0);
        b.rate = oz_vec3(0, 10 * spread(n, 4), 3 * spread(n, 5));
        a.rate = oz_vec3(0, 7 * spread(n, 3), 0);
        OzPairForce with = oz_rods_pair(a, b, (OzSpace){.unit = 1}, damped, &none, 1e-6, 0.5);
        OzPairForce without = oz_rods_pair(a, b, (OzSpace){.unit = 1}, elastic, &none, 1e-6, 0.5);
        double power = oz_dot(oz_minus(with.force, without.force), b.velocity) +
                       oz_dot(oz_minus(with.torque_b, without.torque_b), b.rate) +
                       oz_dot(oz_minus(with.torque_a, without.torque_a), a.rate);
        double noted =
            oz_dot(with.parts.dashpot, with.contact.velocity) + oz_dot(with.couple, with.turning);
        assert_true(with.contact.touching && power < 0);
        /* differences of forces of which the dashpots are a small part: 7e-14 */
        assert_true(fabs(noted / power - 1) < 1e-12);
    }
}

/* Two rods that meet flat, spinning a little: energy must balance, with damping by the ledger. */
static void check_collision(double restitution, double bound)
{
    Rig rig;
    rig_open(
        &rig,
        "model: rods\ntime: {step: 1e-7, duration: 1}\nintegrator: velocity-verlet\n"
        "gravity: [0, 0, 0]\nobserve: {ledger: true}\n"
        "contact: {contact_time: 1e-4, restitution: %g, friction: 0.3, parallel: line}\ngrains:\n"
        "  - {kind: single, diameter: 1e-3, aspect: 4, position: [0, 0, 0], velocity: [0.1, 0, 0],"
        " spin: [1, 3, 0]}\n"
        "  - {kind: single, diameter: 1e-3, aspect: 4, position: [1.03e-3, 0, 3e-4],"
        " axis: [0.01, 0.02, 1]}\n",
        restitution);
    rig_start(&rig);
    double before = mechanical_energy(&rig.now), worst = 0, least = before;
    for (int step = 100; step <= 9000; step += 100) {
        rig_advance(&rig, step);
        const OzLedger *l = &rig.now.ledger;
        double mechanical = mechanical_energy(&rig.now);
        double sum = mechanical + l->elastic + l->dissipated + l->friction;
        worst = fmax(worst, fabs(sum - before) / before);
        least = fmin(least, mechanical);
    }
    assert_true(least < 0.8 * before); /* they did meet */
    if (!(worst < bound)) {
        fail_msg("restitution %g: energy off by %g", restitution, worst);
    }
    rig_close(&rig);
}

static void test_energy_balances(void **state)
{
    (void)state;
    /* 1000 steps a contact: second order, (pi/1000)^2 of the energy a contact exchanges; the
     * ledger's trapezoidal rule meets the dashpot's jump at first touch, 1e-3. */
    check_collision(1, 1e-4);
    check_collision(0.5, 1e-3);
}

/* 25 upright rods packed into a box, moving, without loss: change of energy over 40 contact times
 * of 30 steps, as a share of it. */
static double heating(const char *parallel)
{
    Rig rig;
    rig_open(
        &rig,
        "model: rods\ntime: {step: 2e-5, duration: 1}\nintegrator: velocity-verlet\n"
        "gravity: [0, 0, 0]\n"
        "contact: {contact_time: 6e-4, restitution: 1, friction: 0, parallel: %s}\ngrains:\n"
        "  - {kind: lattice, diameter: 0.5e-3, aspect: 4, cells: [5, 5, 1],"
        " spacing: [0.497e-3, 0.497e-3, 1], position: [-0.994e-3, -0.994e-3, 1.3e-3]}\nwalls:\n"
        "  - {kind: plane}\n  - {kind: plane, normal: [0, 0, -1], point: [0, 0, 2.6e-3]}\n"
        "  - {kind: plane, normal: [1, 0, 0], point: [-1.245e-3, 0, 0]}\n"
        "  - {kind: plane, normal: [-1, 0, 0], point: [1.245e-3, 0, 0]}\n"
        "  - {kind: plane, normal: [0, 1, 0], point: [0, -1.245e-3, 0]}\n"
        "  - {kind: plane, normal: [0, -1, 0], point: [0, 1.245e-3, 0]}\n",
        parallel);
    for (int i = 0; i < 3 * rig.grains.count; i++) {
        rig.grains.velocity[i] = 0.02 * spread(i + 1, i % 3);
    }
    rig_start(&rig);
    double before = mechanical_energy(&rig.now) + rig.now.ledger.elastic;
    rig_advance(&rig, 1200);
    double after = mechanical_energy(&rig.now) + rig.now.ledger.elastic;
    rig_close(&rig);
    return after / before - 1;
}

static void test_an_aligned_bed_keeps_its_energy(void **state)
{
    (void)state;
    double line = heating("line"), single = heating("single");
    /* second order at 30 steps a contact: (pi/30)^2 / 12, bounded; the jumps of the single contact
     * heat */
    if (!(fabs(line) < 5e-3 && single > 0.1)) {
        fail_msg("energy changed by %g with line, by %g with single", line, single);
    }
}

/* The report's own bed: torque under line is smooth, under single it jumps. */
static void test_the_report_tells_them_apart(void **state)
{
    (void)state;
    const char *path = ORZO_SCENES "/report/aligned.yaml";
    OzParallelNoise line, fine, single;
    OzOptions none = {0};
    assert_int_equal(OZ_OK, oz_report_parallel_measure(&line, path, OZ_PARALLEL_LINE, 30, &none));
    assert_int_equal(OZ_OK, oz_report_parallel_measure(&fine, path, OZ_PARALLEL_LINE, 90, &none));
    assert_int_equal(OZ_OK,
                     oz_report_parallel_measure(&single, path, OZ_PARALLEL_SINGLE, 30, &none));
    assert_true(fabs(line.energy) < 5e-3 && single.energy > 0.1); /* reasons above */
    /* a smooth torque's change falls with the step, to a third; edges of contacts leave it at half
     */
    assert_true(fine.jump < 0.5 * line.jump && single.jump > 2 * line.jump);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_force_is_the_gradient),
        cmocka_unit_test(test_no_jump_through_zero),
        cmocka_unit_test(test_short_shafts_are_spheres),
        cmocka_unit_test(test_rods_have_no_head),
        cmocka_unit_test(test_skew_shafts_touch_once),
        cmocka_unit_test(test_a_slow_loop_gives_no_energy),
        cmocka_unit_test(test_power_of_dashpots),
        cmocka_unit_test(test_energy_balances),
        cmocka_unit_test(test_an_aligned_bed_keeps_its_energy),
        cmocka_unit_test(test_the_report_tells_them_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
