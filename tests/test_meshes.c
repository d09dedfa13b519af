/* Walls of triangles: against planes and closed forms on the host reference, and a crowd in a mesh
 * on the device beside it. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "export/surface.h"
#include "mesh_files.h"
#include "sim/sim_state.h"

static const double G = 9.81, R = 0.5e-3;
enum { STEPS_PER_MS = 500 };

/* A grain of 1 mm on a slope. */
#define ONE                                                                                        \
    "model: rods\nprecision: double\ngravity: [%g, %g, %g]\ntime: {step: 2e-6, duration: 10}\n"    \
    "integrator: velocity-verlet\n"                                                                \
    "contact: {contact_time: 2e-4, restitution: %g, friction: %g}\n"                               \
    "grains: [{kind: single, diameter: 1e-3, aspect: %g, axis: [%g, %g, %g],"                      \
    " position: [%g, %g, %g]}]\nwalls:\n%s"

static void assert_within(double a, double b, double most)
{
    if (!(fabs(a - b) <= most)) {
        fail_msg("%.9g is not %.9g within %g", a, b, most);
    }
}

/* A line of a scene's walls. */
static const char *mesh_wall(const char *path, const char *rest)
{
    static char text[4][256];
    static int next;
    char *to = text[next++ % 4];
    snprintf(to, sizeof text[0], "  - {kind: mesh, path: '%s'%s}\n", path, rest);
    return to;
}

/* Places, velocities and spins of one grain, in units of the way and the speed that it has made. */
static void assert_same_way(const Rig *a, const Rig *b, double most)
{
    double way = fabs(a->now.position[0] - a->grains.position[0]);
    double speed = fabs(a->now.velocity[0]);
    assert_true(way > 2e-3);
    for (int k = 0; k < 3; k++) {
        assert_within(b->now.position[k], a->now.position[k], most * way);
        assert_within(b->now.velocity[k], a->now.velocity[k], most * speed);
        assert_within(R * b->now.angular_velocity[k], R * a->now.angular_velocity[k], most * speed);
    }
}

/* What rolls, slides or tumbles over 200 triangles, a tenth to half of a grain wide, does as on one
 * plane. The distances differ by rounding; a joint that is felt, or a spring that is lost at it,
 * shows in the first digits. */
static void joints_are_not_felt(void **state)
{
    (void)state;
    const char *path = mesh_floor(20, 12);
    const struct {
        double friction, aspect, axis[3], height;
    } cases[] = {{5, 0, {0, 0, 1}, 1},     {0.1, 0, {0, 0, 1}, 1},   {5, 3, {0, 1, 0}, 1},
                 {0.1, 3, {1, 0.3, 0}, 1}, {0.1, 3, {0.3, 1, 0}, 1}, {0.5, 3, {1, 2, 2}, 3.5}};
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        Rig rigs[2];
        const char *walls[] = {"  - {kind: plane}\n", mesh_wall(path, ", scale: 1e-3")};
        for (int k = 0; k < 2; k++) {
            rig_open(&rigs[k], ONE, 3.0, 0.4, -9.0, 0.3, cases[c].friction, cases[c].aspect,
                     cases[c].axis[0], cases[c].axis[1], cases[c].axis[2], -2e-3, -0.1e-3,
                     cases[c].height * R, walls[k]);
            rig_start(&rigs[k]);
            rig_advance(&rigs[k], 60 * STEPS_PER_MS);
        }
        assert_same_way(&rigs[0], &rigs[1], 1e-6); /* asked for: 1e-3 */
        rig_close(&rigs[0]);
        rig_close(&rigs[1]);
    }
}

/* A smooth sphere lies in a slot between two triangles, on their edges: half its weight each. */
static void a_sphere_lies_on_edges(void **state)
{
    (void)state;
    Rig rig;
    const double beside = 0.3, z = 0.4e-3;
    const char *slot = "v -4 -3 0\nv -0.3 -3 0\nv -0.3 3 0\nv -4 3 0\nf 1 2 3 4\n"
                       "v 0.3 -3 0\nv 4 -3 0\nv 4 3 0\nv 0.3 3 0\nf -4 -3 -2 -1\n";
    rig_open(&rig, ONE, 0.0, 0.0, -G, 0.3, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, z,
             mesh_wall(mesh_of_text(slot, "obj"), ", scale: 1e-3"));
    rig_start(&rig);
    rig_advance(&rig, 40 * STEPS_PER_MS);
    double weight = rig.grains.mass[0] * G;
    assert_int_equal(rig.now.contacts.count, 2);
    for (int i = 0; i < 2; i++) { /* overlaps at rest are 2e-5 radii */
        const OzContactEntry *e = &rig.now.contacts.entry[i];
        assert_within(e->push * 0.8, weight / 2, 3e-4 * weight);
        assert_within(fabs(e->point[0]), beside * 1e-3, 3e-4 * R);
    }
    assert_within(rig.now.position[2], z, 3e-4 * R);
    rig_close(&rig);
}

/* A contact of a rod at rest: where along x, and its share of the weight. */
typedef struct Rest {
    double x, share;
} Rest;

/* As in test_shafts: the law of the lever. */
static void expect_rest(const char *mesh, double x, const Rest rests[2])
{
    Rig rig;
    double found[2] = {0, 0};
    rig_open(&rig, ONE, 0.0, 0.0, -G, 0.3, 0.5, 4.0, 1.0, 0.0, 0.0, x, 0.0, R,
             mesh_wall(mesh_of_text(mesh, "obj"), ", scale: 1e-3"));
    rig_start(&rig);
    rig_advance(&rig, 40 * STEPS_PER_MS);
    double weight = rig.grains.mass[0] * G;
    for (int64_t i = 0; i < rig.now.contacts.count; i++) {
        const OzContactEntry *e = &rig.now.contacts.entry[i];
        int k = fabs(e->point[0] - rests[1].x) < fabs(e->point[0] - rests[0].x);
        assert_within(e->point[0], rests[k].x, 1e-3 * R);
        found[k] += e->push / weight;
    }
    assert_within(found[0], rests[0].share, 1e-3);
    assert_within(found[1], rests[1].share, 1e-3);
    assert_within(rig.now.position[2], R, 1e-3 * R);
    rig_close(&rig);
}

static void rods_lie_on_edges(void **state)
{
    (void)state;
    /* across a beam of 2 mm, of eight triangles */
    expect_rest("v -1 -2 0\nv 0 -2 0\nv 1 -2 0\nv -1 0.1 0\nv 0 0.1 0\nv 1 0.1 0\n"
                "v -1 2 0\nv 0 2 0\nv 1 2 0\nf 1 2 5 4\nf 2 3 6 5\nf 4 5 8 7\nf 5 6 9 8\n",
                0.3e-3, (Rest[]){{-1e-3, 0.35}, {1e-3, 0.65}});
    /* on a table's edge: an end, and the shaft at the edge */
    expect_rest("v -4 -2 0\nv 0 -2 0\nv 0 2 0\nv -4 2 0\nf 1 2 3 4\n", -1.3e-3,
                (Rest[]){{-3.3e-3, 1.3 / 3.3}, {0, 2 / 3.3}});
    /* on a ridge of two roofs */
    expect_rest("v 0 -4 0\nv 0 4 0\nv -2 4 -1\nv -2 -4 -1\nf 1 2 3 4\n"
                "v 2 -4 -1\nv 2 4 -1\nf 1 5 6 2\n",
                0, (Rest[]){{0, 1}, {9, 0}});
}

static const char crowd[] =
    "model: rods\nprecision: %s\ntime: {step: 1e-5, duration: 1}\nintegrator: velocity-verlet\n"
    "observe: {ledger: true}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4}\ngrains:\n"
    "  - {kind: random, count: 50, diameter: 0.6e-3, aspect: 2, fill: 0.2}\n"
    "  - {kind: random, count: 20, diameter: 0.6e-3, fill: 0.2}\n"
    "walls:\n"
    "  - {kind: mesh, path: '%s', scale: 2.5e-3, point: [0, 0, 1e-3],"
    " motion: {direction: [1, 0, 1], frequency: 200, amplitude: 1e-4}}\n"
    "  - {kind: mesh, path: '%s', scale: 1e-3, point: [0, 0, 1e-3], two_sided: true}\n";

enum { STEPS = 200, LONG = 4000 };

static void assert_held(const OzSnapshot *now)
{
    for (int64_t i = 0; i < now->count; i++) {
        for (int k = 0; k < 3; k++) {
            double x = now->position[3 * i + k] - (k == 2 ? 1e-3 : 0);
            assert_true(fabs(x) < 2.5e-3 - 0.2e-3);
        }
    }
}

/* As in test_containers: after 200 steps with hits rounding has grown a thousandfold; a wrong term
 * shows in the first digits. Random grains are put inside, and none leaks. */
static void the_device_does_as_the_reference(void **state)
{
    (void)state;
    const char *box = mesh_of_text(mesh_box, "obj"), *inner = mesh_of_text(mesh_fence, "OBJ");
    const char *const precisions[] = {"double", "float"};
    const double tolerances[] = {1e-9, 1e-3};
    for (int k = 0; k < 2; k++) {
        Rig rig;
        OzDevice device = shaped_device(NATIVE);
        device.small_most = k ? OZ_DEVICE_SMALL_MOST : 0; /* in tiles, too */
        rig_open(&rig, crowd, precisions[k], box, inner);
        throw_grains(&rig.grains, 0.8, 20);
        OzSim *sim = start_sim(&rig, &device);
        OzSnapshot seen = state_at(&rig, sim, STEPS);
        rig_start(&rig);
        assert_held(&rig.now);
        rig_advance(&rig, STEPS);
        assert_true(farthest(seen.velocity, rig.now.velocity, 3 * seen.count) < tolerances[k]);
        assert_true(farthest(seen.position, rig.now.position, 3 * seen.count) < tolerances[k]);
        assert_true(oz_contact_list_sum(&seen.contacts).walls > 5);
        assert_int_equal(oz_contact_list_sum(&seen.contacts).walls,
                         oz_contact_list_sum(&rig.now.contacts).walls);
        double work = rig.now.ledger.work_walls;
        assert_true(fabs(work) > 1e-9 &&
                    fabs(seen.ledger.work_walls - work) < 1e2 * tolerances[k] * fabs(work));
        oz_snapshot_free(&seen);
        seen = state_at(&rig, sim, LONG);
        assert_held(&seen);
        oz_snapshot_free(&seen);
        oz_sim_free(sim);
        rig_close(&rig);
    }
}

/* A sphere that flies past an edge by less than its radius, by two thirds of that a step at most,
 * is turned away by it: without loss and friction as fast as it was. With 100 steps in a contact
 * velocity-verlet is right to (2 pi / 200)^2 of a deviation that comes back to a ten thousandth. */
static void fast_grains_do_not_slip_through_edges(void **state)
{
    (void)state;
    const char *path = mesh_of_text("v -4 -4 0\nv 4 -4 0\nv 0 0 0\nf 1 2 3\n", "obj");
    const double aside[] = {-0.3e-3, 0, 0.2e-3}; /* of the corner that points along y */
    for (int k = 0; k < 3; k++) {
        Rig rig;
        rig_open(&rig, ONE, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, aside[k], 0.2e-3, 1.5e-3,
                 mesh_wall(path, ", scale: 1e-3, two_sided: true"));
        rig.grains.velocity[2] = -0.8;
        rig_start(&rig);
        rig_advance(&rig, 4 * STEPS_PER_MS);
        const double *v = rig.now.velocity;
        assert_true(v[1] > 0.1);
        assert_within(sqrt(dot3(v, v)), 0.8, 1e-4 * 0.8);
        rig_close(&rig);
    }
}

/* A plate of one side lets grains pass from behind: that is where none should be. */
static void one_side_is_one_side(void **state)
{
    (void)state;
    const char *path = mesh_of_text("v -4 -4 0\nv 4 -4 0\nv 0 4 0\nf 1 2 3\n", "obj");
    for (int sides = 1; sides <= 2; sides++) {
        Rig rig;
        rig_open(&rig, ONE, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -R * 0.99,
                 mesh_wall(path, sides == 2 ? ", scale: 1e-3, two_sided: true" : ", scale: 1e-3"));
        rig_start(&rig);
        assert_int_equal(rig.now.contacts.count, sides - 1);
        rig_close(&rig);
    }
}

/* A sphere among rods has no second end: it touches once, as hard as on a plane. */
static void spheres_among_rods_touch_once(void **state)
{
    (void)state;
    const char *path = mesh_of_text("v -9 -9 0\nv 9 -9 0\nv 0 9 0\nf 1 2 3\n", "obj");
    const char *walls[] = {"{kind: plane}", mesh_wall(path, ", scale: 1e-3") + 4};
    double push[2];
    for (int k = 0; k < 2; k++) {
        Rig rig;
        rig_open(&rig,
                 "model: rods\nprecision: double\ngravity: [0, 0, 0]\n"
                 "time: {step: 2e-6, duration: 10}\ncontact: {contact_time: 2e-4, restitution: "
                 "0.3, friction: 0}\ngrains:\n"
                 "  - {kind: single, diameter: 1e-3, position: [0, 0, %g]}\n"
                 "  - {kind: single, diameter: 1e-3, aspect: 2, position: [0, 0, 5e-3]}\n"
                 "walls:\n  - %s\n",
                 R * 0.99, walls[k]);
        rig_start(&rig);
        assert_int_equal(rig.now.contacts.count, 1);
        push[k] = rig.now.contacts.entry[0].push;
        rig_close(&rig);
    }
    assert_within(push[1], push[0], 1e-12 * push[0]); /* rounding */
}

/* What is exported is as large as the mesh, and where it is. */
static void surfaces_are_exported(void **state)
{
    (void)state;
    Rig rig;
    OzSurface surface = {0};
    double high = 0;
    rig_open(&rig, ONE, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2e-3,
             mesh_wall(mesh_of_text(mesh_box, "obj"), ", scale: 3e-3, point: [0, 0, 1e-3]"));
    rig_start(&rig);
    must(oz_surface_add_walls(&surface, &rig.now));
    assert_int_equal(surface.cell_count, 12);
    for (int64_t i = 0; i < surface.point_count; i++) {
        high = fmax(high, (double)surface.points[3 * i + 2]);
    }
    assert_within(high, 4e-3, 1e-9);
    oz_surface_free(&surface);
    rig_close(&rig);
}

/* What slots remember is in the state: the same bits as without a stop; and so are the triangles.
 */
static void runs_go_on_from_states(void **state)
{
    (void)state;
    Rig rig, other;
    OzState saved = {0};
    OzDevice device = shaped_device(NATIVE);
    const char *box = mesh_of_text(mesh_box, "obj"), *inner = mesh_of_text(mesh_fence, "obj");
    rig_open(&rig, crowd, "float", box, inner);
    throw_grains(&rig.grains, 0.8, 20);
    OzSim *sim = start_sim(&rig, &device), *next = start_sim(&rig, &device);
    must(oz_sim_advance(sim, STEPS));
    OzStateVisit save = oz_state_save(&saved), load = oz_state_load(&saved);
    must(oz_sim_state_visit(sim, &save));
    must(oz_sim_state_visit(next, &load));
    OzSnapshot one = state_at(&rig, sim, 3 * STEPS), two = state_at(&rig, next, 3 * STEPS);
    assert_same_bits(&one, &two);
    assert_true(oz_contact_list_sum(&one.contacts).walls > 5);
    oz_snapshot_free(&one);
    oz_snapshot_free(&two);
    oz_sim_free(next);
    rig_open(&other, crowd, "float", mesh_of_text(mesh_moved, "obj"), inner);
    next = start_sim(&other, &device);
    load = oz_state_load(&saved);
    assert_int_equal(oz_sim_state_visit(next, &load), OZ_ERR_INPUT);
    oz_sim_free(next);
    oz_sim_free(sim);
    oz_state_free(&saved);
    rig_close(&other);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(joints_are_not_felt),
        cmocka_unit_test(a_sphere_lies_on_edges),
        cmocka_unit_test(rods_lie_on_edges),
        cmocka_unit_test(fast_grains_do_not_slip_through_edges),
        cmocka_unit_test(one_side_is_one_side),
        cmocka_unit_test(spheres_among_rods_touch_once),
        cmocka_unit_test(surfaces_are_exported),
        cmocka_unit_test(the_device_does_as_the_reference),
        cmocka_unit_test(runs_go_on_from_states),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
