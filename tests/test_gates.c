/* Walls that come and go: closed forms of single spheres on the host reference, and a crowd on the
 * device beside it. ORZO_NEEDS_DEVICE. */
#include "device_rig.h"

#include "draw/container.h"
#include "draw/framing.h"
#include "export/surface.h"

static const double PI = 3.14159265358979323846, G = 9.81, R = 0.5e-3, STEP = 2e-6;

/* Spheres of 1 mm in one wall or two, without friction. */
#define SPHERES                                                                                    \
    "model: rods\nprecision: double\ngravity: [0, 0, %g]\ntime: {step: 2e-6, duration: 10}\n"      \
    "integrator: %s\nobserve: {ledger: true}\n"                                                    \
    "contact: {contact_time: 2e-4, restitution: 0.3, friction: 0}\ngrains:\n%s\nwalls:\n%s\n"

static void assert_within(double a, double b, double most)
{
    if (!(fabs(a - b) <= most)) {
        fail_msg("%.9g is not %.9g within %g", a, b, most);
    }
}

static int64_t steps_of(double time)
{
    return llround(time / STEP);
}

/* What is left of the change of energy since `before` when all that the ledger knows is taken off.
 */
static double residual(const Rig *rig, double before)
{
    const OzLedger *l = &rig->now.ledger;
    return mechanical_energy(&rig->now) + l->elastic - before + l->dissipated + l->friction -
           l->work_walls;
}

/* A sphere has come to rest (to 1e-9 after 40 ms, test_containers.c) when its floor goes: it falls
 * freely from then on, and the floor takes along what it stored, (m g)^2 / (2 k). Forces end with
 * the step, or half a step earlier where grains move first. */
static void a_sphere_falls_when_its_floor_goes(void **state)
{
    (void)state;
    const double goes = 40e-3, later = 10e-3;
    for (int k = 1; k < INTEGRATORS; k++) {
        Rig rig;
        rig_open(&rig, SPHERES, -G, integrator_names[k],
                 "  - {kind: single, diameter: 1e-3, position: [0, 0, 0.5e-3]}",
                 "  - {kind: plane, until: 40e-3}");
        rig_start(&rig);
        double before = mechanical_energy(&rig.now) + rig.now.ledger.elastic;
        rig_advance(&rig, steps_of(goes) - 1);
        double high = rig.now.position[2], stored = rig.now.ledger.elastic;
        double stiffness = (pow(PI, 2) + pow(log(0.3), 2)) / pow(2e-4, 2); /* over mass, 1/s^2 */
        assert_int_equal(rig.now.contacts.count, 1);
        /* discrete equilibria of a linear spring lie where the continuous one does */
        assert_within(stored, rig.grains.mass[0] * G * G / (2 * stiffness), 1e-5 * stored);
        rig_advance(&rig, steps_of(goes));
        assert_int_equal(rig.now.contacts.count, 0);
        rig_advance(&rig, steps_of(goes + later));
        assert_within(rig.now.velocity[2], -G * later, G * STEP);
        assert_within(rig.now.position[2], high - 0.5 * G * later * later, G * later * STEP);
        assert_within(rig.now.ledger.work_walls, -stored, 1e-6 * stored);
        /* symplectic Euler counts a fall by half a step's way more or less, m g (g t) dt / 2 */
        double half_step = 0.5 * rig.grains.mass[0] * G * G * later * STEP;
        assert_within(residual(&rig, before), 0, k == 2 ? 1e-3 * stored : 1.01 * half_step);
        rig_close(&rig);
    }
}

/* A sheet comes at 90 ms: what has fallen through its place before falls on, what meets it later is
 * thrown back with 0.3 of its speed (to the weight's part in a hit, g 2e-4 s of 1 m/s). */
static void what_comes_later_is_met(void **state)
{
    (void)state;
    const double end = 110e-3, low = 0.02, high = 0.05;
    Rig rig;
    rig_open(&rig, SPHERES, -G, "velocity-verlet",
             "  - {kind: single, diameter: 1e-3, position: [-3e-3, 0, 0.0205]}\n"
             "  - {kind: single, diameter: 1e-3, position: [3e-3, 0, 0.0505]}",
             "  - {kind: rectangle, size: [0.02, 0.02], from: 90e-3}");
    rig_start(&rig);
    rig_advance(&rig, steps_of(end));
    assert_within(rig.now.position[2], R + low - 0.5 * G * end * end,
                  1e-9); /* exact but rounding */
    double hit = sqrt(2 * high / G), speed = sqrt(2 * G * high);
    assert_within(rig.now.velocity[5], 0.3 * speed - G * (end - hit), 5e-3 * speed);
    rig_close(&rig);
}

/* A wall that comes where a sphere is puts in what the contact stores, k depth^2 / 2, and all of it
 * is found again. Half a step's push is what symplectic Euler misses: speed x step over depth. */
static void a_wall_that_comes_does_work(void **state)
{
    (void)state;
    const double depth = 0.1 * R, comes = 1e-3;
    for (int k = 1; k < INTEGRATORS; k++) {
        Rig rig;
        rig_open(&rig, SPHERES, 0.0, integrator_names[k],
                 "  - {kind: single, diameter: 1e-3, position: [0, 0, 0.45e-3]}",
                 "  - {kind: plane, from: 1e-3}");
        rig_start(&rig);
        rig_advance(&rig, steps_of(comes) - 1);
        assert_true(rig.now.velocity[2] == 0 && rig.now.contacts.count == 0);
        rig_advance(&rig, steps_of(comes + 1e-3));
        double stiffness = (pow(PI, 2) + pow(log(0.3), 2)) / pow(2e-4, 2);
        double put_in = 0.5 * stiffness * rig.grains.mass[0] * depth * depth;
        assert_int_equal(rig.now.contacts.count, 0);
        assert_within(rig.now.ledger.work_walls, put_in, 1e-9 * put_in);
        assert_within(residual(&rig, 0), 0, 2 * STEP / 2e-4 * put_in);
        assert_true(rig.now.velocity[2] > 0);
        rig_close(&rig);
    }
}

/* A sphere lies on two sheets where they join and touches the first alone; when that goes it
 * touches the other one. */
static void a_joint_does_not_count_what_is_gone(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, SPHERES, -G, "velocity-verlet",
             "  - {kind: single, diameter: 1e-3, position: [0, 0, 0.5e-3]}",
             "  - {kind: rectangle, size: [4e-3, 4e-3], point: [-2e-3, 0, 0], until: 40e-3}\n"
             "  - {kind: rectangle, size: [4e-3, 4e-3], point: [2e-3, 0, 0]}");
    rig_start(&rig);
    for (int gone = 0; gone < 2; gone++) {
        rig_advance(&rig, steps_of(40e-3) - 1 + gone);
        assert_int_equal(rig.now.contacts.count, 1);
        assert_int_equal(rig.now.contacts.entry[0].b, -1 - gone);
        /* it still lies as deep as at rest */
        assert_within(rig.now.contacts.entry[0].push, rig.grains.mass[0] * G,
                      1e-6 * rig.grains.mass[0] * G);
    }
    rig_close(&rig);
}

/* A gate and a floor are two rectangles in files for other programs, and two fills of six corners
 * in pictures, lines left out; without the gate one. */
static void a_gate_that_is_gone_is_not_shown(void **state)
{
    (void)state;
    Rig rig;
    rig_open(&rig, SPHERES, 0.0, "symplectic-euler",
             "  - {kind: single, diameter: 1e-3, position: [1e-3, 0, 2e-3]}",
             "  - {kind: rectangle, size: [8e-3, 8e-3]}\n"
             "  - {kind: rectangle, size: [4e-3, 4e-3], normal: [1, 0, 0], edge: [0, 1, 0], "
             "point: [0, 0, 2e-3], until: 1e-4}");
    rig_start(&rig);
    OzLook look = oz_framing_look(&rig.scene, &rig.now);
    for (int gone = 0; gone < 2; gone++) {
        OzSurface surface = {0};
        OzContainer container = {.high = 0};
        OzCamera camera = oz_camera_make(&look, 0);
        size_t corners = 0;
        rig_advance(&rig, gone ? 50 : 49);
        must(oz_surface_add_walls(&surface, &rig.now));
        must(oz_container_build(&container, &rig.now, &look, &camera, OZ_VIEW_LATERAL));
        for (int mesh = 0; mesh < OZ_CONTAINER_COUNT; mesh++) {
            const OzMesh *m = &container.meshes[mesh];
            for (size_t i = 0; i < m->count; i++) {
                corners += m->corners[i].rgba[3] < 0.9F; /* rims of sheets are not so clear */
            }
        }
        assert_int_equal(surface.cell_count, gone ? 1 : 2);
        assert_int_equal(corners, gone ? 6 : 12);
        oz_surface_free(&surface);
        oz_container_free(&container);
    }
    rig_close(&rig);
}

/* Corners of glass in one of a container's meshes; lines are less clear. */
static int count_glass(const OzContainer *container, int mesh)
{
    int count = 0;
    for (size_t i = 0; i < container->meshes[mesh].count; i++) {
        count += container->meshes[mesh].corners[i].rgba[3] < 0.6F;
    }
    return count;
}

/* A box is six panes of two triangles, of which front and lid are before the grains when seen from
 * a little above; a closed drum is a band and two discs of 96 quads each. */
static void closed_containers_are_of_glass(void **state)
{
    (void)state;
    static const char *const walls[] = {
        "  - {kind: box, size: [8e-3, 6e-3, 5e-3]}",
        "  - {kind: cylinder, diameter: 8e-3, axis: [0, 1, 0], length: 5e-3, ends: closed}"};
    for (int round = 0; round < 2; round++) {
        Rig rig;
        OzContainer container = {.high = 0};
        rig_open(&rig, SPHERES, 0.0, "symplectic-euler",
                 "  - {kind: single, diameter: 1e-3, position: [0, 1e-3, 2e-3]}", walls[round]);
        rig_start(&rig);
        OzLook look = oz_framing_look(&rig.scene, &rig.now);
        OzCamera camera = oz_camera_make(&look, 0);
        must(oz_container_build(&container, &rig.now, &look, &camera, OZ_VIEW_LATERAL));
        int behind = count_glass(&container, OZ_CONTAINER_BEHIND);
        int before = count_glass(&container, OZ_CONTAINER_BEFORE);
        assert_int_equal(before + behind, round ? 3 * 96 * 6 : 36);
        assert_true(round ? before > 96 * 6 : before == 12);
        oz_container_free(&container);
        rig_close(&rig);
    }
}

/* How far up the picture glass, or lines, of a container reach, view coordinates. */
static double highest_of(const OzContainer *container, bool glass)
{
    double high = -INFINITY;
    for (int mesh = 0; mesh < OZ_CONTAINER_COUNT; mesh++) {
        const OzMesh *m = &container->meshes[mesh];
        for (size_t i = 0; i < m->count; i++) {
            bool is_glass = m->corners[i].rgba[3] < 0.6F;
            high = is_glass == glass ? fmax(high, (double)m->corners[i].place[1]) : high;
        }
    }
    return high;
}

/* A box that has turned by half a radian: its glass ends at its edges, to the width of a line, a
 * hundredth of the picture; as built it would end a fifth lower. */
static void glass_turns_with_its_box(void **state)
{
    (void)state;
    Rig rig;
    OzContainer container = {.high = 0};
    rig_open(&rig, SPHERES, 0.0, "symplectic-euler",
             "  - {kind: single, diameter: 0.2e-3, position: [0, 0, 2e-3]}",
             "  - {kind: box, size: [8e-3, 6e-3, 5e-3], motion: {angular_velocity: 1e3, axis: [0, "
             "1, 0]}}");
    rig_start(&rig);
    rig_advance(&rig, 50);
    OzLook look = oz_framing_look(&rig.scene, &rig.now);
    OzCamera camera = oz_camera_make(&look, 0);
    must(oz_container_build(&container, &rig.now, &look, &camera, OZ_VIEW_LATERAL));
    double glass = highest_of(&container, true), lines = highest_of(&container, false);
    assert_true(fabs(glass - lines) < 0.01);
    oz_container_free(&container);
    rig_close(&rig);
}

/* Rods and spheres, or spheres alone, fly about between walls of which a sheet and a cylinder go,
 * and a sphere and another sheet come, in the middle of hits. */
static const char crowd[] =
    "model: rods\nprecision: %s\ntime: {step: 1e-5, duration: 1}\nintegrator: %s\n"
    "observe: {ledger: true}\nguards: {overlap: {stop: 2}}\n"
    "contact: {contact_time: 3e-4, restitution: 0.5, friction: 0.4}\ngrains:\n"
    "  - {kind: random, count: 40, diameter: 0.6e-3, aspect: %d, fill: 0.2}\n"
    "  - {kind: random, count: 20, diameter: 0.6e-3, fill: 0.2}\n"
    "walls:\n"
    "  - {kind: box, size: [5e-3, 5e-3, 8e-3], point: [0, 0, -4e-3]}\n"
    "  - {kind: cylinder, diameter: 5e-3, until: 6.5e-4}\n"
    "  - {kind: sphere, diameter: 8.6e-3, from: 4e-4}\n"
    "  - {kind: rectangle, size: [3e-3, 3e-3], until: 9e-4}\n"
    "  - {kind: rectangle, size: [3e-3, 1e-3], point: [0, 2e-3, 3.4e-3], from: 3e-4, until: "
    "1.2e-3}\n";

enum { STEPS = 150 };

/* Rounding grows a thousandfold in 150 steps with hits; a wall that came or went a step early shows
 * in the third digit. */
static void the_device_does_as_the_reference(void **state)
{
    (void)state;
    const char *const precisions[] = {"double", "float"};
    const double tolerances[] = {1e-9, 1e-3};
    for (int k = 0; k < 2; k++) {
        Rig rig;
        rig_open(&rig, crowd, precisions[k], k ? "symplectic-euler" : "velocity-verlet", 2 * k);
        throw_grains(&rig.grains, 0.8, 20);
        OzSnapshot seen = state_after(&rig, NATIVE, STEPS);
        rig_start(&rig);
        rig_advance(&rig, STEPS);
        double work = rig.now.ledger.work_walls;
        assert_true(farthest(seen.velocity, rig.now.velocity, 3 * seen.count) < tolerances[k]);
        assert_true(farthest(seen.position, rig.now.position, 3 * seen.count) < tolerances[k]);
        assert_int_equal(oz_contact_list_sum(&seen.contacts).walls,
                         oz_contact_list_sum(&rig.now.contacts).walls);
        assert_true(fabs(work) > 1e-9 &&
                    fabs(seen.ledger.work_walls - work) < 1e2 * tolerances[k] * fabs(work));
        oz_snapshot_free(&seen);
        rig_close(&rig);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_falls_when_its_floor_goes),
        cmocka_unit_test(what_comes_later_is_met),
        cmocka_unit_test(a_wall_that_comes_does_work),
        cmocka_unit_test(a_joint_does_not_count_what_is_gone),
        cmocka_unit_test(a_gate_that_is_gone_is_not_shown),
        cmocka_unit_test(closed_containers_are_of_glass),
        cmocka_unit_test(glass_turns_with_its_box),
        cmocka_unit_test(the_device_does_as_the_reference),
    };
    return cmocka_run_group_tests(tests, open_rig_device, close_rig_device);
}
