/* Single bodies and small heaps in the host reference against what mechanics says: rest on a plane,
 * sliding and rolling, free rotation, and the order of each integrator. */
#include "rig.h"

#include "model/contact.h"

static const double pi = 3.14159265358979323846;
static const char *const floor_wall =
    "walls: [{kind: plane, point: [0, 0, 0], normal: [0, 0, 1]}]\n";

/* A flat rod, or a sphere for aspect 0, that barely touches the floor. */
static void open_on_floor(Rig *rig, double aspect, double friction, const char *slip)
{
    rig_open(rig,
             "model: rods\ntime: {step: 3e-6, duration: 1}\nintegrator: velocity-verlet\n"
             "contact: {contact_time: 1e-4, restitution: 0.4, friction: %g, slip: %s}\n"
             "grains: [{kind: single, diameter: 1e-3, aspect: %g, axis: [1, 0, 0],"
             " position: [0, 0, 0.5e-3]}]\n%s",
             friction, slip, aspect, floor_wall);
}

/* Lowers the grain to where its weight is borne by `contacts` springs. */
static void sink(Rig *rig, int contacts)
{
    OzContactConstants c = oz_contact_constants(&rig->scene.contact);
    rig->grains.position[2] -= 9.81 / (contacts * c.stiffness);
}

static void test_rest_on_a_plane(void **state)
{
    (void)state;
    for (int ends = 1; ends <= 2; ends++) {
        Rig rig;
        open_on_floor(&rig, ends == 1 ? 0 : 4, 0.3, "cut");
        OzContactConstants c = oz_contact_constants(&rig.scene.contact);
        rig_start(&rig);
        rig_advance(&rig, 2000); /* 60 contact times: oscillations died out by 0.4^60 */
        assert_int_equal(oz_contact_list_sum(&rig.now.contacts).walls, ends);
        assert_int_equal(oz_contact_list_sum(&rig.now.contacts).pairs, 0);
        /* k xi = m g / ends, k = kappa m; xi of 1e-8 m is a difference of coordinates of 5e-4 m */
        double expected = 9.81 / (ends * c.stiffness);
        assert_true(fabs(oz_contact_list_sum(&rig.now.contacts).overlap_max / expected - 1) < 1e-9);
        assert_true(fabs(oz_contact_list_sum(&rig.now.contacts).overlap_sum / (ends * expected) -
                         1) < 1e-9);
        /* what swung is gone; rounding of overlaps: 1e-14 */
        assert_true(fabs(rig.now.velocity[2]) < 1e-12);
        rig_close(&rig);
    }
}

/* The spring that starts it takes mu g / kappa_t = 4e-9 m of sliding, 1e-6 of the way: nothing.
 * What is left is the overlap, 1e-5 of the lever. */
static void test_sliding_sphere_ends_rolling(void **state)
{
    (void)state;
    Rig rig;
    const double v0 = 0.05, deceleration = 0.3 * 9.81, rolls = 2 * v0 / (7 * deceleration);
    open_on_floor(&rig, 0, 0.3, "cut");
    sink(&rig, 1);
    rig.grains.velocity[0] = v0;
    rig_start(&rig);
    rig_advance(&rig, (int64_t)(0.5 * rolls / 3e-6));
    /* Coulomb's limit all the way: rounding of thousands of steps */
    assert_true(fabs(rig.now.velocity[0] - (v0 - deceleration * rig.now.time)) < 1e-9 * v0);
    rig_advance(&rig, (int64_t)(2 * rolls / 3e-6));
    /* the overlap, 1e-5 of the lever */
    assert_true(fabs(rig.now.velocity[0] / (5.0 / 7 * v0) - 1) < 2e-5);
    assert_true(fabs(rig.now.angular_velocity[1] * 0.5e-3 / rig.now.velocity[0] - 1) < 2e-5);
    rig_close(&rig);
}

/* Speed of a flat rod that slides along its axis less what Coulomb says after half a stopping
 * time, and as it is after two. */
static void slide_rod(const char *slip, double *half, double *after)
{
    Rig rig;
    const double v0 = 0.05, stops = v0 / (0.3 * 9.81);
    open_on_floor(&rig, 4, 0.3, slip);
    sink(&rig, 2);
    rig.grains.velocity[0] = v0;
    rig_start(&rig);
    rig_advance(&rig, (int64_t)(0.5 * stops / 3e-6));
    *half = rig.now.velocity[0] - (v0 - 0.3 * 9.81 * rig.now.time);
    rig_advance(&rig, (int64_t)(2 * stops / 3e-6));
    *after = rig.now.velocity[0];
    rig_close(&rig);
}

static void test_sliding_rod(void **state)
{
    (void)state;
    double half, after;
    slide_rod("cut", &half, &after);
    /* friction below the centre pitches the rod by 1e-5: what one end bears more the other bears
     * less, to the square of that; the dashpot alone is beyond Coulomb's limit from the first step
     * on */
    assert_true(fabs(half) < 1e-9 * 0.05);
    assert_true(fabs(after) < 1e-9 * 0.05);
    slide_rod("scale", &half, &after);
    assert_true(fabs(half) < 1e-9 * 0.05);
    /* the spring that grew with the sliding throws it back: the literal reading of the paper */
    assert_true(after < -0.8 * 0.05);
}

static void open_spinning(Rig *rig, const char *gyroscopic)
{
    rig_open(rig,
             "model: rods\ntime: {step: 1e-5, duration: 1}\nintegrator: symplectic-euler\n"
             "gravity: [0, 0, 0]\ngyroscopic: %s\ncontact: {contact_time: 1e-3, restitution: 0.5}\n"
             "grains: [{kind: single, diameter: 1e-3, aspect: 4, axis: [1, 2, 3],"
             " position: [0, 0, 0], spin: [300, -100, 200]}]\n",
             gyroscopic);
}

/* Angle between two vectors. */
static double angle_between(const double *a, const double *b)
{
    double across[3];
    cross3(a, b, across);
    return atan2(sqrt(dot3(across, across)), dot3(a, b));
}

/* The axis of a free axisymmetric body goes round the angular momentum L at |L| / I. Each step is
 * the exact motion but for the series of sine and cosine, 1e-13 at 4e-3 rad, and rounding. */
static void test_free_rotation_precesses(void **state)
{
    (void)state;
    Rig rig;
    double before[3], after[3], mean[3], axis[3];
    open_spinning(&rig, "true");
    rig_start(&rig);
    own_momentum(&rig.now, 0, before);
    memcpy(axis, rig.now.axis, sizeof axis);
    double size = sqrt(dot3(before, before)), energy = mechanical_energy(&rig.now);
    double nutation = angle_between(axis, before), rate = size / rig.grains.inertia[0];
    for (int turn = 1; turn <= 20; turn++) {
        rig_advance(&rig, (int64_t)round(turn * 2 * pi / rate / 1e-5));
        own_momentum(&rig.now, 0, after);
        for (int c = 0; c < 3; c++) {
            mean[c] = after[c] - before[c];
        }
        /* rounding of thousands of steps: 5e-15 */
        assert_true(sqrt(dot3(mean, mean)) < 1e-13 * size);
        assert_true(fabs(mechanical_energy(&rig.now) / energy - 1) < 1e-12);
        assert_true(fabs(angle_between(rig.now.axis, after) - nutation) < 1e-12);
        /* whole turns but for the rounding of the time to steps */
        double phase = remainder(rate * rig.now.time, 2 * pi);
        double chord = 2 * asin(sin(nutation) * fabs(sin(phase / 2)));
        assert_true(fabs(angle_between(rig.now.axis, axis) - chord) < 1e-11);
    }
    rig_close(&rig);
}

/* The quaternion itself, whose turn about the axis no axis shows: over a step it turns by spin
 * times dt, to the square of what spin changes in a step, 4e-3 of it. */
static void test_orientation_follows_the_spin(void **state)
{
    (void)state;
    for (int gyroscopic = 0; gyroscopic < 2; gyroscopic++) {
        Rig rig;
        double q[4], turned[3];
        open_spinning(&rig, gyroscopic ? "true" : "false");
        rig_start(&rig);
        memcpy(q, rig.now.quaternion, sizeof q);
        rig_advance(&rig, 1);
        const double *p = rig.now.quaternion;
        cross3(&q[1], &p[1], turned);
        for (int c = 0; c < 3; c++) { /* the vector of p times q inverse, twice over dt */
            double rate = 2 / 1e-5 * (q[0] * p[1 + c] - p[0] * q[1 + c] + turned[c]);
            double mean = 0.5 * (rig.grains.angular_velocity[c] + rig.now.angular_velocity[c]);
            assert_true(fabs(rate - mean) < 2e-6 * 374); /* |spin|; a twelfth of that square */
        }
        rig_close(&rig);
    }
}

/* Without the gyroscopic term (P eq. 9) it is the angular velocity that stays. */
static void test_free_rotation_of_the_paper(void **state)
{
    (void)state;
    Rig rig;
    open_spinning(&rig, "false");
    rig_start(&rig);
    double start = angle_between(rig.now.axis, rig.now.angular_velocity);
    rig_advance(&rig, 5000);
    for (int c = 0; c < 3; c++) {
        assert_true(rig.now.angular_velocity[c] == rig.grains.angular_velocity[c]);
    }
    /* rounding of 5000 steps */
    assert_true(fabs(angle_between(rig.now.axis, rig.now.angular_velocity) - start) < 1e-13);
    rig_close(&rig);
}

/* A rod across two rods on a floor, set down with half of its overlaps and leaning aside:
 * everything touches and sticks all the time, so that positions are smooth in the time step. */
static void open_heap(Rig *rig, int integrator, const char *point, double step)
{
    rig_open(rig,
             "model: rods\ntime: {step: %.17g, duration: 1}\nintegrator: %s\n"
             "gravity: [0.7, 0.4, -9.81]\ncontact: {contact_time: 1e-3, restitution: 0.7,"
             " friction: 2, contact_point: %s}\n"
             "grains:\n  - {kind: single, diameter: 1e-3, aspect: 4, axis: [1, 0, 0],"
             " position: [0, 1.2e-3, 0.4996e-3]}\n"
             "  - {kind: single, diameter: 1e-3, aspect: 4, axis: [1, 0, 0],"
             " position: [0.1e-3, -1.2e-3, 0.4996e-3]}\n"
             "  - {kind: single, diameter: 1e-3, aspect: 5, axis: [0, 1, 0],"
             " position: [0.05e-3, 0.1e-3, 1.499e-3]}\n%s",
             step, integrator_names[integrator], point, floor_wall);
}

enum { HEAP = 3 * 9 };

/* Positions (in diameters), axes and velocities (in diameters a contact time) after three of them.
 */
static void run_heap(int integrator, const char *point, int steps, double state[HEAP])
{
    Rig rig;
    open_heap(&rig, integrator, point, 1e-3 / steps);
    rig_start(&rig);
    rig_advance(&rig, 3 * steps);
    assert_int_equal(oz_contact_list_sum(&rig.now.contacts).walls, 4);
    assert_int_equal(oz_contact_list_sum(&rig.now.contacts).pairs, 2);
    for (int k = 0; k < 9; k++) {
        state[k] = rig.now.position[k] / 1e-3;
        state[9 + k] = rig.now.axis[k];
        state[18 + k] = rig.now.velocity[k];
    }
    rig_close(&rig);
}

static double distance(const double *a, const double *b)
{
    double sum = 0;
    for (int k = 0; k < HEAP; k++) {
        sum += (a[k] - b[k]) * (a[k] - b[k]);
    }
    return sqrt(sum);
}

/* Halving the step divides the change by 2^order; at 400 steps a contact time the next order in the
 * step is still a tenth of it. */
static void check_order(int integrator, const char *point, int order)
{
    double coarse[HEAP], middle[HEAP], fine[HEAP];
    run_heap(integrator, point, 400, coarse);
    run_heap(integrator, point, 800, middle);
    run_heap(integrator, point, 1600, fine);
    double ratio = distance(coarse, middle) / distance(middle, fine);
    if (!(fabs(log2(ratio) - order) < 0.15)) {
        fail_msg("%s, %s: order %g instead of %d", integrator_names[integrator], point, log2(ratio),
                 order);
    }
}

static void test_order_of_the_integrators(void **state)
{
    (void)state;
    const int orders[INTEGRATORS] = {1, 1, 2};
    for (int integrator = 0; integrator < INTEGRATORS; integrator++) {
        check_order(integrator, "midpoint", orders[integrator]);
        check_order(integrator, "surfaces", orders[integrator]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rest_on_a_plane),
        cmocka_unit_test(test_sliding_sphere_ends_rolling),
        cmocka_unit_test(test_sliding_rod),
        cmocka_unit_test(test_free_rotation_precesses),
        cmocka_unit_test(test_orientation_follows_the_spin),
        cmocka_unit_test(test_free_rotation_of_the_paper),
        cmocka_unit_test(test_order_of_the_integrators),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
