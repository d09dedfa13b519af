/* Rods outside of round walls: closed forms of one rod on the host reference, its forces against
 * the energy of its overlaps, and a crowd on the device beside it. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

/* A rod of 1 mm and a shaft of 4 mm. */
#define ONE                                                                                        \
    "model: rods\nprecision: double\ngravity: [0, 0, %g]\ntime: {step: 2e-6, duration: 10}\n"      \
    "integrator: velocity-verlet\n"                                                                \
    "contact: {contact_time: 2e-4, restitution: %g, friction: %g}\n"                               \
    "grains: [{kind: single, diameter: 1e-3, aspect: 4, axis: [%g, %g, %g],"                       \
    " position: [%g, %g, %g]}]\n"                                                                  \
    "walls:\n%s"

#define BAR  "  - {kind: cylinder, axis: [0, 1, 0], diameter: 6e-3, side: outside}\n"
#define BALL "  - {kind: sphere, diameter: 6e-3, side: outside}\n"
#define STUMP                                                                                      \
    "  - {kind: cylinder, axis: [0, 1, 0], point: [0, -3e-3, 0], diameter: 6e-3, length: 6e-3,"    \
    " ends: closed, side: outside}\n"

/* Its end is as high as the tops of the others. */
#define STAND                                                                                      \
    "  - {kind: cylinder, point: [0, 0, 3e-3], axis: [0, 0, -1], diameter: 3e-3, length: 9e-3,"    \
    " ends: closed, side: outside}\n"
#define PILLAR                                                                                     \
    "  - {kind: cylinder, point: [0, 0, -6e-3], diameter: 3e-3, length: 9e-3, ends: closed,"       \
    " side: outside}\n"

static const double G = 9.81, R = 0.5e-3, TOP = 3.5e-3, HALF = 2e-3;
static const double PI = 3.14159265358979323846;
enum { STEPS_PER_MS = 500 };

static void assert_within(double a, double b, double most)
{
    if (!(fabs(a - b) <= most)) {
        fail_msg("%.9g is not %.9g within %g", a, b, most);
    }
}

/* N/m. The damped half period is the contact time: k = m_eff (pi^2 + ln(e)^2) / t^2, where the law
 * takes the grain's mass at a wall. */
static double stiffness(double mass, double restitution)
{
    double loss = log(restitution), time = 2e-4;
    return mass * (PI * PI + loss * loss) / (time * time);
}

/* A rod that is balanced across the top bears its weight in one place, at an overlap of the weight
 * by the stiffness. */
static void expect_rest(const char *wall, int places)
{
    Rig rig;
    rig_open(&rig, ONE, -G, 0.3, 0.5, 1.0, 0.0, 0.0, 0.0, 0.0, TOP, wall);
    rig_start(&rig);
    rig_advance(&rig, 40 * STEPS_PER_MS); /* dashpots have died away, as in test_containers */
    double mass = rig.grains.mass[0], push = 0, force[1][3];
    double overlap = mass * G / stiffness(mass, 0.3);
    assert_int_equal(rig.now.contacts.count, places);
    for (int k = 0; k < places; k++) {
        const OzContactEntry *e = &rig.now.contacts.entry[k];
        push += e->push;
        assert_within(e->point[0], 0, 1e-6 * R);
    }
    assert_within(push, mass * G, 1e-6 * mass * G);
    /* of which a millionth of a radius does not touch (OZ_WALL_SHAFT_LEAST) */
    assert_within(TOP - rig.now.position[2], overlap + 1e-6 * R, 1e-3 * overlap);
    oz_contact_list_push_walls(&rig.now.contacts, force, 1);
    assert_within(force[0][2], -mass * G, 1e-6 * mass * G); /* as much on the wall */
    rig_close(&rig);
}

static void rods_balance(void **state)
{
    (void)state;
    expect_rest(BAR, 1);
    expect_rest(BALL, 1);
    expect_rest(STUMP, 1);
}

/* Without friction and loss a rod that falls level with speed v on a place so far from its middle
 * takes away the impulse 2 v / (1 / m + x^2 / I) there. While it touches (2e-4 s) it turns by x v t
 * / (x^2 + I/m), 6e-3: of that order is what is left. */
static void expect_spin(const char *wall, double x)
{
    Rig rig;
    const double speed = 0.05;
    rig_open(&rig, ONE, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, x, 0.0, TOP + 1e-6, wall);
    rig.grains.velocity[2] = -speed;
    rig_start(&rig);
    rig_advance(&rig, STEPS_PER_MS / 2);
    double mass = rig.grains.mass[0], inertia = rig.grains.inertia[0];
    double impulse = 2 * speed / (1 / mass + x * x / inertia);
    assert_int_equal(rig.now.contacts.count, 0);
    assert_within(rig.now.velocity[2], impulse / mass - speed, 1e-2 * speed);
    assert_within(rig.now.angular_velocity[1], impulse * x / inertia,
                  1e-2 * fabs(impulse * x / inertia));
    rig_close(&rig);
}

static void rods_turn_where_they_hit(void **state)
{
    (void)state;
    expect_spin(BAR, 0.7e-3);
    expect_spin(BALL, -1.2e-3);
    expect_spin(STUMP, 0.7e-3);
}

/* A rod that stands so, and what it gets. */
typedef struct Load {
    double energy, force[3], torque[3];
} Load;

static Load load_at(Rig *rig, const double position[3], const double axis[3])
{
    Load load = {0};
    double size = sqrt(dot3(axis, axis)), force[1][3], torque[1][3];
    /* the quaternion that takes z to the axis */
    double u[3] = {axis[0] / size, axis[1] / size, axis[2] / size}, w = sqrt((1 + u[2]) / 2);
    double turn[4] = {w, -u[1] / (2 * w), u[0] / (2 * w), 0};
    memcpy(rig->grains.position, position, 3 * sizeof *position);
    memcpy(rig->grains.quaternion, turn, sizeof turn);
    rig_start(rig);
    const double about[1][3] = {{position[0], position[1], position[2]}};
    oz_contact_list_push_walls(&rig->now.contacts, force, 1);
    oz_contact_list_turn_walls(&rig->now.contacts, about, torque, 1);
    load.energy = oz_contact_list_sum(&rig->now.contacts).energy;
    for (int c = 0; c < 3; c++) {
        load.force[c] = -force[0][c];
        load.torque[c] = -torque[0][c];
    }
    return load;
}

/* Force and torque are minus the slopes of the energy, wherever the rod touches: with its shaft,
 * with an end, or with both. Central differences over 1e-4 radii are right to 1e-4 where curvature
 * does not change, and to what pushes of a millionth of a radius that are left out make. */
static void expect_slopes(const char *wall, double most, const double position[3],
                          const double axis[3])
{
    Rig rig;
    const double way = 1e-4 * R;
    rig_open(&rig, ONE, 0.0, 0.5, 0.0, axis[0], axis[1], axis[2], position[0], position[1],
             position[2], wall);
    Load here = load_at(&rig, position, axis);
    double push = sqrt(dot3(here.force, here.force));
    assert_true(push > 0);
    for (int c = 0; c < 3; c++) {
        double energy[2][2];
        for (int s = 0; s < 2; s++) {
            double moved[3], turned[3], by[3] = {0}, sign = s ? 1 : -1,
                                        size = sqrt(dot3(axis, axis));
            memcpy(moved, position, sizeof moved);
            moved[c] += sign * way;
            by[c] = sign * way / HALF;
            cross3(by, axis, turned);
            for (int k = 0; k < 3; k++) {
                turned[k] = (axis[k] + turned[k]) / size;
            }
            energy[s][0] = load_at(&rig, moved, axis).energy;
            energy[s][1] = load_at(&rig, position, turned).energy;
        }
        assert_within(here.force[c], (energy[0][0] - energy[1][0]) / (2 * way), most * push);
        double slope = (energy[0][1] - energy[1][1]) / (2 * way / HALF);
        double along = dot3(axis, here.torque) / dot3(axis, axis); /* no turn about its own axis */
        assert_within(here.torque[c] - along * axis[c], slope, most * push * HALF);
    }
    rig_close(&rig);
}

static void forces_have_a_potential(void **state)
{
    (void)state;
    const char *const wide = "  - {kind: cylinder, axis: [0, 1, 0], diameter: 2, side: outside,"
                             " point: [0, 0, -0.997]}\n"; /* 500 rods across: its top is at 3 mm */
    const char *const walls[] = {BAR, BALL, wide};
    for (int k = 0; k < 3; k++) {
        expect_slopes(walls[k], 2e-4, (double[]){0.4e-3, 0.1e-3, TOP - 0.05 * R},
                      (double[]){1, 0.3, 0.02});
        expect_slopes(walls[k], 2e-4, (double[]){1.97e-3, 0.1e-3, TOP - 0.1 * R},
                      (double[]){1, 0.01, 0.01});
    }
    /* a solid's round side, across its rim, and from within it out over the rim; an edge has the
     * rod's own curvature, and a point on each side of it is off by 0.004 half shafts */
    expect_slopes(STUMP, 2e-4, (double[]){0.4e-3, 0.1e-3, TOP - 0.05 * R},
                  (double[]){1, 0.3, 0.02});
    expect_slopes(PILLAR, 5e-3, (double[]){0.3e-3, 0.2e-3, TOP - 0.05 * R},
                  (double[]){1, 0.3, 0.004});
    expect_slopes(PILLAR, 2e-4, (double[]){1.2e-3, 0.2e-3, TOP - 0.05 * R},
                  (double[]){1, 0.3, 0.002});
    /* nearly parallel: shaft and both ends, which give way to it */
    expect_slopes(BAR, 2e-4, (double[]){0.15e-3, 0, TOP - 0.08 * R}, (double[]){0.12, 1, 0.005});
    expect_slopes(BAR, 2e-4, (double[]){0.05e-3, 0.1e-3, TOP - 0.05 * R},
                  (double[]){0.05, 1, 0.002});
    expect_slopes(STUMP, 2e-4, (double[]){0.15e-3, 0, TOP - 0.08 * R}, (double[]){0.12, 1, 0.005});
    expect_slopes(wide, 2e-4, (double[]){0, 0.1e-3, TOP - 0.05 * R}, (double[]){1, 0.05, 0.001});
}

/* A rod along a bar lies on two ends, as on a plane. */
static void rods_lie_along(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, ONE, -G, 0.3, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, TOP, BAR);
    rig_start(&rig);
    rig_advance(&rig, 40 * STEPS_PER_MS);
    double weight = rig.grains.mass[0] * G;
    assert_int_equal(rig.now.contacts.count, 2);
    for (int k = 0; k < 2; k++) {
        const OzContactEntry *e = &rig.now.contacts.entry[k];
        assert_within(e->push, weight / 2, 1e-6 * weight);
        assert_within(fabs(e->point[1]), HALF, 1e-6 * HALF);
    }
    rig_close(&rig);
}

/* On a pillar's end it lies on the rim, off the middle on both sides by the law of the lever, or on
 * one side and its own end. Where it tilts by 1e-4 over the round edge contacts lie so far off the
 * rim. */
static void rods_lie_on_a_pillar(void **state)
{
    (void)state;
    const double half = sqrt(1.5 * 1.5 - 0.2 * 0.2) * 1e-3;
    const double at[2] = {0.3e-3, 1.2e-3}, left[2] = {-half, 1.2e-3 - HALF};
    for (int k = 0; k < 2; k++) {
        Rig rig;
        double found[2] = {0, 0};
        rig_open(&rig, ONE, -G, 0.3, 0.5, 1.0, 0.0, 0.0, at[k], 0.2e-3, TOP, k ? PILLAR : STAND);
        rig_start(&rig);
        rig_advance(&rig, 40 * STEPS_PER_MS);
        double weight = rig.grains.mass[0] * G, width = half - left[k];
        for (int64_t i = 0; i < rig.now.contacts.count; i++) {
            const OzContactEntry *e = &rig.now.contacts.entry[i];
            int right = e->point[0] > at[k];
            assert_within(e->point[0], right ? half : left[k], 1e-3 * R);
            found[right] += e->push;
        }
        assert_within(found[0], weight * (half - at[k]) / width, 1e-3 * weight);
        assert_within(found[1], weight * (at[k] - left[k]) / width, 1e-3 * weight);
        rig_close(&rig);
    }
}

/* A rod that is moved over the top: its contact slides from the cap at one end along the shaft to
 * the other. In steps of 5 um the overlap, 50 um, and the slope of the cap against the wall change
 * by a fortieth. */
static void expect_no_jump(const char *wall, double turn, double tilt)
{
    Rig rig;
    Load last = {0};
    const double axis[3] = {cos(tilt) * cos(turn), cos(tilt) * sin(turn), sin(tilt)};
    rig_open(&rig, ONE, 0.0, 0.5, 0.0, 1.0, 0.0, 0.0, 0.0, 0.1e-3, TOP - 0.1 * R, wall);
    double most = 0.1 * R * stiffness(rig.grains.mass[0], 0.5), peak = 0;
    for (int i = 0; i <= 1200; i++) {
        Load now = load_at(&rig, (double[]){-3e-3 + 5e-6 * i, 0.1e-3, TOP - 0.1 * R}, axis);
        for (int c = 0; c < 3 && i > 0; c++) {
            assert_within(now.force[c], last.force[c], 0.05 * most);
            assert_within(now.torque[c], last.torque[c], 0.05 * most * HALF);
        }
        peak = fmax(peak, now.force[2]);
        last = now;
    }
    assert_true(peak > 0.9 * most);
    rig_close(&rig);
}

static void forces_do_not_jump(void **state)
{
    (void)state;
    expect_no_jump(BAR, 0, 0);
    expect_no_jump(BAR, 0.4, 0.03);
    expect_no_jump(BALL, 0.1, 0.01);
    expect_no_jump(STUMP, 0.4, 0.03);
    expect_no_jump(PILLAR, 0, 0);
    expect_no_jump(PILLAR, 0.2, 0.01);
}

/* Grains keep clear of a solid cylinder, and a rod in it would lie behind it. */
static void nothing_lies_within(void **state)
{
    (void)state;
    Rig rig;
    OzScene scene;
    const char *text = "model: rods\ntime: {step: 1e-6, duration: 1}\n"
                       "contact: {contact_time: 1e-4, restitution: 0.5}\n%s"
                       "walls:\n  - {kind: box, size: [9e-3, 9e-3, 9e-3], point: [0, 0, -4e-3]}\n"
                       "  - {kind: sphere, diameter: 2e-3, point: [2e-3, 2e-3, 3e-3], side: "
                       "outside}\n" STUMP;
    int between = 0;
    rig_open(&rig, text, "grains: [{kind: random, count: 150, diameter: 0.3e-3, aspect: 9}]\n");
    for (int64_t i = 0; i < rig.grains.count; i++) {
        const double *x = &rig.grains.position[3 * i], *q = &rig.grains.quaternion[4 * i];
        double u[3] = {2 * (q[1] * q[3] + q[0] * q[2]), 2 * (q[2] * q[3] - q[0] * q[1]),
                       1 - 2 * (q[1] * q[1] + q[2] * q[2])};
        double nearest[2] = {INFINITY, INFINITY};
        for (int k = -50; k <= 50; k++) {
            double p[3], along = k / 50.0 * 0.5 * rig.grains.length[i];
            for (int c = 0; c < 3; c++) {
                p[c] = x[c] + along * u[c];
            }
            double gap = fmax(hypot(p[0], p[2]) - 3e-3, fabs(p[1]) - 3e-3);
            double ball = sqrt(pow(p[0] - 2e-3, 2) + pow(p[1] - 2e-3, 2) + pow(p[2] - 3e-3, 2));
            between += abs(k) < 40 && gap < nearest[0] && gap < 0.3e-3;
            nearest[0] = fmin(nearest[0], gap);
            nearest[1] = fmin(nearest[1], ball - 1e-3);
        }
        assert_true(nearest[0] > 0); /* at a rim a cap may be nearer to both than its radius */
        assert_true(nearest[1] > 0.14e-3);
    }
    assert_true(between > 0);
    rig_close(&rig);
    char whole[1024];
    snprintf(whole, sizeof whole, text,
             "grains: [{kind: single, diameter: 0.3e-3, aspect: 4, position: [0, 0, 1e-3]}]\n");
    assert_int_equal(oz_scene_parse(&scene, "rig.yaml", whole, NULL, 0), OZ_ERR_INPUT);
    assert_true(strstr(oz_status_text(), "lies behind walls.2") != NULL);
    oz_scene_free(&scene);
}

/* Rods and spheres fall over a bar that is shaken, a ball and a stump that turns. */
static const char crowd[] =
    "model: rods\nprecision: %s\ntime: {step: 1e-5, duration: 1}\nintegrator: velocity-verlet\n"
    "observe: {ledger: true}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4}\ngrains:\n"
    "  - {kind: random, count: 60, diameter: 0.6e-3, aspect: 3}\n"
    "  - {kind: random, count: 20, diameter: 0.6e-3}\n"
    "walls:\n"
    "  - {kind: box, size: [7e-3, 7e-3, 9e-3]}\n"
    "  - {kind: cylinder, axis: [1, 0, 0], diameter: 1.6e-3, point: [0, 2e-3, 3e-3], side: outside,"
    " motion: {direction: [0, 0, 1], frequency: 200, amplitude: 5e-5}}\n"
    "  - {kind: sphere, diameter: 3e-3, point: [0, -2e-3, 4e-3], side: outside}\n"
    "  - {kind: cylinder, axis: [0, 0, 1], diameter: 1e-3, point: [2.5e-3, 0, 1e-3], length: 5e-3,"
    " ends: closed, side: outside, motion: {angular_velocity: 100}}\n";

enum { STEPS = 250 };

static void the_device_does_as_the_reference(void **state)
{
    (void)state;
    const char *const precisions[] = {"double", "float"};
    const double tolerances[] = {1e-9, 1e-3}; /* chaos amplifies rounding, as in test_shafts */
    for (int k = 0; k < 2; k++) {
        Rig rig;
        int at_shafts = 0;
        rig_open(&rig, crowd, precisions[k]);
        throw_grains(&rig.grains, 0.8, 20);
        OzSnapshot seen = state_after(&rig, NATIVE, STEPS);
        rig_start(&rig);
        for (int step = STEPS / 50; step <= STEPS; step += STEPS / 50) {
            rig_advance(&rig, step);
            for (int64_t i = 0; i < rig.now.contacts.count; i++) {
                const OzContactEntry *e = &rig.now.contacts.entry[i];
                at_shafts += e->part_a >= 2 * 9; /* behind the ends at all sides */
            }
        }
        assert_true(at_shafts > 10);
        assert_true(farthest(seen.velocity, rig.now.velocity, 3 * seen.count) < tolerances[k]);
        assert_true(farthest(seen.position, rig.now.position, 3 * seen.count) < tolerances[k]);
        assert_int_equal(oz_contact_list_sum(&seen.contacts).walls,
                         oz_contact_list_sum(&rig.now.contacts).walls);
        double work = rig.now.ledger.work_walls;
        assert_true(fabs(work) > 1e-10 &&
                    fabs(seen.ledger.work_walls - work) < 1e2 * tolerances[k] * fabs(work));
        oz_snapshot_free(&seen);
        rig_close(&rig);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rods_balance),
        cmocka_unit_test(rods_turn_where_they_hit),
        cmocka_unit_test(forces_have_a_potential),
        cmocka_unit_test(rods_lie_along),
        cmocka_unit_test(rods_lie_on_a_pillar),
        cmocka_unit_test(forces_do_not_jump),
        cmocka_unit_test(nothing_lies_within),
        cmocka_unit_test(the_device_does_as_the_reference),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
