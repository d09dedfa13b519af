/* Walls with edges: closed forms of one sphere on the host reference, and a hopper of joined walls
 * on the device beside it. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "export/surface.h"

/* A sphere of 1 mm in walls of its own. */
#define ONE                                                                                        \
    "model: rods\nprecision: double\ngravity: [%g, %g, %g]\ntime: {step: 2e-6, duration: 10}\n"    \
    "integrator: velocity-verlet\n"                                                                \
    "contact: {contact_time: 2e-4, restitution: %g, friction: %g}\n"                               \
    "grains: [{kind: single, diameter: 1e-3, position: [%g, %g, %g]}]\n"                           \
    "walls:\n%s"

static const double G = 9.81, R = 0.5e-3;
enum { STEPS_PER_MS = 500 };

static void assert_within(double a, double b, double most)
{
    if (!(fabs(a - b) <= most)) {
        fail_msg("%.9g is not %.9g within %g", a, b, most);
    }
}

/* A smooth sphere lies on an edge, beside it by so much, and leans on its mirror image or an
 * upright plane: forces of the edge over the weight. Overlaps at rest are 2e-5 radii, which shift
 * the edge's direction by a few times as much; dashpots have died away to 1e-9 after 40 ms, 200
 * contact times. */
static void expect_edge(const char *walls, double x, double beside, double share)
{
    Rig rig;
    double force[2][3], z = sqrt(R * R - beside * beside);
    rig_open(&rig, ONE, 0.0, 0.0, -G, 0.3, 0.0, x, 0.0, z, walls);
    rig_start(&rig);
    rig_advance(&rig, 40 * STEPS_PER_MS);
    oz_contact_list_push_walls(&rig.now.contacts, force, 2);
    double weight = rig.grains.mass[0] * G, aside = share * weight * beside / z;
    assert_within(force[0][2], -share * weight, 1e-7 * weight);
    assert_within(force[0][0], -aside, 3e-4 * weight);
    assert_within(force[1][0], aside, 3e-4 * weight);
    assert_within(rig.now.position[2], z, 3e-4 * R);
    rig_close(&rig);
}

static void a_sphere_lies_on_edges(void **state)
{
    (void)state;
    /* a slot between two rectangles, one of them turned over and told by another edge */
    expect_edge("  - {kind: rectangle, point: [-2.3e-3, 0, 0], size: [4e-3, 6e-3]}\n"
                "  - {kind: rectangle, point: [2.3e-3, 0, 0], normal: [0, 0, -2],"
                " edge: [0, 3, 0], size: [6e-3, 4e-3]}\n",
                0, 0.3e-3, 0.5);
    /* the rim of a disc and a plane */
    expect_edge("  - {kind: disc, diameter: 8e-3}\n"
                "  - {kind: plane, normal: [-1, 0, 0], point: [4.7e-3, 0, 0]}\n",
                4.2e-3, 0.2e-3, 1);
    /* the mouth of a tube and a plane */
    expect_edge("  - {kind: cylinder, diameter: 8e-3, axis: [0, 0, -1], length: 5e-3}\n"
                "  - {kind: plane, normal: [-1, 0, 0], point: [4.7e-3, 0, 0]}\n",
                4.2e-3, 0.2e-3, 1);
}

/* Where it is, how it goes and how it turns, in units of the way and the speed that it has made. */
static void assert_same_way(const Rig *a, const Rig *b, double most)
{
    double way = fabs(a->now.position[0] - a->grains.position[0]);
    double speed = fabs(a->now.velocity[0]);
    for (int k = 0; k < 3; k++) {
        assert_within(b->now.position[k], a->now.position[k], most * way);
        assert_within(b->now.velocity[k], a->now.velocity[k], most * speed);
        assert_within(R * b->now.angular_velocity[k], R * a->now.angular_velocity[k], most * speed);
    }
}

/* What rolls or slides down a slope over joints of rectangles does as on one plane. The distances
 * differ by rounding; a joint that is felt, or a spring that is lost at it, shows in the first
 * digits. */
static void joints_are_not_felt(void **state)
{
    (void)state;
    const char *plane = "  - {kind: plane}\n";
    const char *tiles = "  - {kind: rectangle, point: [1e-3, 0, 0], size: [2e-3, 4e-3]}\n"
                        "  - {kind: rectangle, point: [-1e-3, 0, 0], size: [2e-3, 4e-3]}\n"
                        "  - {kind: rectangle, point: [3e-3, 1e-3, 0], size: [2e-3, 2e-3]}\n"
                        "  - {kind: rectangle, point: [3e-3, -1e-3, 0], size: [2e-3, 2e-3]}\n";
    for (int slides = 0; slides < 2; slides++) {
        Rig rigs[2];
        for (int k = 0; k < 2; k++) {
            rig_open(&rigs[k], ONE, 3.0, 0.4, -9.0, 0.3, slides ? 0.1 : 5.0, -1e-3, -0.1e-3, R,
                     k ? tiles : plane);
            rig_start(&rigs[k]);
            rig_advance(&rigs[k], 50 * STEPS_PER_MS);
        }
        assert_true(rigs[0].now.position[0] > 1.5e-3);
        assert_same_way(&rigs[0], &rigs[1], 1e-6);
        rig_close(&rigs[0]);
        rig_close(&rigs[1]);
    }
}

/* Without loss and friction what hits a rim or a corner goes on as fast as before. With 100 steps
 * in a contact velocity-verlet is right to (2 pi / 200)^2 of a deviation that comes back to a ten
 * thousandth. */
static void expect_speed_kept(const char *walls, double x, double z)
{
    Rig rig;
    rig_open(&rig, ONE, 0.0, 0.0, 0.0, 1.0, 0.0, x, 0.1e-3, z, walls);
    rig.grains.velocity[0] = 0.05;
    rig.grains.velocity[2] = -0.4;
    rig_start(&rig);
    rig_advance(&rig, 8 * STEPS_PER_MS);
    const double *v = rig.now.velocity;
    assert_true(fabs(v[0] - 0.05) > 0.05); /* it has hit the rim, not the face */
    assert_within(sqrt(dot3(v, v)), sqrt(0.05 * 0.05 + 0.4 * 0.4), 1e-4 * 0.4);
    rig_close(&rig);
}

static void a_rim_gives_back(void **state)
{
    (void)state;
    expect_speed_kept("  - {kind: disc, diameter: 8e-3}\n", 4e-3, 1.5e-3);
    expect_speed_kept("  - {kind: rectangle, size: [8e-3, 0.1e-3], point: [0, -0.1e-3, 0]}\n", 4e-3,
                      1.5e-3);
    expect_speed_kept("  - {kind: cone, point: [0, 0, -3e-3], diameter: [2e-3, 8e-3],"
                      " length: 3e-3}\n",
                      3.9e-3, 1.5e-3);
}

static const char hopper[] =
    "model: rods\nprecision: double\ntime: {step: 1e-5, duration: 1}\nintegrator: velocity-verlet\n"
    "observe: {ledger: true}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4}\ngrains:\n"
    "  - {kind: random, count: 90, diameter: 1e-3}\n"
    "walls:\n"
    "  - {kind: cone, diameter: [2e-3, 6e-3], length: 3e-3}\n"
    "  - {kind: cylinder, diameter: 6e-3, point: [0, 0, 3e-3], length: 5e-3}\n"
    "  - {kind: rectangle, point: [-1e-3, 0, 0], size: [2e-3, 4e-3], "
    "motion: {direction: [1, 0, 1], frequency: 200, amplitude: 5e-5}}\n"
    "  - {kind: rectangle, point: [1e-3, 0, 0], size: [2e-3, 4e-3]}\n"
    "  - {kind: disc, point: [0, 0, 8e-3], normal: [0, 0, -1], diameter: 6e-3,"
    " motion: {angular_velocity: 100}}\n";

/* The radius that the hopper has at a height, m. */
static double radius_at(double z)
{
    return z < 3e-3 ? 1e-3 + z / 3e-3 * 2e-3 : 3e-3;
}

/* Spheres are put into the hopper alone, clear of it, and both its parts are filled: a ball touches
 * the slope where its radius is larger by a factor of its inclination's secant, root of 13/9. */
static void random_grains_are_put_inside(void **state)
{
    (void)state;
    Rig rig;
    int below = 0;
    rig_open(&rig, hopper);
    for (int64_t i = 0; i < rig.grains.count; i++) {
        const double *x = &rig.grains.position[3 * i];
        double secant = x[2] < 3e-3 ? sqrt(13) / 3 : 1;
        assert_true(x[2] >= R && x[2] <= 8e-3 - R);
        assert_true(hypot(x[0], x[1]) <= radius_at(x[2]) - R * fmin(secant, 1));
        below += x[2] < 3e-3;
    }
    assert_true(below > 4 && below < 45); /* a fifth of the room */
    rig_close(&rig);
}

/* Exported surfaces: areas by Newell's sum over corners. Round ones have 64 corners around, and 0.2
 * % less than circles. */
static void surfaces_are_as_large_as_walls(void **state)
{
    (void)state;
    Rig rig;
    OzSurface surface = {0};
    double area[5] = {0};
    const double pi = 3.14159265358979323846,
                 right[] = {pi * (1e-3 + 3e-3) * sqrt(13) * 1e-3, 2 * pi * 3e-3 * 5e-3, 8e-6, 8e-6,
                            pi * 9e-6};
    rig_open(&rig, hopper);
    rig_start(&rig);
    must(oz_surface_add_walls(&surface, &rig.now));
    for (int64_t cell = 0, first = 0; cell < surface.cell_count; first = surface.ends[cell++]) {
        double sum[3] = {0};
        for (int64_t c = first; c < surface.ends[cell]; c++) {
            int64_t next = c + 1 < surface.ends[cell] ? c + 1 : first;
            double a[3], b[3], product[3];
            for (int k = 0; k < 3; k++) {
                a[k] = (double)surface.points[3 * surface.corners[c] + k];
                b[k] = (double)surface.points[3 * surface.corners[next] + k];
            }
            cross3(a, b, product);
            for (int k = 0; k < 3; k++) {
                sum[k] += product[k] / 2;
            }
        }
        area[surface.owner[cell]] += sqrt(dot3(sum, sum));
    }
    for (int w = 0; w < 5; w++) {
        assert_within(area[w], right[w], 3e-3 * right[w]);
    }
    oz_surface_free(&surface);
    rig_close(&rig);
}

enum { STEPS = 250, LONG = 6000 };

/* None leaks, at the joints of cone and tube, tube and lid, cone and floor or between the tiles: a
 * thousandth of a radius is what they press in. */
static void assert_held(const OzSnapshot *now)
{
    for (int64_t i = 0; i < now->count; i++) {
        const double *x = &now->position[3 * i];
        assert_true(x[2] > 0.9 * R - 5e-5 && x[2] < 8e-3 - 0.9 * R);
        assert_true(hypot(x[0], x[1]) < radius_at(x[2]) - 0.9 * R);
    }
}

/* As in test_containers: after some hundred steps with hits rounding has grown a thousandfold; a
 * wrong term shows in the first digits. */
static void the_device_does_as_the_reference(void **state)
{
    (void)state;
    Rig rig;
    OzDevice device = shaped_device(NATIVE);
    rig_open(&rig, hopper);
    throw_grains(&rig.grains, 1, 20);
    OzSim *sim = start_sim(&rig, &device);
    OzSnapshot seen = state_at(&rig, sim, STEPS);
    rig_start(&rig);
    rig_advance(&rig, STEPS);
    assert_true(farthest(seen.velocity, rig.now.velocity, 3 * seen.count) < 1e-9);
    assert_true(farthest(seen.position, rig.now.position, 3 * seen.count) < 1e-9);
    assert_true(oz_contact_list_sum(&seen.contacts).walls > 5);
    assert_int_equal(oz_contact_list_sum(&seen.contacts).walls,
                     oz_contact_list_sum(&rig.now.contacts).walls);
    oz_snapshot_free(&seen);
    seen = state_at(&rig, sim, LONG);
    assert_held(&seen);
    oz_snapshot_free(&seen);
    oz_sim_free(sim);
    rig_close(&rig);
}

/* The hopper's walls otherwise: a slope of two tiles, the other walls out of the way. */
static const char slope[] =
    "model: rods\nprecision: double\ntime: {step: 1e-5, duration: 1}\nintegrator: velocity-verlet\n"
    "gravity: [3, 0.4, -9]\nobserve: {ledger: true}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4}\ngrains:\n"
    "  - {kind: lattice, diameter: 1e-3, cells: [1, 4, 1], spacing: [1, 1.1e-3, 1],"
    " position: [-1.1e-3, -1.7e-3, 0.5e-3]}\n"
    "walls:\n"
    "  - {kind: cone, point: [0.1, 0, 0], diameter: [2e-3, 6e-3], length: 3e-3}\n"
    "  - {kind: cylinder, point: [0.1, 0, 0], diameter: 6e-3, length: 5e-3}\n"
    "  - {kind: rectangle, point: [2e-3, 0, 0], size: [4e-3, 8e-3]}\n"
    "  - {kind: rectangle, point: [-2e-3, 0, 0], size: [4e-3, 8e-3]}\n"
    "  - {kind: disc, point: [0.1, 0, 0], diameter: 6e-3, motion: {angular_velocity: 100}}\n";

/* A spring goes over the joint on the device as it does on the host: rolling spheres have the same
 * friction before and behind it, 2/7 of what pulls along the slope. */
static void springs_go_over_joints(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, slope);
    const double *g = rig.scene.gravity;
    OzDevice device = shaped_device(NATIVE);
    OzSim *sim = start_sim(&rig, &device);
    for (int64_t step = 1000; step <= 5000; step += 100) {
        OzSnapshot seen = state_at(&rig, sim, step);
        assert_int_equal(seen.contacts.count, 4);
        for (int i = 0; i < 4; i++) {
            const OzContactEntry *e = &seen.contacts.entry[i];
            assert_int_equal(e->b, seen.position[3 * e->a] > 0 ? -3 : -4);
            double pull = 2.0 / 7 * rig.grains.mass[e->a] * hypot(g[0], g[1]);
            assert_within(hypot(e->tangential[0], e->tangential[1]), pull, 1e-2 * pull);
        }
        oz_snapshot_free(&seen);
    }
    oz_sim_free(sim);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_lies_on_edges),
        cmocka_unit_test(joints_are_not_felt),
        cmocka_unit_test(a_rim_gives_back),
        cmocka_unit_test(random_grains_are_put_inside),
        cmocka_unit_test(surfaces_are_as_large_as_walls),
        cmocka_unit_test(the_device_does_as_the_reference),
        cmocka_unit_test(springs_go_over_joints),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
